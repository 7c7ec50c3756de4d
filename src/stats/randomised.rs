//! Intervals from independent randomisations of a design: points of one design are not independent of each other, so that no interval
//! can rest on their number.
//!
//! The error of a statistic is that of the jackknife over the randomisations (Tukey 1958; Owen 2013, chapters 10 and 17): the
//! statistic is taken without one of them in turn. Of a mean over equally large randomisations it is the standard error of their
//! means. Intervals are Student's with one degree of freedom fewer than there are randomisations.

use std::borrow::Cow;

use super::moments::{cov, mean, sigma, sum};
use super::order::{Sorted, quantile};
use super::reference::student;
use super::{Estimate, Summary};
use crate::math::exp;

/// Fewer randomisations tell no error.
const FEWEST: usize = 3;

/// The statistic of all items of some randomisations, with its 95 % interval. `statistic` says `None` where it is not defined; there
/// is no interval where that is so without one of the randomisations, or where fewer than three hold anything.
pub fn by_randomisations<T: Clone>(
    randomisations: &[Vec<T>],
    statistic: impl Fn(&[T]) -> Option<f64>,
) -> Estimate {
    let Some(value) = statistic(&randomisations.concat()) else { return Estimate::UNDEFINED };
    let held: Vec<&Vec<T>> = randomisations.iter().filter(|own| !own.is_empty()).collect();
    if held.len() < FEWEST {
        return Estimate { value: Some(value), interval: None };
    }
    let without = |left_out: usize| {
        let rest = held.iter().enumerate().filter(|(k, _)| *k != left_out);
        statistic(&rest.flat_map(|(_, own)| own.iter().cloned()).collect::<Vec<T>>())
    };
    let interval = (0..held.len()).map(without).collect::<Option<Vec<f64>>>().map(|without| {
        let half = student((held.len() - 1) as f64) * jackknife_error(&without);
        [value - half, value + half]
    });
    Estimate { value: Some(value), interval }
}

/// Standard error of a statistic from its values without one group in turn, at least two.
pub(super) fn jackknife_error(without: &[f64]) -> f64 {
    let count = without.len() as f64;
    let centre = mean(without).unwrap_or(0.0);
    let squares: Vec<f64> = without.iter().map(|x| (x - centre) * (x - centre)).collect();
    ((count - 1.0) / count * sum(&squares)).sqrt()
}

/// Interval of a quantile between two others: those at the ends of the interval of the share of values up to it (Woodruff 1952). `None`
/// where that share may be 0 or 1.
fn between_quantiles(shared: &[Vec<f64>], all: &[f64], value: f64) -> Option<[f64; 2]> {
    let up_to = |values: &[f64]| values.iter().filter(|x| **x <= value).count() as f64 / values.len() as f64;
    let [low, high] =
        by_randomisations(shared, |values| (!values.is_empty()).then(|| up_to(values))).interval?;
    if low <= 0.0 || high >= 1.0 {
        return None;
    }
    Some([quantile(all, low)?, quantile(all, high)?])
}

/// The same interval on the logarithm, for what is above 0; as it was where its value is not.
fn above_0(Estimate { value, interval }: Estimate) -> Estimate {
    let interval = value.zip(interval).map(|(value, [low, high])| match value > 0.0 {
        true => [-1.0, 1.0].map(|side| value * exp(side * 0.5 * (high - low) / value)),
        false => [low, high],
    });
    Estimate { value, interval }
}

/// Values of an ensemble: independent of each other, or the points of randomisations of a design.
#[derive(Clone, Debug, PartialEq)]
pub enum Sample<'v> {
    /// Independent.
    Independent(Cow<'v, [f64]>),
    /// By randomisation.
    Randomised(Vec<Vec<f64>>),
}

impl Sample<'_> {
    /// From values with the numbers of their members, of which `randomisations` share the design in turn; 1 where each member is drawn
    /// by itself.
    pub fn of(values: impl IntoIterator<Item = (u64, f64)>, randomisations: u64) -> Self {
        if randomisations < 2 {
            return Sample::Independent(values.into_iter().map(|(_, value)| value).collect());
        }
        let mut shared = vec![Vec::new(); randomisations as usize];
        for (member, value) in values {
            shared[(member % randomisations) as usize].push(value);
        }
        Sample::Randomised(shared)
    }

    /// Mean, sigma and COV with their intervals; those of sigma and COV stay above 0.
    pub fn summary(&self) -> Summary {
        match self {
            Sample::Independent(values) => Summary::of(values),
            Sample::Randomised(shared) => Summary {
                n: shared.iter().map(Vec::len).sum(),
                mean: by_randomisations(shared, mean),
                sigma: above_0(by_randomisations(shared, sigma)),
                cov: above_0(by_randomisations(shared, cov)),
            },
        }
    }

    /// The same with an interval of the mean that stays above 0; see [`Summary::of_positive`].
    pub fn summary_of_positive(&self) -> Summary {
        match self {
            Sample::Independent(values) => Summary::of_positive(values),
            Sample::Randomised(_) => {
                let summary = self.summary();
                Summary { mean: above_0(summary.mean), ..summary }
            }
        }
    }

    /// Standard error of the mean; 0 where there are too few values to tell it.
    pub fn error_of_mean(&self) -> f64 {
        match self {
            Sample::Independent(values) => {
                sigma(values).map_or(0.0, |sigma| sigma / (values.len() as f64).sqrt())
            }
            Sample::Randomised(shared) => {
                let held = shared.iter().filter(|own| !own.is_empty()).count();
                let half = by_randomisations(shared, mean).interval.map(|[low, high]| 0.5 * (high - low));
                half.map_or(0.0, |half| half / student((held - 1) as f64))
            }
        }
    }

    /// The quantile at `p` of type 7 with its interval; `None` where the sample does not bound it on both sides.
    pub fn quantile(&self, p: f64) -> Estimate {
        match self {
            Sample::Independent(values) => Sorted::of(values.to_vec()).quantile(p),
            Sample::Randomised(shared) => {
                let all = shared.concat();
                let value = quantile(&all, p);
                Estimate { value, interval: value.and_then(|value| between_quantiles(shared, &all, value)) }
            }
        }
    }
}
