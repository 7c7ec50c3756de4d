//! The paths that a wall may have under a truth: what the emulators expect, and what walls differ by.

use crate::critic::simulate::bank::{Curves, Emulated, NUMBERS, PRIOR_WIDENING, Pushes, Test};
use crate::critic::simulate::queries::Queries;
use crate::critic::simulate::truth::Truth;
use crate::critic::simulate::world::{Walls, World, varying};
use crate::random::Streams;

/// A wall differs from the expected path as one of so many of its nearest neighbours in the bank does.
pub(super) const NEIGHBOURS: usize = 20;

/// What walls share is set beside what the wall so far down the list of the nearest has of its own.
const COMMON_APART: usize = 3;

/// What is known of the walls of a family before they are built.
pub(super) struct Likely {
    family: usize,
    /// The numbers of a path to be expected, see [`Path::adding`](crate::critic::Path::adding).
    expected: [f64; NUMBERS],
    /// What each may differ by, each equally likely.
    own: Vec<[f64; NUMBERS]>,
    /// And what all of them may besides, by the emulators' errors, each equally likely.
    common: Vec<[f64; NUMBERS]>,
    random: bool,
}

impl Likely {
    /// The numbers of a specimen's path: one of those that a wall may have.
    pub(super) fn wall(&self, specimen: usize, streams: &Streams) -> [f64; NUMBERS] {
        let Likely { family, expected, own, common, random } = self;
        // Walls in which nothing is drawn are the same: what is left is the emulator's error, and they share it.
        let name = match random {
            true => format!("stones {specimen}"),
            false => format!("stones of family {family}"),
        };
        let alone = moved(expected, &own[streams.of(&name).below(own.len())]);
        let shared = streams.of(&format!("emulator of family {family}")).below(common.len());
        moved(&alone, &common[shared])
    }
}

impl World<'_> {
    /// The paths that the walls of a family may have under a truth.
    pub(super) fn likely(&self, family: usize, truth: &Truth) -> Likely {
        let family = self.stands_for[family];
        let Walls { emulator, random } = &self.base[&family];
        let joints = truth.joints[self.kinds[family]].map(|score| score / PRIOR_WIDENING);
        let base = emulator.emulated(&joints, NEIGHBOURS);
        let mut likely = Likely {
            family,
            expected: base.numbers,
            own: vec![[0.0; NUMBERS]; base.left.len()],
            common: vec![[0.0; NUMBERS]; base.left.len()],
            random: *random,
        };
        likely.leave(&base, 0);
        for (place, (cause, parameters)) in self.acting(truth, self.kinds[family]).enumerate() {
            let Some(change) = self.changes.get(&(family, cause)) else { continue };
            let parameters = varying(self.mechanisms, Some(cause), parameters.iter().copied());
            let scores: Vec<f64> = joints.into_iter().chain(parameters).collect();
            let emulated = change.emulator.emulated(&scores, NEIGHBOURS);
            likely.expected = moved(&likely.expected, &emulated.numbers);
            // The stones of the nearest wall with what the effect on a wall half way down the list is left with (a second effect: a
            // quarter), and so on round: what is nearest in the one has no part in what is nearest in the other.
            likely.leave(&emulated, emulated.left.len() >> (1 + place));
            likely.random |= change.random;
        }
        likely
    }

    /// What the paths that a wall of a family may have under a truth, equally likely, show of the queries before errors, path by
    /// path; and whether walls of the family differ, or share one path. Taken for independent of each other, the mean of so many
    /// `walls` scatters as it does where they share the emulators' errors. A wall that has fallen shows what it did last.
    pub(in crate::critic) fn may_show(
        &self,
        family: usize,
        queries: &Queries,
        truth: &Truth,
        walls: usize,
    ) -> (Vec<Vec<f64>>, bool) {
        let Likely { expected, own, common, random, .. } = self.likely(family, truth);
        let gauge = self.gauge(truth);
        let times = if random { (walls as f64).sqrt() } else { 1.0 };
        let apart = common.iter().cycle().skip(COMMON_APART);
        let of = |(own, common): (&[f64; NUMBERS], &[f64; NUMBERS])| {
            let left = std::array::from_fn(|k| own[k] + times * common[k]);
            let numbers = moved(&expected, &left);
            if let Test::Shear { widest } = self.test {
                return queries.pushes(&Pushes::of(&numbers, widest));
            }
            let curves = Curves::of(&numbers);
            let last = curves.collapse();
            let read = |points: &mut [f64; 3]| *points = points.map(|x| gauge.reading(x));
            let mut points = curves.last_displacements(&queries.tilts);
            points.iter_mut().for_each(read);
            let mut left = Vec::new();
            if queries.goes_back {
                // One for each tilt.
                let of = |tilt: &f64| curves.remainders(tilt.min(last)).unwrap_or_default();
                left.extend(queries.tilts.iter().map(of));
                left.iter_mut().for_each(read);
            }
            queries.shown(last, &points, &left)
        };
        (own.iter().zip(apart).map(of).collect(), random)
    }
}

impl Likely {
    /// Adds what an emulator leaves, from the wall at `first` on.
    fn leave(&mut self, emulated: &Emulated<'_>, first: usize) {
        let count = emulated.left.len() as f64;
        let mean: [f64; NUMBERS] =
            std::array::from_fn(|k| emulated.left.iter().fold(0.0, |sum, left| sum + left[k]) / count);
        let alone = emulated.common.map(|share| (1.0 - share).sqrt());
        let shared = emulated.common.map(f64::sqrt);
        let left = emulated.left.iter().cycle().skip(first);
        for ((own, common), left) in self.own.iter_mut().zip(&mut self.common).zip(left) {
            for k in 0..NUMBERS {
                let off = left[k] - mean[k];
                own[k] += mean[k] + alone[k] * off;
                common[k] += shared[k] * off;
            }
        }
    }
}

/// What is expected of a wall and what it differs by.
fn moved(expected: &[f64; NUMBERS], left: &[f64; NUMBERS]) -> [f64; NUMBERS] {
    std::array::from_fn(|k| expected[k] + left[k])
}
