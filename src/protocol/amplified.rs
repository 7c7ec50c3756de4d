//! The replay of a wall by limit analysis: at rest, then along its mechanism further and further.

use crate::contact::{Patch, Settings, find_patch};
use crate::math::Vec3;
use crate::model::{BuiltJoint, JointReading, Level, Movement, Outcome, Replay, ReplayState, Wall};
use crate::solve::limit::{BlockMotion, Limit, Thrust};

/// States along the mechanism, and how far its fastest corner goes, as a share of the wall's height.
const STATES: usize = 20;
const FURTHEST: f64 = 0.2;

/// The replay of what a limit analysis found: the wall at rest, if it can stand at all, and its mechanism where it `falls`. The forces
/// found, times `scale`, are those of the level at which it falls, and are shown in all states.
pub fn amplified(
    (wall, settings): (&Wall, &Settings),
    found: &Limit,
    (level, scale): (Level, f64),
    falls: bool,
) -> Replay {
    let rests = found.outcome != Outcome::UnstableAtRest;
    let joint = |thrust: &Thrust| {
        let blocks = [thrust.blocks.0, thrust.blocks.1];
        let [first, second] = blocks.map(|id| &wall.blocks[id as usize].shape);
        let patch = find_patch(first, second, settings)?;
        let joint = as_built(blocks, &patch);
        let across = (thrust.force * scale).dot(&joint.normal);
        let along = (thrust.force * scale - joint.normal * across).norm();
        let stresses = [across / joint.area, along / joint.area];
        Some((joint, stresses))
    };
    let (joints, stresses): (Vec<BuiltJoint>, Vec<[f64; 2]>) = found.thrust.iter().filter_map(joint).unzip();
    let centroids: Vec<Vec3> =
        wall.blocks.iter().map(|block| block.shape.mass_properties().centroid).collect();
    let bodies = bodies(wall, &centroids);
    let (low, high) = wall.bounds();
    let state = |amplitude: f64| {
        let poses: Vec<Movement> = (0..centroids.len())
            .map(|id| along(&found.mechanism[id], amplitude, &(centroids[id] - bodies[id])))
            .collect();
        let reading = |(joint, [normal_stress, shear_stress]): (&BuiltJoint, &[f64; 2])| {
            let [opening, slip] = joint.parted(&centroids, &poses, &Vec3::zeros());
            JointReading { opening, slip, normal_stress: *normal_stress, shear_stress: *shear_stress }
        };
        let joints = joints.iter().zip(&stresses).map(reading).collect();
        ReplayState { level, is_equilibrium: amplitude == 0.0 && rests, poses, joints, gone: Vec::new() }
    };
    let moves = found.mechanism.iter().any(|motion| *motion != BlockMotion::default());
    let last = if moves && falls { STATES } else { 0 };
    let amplitude = |at: usize| FURTHEST * (high.z - low.z) * at as f64 / STATES as f64;
    let states = (0..=last).map(|at| state(amplitude(at))).collect();
    Replay { joints, states, is_mechanism: true }
}

/// A block along the motion of its body, whose centroid is off its own.
fn along(motion: &BlockMotion, amplitude: f64, off: &Vec3) -> Movement {
    let movement = Movement { shift: motion.velocity, turn: motion.spin }.times(amplitude);
    Movement { shift: movement.shift + movement.rotation() * off - off, ..movement }
}

/// The centroid of the body of every block: of a part of a stone that of the stone.
fn bodies(wall: &Wall, centroids: &[Vec3]) -> Vec<Vec3> {
    let leads = wall.leads();
    let mut sums = vec![(0.0, Vec3::zeros()); centroids.len()];
    for (id, block) in wall.blocks.iter().enumerate() {
        let (mass, own) = (block.mass(), block.mass_properties().centroid);
        let (all, moment) = sums[leads[id]];
        sums[leads[id]] = (all + mass, moment + own * mass);
    }
    let of = |id: usize| {
        let (mass, moment) = sums[leads[id]];
        if mass > 0.0 { moment / mass } else { centroids[id] }
    };
    (0..centroids.len()).map(of).collect()
}

fn as_built(blocks: [u32; 2], patch: &Patch) -> BuiltJoint {
    let moments = patch.polygon.moments();
    let polygon: Vec<Vec3> = patch.polygon.vertices.iter().map(|&st| patch.frame.lift(st)).collect();
    BuiltJoint {
        blocks,
        // To rigid blocks a gap within the tolerance is none.
        gaps: vec![0.0; polygon.len()],
        polygon,
        normal: if patch.reference_is_second { -patch.plane.normal } else { patch.plane.normal },
        middle: patch.frame.lift(moments.centroid()),
        area: moments.area,
    }
}
