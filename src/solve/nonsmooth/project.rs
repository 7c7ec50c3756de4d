//! Overlaps pushed apart, apart from velocities.
//!
//! Joints are followed on velocities, whose error grows with the square of the step: stones come to overlap by some nanometres. They are
//! moved apart by the least motion in the norm of the masses, without friction: `min 1/2 d M d` such that `g + n . H^T d >= 0`. Velocities
//! stay as they are: an overlap that was pushed out with the speed `g / h` would give the stones energy.

use crate::math::Vec3;
use crate::solve::Assembly;
use crate::solve::nonsmooth::Normal;
use crate::solve::nonsmooth::contacts::Contacts;
use crate::solve::nonsmooth::newton::{Kept, Start, newton};
use crate::solve::nonsmooth::point::Bearing;
use crate::solve::nonsmooth::problem::{Inertia, Problem, masses};
use crate::solve::system::{DOF, System};

/// Accuracy of the motion, over a unit of the overlap at the mean mass.
const TOLERANCE: f64 = 1e-6;
/// Factorisations.
const MOST: u32 = 50;
/// Share of the overlap that stays: faces that are pushed just apart would have lost one another.
const STAYS: f64 = 0.5;

/// Pushes joints apart that overlap by more than `enough` (m). The largest overlap (m) and the work (J) that it did against the loads; `None`
/// where there is nothing to do, or it cannot be done.
pub(super) fn project(
    assembly: &mut Assembly<'_>,
    contacts: &Contacts,
    (system, kept): (&mut System, &mut Kept),
    enough: f64,
) -> Option<(f64, f64)> {
    let bodies = &assembly.bodies.all;
    let overlap = contacts.overlap(&assembly.joints, bodies);
    if overlap <= enough {
        return None;
    }
    let none = [[0.0; DOF]; DOF];
    let inertias: Vec<Inertia> = bodies.iter().map(|body| Inertia::of(body, &body.rotation, &none)).collect();
    let mut points = contacts.points(&assembly.joints, (bodies, bodies), &inertias, Normal::Gap, (1.0, 1.0));
    for point in &mut points {
        (point.friction, point.cohesion, point.least) = (0.0, 0.0, 0.0);
        // What overlaps is brought to a share of what is allowed; the rest must not come to overlap.
        let offset =
            if point.gap < 0.0 { point.gap.min(-STAYS * enough) + STAYS * enough } else { point.gap };
        point.bearing = Bearing::Rigid { offset };
    }
    let (_, mean_mass) = masses(bodies);
    let free = vec![0.0; DOF * bodies.len()];
    let start = vec![[0.0; 3]; points.len()];
    let problem = Problem {
        inertias,
        free: free.clone(),
        points,
        step: 1.0,
        weight: mean_mass * overlap,
        fastest: overlap,
        mean_mass,
    };
    // What the last step's matrix was for is nothing here, and what this one is for nothing to the next step.
    *kept = Kept::default();
    let start = Start { velocities: &free, impulses: &start, weight: 0.0 };
    let solved = newton(&problem, (system, kept), bodies, start, (TOLERANCE, MOST))?;
    *kept = Kept::default();
    let moved = problem.velocities(&solved.impulses);
    let mut work = 0.0;
    for (b, body) in assembly.bodies.all.iter_mut().enumerate().filter(|(_, body)| body.moves()) {
        let d = &moved[DOF * b..DOF * b + DOF];
        let (shift, turn) = (Vec3::new(d[0], d[1], d[2]), Vec3::new(d[3], d[4], d[5]));
        let from = body.clone();
        body.place(&from, &shift, &turn);
        work -= body.force.dot(&shift) + body.torque.dot(&turn);
    }
    Some((overlap, work))
}
