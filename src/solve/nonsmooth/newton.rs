//! Newton's method for the problem of a step.
//!
//! Impulses are those of the augmented Lagrangian, `r = P(from - rho u)`, with a large weight `rho`: the balance `M (v - free) = H r(v)` is a
//! semismooth equation of the velocities alone, regular however many contacts a stone has. It is solved by Newton's method with a line search;
//! then `from` becomes `r`, until that changes nothing. One sparse factorisation an iteration; a few serve, however many courses a wall has,
//! as nothing travels from contact to contact.

use crate::math::Vec3;
use crate::solve::bodies::Body;
use crate::solve::nonsmooth::point::{Point, Slope, State};
use crate::solve::nonsmooth::problem::wrench;
use crate::solve::nonsmooth::{Friction, Problem, Residual};
use crate::solve::system::{DOF, System};

/// Largest weight of the velocity over the inertia at a point. Each update of the impulses takes the error off by about as much, times how little
/// the contacts are coupled.
const WEIGHT: f64 = 1e6;
/// A step begins with the weight with which the last one ended, as long as every iteration takes off half: that suits a start as near as that
/// one's end. Where a stone hits or begins to slide, it throws Newton's method off its way, and the step begins anew with this weight. It grows by
/// this factor.
const FIRST: f64 = 1e3;
const GROWS: f64 = 10.0;
/// So many iterations in a row that take off less than half are too slow.
const SLOW: u32 = 6;
/// A weight with which it lost its way is not tried again before so many updates have come off.
const TRUSTED: u32 = 2;
/// What is left within this factor of the unbalance asked for is rounding.
const BALANCED: f64 = 1e4;
/// Velocities are rounded by so much, and the weight multiplies it: in fast motion it is less.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// A step of Newton's method is halved at most so often.
const HALVINGS: u32 = 8;
/// A step that takes off less than this share of the unbalance times its length is too long.
const DECREASE: f64 = 1e-2;
/// It goes on below the tolerance, as that costs little: to this share of it, or until so many updates have left more than a share. Impulses
/// that hardly any motion decides creep from contact to contact for dozens of updates.
const AIM: f64 = 0.1;
const IDLE: u32 = 3;
const LEFT: f64 = 0.7;
/// Newton's iterations between two updates of the impulses end at this share of the tolerance.
const INNER: f64 = 1e-2;
/// A matrix from before serves as long as it takes off all but so much.
const SERVES: f64 = 1e-4;

/// What Newton's method came to.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub impulses: Vec<[f64; 3]>,
    pub residual: Residual,
    /// Factorisations.
    pub factorisations: u32,
    /// The weight with which it got there: the next step tries it first.
    pub weight: f64,
}

/// Where the method begins: velocities of the bodies (six each), impulses of the points, and the weight.
pub(super) struct Start<'s> {
    pub velocities: &'s [f64],
    pub impulses: &'s [[f64; 3]],
    pub weight: f64,
}

/// For which matrix the system is factorised. It is forgotten when contacts are looked for anew.
#[derive(Clone, Debug, Default)]
pub(super) struct Kept {
    states: Vec<State>,
    weight: f64,
    step: f64,
}

impl Kept {
    fn serves(&self, states: &[State], weight: f64, step: f64) -> bool {
        self.weight == weight && self.step == step && self.states == states
    }
}

/// The point at which a set of velocities is looked at.
struct Trial {
    v: Vec<f64>,
    impulses: Vec<[f64; 3]>,
    states: Vec<State>,
    unbalance: Vec<f64>,
    energy: f64,
}

