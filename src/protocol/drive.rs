//! The loop over load steps: apply, solve, observe, stop.

use crate::contact;
use crate::math::{Vec3, cbrt};
use crate::model::{JointLaws, Level, Outcome, Wall};
use crate::protocol::observe::{displacements, out_of_plane, top_points};
use crate::protocol::pressure::back_loads;
use crate::protocol::restraint::{Surroundings, restrain};
use crate::protocol::{Ends, Protocol};
use crate::solve::explicit::Simulation;
use crate::solve::{Solver, Status};

/// What was observed at the end of one load step.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadStep {
    /// Load factor: 0 under gravity alone, 1 at the full load.
    pub load_factor: f64,
    /// Largest out-of-plane (+y) displacement at the wall's top since the end of the gravity step (m).
    pub top_displacement: f64,
    /// Unbalanced force ratio reached.
    pub unbalanced_ratio: f64,
    /// Time steps that the load step took.
    pub solver_steps: u64,
}

/// How the evaluation of one wall went.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// How it ended.
    pub outcome: Outcome,
    /// One entry per load step begun, gravity first.
    pub steps: Vec<LoadStep>,
    /// Displacement of every stone's centroid (m) from its position as built, by block id.
    pub displacements: Vec<Vec3>,
    /// Number of joints found at rest.
    pub joints: usize,
}

/// Takes a wall of stones through a protocol: gravity first, then the load in equal steps.
///
/// `wall` holds the stones only; the base and the ends are added here as `ends` says. `sub_contacts` counts the
/// sub-contacts of a joint along its longer and its shorter extent.
pub fn run(
    wall: &Wall,
    laws: &dyn JointLaws,
    protocol: &Protocol,
    ends: Ends,
    sub_contacts: [u32; 2],
    solver: &Solver,
) -> Run {
    let Protocol::Lateral(lateral) = protocol;
    let Solver::Explicit(settings) = solver;
    let surroundings = Surroundings { laws, ends, first_added: wall.blocks.len() as u32 };
    let assembly = restrain(wall, ends);
    let contact = contact::Settings::for_size(typical_size(wall), sub_contacts);
    let mut simulation = Simulation::new(&assembly, &surroundings, *settings, contact);
    let joints = simulation.assembly.joints.all.len();
    // Once, in the positions as built: from then on each load moves with its stone.
    for load in back_loads(wall, lateral) {
        simulation.assembly.add_load(load.block, load.point, load.force);
    }
    let top = top_points(wall);
    let base_thickness = wall.bounds().1.y - wall.bounds().0.y;
    let limit = lateral.collapse_share * base_thickness;

    let mut at_rest = displacements(&assembly, &simulation.assembly.bodies, &top);
    let mut steps = Vec::new();
    let mut outcome = Outcome::Equilibrium;
    for step in 0..=lateral.steps {
        let load_factor = f64::from(step) / f64::from(lateral.steps.max(1));
        simulation.assembly.load_factor = load_factor;
        let before = simulation.steps;
        let (status, unbalanced_ratio) = simulation
            .relax(|bodies| out_of_plane(&displacements(&assembly, bodies, &top), &at_rest).1 > limit);
        let now = displacements(&assembly, &simulation.assembly.bodies, &top);
        if step == 0 {
            at_rest.clone_from(&now);
        }
        steps.push(LoadStep {
            load_factor,
            top_displacement: out_of_plane(&now, &at_rest).0,
            unbalanced_ratio,
            solver_steps: simulation.steps - before,
        });
        let at = Level::Factor(load_factor);
        outcome = match status {
            Status::Equilibrium => Outcome::Equilibrium,
            Status::Stopped if step == 0 => Outcome::UnstableAtRest,
            Status::Stopped => Outcome::Collapsed { at },
            Status::StepsSpent | Status::NoEquilibrium => {
                Outcome::NotConverged { at, unbalanced_ratio, why: "the steps ran out".to_string() }
            }
            Status::NonFinite => Outcome::NonFinite { at },
        };
        if outcome != Outcome::Equilibrium {
            break;
        }
    }
    let displacements = simulation
        .assembly
        .bodies
        .all
        .iter()
        .zip(&assembly.blocks)
        .take(wall.blocks.len())
        .map(|(body, block)| body.position - block.shape.mass_properties().centroid)
        .collect();
    Run { outcome, steps, displacements, joints }
}

/// Edge of the cube with a stone's mean volume (m): the length to which contact tolerances are scaled.
fn typical_size(wall: &Wall) -> f64 {
    let (count, volume) =
        wall.stones().fold((0u32, 0.0), |(n, v), (_, block)| (n + 1, v + block.shape.volume()));
    cbrt(volume / f64::from(count.max(1)))
}
