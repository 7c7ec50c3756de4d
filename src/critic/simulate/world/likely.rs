//! The paths that a wall may have under a truth: what the emulators expect, and what walls differ by.

use crate::critic::simulate::bank::{Curves, Emulated, Emulator, NUMBERS, PRIOR_WIDENING, Pushes, Test};
use crate::critic::simulate::queries::Queries;
use crate::critic::simulate::truth::Truth;
use crate::critic::simulate::world::{Walls, World, varies, varying};
use crate::math::ln;
use crate::random::Streams;
use crate::random::standard_normal::quantile;
use crate::study::Acts;

/// A wall differs from the expected path as one of so many of its nearest neighbours in the bank does.
pub(super) const NEIGHBOURS: usize = 20;

/// What walls share is set beside what the wall so far down the list of the nearest has of its own.
const COMMON_APART: usize = 3;

/// Unit of parameters that are stiffnesses of joints.
const STIFFNESS: &str = "Pa/m";
/// Half of the way over which slopes are taken, in standard deviations.
const HALF: f64 = 0.2;
/// Beyond this a score is as good as at the end of its prior.
const FURTHEST: f64 = 4.0;

/// What is known of the walls of a family before they are built.
pub(super) struct Likely {
    family: usize,
    /// The numbers of a path to be expected, see [`Path::adding`](crate::critic::Path::adding).
    expected: [f64; NUMBERS],
    /// What each may differ by, each equally likely.
    own: Vec<[f64; NUMBERS]>,
    /// And what all of them may besides, by the emulators' errors, each equally likely.
    common: Vec<[f64; NUMBERS]>,
    /// What a standard deviation of a specimen's stiffness changes.
    by_stiffness: [f64; NUMBERS],
    random: bool,
}

/// What the walls of a family may show of queries, before errors.
pub(in crate::critic) struct MayShow {
    /// By path, all equally likely, and query.
    pub paths: Vec<Vec<f64>>,
    /// Whether every specimen has a path of its own, or all share one.
    pub random: bool,
    /// What a standard deviation of a specimen's stiffness adds, by query: each specimen has a stiffness of its own.
    pub by_stiffness: Vec<f64>,
}

impl Likely {
    /// The numbers of a specimen's path: one of those that a wall may have.
    pub(super) fn wall(&self, specimen: usize, streams: &Streams) -> [f64; NUMBERS] {
        let Likely { family, expected, own, common, by_stiffness, random } = self;
        // Walls in which nothing is drawn are the same: what is left is the emulator's error, and they share it.
        let name = match random {
            true => format!("stones {specimen}"),
            false => format!("stones of family {family}"),
        };
        let alone = moved(expected, &own[streams.of(&name).below(own.len())]);
        let shared = streams.of(&format!("emulator of family {family}")).below(common.len());
        let stiffness = quantile(streams.of(&format!("stiffness of specimen {specimen}")).uniform());
        moved(&moved(&alone, &common[shared]), &by_stiffness.map(|by| stiffness * by))
    }
}

