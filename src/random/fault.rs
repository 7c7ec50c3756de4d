//! Which parameters make a distribution.

use super::Family;
use super::truncated::TruncatedNormal;
use crate::math::ln;

/// Largest magnitude of a parameter: far beyond any use, and far enough from overflow that no product of two
/// parameters reaches it.
const LARGEST: f64 = 1e100;
/// Smallest standard deviation or width, for the same reason.
const SMALLEST: f64 = 1e-100;

/// A parameter that makes no distribution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{parameter} = {found}: {allowed}")]
pub struct BadFamily {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// Value found.
    pub found: f64,
    /// What is allowed, in words.
    pub allowed: &'static str,
}

impl Family {
    /// Accepts the parameters, or names every one that is wrong.
    ///
    /// An accepted empirical list comes back in ascending order, which is what makes its quantile an inverse CDF.
    ///
    /// ```
    /// use pirca::random::Family;
    /// assert!(Family::Normal { mean: 0.12, sd: 0.03 }.checked().is_ok());
    /// let faults = Family::Normal { mean: f64::NAN, sd: -1.0 }.checked().unwrap_err();
    /// assert_eq!(faults.len(), 2);
    /// ```
    pub fn checked(mut self) -> Result<Self, Vec<BadFamily>> {
        let mut faults = Faults(Vec::new());
        match &mut self {
            Family::Constant { value } => {
                faults.magnitude("value", *value);
            }
            Family::Uniform { low, high } => {
                faults.bounds(*low, *high);
            }
            Family::Normal { mean, sd } => {
                faults.location_and_scale(*mean, *sd);
            }
            Family::TruncatedNormal { mean, sd, low, high } => faults.truncated(*mean, *sd, *low, *high),
            Family::Lognormal { mean, sd } => faults.lognormal(*mean, *sd),
            Family::TruncatedLognormal { median, log_sd, low, high } => {
                faults.truncated_lognormal(*median, *log_sd, *low, *high);
            }
            Family::Triangular { low, mode, high } => faults.triangular(*low, *mode, *high),
            Family::Empirical { values } => {
                faults.list(values);
                values.sort_by(f64::total_cmp);
            }
        }
        if faults.0.is_empty() { Ok(self) } else { Err(faults.0) }
    }
}

/// The faults found so far; each check returns whether it passed, so that a relation between two parameters is only
/// judged when both are numbers.
struct Faults(Vec<BadFamily>);

impl Faults {
    fn require(&mut self, holds: bool, parameter: &'static str, found: f64, allowed: &'static str) -> bool {
        if !holds {
            self.0.push(BadFamily { parameter, found, allowed });
        }
        holds
    }

    fn magnitude(&mut self, parameter: &'static str, found: f64) -> bool {
        // NaN fails the comparison too.
        self.require(found.abs() <= LARGEST, parameter, found, "must be a number between -1e100 and 1e100")
    }

    fn bounds(&mut self, low: f64, high: f64) -> bool {
        let both = self.magnitude("low", low) & self.magnitude("high", high);
        both && self.require(high - low >= SMALLEST, "high", high, "must be above low by at least 1e-100")
    }

    fn location_and_scale(&mut self, mean: f64, sd: f64) -> bool {
        let mean_is_good = self.magnitude("mean", mean);
        let in_range = (SMALLEST..=LARGEST).contains(&sd);
        mean_is_good
            & self.require(
                in_range,
                "sd",
                sd,
                "must be between 1e-100 and 1e100 (a variable without scatter is the family constant)",
            )
    }

    fn truncated(&mut self, mean: f64, sd: f64, low: f64, high: f64) {
        let parent = self.location_and_scale(mean, sd);
        let bounds = self.bounds(low, high);
        if !(parent && bounds) {
            return;
        }
        // Below this width the interval's probability is a difference of nearly equal numbers.
        let wide = (high - low) / sd >= 1e-6;
        if self.require(wide, "high", high, "must be above low by at least 1e-6 sd") {
            self.left_of_parent(&TruncatedNormal::new(mean, sd, low, high), (low, high), low > mean);
        }
    }

    /// Below this probability the normal CDF leaves the normal range of double precision.
    fn left_of_parent(&mut self, cut: &TruncatedNormal, (low, high): (f64, f64), lies_above: bool) {
        let (name, bound) = if lies_above { ("low", low) } else { ("high", high) };
        let allowed = "must not cut off all but 1e-300 of the parent's probability";
        self.require(cut.mass() >= 1e-300, name, bound, allowed);
    }

    fn truncated_lognormal(&mut self, median: f64, log_sd: f64, low: f64, high: f64) {
        let in_range = (SMALLEST..=LARGEST).contains(&median);
        let parent = self.require(in_range, "median", median, "must be between 1e-100 and 1e100")
            & self.require(
                (1e-12..=10.0).contains(&log_sd),
                "log_sd",
                log_sd,
                "must be between 1e-12 and 10",
            );
        let bounds = self.bounds(low, high)
            && self.require(low > 0.0, "low", low, "must be above 0")
            // Squares of the values must not overflow.
            && self.require(high / low <= 1e100, "high", high, "must be at most 1e100 times low");
        if !(parent && bounds) {
            return;
        }
        let (mean, from, to) = (ln(median), ln(low), ln(high));
        let wide = (to - from) / log_sd >= 1e-6;
        if self.require(wide, "high", high, "must be above low by at least 1e-6 log_sd in its logarithm") {
            self.left_of_parent(&TruncatedNormal::new(mean, log_sd, from, to), (low, high), from > mean);
        }
    }

    fn lognormal(&mut self, mean: f64, sd: f64) {
        let both = self.location_and_scale(mean, sd);
        let positive = !mean.is_nan() && self.require(mean > 0.0, "mean", mean, "must be above 0");
        if both && positive {
            // Outside this range the variable is a constant, or its quantiles overflow.
            let in_range = (1e-12..=1e50).contains(&(sd / mean));
            self.require(in_range, "sd", sd, "must be between 1e-12 and 1e50 times the mean");
        }
    }

    fn triangular(&mut self, low: f64, mode: f64, high: f64) {
        let mode_is_good = self.magnitude("mode", mode);
        if self.bounds(low, high) && mode_is_good {
            self.require((low..=high).contains(&mode), "mode", mode, "must lie between low and high");
        }
    }

    fn list(&mut self, values: &[f64]) {
        self.require(!values.is_empty(), "number of values", 0.0, "must be at least 1");
        for &value in values {
            self.magnitude("values", value);
        }
    }
}
