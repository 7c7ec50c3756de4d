//! In which condition the joints of a solved wall are as it falls, or where it rests: closed, a hinge, slipping, open.

use crate::contact;
use crate::contact::{Patch, find_patch};
use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::JointState;
use crate::render::picture::{Hinge, Stone};

/// A joint that carries less than this share of what the most loaded one does carries nothing.
const CARRIES: f64 = 1e-6;
/// As a wall falls, joints that turn and slip by less than this share of the most that one does stay closed.
const MOVES: f64 = 0.1;
/// At rest a joint is a hinge when its blocks touch over less than this share of its width: the force is then within a ninth of the
/// width of the edge, as on a pressure that grows linearly.
const TOUCHES: f64 = 1.0 / 3.0;

/// The condition of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Condition {
    /// Its blocks stay together.
    Closed,
    /// Its blocks press on each other along an edge and turn about it.
    Hinge,
    /// Its blocks press on each other and slip, by more than they turn.
    Slip,
    /// It carries nothing.
    Open,
}

impl Condition {
    /// The word for it in the files.
    pub fn name(self) -> &'static str {
        match self {
            Condition::Closed => "closed",
            Condition::Hinge => "hinge",
            Condition::Slip => "slip",
            Condition::Open => "open",
        }
    }
}

/// How the blocks of a joint move against each other in a mechanism (m, in its scale).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parting {
    /// By how much they part where they part most.
    pub most: f64,
    /// By how much they part where they part least: what slides dilates everywhere alike.
    pub least: f64,
    /// By how much they slip at the joint's middle.
    pub slip: f64,
}

impl Parting {
    /// Over a joint of two stones; one that is not among them is the ground.
    pub fn of(stones: &[Stone], blocks: [usize; 2], patch: &Patch) -> Parting {
        let corners = || patch.polygon.vertices.iter().map(|&st| patch.frame.lift(st));
        let parted = || corners().map(|corner| Parting::at(stones, blocks, patch, &corner));
        let middle = patch.frame.lift(patch.polygon.moments().centroid());
        let relative = relative(stones, blocks, patch, &middle);
        let normal = patch.plane.normal;
        Parting {
            most: parted().fold(f64::NEG_INFINITY, f64::max),
            least: parted().fold(f64::INFINITY, f64::min),
            slip: (relative - normal * relative.dot(&normal)).norm(),
        }
    }

    /// By how much they part at a point of the joint.
    pub fn at(stones: &[Stone], blocks: [usize; 2], patch: &Patch, point: &Vec3) -> f64 {
        relative(stones, blocks, patch, point).dot(&patch.plane.normal)
    }

    /// By how much they turn, as far as corners part by it.
    fn turn(&self) -> f64 {
        self.most - self.least
    }
}

/// How a point of a joint moves as the block above its plane has it, against how it moves as the other one has it.
fn relative(stones: &[Stone], blocks: [usize; 2], patch: &Patch, point: &Vec3) -> Vec3 {
    let moved = |id: usize| {
        stones.get(id).map_or_else(Vec3::zeros, |stone| {
            let lever = point - stone.shape.mass_properties().centroid;
            stone.movement.shift + stone.movement.turn.cross(&lever)
        })
    };
    let [one, other] = blocks.map(moved);
    if patch.reference_is_second { one - other } else { other - one }
}

/// The conditions of the joints of a wall, with the ground in it: by the movement of its stones where that is its fall.
pub(crate) fn conditions(
    (wall, settings): (&Wall, &contact::Settings),
    stones: &[Stone],
    joints: &[JointState],
    falls: bool,
) -> Vec<Condition> {
    let parting = |joint: &JointState| {
        let blocks = joint.blocks.map(|id| id as usize);
        let [first, second] = blocks.map(|id| wall.blocks.get(id));
        let patch = find_patch(&first?.shape, &second?.shape, settings)?;
        Some(Parting::of(stones, blocks, &patch))
    };
    let partings: Vec<Option<Parting>> =
        joints.iter().map(|joint| if falls { parting(joint) } else { None }).collect();
    let fastest = partings.iter().flatten().map(|of| of.turn().max(of.slip)).fold(0.0, f64::max);
    of_all(joints, |at| match &partings[at] {
        Some(of) if of.turn().max(of.slip) < MOVES * fastest => Condition::Closed,
        Some(of) if of.turn() >= of.slip => Condition::Hinge,
        Some(_) => Condition::Slip,
        None => at_rest(&joints[at]),
    })
}

