//! The normal and the lognormal family.

use super::family::Distribution;
use super::standard_normal;
use crate::math::{exp, ln, ln_1p};

/// Normal.
pub(super) struct Normal {
    pub(super) mean: f64,
    pub(super) sd: f64,
}

impl Normal {
    fn standardised(&self, x: f64) -> f64 {
        (x - self.mean) / self.sd
    }
}

impl Distribution for Normal {
    fn quantile(&self, u: f64) -> f64 {
        self.mean + self.sd * standard_normal::quantile(u)
    }
    fn density(&self, x: f64) -> Option<f64> {
        Some(standard_normal::density(self.standardised(x)) / self.sd)
    }
    fn cdf(&self, x: f64) -> f64 {
        standard_normal::cdf(self.standardised(x))
    }
    fn mean(&self) -> f64 {
        self.mean
    }
    fn sd(&self) -> f64 {
        self.sd
    }
    fn support(&self) -> (f64, f64) {
        (f64::NEG_INFINITY, f64::INFINITY)
    }
}

/// Lognormal: its logarithm is the normal variable `log`.
pub(super) struct Lognormal {
    mean: f64,
    sd: f64,
    log: Normal,
}

impl Lognormal {
    /// From mean m and standard deviation s of the variable itself: the logarithm has the variance
    /// ln(1 + (s/m)^2) and the mean ln m less half of that.
    pub(super) fn new(mean: f64, sd: f64) -> Self {
        let cov = sd / mean;
        let variance = ln_1p(cov * cov);
        let log = Normal { mean: ln(mean) - 0.5 * variance, sd: variance.sqrt() };
        Lognormal { mean, sd, log }
    }
}

impl Distribution for Lognormal {
    fn quantile(&self, u: f64) -> f64 {
        exp(self.log.quantile(u))
    }
    fn density(&self, x: f64) -> Option<f64> {
        if x <= 0.0 {
            return Some(0.0);
        }
        self.log.density(ln(x)).map(|of_the_log| of_the_log / x)
    }
    fn cdf(&self, x: f64) -> f64 {
        if x <= 0.0 { 0.0 } else { self.log.cdf(ln(x)) }
    }
    fn mean(&self) -> f64 {
        self.mean
    }
    fn sd(&self) -> f64 {
        self.sd
    }
    fn support(&self) -> (f64, f64) {
        (0.0, f64::INFINITY)
    }
}
