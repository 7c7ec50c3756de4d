//! The states of a wall over its load path, from rest through the collapse: what a slider, an animation or a series of files shows.

use crate::math::Vec3;
use crate::model::{Level, Movement};

/// The states of one wall in the order in which it goes through them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Replay {
    /// The joints that the wall was built with. Joints between blocks that meet on the way are not among them.
    pub joints: Vec<BuiltJoint>,
    /// The states at rest by growing load, then the collapse if there is one.
    pub states: Vec<ReplayState>,
    /// Whether the collapse is a mechanism of limit analysis drawn larger and larger: it has no size of its own, so that openings and
    /// slips say where joints part, not how far.
    pub is_mechanism: bool,
}

/// A joint where it was built.
#[derive(Clone, Debug, PartialEq)]
pub struct BuiltJoint {
    /// Its blocks, lower id first; an id beyond those of the wall is the ground, or another block that is put around it.
    pub blocks: [u32; 2],
    /// Its outline (m, world axes), in order around.
    pub polygon: Vec<Vec3>,
    /// How far the two blocks are apart at these corners as built (m); negative where they overlap.
    pub gaps: Vec<f64>,
    /// Unit normal, from the first block to the second.
    pub normal: Vec3,
    /// Its middle (m).
    pub middle: Vec3,
    /// Its area (m^2).
    pub area: f64,
}

/// A wall at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayState {
    /// The load on it.
    pub level: Level,
    /// Whether it is at rest (on a table that turns steadily: stands); otherwise it is on its way down.
    pub is_equilibrium: bool,
    /// How every block has moved since it was built, by block id.
    pub poses: Vec<Movement>,
    /// What the joints do, in the order of [`Replay::joints`].
    pub joints: Vec<JointReading>,
    /// Blocks that fell out before, ascending: they are not there any more.
    pub gone: Vec<u32>,
}

/// What a joint does at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointReading {
    /// Largest gap over the joint (m); 0 where it is closed throughout.
    pub opening: f64,
    /// Relative displacement of its blocks along the joint at its middle, since the wall first came to rest (m).
    pub slip: f64,
    /// Pressure: the force across the joint over its area (Pa), at least 0 but for joints that bear tension.
    pub normal_stress: f64,
    /// The force along the joint over its area (Pa).
    pub shear_stress: f64,
}

impl Replay {
    /// Whether it is followed in time on ground that moves, so that its states come at times.
    pub fn is_in_time(&self) -> bool {
        self.states.iter().any(|state| matches!(state.level, Level::Time(_)))
    }

    /// One of its states in words. A wall that falls does so under more than it bears: how far its load lies beyond the limit, the largest
    /// load at rest, is said in load steps, so that a replay names no second capacity.
    pub fn said(&self, state: &ReplayState) -> String {
        let (level, limit) = (state.level, self.states.iter().rev().find(|own| own.is_equilibrium));
        match (state.is_equilibrium, level, limit) {
            (true, ..) => format!("at rest at {level}"),
            (false, Level::Time(_), _) => format!("at {level}"),
            _ if self.is_mechanism => {
                format!("along the mechanism, which has no size of its own, at {level}")
            }
            (false, _, Some(limit)) if level.value() > limit.level.value() => {
                let steps = self.beyond(level.value() - limit.level.value());
                format!("falling, {steps} beyond the limit at {}", limit.level)
            }
            _ => format!("falling at {level}"),
        }
    }

    /// How many load steps an amount of load is. A wall that hesitates as it falls gets whole ones; where none did, the longest step at
    /// rest is one. The last step before the limit may be shorter, as a limit is bracketed.
    fn beyond(&self, amount: f64) -> String {
        let longest = |at_rest: bool| {
            let states = self.states.iter().filter(|state| state.is_equilibrium == at_rest);
            let levels: Vec<f64> = states.map(|state| state.level.value()).collect();
            levels.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
        };
        let step = Some(longest(false)).filter(|step| *step > 0.0).unwrap_or_else(|| longest(true));
        match if step > 0.0 { (amount / step).round() } else { 1.0 } {
            0.0 => "less than one load step".to_owned(),
            1.0 => "one load step".to_owned(),
            steps => format!("{steps} load steps"),
        }
    }
}