/// Solves a problem from velocities and impulses nearby. What is reached in the end is in [`Solved::residual`]; `None` where a matrix is singular.
///
/// The weight grows from update to update. Where Newton's method loses its way it starts again from the last update with less, and the weight
/// stays below the one that failed until it has proved itself.
pub(super) fn newton(
    problem: &Problem,
    (system, kept): (&mut System, &mut Kept),
    bodies: &[Body],
    start: Start<'_>,
    (tolerance, max_iterations): (f64, u32),
) -> Option<Solved> {
    let mut from = start.impulses.to_vec();
    let mut v = start.velocities.to_vec();
    // Of a body of the mean mass the impulse of the tolerance must be more than what the weight makes of the rounding.
    let limit = 0.1 * AIM * tolerance * problem.weight / (problem.mean_mass * ROUNDING * problem.fastest);
    // In powers of ten, so that the matrix of one step serves the next.
    let mut most = WEIGHT;
    while most > limit {
        most /= GROWS;
    }
    let (mut weight, mut allowed) = (most.min(start.weight.max(FIRST)), most);
    // An impulse of the tolerance on a body of the mean mass.
    let unit = problem.weight * problem.weight / problem.mean_mass;
    let share = INNER * tolerance;
    let enough = 0.5 * unit * share * share;
    let (mut factorisations, mut updates, mut idle, mut trusted) = (0, 0, 0, 0);
    let mut best: Option<Solved> = None;
    loop {
        let mut now = Trial::at(problem, v.clone(), &from, weight);
        let mut slow = 0;
        let tries = updates == 0 && weight > FIRST;
        while now.energy > enough && slow < SLOW && factorisations < max_iterations {
            // The matrix of the last step serves where points stick, slide and open as they did there, if it takes off well.
            if kept.serves(&now.states, weight, problem.step) {
                let change = system.solve(&now.unbalance);
                let v = now.v.iter().zip(&change).map(|(v, change)| v - change).collect();
                let next = Trial::at(problem, v, &from, weight);
                if next.energy < SERVES * now.energy {
                    now = next;
                    continue;
                }
            }
            system.clear();
            let slides = assemble(problem, system, bodies, (&now, &from, weight));
            system.factorise(!slides)?;
            factorisations += 1;
            *kept = Kept { states: now.states.clone(), weight, step: problem.step };
            let change = system.solve(&now.unbalance);
            let next = search(problem, &now, &change, &from, weight);
            // A kink at which no length takes anything off is left by the update with less weight: beyond it lies no better place.
            if next.energy >= now.energy {
                break;
            }
            slow = if next.energy > 0.5 * now.energy { slow + 1 } else { 0 };
            now = next;
            if tries && slow > 0 {
                break;
            }
        }
        updates += 1;
        let velocities = problem.velocities(&now.impulses);
        let residual = Residual::of(problem, Friction::Coulomb, &velocities, &now.impulses);
        let before = best.as_ref().map_or(f64::INFINITY, |best| best.residual.natural_map);
        idle = if residual.natural_map < LEFT * before { 0 } else { idle + 1 };
        if best.is_none() || residual.natural_map < before {
            best = Some(Solved { impulses: now.impulses.clone(), residual, factorisations, weight });
        }
        let reached = best.as_ref().map_or(f64::INFINITY, |best| best.residual.natural_map);
        let is_enough = reached <= AIM * tolerance || (reached <= tolerance && idle >= IDLE);
        if is_enough || factorisations >= max_iterations || updates >= max_iterations {
            return best.map(|best| Solved { factorisations, ..best });
        }
        if now.energy <= BALANCED * enough {
            (from, v) = (now.impulses, now.v);
            trusted += 1;
            if trusted >= TRUSTED {
                allowed = most.min(GROWS * allowed);
            }
            weight = allowed.min(GROWS * weight);
        } else if tries {
            weight = most.min(FIRST);
        } else {
            (allowed, trusted) = (weight / GROWS, 0);
            weight /= GROWS * GROWS;
        }
    }
}

impl Trial {
    fn at(problem: &Problem, v: Vec<f64>, from: &[[f64; 3]], weight: f64) -> Trial {
        let response = |(point, from): (&Point, &[f64; 3])| {
            let response = point.response(&point.relative_velocity(&v), from, weight * point.inertia);
            (response.impulse, response.state)
        };
        let (impulses, states): (Vec<[f64; 3]>, Vec<State>) =
            problem.points.iter().zip(from).map(response).unzip();
        let unbalance = problem.unbalance(&v, &impulses);
        let energy = problem.energy(&unbalance);
        Trial { v, impulses, states, unbalance, energy }
    }
}

