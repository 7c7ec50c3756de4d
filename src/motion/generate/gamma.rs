//! The incomplete gamma function and its inverse, on libm: the same bits everywhere.

use crate::math::{exp, ln, ln_gamma};

/// Relative size of a term that changes no digit.
const SMALL: f64 = 1e-17;

/// Probability of a gamma variable of a shape and of rate 1 up to `x` (Abramowitz and Stegun 1964, 6.5.29). All terms are positive, so that
/// none is lost; there are about as many as `x` lies above the shape, and some ten times the root of the shape.
pub(super) fn cdf(shape: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let (mut term, mut sum) = (1.0 / shape, 1.0 / shape);
    let mut k = 1.0;
    while term > SMALL * sum {
        term *= x / (shape + k);
        sum += term;
        k += 1.0;
    }
    exp(shape * ln(x) - x - ln_gamma(shape)) * sum
}

/// The value up to which a gamma variable of a shape and of rate 1 lies with probability `p` in (0, 1), to the last bit or two.
pub(super) fn quantile(shape: f64, p: f64) -> f64 {
    let mut high = shape + 1.0;
    while cdf(shape, high) < p {
        high *= 2.0;
    }
    let mut low = 0.0;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return low;
        }
        if cdf(shape, middle) < p { low = middle } else { high = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::erf;

    #[test]
    fn it_is_the_closed_form_of_whole_and_half_shapes() {
        for x in [0.01, 0.5, 1.0, 2.5, 7.0, 30.0] {
            let expected =
                [(1.0, 1.0 - exp(-x)), (3.0, 1.0 - exp(-x) * (1.0 + x + 0.5 * x * x)), (0.5, erf(x.sqrt()))];
            for (shape, expected) in expected {
                // `1 - exp(-x)` itself keeps 1e-16 of 1.
                assert!((cdf(shape, x) - expected).abs() < 2e-15, "{shape} {x}: {}", cdf(shape, x));
            }
        }
    }

    #[test]
    fn quantiles_invert_it() {
        for shape in [1.0, 1.7, 4.0, 40.0, 900.0] {
            for p in [0.05, 0.45, 0.95] {
                // A density of at most 1 times the last bit of the quantile, and 1e-14 of the scale at large shapes.
                assert!((cdf(shape, quantile(shape, p)) - p).abs() < 1e-12, "{shape} {p}");
            }
        }
        assert!((quantile(1.0, 0.95) + ln(0.05)).abs() < 1e-14);
    }
}