impl World<'_> {
    /// The paths that the walls of a family may have under a truth.
    pub(super) fn likely(&self, family: usize, truth: &Truth) -> Likely {
        let kind = self.kinds[family];
        let family = self.stands_for[family];
        let Walls { emulator, random } = &self.base[&family];
        let joints = truth.joints[kind].map(|score| score / PRIOR_WIDENING);
        let base = emulator.emulated(&joints, NEIGHBOURS);
        let mut likely = Likely {
            family,
            expected: base.numbers,
            own: vec![[0.0; NUMBERS]; base.left.len()],
            common: vec![[0.0; NUMBERS]; base.left.len()],
            by_stiffness: [0.0; NUMBERS],
            random: *random,
        };
        likely.leave(&base, 0);
        let scatter = truth.stiffness_scatter();
        likely.stiffen(scatter, self.per_stiffness(&joints, emulator, None));
        for (place, (cause, parameters)) in self.acting(truth, kind).enumerate() {
            let Some(change) = self.changes.get(&(family, cause)) else { continue };
            let parameters = varying(self.mechanisms, Some(cause), parameters.iter().copied());
            let scores: Vec<f64> = joints.into_iter().chain(parameters).collect();
            let emulated = change.emulator.emulated(&scores, NEIGHBOURS);
            likely.expected = moved(&likely.expected, &emulated.numbers);
            // The stones of the nearest wall with what the effect on a wall half way down the list is left with (a second effect: a
            // quarter), and so on round: what is nearest in the one has no part in what is nearest in the other.
            likely.leave(&emulated, emulated.left.len() >> (1 + place));
            likely.random |= change.random;
            likely.stiffen(scatter, self.per_stiffness(&scores, &change.emulator, Some(cause)));
        }
        likely
    }

    /// What an emulator's numbers change by with the logarithm of the joints' stiffness, that of every part of their law: kn, and the
    /// stiffnesses that are parameters of the cause.
    fn per_stiffness(&self, scores: &[f64], emulator: &Emulator, cause: Option<usize>) -> [f64; NUMBERS] {
        let kn = &self.nuisances[0].prior;
        let kn = slope_of_log(|score| kn.at_score(PRIOR_WIDENING * score), scores[0]);
        let parameters = cause.map_or(&[][..], |cause| &self.mechanisms[cause].parameters);
        let is_of_joints = cause.is_some_and(|cause| self.mechanisms[cause].acts == Acts::Joints);
        let varying = parameters.iter().filter(|p| varies(&p.search)).zip(3..);
        let stiffnesses = varying.filter(|(p, _)| is_of_joints && p.unit == STIFFNESS);
        let own = stiffnesses.map(|(p, at)| (at, slope_of_log(|score| p.search.at_score(score), scores[at])));
        let mut numbers = [0.0; NUMBERS];
        for (input, slope) in std::iter::once((0, kn)).chain(own).filter(|(_, slope)| *slope > 0.0) {
            let by = emulator.slope(scores, input);
            numbers.iter_mut().zip(by).for_each(|(number, by)| *number += by / slope);
        }
        numbers
    }

    /// What the walls of a family may show under a truth. Taken for independent of each other, the mean of so many `walls` scatters
    /// as it does where they share the emulators' errors. A wall that has fallen shows what it did last.
    pub(in crate::critic) fn may_show(
        &self,
        family: usize,
        queries: &Queries,
        truth: &Truth,
        walls: usize,
    ) -> MayShow {
        let Likely { expected, own, common, by_stiffness, random, .. } = self.likely(family, truth);
        let gauge = self.gauge(truth);
        let times = if random { (walls as f64).sqrt() } else { 1.0 };
        let apart = common.iter().cycle().skip(COMMON_APART);
        let shown = |numbers: &[f64; NUMBERS]| {
            if self.sought.is_some() {
                return queries.shaken(numbers);
            }
            if let Test::Shear { widest } = self.test {
                return queries.pushes(&Pushes::of(numbers, widest));
            }
            let curves = Curves::of(numbers);
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
        let of = |(own, common): (&[f64; NUMBERS], &[f64; NUMBERS])| {
            shown(&moved(&expected, &std::array::from_fn(|k| own[k] + times * common[k])))
        };
        let paths = own.iter().zip(apart).map(of).collect();
        let at = |way: f64| shown(&moved(&expected, &by_stiffness.map(|by| way * HALF * by)));
        let by_stiffness = at(1.0).iter().zip(at(-1.0)).map(|(a, b)| (a - b) / (2.0 * HALF)).collect();
        MayShow { paths, random, by_stiffness }
    }
}

impl Likely {
    /// Adds what so large a change of the logarithm of the stiffness makes.
    fn stiffen(&mut self, scatter: f64, per_stiffness: [f64; NUMBERS]) {
        self.by_stiffness.iter_mut().zip(per_stiffness).for_each(|(number, per)| *number += scatter * per);
    }

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

/// Slope of the logarithm of a positive quantity over its score.
fn slope_of_log(quantity: impl Fn(f64) -> f64, score: f64) -> f64 {
    let held = score.clamp(-FURTHEST, FURTHEST);
    (ln(quantity(held + HALF)) - ln(quantity(held - HALF))) / (2.0 * HALF)
}
