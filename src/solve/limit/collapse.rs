//! What came of a limit analysis: multiplier, mechanism, thrust, and how accurate they are.

use crate::math::Vec3;
use crate::model::Outcome;
use crate::solve::limit::Flow;
use crate::solve::limit::audit::world_forces;
use crate::solve::limit::program::{Program, Solved};

/// The result of a limit analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// How it ended.
    pub outcome: Outcome,
    /// The largest multiplier found: tan of the angle for tilt; the largest asked for when the wall stands to the end; the
    /// largest share of its dead loads that it bears when it is unstable at rest.
    pub multiplier: f64,
    /// The flow rule, and so what the multiplier is (see [`Flow::meaning`]).
    pub flow: Flow,
    /// Velocities of the collapse mechanism by block, scaled so that the fastest corner of a joint moves at 1 m/s; all
    /// zero when there is none.
    pub mechanism: Vec<BlockMotion>,
    /// The force that each joint carries in the state found; one of many when the wall is statically indeterminate.
    pub thrust: Vec<Thrust>,
    /// What forces and mechanism are worth, recomputed.
    pub accuracy: Accuracy,
    /// Iterations of the conic solver, over all programs solved.
    pub iterations: u32,
    /// What is known of the multiplier where it was not found: between these. With associative flow from a state in
    /// equilibrium and a mechanism that agree too little, so that the true one is between; without dilatancy where the search
    /// went last, which bounds nothing. `None` where even that is not known.
    pub between: Option<[f64; 2]>,
    /// The search for a state without dilatancy, for [`Flow::NonAssociative`].
    pub fixed_point: Option<FixedPoint>,
}

/// Velocity of a block in the mechanism.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BlockMotion {
    /// Velocity of the centroid (m/s), world axes; for a part of a stone that of the stone.
    pub velocity: Vec3,
    /// Angular velocity (rad/s), world axes.
    pub spin: Vec3,
}

/// What a joint carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thrust {
    /// The two blocks, lower id first; the first part of a stone for all of its parts.
    pub blocks: (u32, u32),
    /// Force (N) on the second block.
    pub force: Vec3,
    /// Where its normal part acts (m); `None` for a joint that carries less than 1e-9 of a block's weight.
    pub at: Option<Vec3>,
}

/// How accurate a solution is, recomputed from its forces and velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Largest unbalanced force, or moment over the block's radius, over the blocks' mean weight.
    pub residual: f64,
    /// Largest excess of a contact force over its strength, over the blocks' mean weight.
    pub excess: f64,
    /// Largest breach of the flow rule over the mechanism's largest velocity.
    pub incompatibility: f64,
    /// The mechanism's own multiplier; not finite where the cap ended the search and there is no mechanism.
    pub kinematic: f64,
    /// The mechanism's multiplier minus that of the forces: the duality gap.
    pub gap: f64,
}

/// How the search for a state without dilatancy went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedPoint {
    /// Programs solved.
    pub iterations: u32,
    /// Whether the multiplier came to rest, and the shear strengths with it or nearly: see `excess`.
    pub converged: bool,
    /// By how much the last program's multiplier is above that of the state found.
    pub change: f64,
    /// Largest excess of a contact's shear over Coulomb's law at the end, over the blocks' mean weight.
    pub excess: f64,
    /// Least and largest multiplier of the last programs: what is known of a search that did not converge.
    pub range: [f64; 2],
}

/// The mechanism of a solution, scaled to a largest velocity of 1 m/s at the contact points.
pub(crate) fn mechanism(program: &Program, solved: &Solved) -> Vec<BlockMotion> {
    let mut fastest: f64 = 0.0;
    for (joint, point) in program.blocks.points() {
        for (b, at) in [(joint.incident, point.at), (joint.reference, point.at - joint.shift)] {
            fastest = fastest.max(program.blocks.velocity(&solved.velocities, b, at).norm());
        }
    }
    let scale = if fastest > 0.0 { 1.0 / fastest } else { 0.0 };
    let motion = |&lead: &usize| {
        let v = &solved.velocities[lead];
        BlockMotion { velocity: v.force * scale, spin: v.moment * scale }
    };
    program.blocks.leads.iter().map(motion).collect()
}

/// The forces of a solution summed up by joint.
pub(crate) fn thrust(program: &Program, solved: &Solved) -> Vec<Thrust> {
    let mut forces = world_forces(program, solved);
    let mut all = Vec::with_capacity(program.blocks.interfaces.len());
    for joint in &program.blocks.interfaces {
        let (mut sum, mut pressure, mut moment) = (Vec3::zeros(), 0.0, Vec3::zeros());
        for (_, at, force) in forces.by_ref().take(joint.points.len()) {
            let n = force.dot(&joint.normal);
            sum += force;
            pressure += n;
            moment += at * n;
        }
        let carries = pressure.abs() > 1e-9 * program.blocks.unit;
        let (a, b) = (joint.incident.min(joint.reference), joint.incident.max(joint.reference));
        all.push(Thrust {
            blocks: (a as u32, b as u32),
            force: if joint.incident == b { sum } else { -sum },
            at: carries.then(|| moment / pressure + program.blocks.origin),
        });
    }
    all
}
