//! Quantiles of the distributions that intervals are read from.

use super::very_many::{self, VERY_MANY};
use crate::math::pow;
use crate::random::standard_normal::cdf;
use statrs::distribution::{Beta, ChiSquared, ContinuousCDF, StudentsT};

/// Probability left out at each end of a 95 % interval.
pub(super) const TAIL: f64 = 0.025;

/// Upper 2.5 % point of Student's t with `freedom` degrees of freedom (any positive number).
pub(super) fn student(freedom: f64) -> f64 {
    student_quantile(1.0 - TAIL, freedom)
}

/// Quantile at `probability` in (0, 1) of Student's t with `freedom` degrees of freedom (any positive number).
pub fn student_quantile(probability: f64, freedom: f64) -> f64 {
    if freedom > VERY_MANY {
        return very_many::student(probability, freedom);
    }
    let t = StudentsT::new(0.0, 1.0, freedom);
    crate::check!(t.is_ok(), "Student's t has no {freedom} degrees of freedom");
    t.map_or(f64::NAN, |t| t.inverse_cdf(probability))
}

/// Lower and upper 2.5 % point of chi-square with `freedom` degrees of freedom (any positive number).
pub(super) fn chi_square(freedom: f64) -> [f64; 2] {
    [TAIL, 1.0 - TAIL].map(|probability| chi_square_quantile(probability, freedom))
}

/// Quantile at `probability` in (0, 1) of chi-square with `freedom` degrees of freedom (any positive number).
pub(super) fn chi_square_quantile(probability: f64, freedom: f64) -> f64 {
    if freedom > VERY_MANY {
        return very_many::chi_square(probability, freedom);
    }
    let c = ChiSquared::new(freedom);
    crate::check!(c.is_ok(), "chi-square has no {freedom} degrees of freedom");
    c.map_or(f64::NAN, |c| c.inverse_cdf(probability))
}

/// Probabilities of chi-square with `freedom` degrees of freedom (any positive number) below and above `x`.
pub(super) fn chi_square_tails(x: f64, freedom: f64) -> [f64; 2] {
    if freedom > VERY_MANY {
        // The cube root is normal (Wilson and Hilferty 1931).
        let spread = 2.0 / (9.0 * freedom);
        let z = (pow(x / freedom, 1.0 / 3.0) - 1.0 + spread) / spread.sqrt();
        return [cdf(z), cdf(-z)];
    }
    let c = ChiSquared::new(freedom);
    crate::check!(c.is_ok(), "chi-square has no {freedom} degrees of freedom");
    c.map_or([f64::NAN; 2], |c| [c.cdf(x), c.sf(x)])
}

/// Lower and upper 2.5 % point of Fisher's F, the ratio of two mean squares with these degrees of freedom (any positive numbers).
pub(super) fn fisher(above: f64, below: f64) -> [f64; 2] {
    // The share of the first sum of squares in both has a beta distribution.
    let beta = Beta::new(0.5 * above, 0.5 * below);
    crate::check!(beta.is_ok(), "Fisher's F has no {above} and {below} degrees of freedom");
    let of = |share: f64| share / (1.0 - share) * below / above;
    [TAIL, 1.0 - TAIL].map(|probability| beta.map_or(f64::NAN, |beta| of(beta.inverse_cdf(probability))))
}

#[cfg(test)]
mod tests {
    use super::fisher;

    #[test]
    fn points_of_fishers_f_are_those_of_printed_tables() {
        // Upper 2.5 % points, and the lower ones as the reciprocals of the upper ones with the degrees exchanged.
        for (above, below, known) in [(4.0, 10.0, 4.468), (10.0, 4.0, 8.844), (1.0, 20.0, 5.872)] {
            assert!((fisher(above, below)[1] - known).abs() < 6e-4, "{:?}", fisher(above, below));
            assert!((fisher(below, above)[0] * known - 1.0).abs() < 2e-4);
        }
    }
}
