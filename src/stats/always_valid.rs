//! Intervals that hold at every number of values at once, so that whoever looks after each further value and stops when he likes is
//! still right with the stated confidence (confidence sequences: Robbins 1970).

use super::empirical::clopper_pearson_at;
use super::moments::{check_values, mean, sigma};
use super::order::order_interval;
use crate::math::{exp, ln, pow};

/// Variance of the standardised mean that the mixture of [`always_valid_mean`] is taken over is one over this: the sequence is
/// narrowest, against others of its kind, at some tens of values.
const MIXTURE: f64 = 2.0;
/// The first number of values at which shares and quantiles are looked at, and by how much it grows from look to look.
const FIRST_LOOK: f64 = 10.0;
const GROWTH: f64 = 1.2;

/// Interval of the mean of normal values of unknown scatter that misses it with a probability of at most `miss`, over all numbers of
/// values together: Student's t mixed over a normal standardised mean (Lai 1976; Wang and Ramdas 2025, Theorem 4.7). With r = c / (n + c)
/// and q = (miss^2 r)^(-1/n) it holds all means with `t^2 / (n - 1) < (q - 1) / (1 - q r)`.
///
/// `None` below two values, and while so few values bound nothing. Equal values give that value twice.
///
/// ```
/// use pirca::stats::always_valid_mean;
/// let values: Vec<f64> = (0..40).map(|k| f64::from(k % 5)).collect();
/// let [low, high] = always_valid_mean(&values, 0.05).unwrap();
/// assert!(low > 1.0 && high < 3.0 && always_valid_mean(&values[..1], 0.05).is_none());
/// ```
pub fn always_valid_mean(values: &[f64], miss: f64) -> Option<[f64; 2]> {
    check_miss(miss);
    let (centre, spread) = mean(values).zip(sigma(values))?;
    let n = values.len() as f64;
    let r = MIXTURE / (n + MIXTURE);
    let q = exp(-(2.0 * ln(miss) + ln(r)) / n);
    let left = 1.0 - q * r;
    (left > 0.0).then(|| {
        let t = ((n - 1.0) * (q - 1.0) / left).sqrt();
        let half = t * spread / n.sqrt();
        [centre - half, centre + half]
    })
}

/// Interval of a probability from trials in their order, that misses it with a probability of at most `miss` over all numbers of trials
/// together: Clopper and Pearson's at growing numbers of trials, whose probabilities to miss add up. What came after the last such
/// number is not used. `None` below ten trials.
pub fn always_valid_share(hits: &[bool], miss: f64) -> Option<[f64; 2]> {
    let (n, miss) = look(hits.len(), miss)?;
    let k = hits[..n].iter().filter(|hit| **hit).count();
    Some(clopper_pearson_at(k, n, 1.0 - miss))
}

/// Interval of the quantile at `p` of values in the order in which they were found, that misses it with a probability of at most `miss`
/// over all numbers of values together: two order statistics at growing numbers of values. `None` while they bound nothing.
pub fn always_valid_quantile(values: &[f64], p: f64, miss: f64) -> Option<[f64; 2]> {
    check_values(values);
    let (n, miss) = look(values.len(), miss)?;
    order_interval(&values[..n], p, 0.5 * miss)
}

/// Half width of a band around the empirical distribution of values, up to the last look, that holds the whole distribution at all looks
/// with a probability of at least 1 - `miss` (Massart 1990); with the number of values that it is about.
pub(super) fn band(values: usize, miss: f64) -> Option<(usize, f64)> {
    let (n, miss) = look(values, miss)?;
    Some((n, (ln(2.0 / miss) / (2.0 * n as f64)).sqrt()))
}

/// The last number of values at which one looks, and the share of `miss` that is spent there: the k-th look has `miss / (k (k + 1))`, and
/// these add up to `miss`.
fn look(values: usize, miss: f64) -> Option<(usize, f64)> {
    check_miss(miss);
    let at = |k: u32| (FIRST_LOOK * pow(GROWTH, f64::from(k - 1))).round() as usize;
    let last = (1..).take_while(|k| at(*k) <= values).last()?;
    Some((at(last), miss / (f64::from(last) * f64::from(last + 1))))
}

fn check_miss(miss: f64) {
    crate::check!(miss > 0.0 && miss < 1.0, "an interval cannot miss with a probability of {miss}");
}