/// The conditions of joints at rest.
pub(crate) fn resting(joints: &[JointState]) -> Vec<Condition> {
    of_all(joints, |at| at_rest(&joints[at]))
}

/// Of joints that carry something by `of`.
fn of_all(joints: &[JointState], of: impl Fn(usize) -> Condition) -> Vec<Condition> {
    let most = joints.iter().map(|joint| joint.force.norm()).fold(0.0, f64::max);
    let carries = |joint: &JointState| joint.force.norm() > CARRIES * most;
    joints.iter().enumerate().map(|(at, j)| if carries(j) { of(at) } else { Condition::Open }).collect()
}

/// Of a joint that carries at rest.
fn at_rest(joint: &JointState) -> Condition {
    if joint.closing.share < TOUCHES && joint.opening > joint.slip {
        Condition::Hinge
    } else if joint.slipped == 1.0 {
        Condition::Slip
    } else {
        Condition::Closed
    }
}

/// The hinges among joints, for a picture: those that turn. As a wall falls their conditions say so; at rest a joint that gapes by less than
/// a tenth of the widest does not turn enough to be seen.
pub(crate) fn hinges(joints: &[JointState], conditions: &[Condition], falls: bool) -> Vec<Hinge> {
    let widest = joints.iter().map(|joint| joint.opening).fold(0.0, f64::max);
    let turns = |joint: &JointState| falls || joint.opening >= MOVES * widest;
    let hinges = joints
        .iter()
        .zip(conditions)
        .filter(|(joint, condition)| **condition == Condition::Hinge && turns(joint));
    // The ground, which may be no block of the picture, comes last.
    hinges.map(|(joint, _)| Hinge { block: joint.blocks[0] as usize, edge: joint.closing.edge }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::Closing;

    fn joint(push: f64, share: f64, opening: f64, slipped: f64) -> JointState {
        JointState {
            blocks: [3, 7],
            place: Vec3::zeros(),
            area: 1.0,
            opening,
            slip: 1e-3,
            slipped,
            crushed: 0.0,
            force: Vec3::z() * push,
            pressure: push,
            closing: Closing { share, edge: [Vec3::zeros(), Vec3::x()] },
        }
    }

    #[test]
    fn joints_at_rest_that_touch_along_an_edge_and_carry_are_hinges() {
        let joints = [
            joint(1e3, 1.0, 0.0, 0.0),
            joint(1e3, 0.1, 1e-2, 0.2),
            joint(1e3, 0.5, 1e-2, 0.2),
            joint(1e3, 0.1, 1e-4, 1.0),
            joint(0.0, 0.0, 1e-2, 0.0),
        ];
        let conditions = resting(&joints);
        let names: Vec<&str> = conditions.iter().map(|of| of.name()).collect();
        assert_eq!(names, ["closed", "hinge", "closed", "slip", "open"]);
        let edge = [Vec3::zeros(), Vec3::x()];
        assert_eq!(hinges(&joints, &conditions, false), [Hinge { block: 3, edge }]);
        // Beside one that gapes ten times as far nothing is seen of it, unless it turns as the wall falls.
        let wider = [joint(1e3, 0.1, 2e-3, 0.0), joint(1e3, 1.0, 2.1e-2, 0.0)];
        assert_eq!(hinges(&wider, &resting(&wider), false), []);
        assert_eq!(hinges(&wider, &resting(&wider), true).len(), 1);
    }
}