impl BuiltJoint {
    /// How a point of it moves with the second block against the first (m), in the axes of the first block as built. `centroids` are
    /// those of the blocks as built (m), `poses` their movements since.
    pub fn apart(&self, centroids: &[Vec3], poses: &[Movement], point: &Vec3) -> Vec3 {
        let [first, second] = self.blocks.map(|id| {
            let (centroid, pose) = (centroids[id as usize], poses[id as usize]);
            pose.shift + centroid + pose.rotation() * (point - centroid)
        });
        poses[self.blocks[0] as usize].rotation().tr_mul(&(second - first))
    }

    /// Opening and slip (m) of blocks that have moved; `before` is how its middle [moved](Self::apart) up to when slip began to count.
    pub fn parted(&self, centroids: &[Vec3], poses: &[Movement], before: &Vec3) -> [f64; 2] {
        let gap =
            |(corner, built): (&Vec3, &f64)| built + self.apart(centroids, poses, corner).dot(&self.normal);
        let widest = self.polygon.iter().zip(&self.gaps).map(gap).fold(0.0, f64::max);
        let since = self.apart(centroids, poses, &self.middle) - before;
        [widest, (since - self.normal * since.dot(&self.normal)).norm()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_6;

    /// A block of 2 m x 2 m x 2 m on a ground whose centroid lies 1 m below.
    fn joint() -> (BuiltJoint, [Vec3; 2]) {
        let corner = |x: f64, y: f64| Vec3::new(x, y, 0.0);
        let polygon = vec![corner(0.0, 0.0), corner(2.0, 0.0), corner(2.0, 2.0), corner(0.0, 2.0)];
        let joint = BuiltJoint {
            blocks: [0, 1],
            gaps: vec![0.0; 4],
            polygon,
            normal: -Vec3::z(),
            middle: Vec3::new(1.0, 1.0, 0.0),
            area: 4.0,
        };
        (joint, [Vec3::new(1.0, 1.0, 1.0), Vec3::new(1.0, 1.0, -1.0)])
    }

    #[test]
    fn a_wall_that_falls_is_said_to_lie_beyond_the_load_that_it_bears() {
        let state = |factor: f64, is_equilibrium: bool| ReplayState {
            level: Level::Factor(factor),
            is_equilibrium,
            poses: Vec::new(),
            joints: Vec::new(),
            gone: Vec::new(),
        };
        let said = |levels: &[(f64, bool)]| {
            let states: Vec<_> = levels.iter().map(|(factor, rests)| state(*factor, *rests)).collect();
            let replay = Replay { joints: Vec::new(), states, is_mechanism: false };
            replay.states.iter().map(|state| replay.said(state)).collect::<Vec<_>>()
        };
        let bracketed = [(0.0, true), (0.1, true), (0.11, true), (0.12, false), (0.22, false), (0.32, false)];
        let limit = "beyond the limit at load factor 0.11";
        assert_eq!(
            said(&bracketed)[2..],
            [
                "at rest at load factor 0.11".to_owned(),
                format!("falling, less than one load step {limit}"),
                format!("falling, one load step {limit}"),
                format!("falling, 2 load steps {limit}"),
            ]
        );
        assert_eq!(
            said(&[(0.1, true), (0.2, true), (0.3, false)])[2],
            "falling, one load step beyond the limit at load factor 0.2"
        );
        assert_eq!(said(&[(0.3, false)])[0], "falling at load factor 0.3", "it never came to rest");
    }

    #[test]
    fn a_block_that_turns_about_an_edge_opens_its_joint_and_one_that_slides_slips() {
        let (joint, centroids) = joint();
        // About the edge y = 2 by 30 degrees: the far edge, 2 m away, is lifted by 2 sin 30 deg.
        let turn = -Vec3::x() * FRAC_PI_6;
        let edge = Vec3::new(1.0, 2.0, 0.0);
        let turned = Movement { shift: Vec3::zeros(), turn };
        let shift = edge - centroids[0] - turned.rotation() * (edge - centroids[0]);
        let [opening, _] =
            joint.parted(&centroids, &[Movement { shift, turn }, Movement::NONE], &Vec3::zeros());
        assert!((opening - 1.0).abs() < 1e-12, "{opening}");
        let slid = Movement { shift: Vec3::new(0.3, 0.4, 0.0), turn: Vec3::zeros() };
        let [opening, slip] = joint.parted(&centroids, &[slid, Movement::NONE], &Vec3::zeros());
        assert!((opening, (slip - 0.5).abs() < 1e-12) == (0.0, true), "{opening} {slip}");
        // What slid before does not count.
        let before = joint.apart(&centroids, &[slid, Movement::NONE], &joint.middle);
        assert_eq!(joint.parted(&centroids, &[slid, Movement::NONE], &before), [0.0, 0.0]);
    }
}
