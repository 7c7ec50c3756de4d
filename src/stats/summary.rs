//! Mean, sigma and COV of one sample, each with its interval.

use super::Estimate;
use super::moments::{cov, mean, sigma};
use super::reference::{chi_square, student};
use crate::math::exp;

/// Mean, sigma and COV of a sample, with 95 % intervals that are exact (mean, sigma) or nearly so (COV) when the values
/// are independent and normal.
///
/// ```
/// use pirca::stats::Summary;
/// let walls = Summary::of(&[13.5, 14.5, 15.0]);
/// assert_eq!(walls.n, 3);
/// assert!((walls.sigma.value.unwrap() - 0.76).abs() < 0.005);
/// assert_eq!(Summary::of(&[14.5]).sigma.value, None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Summary {
    /// Number of values.
    pub n: usize,
    /// Arithmetic mean; undefined for an empty sample, without interval for one value. Student's interval.
    pub mean: Estimate,
    /// Standard deviation (divisor n - 1); undefined below two values. Chi-square interval.
    pub sigma: Estimate,
    /// Sigma over the magnitude of the mean; undefined below two values and for a mean of 0. Interval of Vangel
    /// (1996): none where its upper end is infinite, which happens when few values scatter much (with three values at
    /// a COV above 0.28). It is meant for a COV up to 1/3; beyond, it is rough. Of three walls whose true COV is 0.2, 15 in 100
    /// samples have none, and those that have one hold the truth in 97 of 100.
    pub cov: Estimate,
}

impl Summary {
    /// The summary of a sample of finite values, summed in the order given.
    pub fn of(values: &[f64]) -> Summary {
        let n = values.len();
        let (mean, sigma, cov) = (mean(values), sigma(values), cov(values));
        Summary {
            n,
            mean: Estimate { value: mean, interval: mean.zip(sigma).map(|(m, s)| mean_interval(n, m, s)) },
            sigma: Estimate { value: sigma, interval: sigma.map(|s| sigma_interval(n, s)) },
            cov: Estimate { value: cov, interval: cov.and_then(|k| cov_interval(n, k)) },
        }
    }
}

impl Summary {
    /// The same with an interval of the mean that stays above 0, for a quantity that cannot be negative (an angle of collapse):
    /// Student's on the logarithm of the mean, `m exp(-+ t sigma / (m sqrt(n)))`. To the first order in the half width it is
    /// Student's own. Where the mean is not above 0 it is left as it is.
    ///
    /// ```
    /// use pirca::stats::Summary;
    /// let angles = [0.5, 2.0, 18.0, 14.5];
    /// let [low, high] = Summary::of_positive(&angles).mean.interval.unwrap();
    /// assert!(Summary::of(&angles).mean.interval.unwrap()[0] < 0.0 && 0.0 < low && low < 8.75 && high > 8.75);
    /// let near = Summary::of_positive(&[14.0, 14.1, 14.2]).mean.interval.unwrap();
    /// let student = Summary::of(&[14.0, 14.1, 14.2]).mean.interval.unwrap();
    /// assert!((near[0] - student[0]).abs() < 3e-3 && (near[1] - student[1]).abs() < 3e-3);
    /// ```
    pub fn of_positive(values: &[f64]) -> Summary {
        let summary = Summary::of(values);
        Summary { mean: above_zero(summary.mean), ..summary }
    }
}

/// A value above 0 with an interval about it, the interval on its logarithm: to the first order in the half width it is the same, and
/// it stays above 0. Where the value is not above 0 it is left as it is.
///
/// Of normal values it holds the truth as often as Student's. Of skewed ones it does so more often, but not in 95 of 100 cases: about
/// the mean of ten lognormal values of COV 0.3, 0.5, 0.7, 1.0 and 1.5 in 94.5, 93.5, 92.5, 90.5 and 87 (Student's own: 94, 92.5, 90.5,
/// 87, 82). It then mostly lies too low, as no large value was among the ten.
pub fn above_zero(estimate: Estimate) -> Estimate {
    let half = |mean: f64, [low, high]: [f64; 2]| (0.5 * (high - low)) / mean;
    let interval = estimate.value.zip(estimate.interval).map(|(mean, interval)| match mean > 0.0 {
        true => [mean * exp(-half(mean, interval)), mean * exp(half(mean, interval))],
        false => interval,
    });
    Estimate { interval, ..estimate }
}

/// mean -+ t sigma / sqrt(n) with n - 1 degrees of freedom (Student 1908).
fn mean_interval(n: usize, mean: f64, sigma: f64) -> [f64; 2] {
    let half = student((n - 1) as f64) * sigma / (n as f64).sqrt();
    [mean - half, mean + half]
}

/// sigma sqrt((n - 1) / u) at the upper and the lower chi-square point u: (n - 1) s^2 / sigma^2 is chi-square with
/// n - 1 degrees of freedom.
fn sigma_interval(n: usize, sigma: f64) -> [f64; 2] {
    sigma_factors(n).map(|factor| sigma * factor)
}

/// The ends of the 95 % interval of a sigma over the sigma found in `n` normal values, at least two.
///
/// ```
/// let [low, high] = pirca::stats::sigma_factors(3);
/// assert!((low - 0.52).abs() < 0.005 && (high - 6.28).abs() < 0.005);
/// ```
pub fn sigma_factors(n: usize) -> [f64; 2] {
    crate::check!(n > 1, "{n} values have no sigma");
    let freedom = (n - 1) as f64;
    let [lower, upper] = chi_square(freedom);
    [(freedom / upper).sqrt(), (freedom / lower).sqrt()]
}

/// Modified McKay interval (Vangel 1996, Eq. 16): k / sqrt(((u + 2)/n - 1) k^2 + u/(n - 1)) at the upper and the lower
/// chi-square point u with n - 1 degrees of freedom; k is the sample's COV. A radicand that is not positive means that
/// no COV is too large to be compatible with the sample.
fn cov_interval(n: usize, k: f64) -> Option<[f64; 2]> {
    let count = n as f64;
    let [lower, upper] = chi_square(count - 1.0);
    let radicand = |u: f64| ((u + 2.0) / count - 1.0) * k * k + u / (count - 1.0);
    let (low, high) = (radicand(upper), radicand(lower));
    (low > 0.0 && high > 0.0).then(|| [k / low.sqrt(), k / high.sqrt()])
}
