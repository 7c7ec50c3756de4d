//! Two arms of a comparison: which is better, by how much, for the next wall, on average, and at which levels.

use serde::Serialize;

use crate::ensemble::{Compared, Contest, Quantity};
use crate::stats;
use crate::stats::selection::{Kind, pairs};
use crate::stats::{Distributed, Dominance, NextPair, dominance, next_pair, probability_above};

/// What a difference shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ArmShown {
    /// The first arm is better, whatever the walls without a value would have borne.
    Better,
    /// The two cannot be told apart beyond the zone of indifference.
    Same,
    /// Neither is shown.
    Open,
}

/// Two arms, the one that is better so far first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ArmDifference {
    /// The one.
    pub arm: String,
    /// The other.
    pub over: String,
    /// What is shown.
    pub shown: ArmShown,
    /// Pairs of walls of the same member in which both brought a value, and pairs in which one did not.
    pub pairs: u64,
    /// See `pairs`.
    pub lost_pairs: u64,
    /// The means of both over the pairs of walls that brought two values, in the unit of the quantity; null where there is no such pair.
    pub means: Option<[f64; 2]>,
    /// By how much the first is better: its mean or its quantile is larger (a displacement smaller), or the probability of its failure
    /// smaller.
    pub better_by: Option<f64>,
    /// The interval of it.
    pub interval: Option<[f64; 2]>,
    /// The interval if the walls without a value had been as weak, or as strong, as can be; null where all brought one.
    pub interval_whatever_failed: Option<[f64; 2]>,
    /// The next pair of walls: how probable it is that the first is stronger.
    pub next_wall: NextPair,
    /// How probable it is that the first is stronger in the mean.
    pub on_average: Option<f64>,
    /// At which levels of the quantity the first is stronger for sure; null below ten walls.
    pub distribution: Option<ShareLevels>,
}

/// The distributions of two arms, see [`Dominance`], with levels in the unit of the quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ShareLevels {
    /// Between the first and the last level at which fewer walls of the first fail for sure.
    pub fewer_fail_between: Option<[f64; 2]>,
    /// Between the first and the last level at which more do.
    pub more_fail_between: Option<[f64; 2]>,
    /// At no level is the share of failed walls of the first larger than that of the second by more than this.
    pub more_fail_by_at_most: f64,
}

impl ArmDifference {
    /// Of the arms at these places of a contest.
    pub fn of(names: [&str; 2], places: [usize; 2], contest: &Contest<'_>, look: &Compared) -> ArmDifference {
        let [a, b] = places.map(|place| &look.kinds[place]);
        let difference = look.rule.difference(a, b, look.kinds.len());
        let pairs = pairs(a, b);
        let miss = 1.0 - contest.confidence;
        let whole: Vec<(f64, f64)> = pairs.iter().filter_map(|(a, b)| a.zip(*b)).collect();
        let told: Vec<f64> = whole.iter().map(|(a, b)| a - b).collect();
        let quantity = Quantity::of(contest.study);
        let mean = |of: fn(&(f64, f64)) -> f64| {
            stats::mean(&whole.iter().map(of).collect::<Vec<_>>()).map(|strength| quantity.strength(strength))
        };
        let zone = contest.same_within;
        ArmDifference {
            arm: names[0].to_owned(),
            over: names[1].to_owned(),
            shown: match difference.whatever {
                Some([low, _]) if low > 0.0 => ArmShown::Better,
                Some([low, high]) if low > -zone && high < zone => ArmShown::Same,
                _ => ArmShown::Open,
            },
            pairs: difference.pairs as u64,
            lost_pairs: difference.lost as u64,
            means: mean(|pair| pair.0).zip(mean(|pair| pair.1)).map(|(a, b)| [a, b]),
            better_by: difference.value,
            interval: difference.interval,
            interval_whatever_failed: difference.whatever.filter(|_| difference.lost > 0),
            next_wall: next_pair(&pairs, contest.tie(), miss),
            on_average: if a.fixed && b.fixed {
                told.first().map(|own| if *own > 0.0 { 1.0 } else { 0.5 * f64::from(u8::from(*own == 0.0)) })
            } else {
                probability_above(&told, 0.0)
            },
            distribution: dominance(distributed(a), distributed(b), miss).map(|own| levels(own, quantity)),
        }
    }
}

fn distributed(kind: &Kind) -> Distributed<'_> {
    match kind.values.first().copied().flatten().filter(|_| kind.fixed) {
        Some(value) => Distributed::Fixed(value),
        None => Distributed::Drawn(&kind.values),
    }
}

/// Levels of strength as levels of the quantity, the lower one first.
fn levels(own: Dominance, quantity: Quantity) -> ShareLevels {
    let back = |[low, high]: [f64; 2]| {
        let [a, b] = [low, high].map(|level| quantity.strength(level));
        [a.min(b), a.max(b)]
    };
    ShareLevels {
        fewer_fail_between: own.stronger.map(back),
        more_fail_between: own.weaker.map(back),
        more_fail_by_at_most: own.weaker_by_at_most,
    }
}
