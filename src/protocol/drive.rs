//! The loop over load steps: apply, solve, observe, stop.

use crate::math::Vec3;
use crate::model::{JointLaws, Outcome, Wall};
use crate::protocol::{Ends, Protocol};
use crate::solve::Solver;

/// What was observed at the end of one load step.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadStep {
    /// Load factor: 0 under gravity alone, 1 at the full load.
    pub load_factor: f64,
    /// Largest out-of-plane (+y) displacement at the wall's top since the end of the gravity step (m).
    pub top_displacement: f64,
    /// Unbalanced force ratio reached.
    pub unbalanced_ratio: f64,
    /// Time steps (explicit) or iterations (implicit) that the step took.
    pub solver_steps: u64,
}

/// How the evaluation of one wall went.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// How it ended.
    pub outcome: Outcome,
    /// One entry per load step begun, gravity first.
    pub steps: Vec<LoadStep>,
    /// Displacement of every block's centroid (m) from its position as built, by block id.
    pub displacements: Vec<Vec3>,
    /// Number of joints found at rest.
    pub joints: usize,
}

/// Takes a wall through a protocol: gravity first, then the load in steps.
pub fn run(
    _wall: &Wall,
    _laws: &dyn JointLaws,
    _protocol: &Protocol,
    _ends: Ends,
    _sub_contacts: [u32; 2],
    _solver: &Solver,
) -> Run {
    unimplemented!()
}
