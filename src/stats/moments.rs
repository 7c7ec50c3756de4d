//! Mean, standard deviation and COV, summed in index order.

use crate::math::{exp, ln};
use crate::random::standard_normal::quantile;
use crate::stats::Estimate;

/// Sum in index order with Neumaier's compensation (Neumaier 1974): the error is a few roundings of the result and of
/// the sum of magnitudes times 1e-32 per term.
pub fn sum(values: &[f64]) -> f64 {
    total(values.iter().copied())
}

/// Arithmetic mean; `None` for an empty sample.
///
/// Taken relative to the first value, so that the mean of equal values is that value, to the last bit.
pub fn mean(values: &[f64]) -> Option<f64> {
    check_values(values);
    let first = *values.first()?;
    Some(first + total(values.iter().map(|v| v - first)) / values.len() as f64)
}

/// Standard deviation of the population that the sample was drawn from (divisor n - 1); `None` below two values.
/// Equal values give exactly 0.
pub fn sigma(values: &[f64]) -> Option<f64> {
    let centre = mean(values)?;
    (values.len() > 1).then(|| comoment(values, centre, values, centre).sqrt())
}

/// Coefficient of variation, sigma over the magnitude of the mean (a number, not per cent); `None` below two values and
/// where the mean is 0.
pub fn cov(values: &[f64]) -> Option<f64> {
    let centre = mean(values)?;
    let ratio = sigma(values)? / centre.abs();
    ratio.is_finite().then_some(ratio)
}

/// Pearson's correlation of two samples of the same length; `None` below two values and where one of them does not scatter.
///
/// ```
/// use pirca::stats::correlation;
/// assert!((correlation(&[1.0, 2.0, 3.0], &[2.0, 4.0, 6.0]).unwrap() - 1.0).abs() < 1e-12);
/// assert_eq!(correlation(&[1.0, 2.0], &[3.0, 3.0]), None);
/// ```
pub fn correlation(a: &[f64], b: &[f64]) -> Option<f64> {
    crate::check!(a.len() == b.len(), "{} values cannot be paired with {}", a.len(), b.len());
    let ((mean_a, mean_b), (sigma_a, sigma_b)) = (mean(a).zip(mean(b))?, sigma(a).zip(sigma(b))?);
    let spread = sigma_a * sigma_b;
    (spread > 0.0).then(|| (comoment(a, mean_a, b, mean_b) / spread).clamp(-1.0, 1.0))
}

/// The same with its 95 % interval for pairs that are normal: Fisher's z, whose standard error is `1 / sqrt(n - 3)`. No interval below four
/// pairs, and none of a correlation of 1 or -1.
///
/// ```
/// use pirca::stats::correlation_estimate;
/// let found = correlation_estimate(&[1.0, 2.0, 3.0, 4.0, 5.0], &[1.0, 3.0, 2.0, 5.0, 4.0]);
/// let [low, high] = found.interval.unwrap();
/// assert!((found.value.unwrap() - 0.8).abs() < 1e-12 && (low + 0.2796).abs() < 1e-4 && (high - 0.9862).abs() < 1e-4);
/// ```
pub fn correlation_estimate(a: &[f64], b: &[f64]) -> Estimate {
    let value = correlation(a, b);
    let interval = value.filter(|r| a.len() > 3 && r.abs() < 1.0).map(|r| {
        let (z, error) = (0.5 * ln((1.0 + r) / (1.0 - r)), quantile(0.975) / ((a.len() - 3) as f64).sqrt());
        [z - error, z + error].map(|z| 1.0 - 2.0 / (exp(2.0 * z) + 1.0))
    });
    Estimate { value, interval }
}

/// Sample covariance (divisor n - 1) of two samples of the same length, at least 2, about their given means.
pub(super) fn comoment(a: &[f64], mean_a: f64, b: &[f64], mean_b: f64) -> f64 {
    covariance(a.iter().zip(b).map(|(x, y)| (x - mean_a, y - mean_b)), a.len())
}

/// Sample covariance (divisor n - 1) of `n` pairs, at least 2, of what they differ by from their means.
pub(super) fn covariance(pairs: impl Iterator<Item = (f64, f64)>, n: usize) -> f64 {
    total(pairs.map(|(x, y)| x * y)) / (n - 1) as f64
}

/// Stops on values that no statistic of this module is defined for.
pub(super) fn check_values(values: &[f64]) {
    for (index, value) in values.iter().enumerate() {
        crate::check!((-1e150..=1e150).contains(value), "value {index} of a sample is {value}");
    }
}

fn total(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut lost) = (0.0_f64, 0.0_f64);
    for value in values {
        let next = sum + value;
        lost += if sum.abs() >= value.abs() { (sum - next) + value } else { (value - next) + sum };
        sum = next;
    }
    sum + lost
}