/// Goes along a change of the velocities, as far as that takes unbalance off.
fn search(problem: &Problem, now: &Trial, change: &[f64], from: &[[f64; 3]], weight: f64) -> Trial {
    let mut length = 1.0;
    let mut best: Option<Trial> = None;
    for _ in 0..=HALVINGS {
        let v = now.v.iter().zip(change).map(|(v, change)| v - length * change).collect();
        let next = Trial::at(problem, v, from, weight);
        let enough = next.energy <= (1.0 - DECREASE * length) * now.energy;
        if best.as_ref().is_none_or(|best| next.energy < best.energy) {
            best = Some(next);
        }
        if enough {
            break;
        }
        length *= 0.5;
    }
    best.expect("one length at least was tried")
}

/// The derivative of the unbalance with the velocities; says whether a point slides, which makes it unsymmetric.
fn assemble(
    problem: &Problem,
    system: &mut System,
    bodies: &[Body],
    (now, from, weight): (&Trial, &[[f64; 3]], f64),
) -> bool {
    let mut slides = false;
    let points = || problem.points.iter().zip(from).zip(&now.states);
    let mut at = 0;
    while at < problem.points.len() {
        let joint = problem.points[at].joint;
        let end = at + problem.points[at..].iter().take_while(|point| point.joint == joint).count();
        let first = &problem.points[at];
        let mut sum = [[0.0; DOF]; DOF];
        let mut touches = false;
        for ((point, from), state) in points().skip(at).take(end - at) {
            let slope = point.slope(&point.relative_velocity(&now.v), from, weight * point.inertia);
            if slope != Slope::default() {
                slides |= *state == State::Slides && point.friction > 0.0;
                touches = true;
                add(&mut sum, &(point.arms[0] - first.arms[0]), &point.axes, &slope);
            }
        }
        if touches {
            system.add_joint(joint, bodies, &both(&sum, &first.arms));
        }
        at = end;
    }
    for (b, inertia) in problem.inertias.iter().enumerate() {
        system.add_own(b, &inertia.matrix);
        inertia.held.iter().for_each(|&k| system.hold(b, k, inertia.matrix[k][k]));
    }
    slides
}

/// Adds to the slope of force and moment about a joint's first point by its relative velocity and spin.
fn add(sum: &mut [[f64; DOF]; DOF], offset: &Vec3, axes: &[Vec3; 3], slope: &Slope) {
    // The velocity at the point along its axes: `axis . (u + w x d) = axis . u + (d x axis) . w`.
    let rows = axes.map(|axis| wrench(offset, &axis));
    for (k, row) in rows.iter().enumerate() {
        for (l, column) in rows.iter().enumerate().filter(|(l, _)| slope[k][*l] != 0.0) {
            for (sums, row) in sum.iter_mut().zip(row) {
                sums.iter_mut().zip(column).for_each(|(sum, column)| *sum += slope[k][l] * row * column);
            }
        }
    }
}

/// The same for the velocities of the two bodies, from whose centroids the arms lead to the point.
fn both(sum: &[[f64; DOF]; DOF], arms: &[Vec3; 2]) -> [[f64; 2 * DOF]; 2 * DOF] {
    // u = v - a x w for the incident body, and the negative for the reference body.
    let columns: [[f64; DOF]; 2 * DOF] = std::array::from_fn(|c| {
        let (arm, sign) = if c < DOF { (&arms[0], 1.0) } else { (&arms[1], -1.0) };
        let unit = Vec3::ith(c % 3, sign);
        match c % DOF {
            0..3 => [unit.x, unit.y, unit.z, 0.0, 0.0, 0.0],
            _ => {
                let u = unit.cross(arm);
                [u.x, u.y, u.z, unit.x, unit.y, unit.z]
            }
        }
    });
    let half: [[f64; DOF]; 2 * DOF] = columns
        .map(|column| std::array::from_fn(|row| sum[row].iter().zip(&column).map(|(a, b)| a * b).sum()));
    std::array::from_fn(|row| {
        std::array::from_fn(|column| columns[row].iter().zip(&half[column]).map(|(a, b)| a * b).sum())
    })
}
