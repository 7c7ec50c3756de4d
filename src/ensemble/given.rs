//! A wall that is given, with parameters that are not known exactly: the points of a design at which it is solved, and the interval
//! that the answers lie in.

use crate::ensemble::Observed;
use crate::random::{Design, Place, RANDOMISATIONS, Spread};
use crate::stats::predictive_quantile;

/// Larger than any answer. A statistic that rests on it is not known.
const BEYOND: f64 = 1e100;

/// A parameter of the wall that is not known exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Unsure {
    /// Its name; its stream is keyed by it.
    pub name: &'static str,
    /// Its dimension in the design, which no other parameter changes.
    pub dimension: u32,
    /// Its distribution.
    pub spread: Spread,
}

/// The values of the parameters at the points of a scrambled Sobol sequence, in 16 randomisations; a pure function of seed and point.
pub fn given_points(unsure: &[Unsure], seed: u64, points: u64) -> Vec<Vec<f64>> {
    let value = |member: u64, own: &Unsure| {
        let place = Place { seed, member, points: (points / RANDOMISATIONS).max(1) };
        let uniform = Design::Sobol.uniform(place, own.name, own.dimension);
        crate::check!(uniform.is_some(), "a Sobol sequence without a point {member}");
        own.spread.quantile(uniform.unwrap_or(0.5))
    };
    (0..points).map(|member| unsure.iter().map(|own| value(member, own)).collect()).collect()
}

/// The ends between which one more answer lies with a probability of 90 %: below the lower one with 5 %, above the upper one with 5 %.
/// Answers are above 0. `None` where an end lies beyond what was looked at, or there are too few answers to tell it (below 19).
///
/// No answer is dropped: of one that is not known the interval holds whatever it is, as it is taken for 0 at the lower end, and for
/// larger than all others at the upper one.
pub fn predicted(answers: &[Observed]) -> [Option<f64>; 2] {
    let known = answers.iter().filter_map(|answer| match answer {
        Observed::Value(value) => Some(*value),
        _ => None,
    });
    let most = known.fold(f64::NEG_INFINITY, f64::max);
    let end = |p: f64, unknown: f64| {
        let values = answers.iter().map(|answer| match answer {
            Observed::Value(value) => *value,
            Observed::Above(_) => BEYOND,
            Observed::Nothing => unknown,
        });
        predictive_quantile(&values.collect::<Vec<f64>>(), p).filter(|end| *end <= most)
    };
    [end(0.05, 0.0), end(0.95, BEYOND)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Scale;

    fn phi() -> Unsure {
        let spread = Spread::spelled("30..38", [0.0, 89.0], Scale::Linear).unwrap();
        Unsure { name: "phi_deg", dimension: 0, spread }
    }

    #[test]
    fn points_fill_a_range_evenly_and_another_parameter_changes_none() {
        let alone = given_points(&[phi()], 1, 64);
        let kn = Spread::spelled("1e7..1e9", [1e3, 1e16], Scale::Logarithmic).unwrap();
        let kn = Unsure { name: "kn_pa_per_m", dimension: 1, spread: kn };
        let both = given_points(&[kn, phi()], 1, 64);
        let of_both: Vec<f64> = both.iter().map(|values| values[1]).collect();
        assert_eq!(alone.concat(), of_both);
        // Of the four points of each randomisation each quarter of the range holds one.
        for first in 0..16 {
            let mut quarters: Vec<u32> = alone
                .iter()
                .skip(first)
                .step_by(16)
                .map(|values| ((values[0] - 30.0) / 2.0) as u32)
                .collect();
            quarters.sort_unstable();
            assert_eq!(quarters, [0, 1, 2, 3]);
        }
        assert_ne!(alone, given_points(&[phi()], 2, 64));
    }

    #[test]
    fn no_answer_is_dropped_from_the_interval() {
        let known: Vec<Observed> = (1..=39).map(|k| Observed::Value(f64::from(k))).collect();
        assert_eq!(predicted(&known), [Some(2.0), Some(38.0)]);
        let with = |more: Observed, count: usize| {
            let mut answers = known[..39 - count].to_vec();
            answers.extend(vec![more; count]);
            predicted(&answers)
        };
        // One that failed widens it on both sides, and two leave no end above.
        assert_eq!(with(Observed::Nothing, 1), [Some(1.0), Some(38.0)]);
        assert_eq!(with(Observed::Nothing, 2), [Some(0.0), None]);
        assert_eq!(with(Observed::Above(89.0), 3), [Some(2.0), None]);
        assert_eq!(predicted(&known[..18]), [None, None]);
    }
}
