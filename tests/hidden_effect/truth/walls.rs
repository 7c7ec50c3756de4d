//! The walls of a campaign, solved in finer steps than those that the inference knows.

use pirca::ensemble::{build, is_random};
use pirca::law::Coulomb;
use pirca::math::{Vec3, radians};
use pirca::model::{JointLaws, Outcome, Wall};
use pirca::protocol::{LoadStep, Protocol, run_changing};
use pirca::random::Streams;
use pirca::study::{DrawnJoints, Study};

use super::effect::{Effect, Place};

/// Steps of the platform, and the width to which the collapse angle is bracketed (deg).
const STEP_DEG: f64 = 1.25;
const BRACKET_DEG: f64 = 0.02;

/// The way of a wall to its collapse.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// The collapse angle (rad).
    pub collapse: f64,
    /// Tilts at which it was at rest (rad), ascending from 0, with the displacements of left, centre and right (m).
    pub rests: Vec<(f64, [f64; 3])>,
}

/// The study with finer steps.
pub fn refined(mut study: Study) -> Study {
    if let Protocol::Tilting(tilting) = &mut study.protocol {
        (tilting.step, tilting.bracket) = (radians(STEP_DEG), radians(BRACKET_DEG));
    }
    study.without_limit_analysis()
}

/// A wall of a study with one stiffness per arm, with what is hidden in it. `None` where it does not end in a collapse that the
/// solver found.
pub fn solved(study: &Study, arm: u32, member: u64, effects: &[Box<dyn Effect>]) -> Option<Way> {
    let built = build(study, arm, member).ok()?.wall;
    let arm = &study.arms[arm as usize];
    let streams = Streams::new(study.seed, member);
    let wall = effects.iter().fold(built, |wall, effect| effect.wall(wall, &streams));
    let base =
        DrawnJoints::new(&arm.joint, arm.kn_points[0], streams.clone()).altered(&arm.mechanisms, &wall);
    let laws = Laws::new(base, &wall, effects, streams.clone());
    let restraint = effects.iter().fold(arm.restraint, |restraint, effect| effect.restraint(restraint));
    let contacts = arm.mechanisms.contacts(arm.sub_contacts);
    let changes = arm.mechanisms.changes(&wall, &streams);
    let run = run_changing(&wall, &laws, &study.protocol, &restraint, contacts, &changes, &study.solver);
    let Outcome::Collapsed { at } = run.outcome else { return None };
    Way::of(at.value(), &run.steps)
}

/// Whether a family's walls are all alike under what is hidden.
pub fn alike(study: &Study, arm: u32, effects: &[Box<dyn Effect>]) -> bool {
    !is_random(&study.arms[arm as usize]) && !effects.iter().any(|effect| effect.differs())
}

impl Way {
    /// From the steps of a wall that fell.
    fn of(collapse: f64, steps: &[LoadStep]) -> Option<Way> {
        let mut rests: Vec<(f64, [f64; 3])> = Vec::new();
        for step in steps {
            let tilt = step.level.value();
            if tilt <= collapse && rests.last().is_none_or(|(last, _)| tilt > *last) {
                rests.push((tilt, step.points?));
            }
        }
        (rests.len() > 1 && collapse > 0.0).then_some(Way { collapse, rests })
    }

    /// Displacements (m) at a tilt (rad), at most the collapse angle. Near it they go as the root of what is left to it, and
    /// are interpolated in that root; uphill they are those of the same tilt downhill.
    pub fn displacements(&self, tilt: f64) -> [f64; 3] {
        if tilt < 0.0 {
            return self.displacements(-tilt).map(|x| -x);
        }
        let root = |tilt: f64| (1.0 - tilt / self.collapse).max(0.0).sqrt();
        let above = self.rests.partition_point(|(at, _)| *at < tilt).clamp(1, self.rests.len() - 1);
        let ((t0, low), (t1, high)) = (&self.rests[above - 1], &self.rests[above]);
        let share = (root(*t0) - root(tilt)) / (root(*t0) - root(*t1));
        std::array::from_fn(|k| low[k] + share * (high[k] - low[k]))
    }
}

/// The laws of a wall's joints with what is hidden in them.
pub struct Laws<'a> {
    base: DrawnJoints<'a>,
    effects: &'a [Box<dyn Effect>],
    streams: Streams,
    boxes: Vec<(Vec3, Vec3)>,
    wall: (Vec3, Vec3),
}

impl<'a> Laws<'a> {
    pub fn new(
        base: DrawnJoints<'a>,
        wall: &Wall,
        effects: &'a [Box<dyn Effect>],
        streams: Streams,
    ) -> Laws<'a> {
        let boxes = wall.blocks.iter().map(|block| block.shape.bounds()).collect();
        Laws { base, effects, streams, boxes, wall: wall.bounds() }
    }

    fn place(&self, a: u32, b: u32) -> Place {
        // What is not the wall's is under it.
        let (low, high) = self.wall;
        let platform = (low, Vec3::new(high.x, high.y, low.z));
        let of = |id: u32| self.boxes.get(id as usize).copied().unwrap_or(platform);
        let ((a0, a1), (b0, b1)) = (of(a), of(b));
        Place {
            blocks: [a, b],
            shared: [a0.sup(&b0), a1.inf(&b1)],
            wall: [low, high],
            on_platform: b as usize >= self.boxes.len(),
        }
    }
}

impl JointLaws for Laws<'_> {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        let (a, b) = (a.min(b), a.max(b));
        let place = self.place(a, b);
        let base = self.base.of(a, b);
        self.effects.iter().fold(base, |law, effect| effect.law(law, &place, &self.streams))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_met_at_its_rests_and_is_a_root_between_them() {
        let root = |tilt: f64| 1.0 - (1.0 - tilt / 0.3).max(0.0).sqrt();
        let rests = [0.0, 0.1, 0.2, 0.3].map(|tilt| (tilt, [root(tilt), 2.0 * root(tilt), 0.0]));
        let way = Way { collapse: 0.3, rests: rests.to_vec() };
        for tilt in [0.0, 0.05, 0.1, 0.27, 0.2999] {
            let [left, centre, right] = way.displacements(tilt);
            assert!((left - root(tilt)).abs() < 1e-12 && (centre - 2.0 * left).abs() < 1e-12, "{tilt}");
            assert_eq!(right, 0.0);
            assert_eq!(way.displacements(-tilt)[0], -left);
        }
    }
}
