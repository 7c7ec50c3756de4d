//! What a solution is worth, recomputed from its forces and velocities.

use crate::math::Vec3;
use crate::model::Support;
use crate::solve::limit::collapse::Accuracy;
use crate::solve::limit::interfaces::Interface;
use crate::solve::limit::loads::Wrench;
use crate::solve::limit::program::{Program, Solved};
use crate::solve::limit::strength::Strength;

/// Accuracy (relative) below which a solution is not believed.
const ACCEPTED: f64 = 1e-6;

impl Accuracy {
    /// Whether forces, mechanism and their two multipliers agree well enough for the multiplier to be reported.
    pub(crate) fn accepts_mechanism(&self, multiplier: f64) -> bool {
        let gap = self.gap.abs() <= ACCEPTED * multiplier.abs().max(1.0);
        self.accepts_state() && gap && self.incompatibility <= ACCEPTED
    }

    /// Whether the forces are in equilibrium within the strength.
    pub(crate) fn accepts_state(&self) -> bool {
        self.residual <= ACCEPTED && self.excess <= ACCEPTED
    }
}

/// Recomputes equilibrium, strength, flow rule and the mechanism's own multiplier.
pub(crate) fn audit(program: &Program, solved: &Solved) -> Accuracy {
    let (power, incompatibility) = flow_rule(program, solved);
    let of = |loads: &[Wrench]| -> f64 {
        loads
            .iter()
            .zip(&solved.velocities)
            .map(|(l, v)| l.force.dot(&v.force) + l.moment.dot(&v.moment))
            .sum()
    };
    let kinematic = (power - of(program.dead)) / of(program.live);
    Accuracy {
        residual: residual(program, solved),
        excess: excess(program.strengths, program, solved),
        incompatibility,
        kinematic,
        gap: kinematic - solved.multiplier,
    }
}

/// Largest unbalanced force or moment (over the block's radius) on a block that moves, over the unit of force.
fn residual(program: &Program, solved: &Solved) -> f64 {
    let blocks = program.blocks;
    let mut sums: Vec<Wrench> = program
        .dead
        .iter()
        .zip(program.live)
        .map(|(d, l)| Wrench {
            force: d.force + l.force * solved.multiplier,
            moment: d.moment + l.moment * solved.multiplier,
        })
        .collect();
    for (joint, at, force) in world_forces(program, solved) {
        for (block, wrench) in blocks.felt(joint, at, force).into_iter().flatten() {
            sums[block] = sums[block].plus(&wrench);
        }
    }
    for (rope, pull) in blocks.ties.iter().zip(&solved.pulls) {
        sums[rope.block].add(rope.at - blocks.rigid[rope.block].centroid, rope.direction * -pull);
    }
    let left = |(block, sum): (&crate::solve::limit::interfaces::Rigid, &Wrench)| {
        let (f, m) = (sum.force, sum.moment / block.radius);
        match block.support {
            Support::Fixed | Support::Absent => 0.0,
            Support::Free => f.norm().max(m.norm()),
            Support::OutOfPlane => f.x.abs().max(f.z.abs()).max(m.y.abs()),
            Support::Upright => f.x.abs().max(f.z.abs()),
        }
    };
    largest(blocks.rigid.iter().zip(&sums).map(left)) / blocks.unit
}

/// Every contact force in world axes: joint, where, force on the incident block (N).
pub(crate) fn world_forces<'a>(
    program: &'a Program,
    solved: &'a Solved,
) -> impl Iterator<Item = (&'a Interface, Vec3, Vec3)> + 'a {
    let joints = program.blocks.interfaces.iter().zip(program.axes);
    joints
        .flat_map(|(joint, axes)| joint.points.iter().map(move |point| (joint, axes, point)))
        .zip(&solved.forces)
        .map(|((joint, [e1, e2], point), [n, t1, t2])| {
            (joint, point.at, joint.normal * *n + e1 * *t1 + e2 * *t2)
        })
}

/// Largest excess of a contact force over the given strengths, or push of a rope that cannot push, over the unit of force.
pub(crate) fn excess(strengths: &[Strength], program: &Program, solved: &Solved) -> f64 {
    let over = strengths.iter().zip(&solved.forces).map(|(s, f)| s.excess(*f, program.cone));
    let ropes = program.blocks.ties.iter().zip(&solved.pulls).filter(|(rope, _)| !rope.two_sided);
    largest(over.chain(ropes.map(|(_, pull)| (-pull).max(0.0)))) / program.blocks.unit
}

/// Power dissipated at the joints (W), and the largest breach of the flow rule over the mechanism's largest velocity.
fn flow_rule(program: &Program, solved: &Solved) -> (f64, f64) {
    let blocks = program.blocks;
    let (mut power, mut incompatible, mut fastest) = (0.0, 0.0f64, 0.0f64);
    let mut strengths = program.strengths.iter();
    for (joint, [e1, e2]) in blocks.interfaces.iter().zip(program.axes) {
        for (point, strength) in joint.points.iter().zip(&mut strengths) {
            let u = blocks.parting(&solved.velocities, joint, point.at);
            let cost = strength.cost([u.dot(&joint.normal), u.dot(e1), u.dot(e2)], program.cone);
            power += cost.power;
            incompatible = incompatible.max(cost.incompatibility);
            let velocity = blocks.velocity(&solved.velocities, joint.incident, point.at);
            fastest = fastest.max(velocity.norm());
        }
    }
    for rope in &blocks.ties {
        let along = blocks.velocity(&solved.velocities, rope.block, rope.at).dot(&rope.direction);
        incompatible = incompatible.max(if rope.two_sided { along.abs() } else { along });
    }
    (power, if fastest > 0.0 { incompatible / fastest } else { 0.0 })
}

/// The largest of some sizes; NaN if one of them is, so that no comparison is passed by a number gone bad.
fn largest(sizes: impl Iterator<Item = f64>) -> f64 {
    sizes.fold(0.0, |largest: f64, x| if x.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(x) })
}
