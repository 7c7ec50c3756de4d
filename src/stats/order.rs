//! Quantiles of a sample and their distribution-free interval.

use super::Estimate;
use super::moments::check_values;
use super::reference::TAIL;
use super::very_many::VERY_MANY;
use statrs::distribution::{Binomial, DiscreteCDF};

/// A place among order statistics that is so near to a whole one is that.
const WHOLE: f64 = 1e-9;

/// A sample in ascending order: sorted once, in place, it gives any number of quantiles without another copy.
#[derive(Clone, Debug, PartialEq)]
pub struct Sorted(Vec<f64>);

impl Sorted {
    /// Sorts a sample of finite values.
    pub fn of(mut values: Vec<f64>) -> Sorted {
        check_values(&values);
        // Values that this order takes for equal have the same bits, so that the places of equal ones do not matter.
        values.sort_unstable_by(f64::total_cmp);
        Sorted(values)
    }

    /// The values, ascending.
    pub fn values(&self) -> &[f64] {
        &self.0
    }

    /// The quantile at `p` with its interval: see [`quantile`] and [`quantile_interval`].
    pub fn quantile(&self, p: f64) -> Estimate {
        Estimate { value: quantile_of_sorted(&self.0, p), interval: self.interval(p, TAIL) }
    }

    /// An interval of the quantile that leaves out `tail` (a probability) at each end.
    fn interval(&self, p: f64, tail: f64) -> Option<[f64; 2]> {
        ranks(self.0.len(), p, tail).map(|ranks| ranks.map(|rank| self.0[rank - 1]))
    }
}

/// The ranks (from 1) of the order statistics that an interval of the quantile at `p` lies between.
fn ranks(n: usize, p: f64, tail: f64) -> Option<[usize; 2]> {
    check_probability(p);
    let below = Binomial::new(p, n as u64).ok()?;
    let (mean, spread) = (p * n as f64, (p * (1.0 - p) * n as f64).sqrt());
    // The k-th smallest value exceeds the quantile with probability P(at most k - 1 values below it). Of very many values that
    // probability is not reliable near the mean, where it is no rarity, which is all that is asked.
    let exceeds = |k: usize| match n as f64 > VERY_MANY && (k as f64 - mean).abs() < spread {
        true => 0.5,
        false => below.cdf(k as u64 - 1),
    };
    let low = last_rank(n, |k| exceeds(k) <= tail)?;
    let high = last_rank(n, |k| exceeds(k) < 1.0 - tail).unwrap_or(0) + 1;
    (high <= n).then_some([low, high])
}

/// Quantile at `p` in [0, 1] of a sample in any order; `None` for an empty one.
///
/// Type 7 of Hyndman and Fan (1996), the default of R and NumPy: linear between the order statistics, with the
/// smallest value at p = 0 and the largest at p = 1.
pub fn quantile(values: &[f64], p: f64) -> Option<f64> {
    quantile_of_sorted(Sorted::of(values.to_vec()).values(), p)
}

/// Value below which one more of the same population lies with probability `p`, averaged over samples like this one: linear between
/// the order statistics at `p (n + 1)` (type 6 of Hyndman and Fan 1996), for every continuous distribution exact at whole places.
/// `None` where the sample is too small to bound one more value so closely (at 0.05 and 0.95 below 19 values).
///
/// ```
/// let walls: Vec<f64> = (1..=19).map(f64::from).collect();
/// assert_eq!(pirca::stats::predictive_quantile(&walls, 0.05), Some(1.0));
/// assert_eq!(pirca::stats::predictive_quantile(&walls[1..], 0.05), None);
/// ```
pub fn predictive_quantile(values: &[f64], p: f64) -> Option<f64> {
    check_probability(p);
    let Sorted(values) = Sorted::of(values.to_vec());
    // What rounding leaves of a whole place.
    let place = p * (values.len() + 1) as f64;
    let place = if (place - place.round()).abs() < WHOLE { place.round() } else { place };
    let below = (place.floor() as usize).checked_sub(1)?;
    let left = *values.get(below)?;
    let share = place - place.floor();
    if share == 0.0 {
        return Some(left);
    }
    values.get(below + 1).map(|right| (left + share * (right - left)).clamp(left, *right))
}

/// 95 % interval of the population's quantile at `p` in [0, 1], between two order statistics (David and Nagaraja 2003,
/// section 7.1). Holds for every continuous distribution, with a coverage of at least 95 %; the number of values below
/// the quantile is binomial. As ranks are whole it is more: 97.9 % for the median of ten values, 95.7 of thirty, 98.3 for
/// the 5 % fractile of a hundred. `None` when the sample is too small to bound the quantile on both sides (for the median:
/// below six values).
pub fn quantile_interval(values: &[f64], p: f64) -> Option<[f64; 2]> {
    order_interval(values, p, TAIL)
}

/// The same with another probability left out at each end.
pub(super) fn order_interval(values: &[f64], p: f64, tail: f64) -> Option<[f64; 2]> {
    Sorted::of(values.to_vec()).interval(p, tail)
}

/// Places of the `count` smallest of values that come with their places, smallest first; of equal ones the lower place. All
/// of them where there are no more.
pub fn smallest(values: impl Iterator<Item = (f64, usize)>, count: usize) -> Vec<usize> {
    let mut values: Vec<(f64, usize)> = values.collect();
    let order = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    if count < values.len() {
        values.select_nth_unstable_by(count, order);
        values.truncate(count);
    }
    values.sort_unstable_by(order);
    values.into_iter().map(|(_, place)| place).collect()
}

/// Type 7 quantile of values in ascending order.
pub(super) fn quantile_of_sorted(values: &[f64], p: f64) -> Option<f64> {
    check_probability(p);
    let last = values.len().checked_sub(1)?;
    let place = p * last as f64;
    let below = place.floor();
    let index = below as usize;
    let (left, right) = (values[index], values[(index + 1).min(last)]);
    Some((left + (place - below) * (right - left)).clamp(left, right))
}

/// Largest rank from 1 to `n` that passes, where passing is lost once and for all as ranks grow.
fn last_rank(n: usize, passes: impl Fn(usize) -> bool) -> Option<usize> {
    let (mut passed, mut failed) = (0, n + 1);
    while failed - passed > 1 {
        let middle = passed + (failed - passed) / 2;
        if passes(middle) {
            passed = middle;
        } else {
            failed = middle;
        }
    }
    (passed > 0).then_some(passed)
}

fn check_probability(p: f64) {
    crate::check!((0.0..=1.0).contains(&p), "a quantile was asked at {p}, outside [0, 1]");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_of_very_many_values_lie_as_far_from_the_middle_as_the_normal_distribution_says() {
        for (n, p) in
            [(10_000_000_usize, 0.5), (100_000_000, 0.5), (100_000_000, 0.05), (1_000_000_000, 0.95)]
        {
            let [low, high] = ranks(n, p, TAIL).expect("there are enough");
            let (mean, half) = (p * n as f64, 1.959964 * (p * (1.0 - p) * n as f64).sqrt());
            let apart = [mean - low as f64, high as f64 - mean];
            // A rank is a whole number, and the binomial distribution is skewed by about as much.
            assert!(apart.iter().all(|apart| (apart - half).abs() < 3.0), "{n} {p}: {apart:?} for {half}");
        }
    }
}
