//! Dominance of a whole distribution: at which levels is the share of the first that lies below smaller than that of the second, and by
//! how much may it be larger anywhere?
//!
//! The first stochastically dominates the second (of the first order) if nowhere a larger share of it lies below. No finite sample shows
//! that for every level, as the ends of a distribution are never seen (Davidson and Duclos 2013). What can be shown is told: the levels
//! between which it is stronger for sure, and a bound on what it may be weaker by.

use super::always_valid::band;
use super::moments::check_values;

/// A sample for the comparison of distributions; larger values are stronger.
#[derive(Clone, Copy, Debug)]
pub enum Distributed<'v> {
    /// Values in the order in which they were drawn; none of one that brought no value, which may lie anywhere.
    Drawn(&'v [Option<f64>]),
    /// Nothing is drawn: each has this value.
    Fixed(f64),
}

/// What is shown of two distributions, all of it together with the stated confidence.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Dominance {
    /// The lowest and the highest level at which a smaller share of the first lies below, for sure.
    pub stronger: Option<[f64; 2]>,
    /// The same of the second.
    pub weaker: Option<[f64; 2]>,
    /// By no more than this is the share of the first that lies below any level larger than that of the second.
    pub weaker_by_at_most: f64,
    /// The same, the two exchanged.
    pub stronger_by_at_most: f64,
}

/// Compares two distributions by a band around each, which hold at all numbers of values together and miss with a probability of at most
/// `miss` in all. The samples need not be independent of one another. `None` below ten values, and of two that are fixed.
pub fn dominance(a: Distributed<'_>, b: Distributed<'_>, miss: f64) -> Option<Dominance> {
    if let (Distributed::Fixed(_), Distributed::Fixed(_)) = (a, b) {
        return None;
    }
    let (a, b) = (Curve::of(a, 0.5 * miss)?, Curve::of(b, 0.5 * miss)?);
    // Below all values, too: those that are lost may lie there.
    let mut levels: Vec<f64> = a.values.iter().chain(&b.values).copied().chain([f64::NEG_INFINITY]).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut found =
        Dominance { stronger: None, weaker: None, weaker_by_at_most: 0.0, stronger_by_at_most: 0.0 };
    let widen = |ends: &mut Option<[f64; 2]>, level: f64| {
        *ends = Some(ends.map_or([level; 2], |[low, _]| [low, level]));
    };
    for level in levels {
        let ([a_low, a_high], [b_low, b_high]) = (a.at(level), b.at(level));
        if a_high < b_low {
            widen(&mut found.stronger, level);
        }
        if b_high < a_low {
            widen(&mut found.weaker, level);
        }
        found.weaker_by_at_most = found.weaker_by_at_most.max(a_high - b_low);
        found.stronger_by_at_most = found.stronger_by_at_most.max(b_high - a_low);
    }
    Some(found)
}

/// A distribution with its band.
struct Curve {
    values: Vec<f64>,
    lost: f64,
    all: f64,
    half: f64,
}

impl Curve {
    fn of(sample: Distributed<'_>, miss: f64) -> Option<Curve> {
        match sample {
            Distributed::Fixed(value) => Some(Curve { values: vec![value], lost: 0.0, all: 1.0, half: 0.0 }),
            Distributed::Drawn(values) => {
                let (n, half) = band(values.len(), miss)?;
                let mut told: Vec<f64> = values[..n].iter().flatten().copied().collect();
                check_values(&told);
                told.sort_by(f64::total_cmp);
                let lost = (n - told.len()) as f64;
                Some(Curve { values: told, lost, all: n as f64, half })
            }
        }
    }

    /// Least and largest share that lies at or below a level.
    fn at(&self, level: f64) -> [f64; 2] {
        let below = self.values.partition_point(|value| *value <= level) as f64;
        [(below / self.all - self.half).max(0.0), ((below + self.lost) / self.all + self.half).min(1.0)]
    }
}
