//! The interval of a sum of counts that weigh differently, as those of weighted walls do.

use super::reference::chi_square_quantile;

/// Interval of the mean of `sum`, a sum of independent Poisson counts times their weights, that misses it with probability `miss`. `variance`
/// is the sum of squared weights over all events counted, plus what else the sum varies by; `next` is the weight of the largest event that may have
/// gone unseen. Of equal weights and no other variance it is the exact interval of a Poisson mean (Garwood 1936). Without an event it ends at
/// `3.69 next` at 95 %.
///
/// Fay and Feuer (1997, Statistics in Medicine 16): each end is that of a gamma distribution with the mean and variance of the sum; at the
/// upper one an event of weight `next` is added. In their simulations and in ours it holds the mean more often than it says, the more so
/// the more the weights differ.
///
/// ```
/// use pirca::stats::weighted_interval;
/// let [low, high] = weighted_interval(3.0, 3.0, 1.0, 0.05);
/// assert!((low - 0.6187).abs() < 1e-4 && (high - 8.7673).abs() < 1e-4);
/// assert!((weighted_interval(0.0, 0.0, 0.01, 0.05)[1] - 0.036889).abs() < 1e-6);
/// ```
pub fn weighted_interval(sum: f64, variance: f64, next: f64, miss: f64) -> [f64; 2] {
    let end = |sum: f64, variance: f64, probability: f64| {
        if sum > 0.0 && variance > 0.0 {
            0.5 * variance / sum * chi_square_quantile(probability, 2.0 * sum * sum / variance)
        } else {
            sum
        }
    };
    [end(sum, variance, 0.5 * miss), end(sum + next, variance + next * next, 1.0 - 0.5 * miss)]
}
