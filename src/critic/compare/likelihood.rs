//! How likely one reading is.

use crate::math::ln;
use crate::random::standard_normal::{between, cdf, density};
use crate::study::{MeasuredKind, Measurement};

/// Logarithm of the likelihood of a measurement whose reading is normal with this mean and standard deviation (SI, above
/// 0): of an exact reading its density, of a rounded one the probability of all that is rounded to it, of a bound the
/// probability of its side. Minus infinity where that is below the smallest number.
///
/// The measurement's own error is not added: `sd` is that of the reading as a whole.
pub fn log_likelihood(m: &Measurement, mean: f64, sd: f64) -> f64 {
    crate::check!(sd > 0.0, "a reading cannot have the standard deviation {sd}");
    let z = (m.value - mean) / sd;
    match m.kind {
        MeasuredKind::Exact => ln(density(z)) - ln(sd),
        MeasuredKind::Rounded => {
            let half = 0.5 * m.resolution / sd;
            ln(between(z - half, z + half))
        }
        MeasuredKind::Below => ln(cdf(z)),
        MeasuredKind::Above => ln(cdf(-z)),
    }
}
