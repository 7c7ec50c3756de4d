//! Quantiles of the distributions that intervals are read from.

use super::very_many::{self, VERY_MANY};
use statrs::distribution::{ChiSquared, ContinuousCDF, StudentsT};

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
    if freedom > VERY_MANY {
        return [TAIL, 1.0 - TAIL].map(|probability| very_many::chi_square(probability, freedom));
    }
    let c = ChiSquared::new(freedom);
    crate::check!(c.is_ok(), "chi-square has no {freedom} degrees of freedom");
    c.map_or([f64::NAN; 2], |c| [c.inverse_cdf(TAIL), c.inverse_cdf(1.0 - TAIL)])
}
