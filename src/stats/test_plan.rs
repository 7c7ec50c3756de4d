//! How many specimens tell what: a difference between two kinds, or a characteristic value of stated quality.

use super::characteristic::{Variation, noncentral_t_cdf, predictive_factor};
use super::reference::student_quantile;
use crate::random::standard_normal::quantile;

/// More specimens than this are never tested.
const MOST: usize = 100_000;

/// What a test of a difference is to reach.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Aim {
    /// Probability with which two kinds that are the same are not called different.
    pub confidence: f64,
    /// Probability with which the difference is seen.
    pub power: f64,
}

/// Pairs of specimens that show a relative difference of two means of this coefficient of variation, whose pairs correlate so:
/// `2 (1 - r) (V / d)^2 (z_conf + z_power)^2`, as if the scatter were known (of small numbers [`specimens_to_see`] tells the truth). Infinite
/// for no difference.
///
/// ```
/// use pirca::stats::{Aim, pairs_to_see};
/// let aim = Aim { confidence: 0.95, power: 0.8 };
/// assert!((pairs_to_see(0.053, 0.0, 0.05, aim) - 17.6).abs() < 0.05);
/// assert!((pairs_to_see(0.053, 0.8, 0.05, aim) - 3.5).abs() < 0.05);
/// ```
pub fn pairs_to_see(cov: f64, correlation: f64, difference: f64, aim: Aim) -> f64 {
    let z = quantile(0.5 + 0.5 * aim.confidence) + quantile(aim.power);
    2.0 * (1.0 - correlation) * (cov / difference) * (cov / difference) * z * z
}

/// Probability that Student's test with `freedom` degrees of freedom sees a difference of so many standard errors, on either side.
fn seen(errors: f64, freedom: f64, confidence: f64) -> f64 {
    let t = student_quantile(0.5 + 0.5 * confidence, freedom);
    1.0 - noncentral_t_cdf(t, freedom, errors) + noncentral_t_cdf(-t, freedom, errors)
}

/// Probability that two independent groups of `n` normal specimens each show a difference of means of `effect` standard deviations (of one
/// specimen), by Student's test of both sides. 0 below two specimens.
pub fn power_of_groups(effect: f64, n: usize, confidence: f64) -> f64 {
    if n < 2 {
        return 0.0;
    }
    let n = n as f64;
    seen(effect.abs() * (0.5 * n).sqrt(), 2.0 * n - 2.0, confidence)
}

/// Least number of specimens in each of two independent groups that show a difference of `effect` standard deviations; `None` beyond
/// a hundred thousand.
pub fn specimens_to_see(effect: f64, aim: Aim) -> Option<usize> {
    least(2, |n| power_of_groups(effect, n, aim.confidence) >= aim.power)
}

/// The smallest difference, in standard deviations of one specimen, that two groups of `n` show; `None` below two.
pub fn smallest_seen(n: usize, aim: Aim) -> Option<f64> {
    if n < 2 {
        return None;
    }
    let (mut low, mut high) = (0.0, 1.0);
    while power_of_groups(high, n, aim.confidence) < aim.power {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if power_of_groups(middle, n, aim.confidence) < aim.power { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// What a characteristic value after EN 1990 D7.2 from `n` specimens loses in the mean, as a share of the true fractile at `probability`
/// of normal values with this coefficient of variation. `None` for a single specimen, and where the true fractile is not above 0.
///
/// ```
/// let loss = |n| pirca::stats::characteristic_loss(n, 0.05, 0.1).unwrap();
/// assert!((loss(3) - (3.372 - 1.645) * 0.1 / (1.0 - 1.645 * 0.1)).abs() < 1e-3 && loss(30) < 0.02);
/// ```
pub fn characteristic_loss(n: usize, probability: f64, cov: f64) -> Option<f64> {
    let k = predictive_factor(n, probability, Variation::Unknown)?;
    let whole = -quantile(probability);
    let fractile = 1.0 - whole * cov;
    (fractile > 0.0).then(|| (k - whole) * cov / fractile)
}

/// Least number of specimens whose characteristic value loses no more than this share in the mean; `None` where there is no fractile above
/// 0, or beyond a hundred thousand.
pub fn specimens_for_characteristic(probability: f64, cov: f64, loss: f64) -> Option<usize> {
    characteristic_loss(2, probability, cov)?;
    least(2, |n| characteristic_loss(n, probability, cov).is_some_and(|own| own <= loss))
}

/// Least number from `from` on that suffices, where more always suffices too.
fn least(from: usize, suffices: impl Fn(usize) -> bool) -> Option<usize> {
    let mut high = from;
    while !suffices(high) {
        if high >= MOST {
            return None;
        }
        high *= 2;
    }
    let mut low = from;
    while low < high {
        let middle = (low + high) / 2;
        if suffices(middle) { high = middle } else { low = middle + 1 }
    }
    Some(low)
}
