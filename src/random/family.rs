//! The distribution families that a study can name.

use super::Stream;
use super::discrete::{Constant, Empirical};
use super::flat::{Triangular, Uniform};
use super::gaussian::{Lognormal, Normal};
use super::standard_normal::cdf;
use super::truncated::{TruncatedLognormal, TruncatedNormal};
use crate::math::{exp, ln};

/// A distribution of one real variable. The parameters have the unit of the variable.
///
/// `checked` comes first: the other functions expect parameters that it has accepted.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "family", rename_all = "snake_case", deny_unknown_fields)]
pub enum Family {
    /// Always the same value.
    Constant {
        /// The value.
        value: f64,
    },
    /// Uniform between two bounds.
    Uniform {
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        sd: f64,
    },
    /// A normal variable known to lie between two bounds.
    TruncatedNormal {
        /// Mean before truncation.
        mean: f64,
        /// Standard deviation before truncation.
        sd: f64,
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
    /// Lognormal: the logarithm of the variable is normal.
    Lognormal {
        /// Mean of the variable itself.
        mean: f64,
        /// Standard deviation of the variable itself.
        sd: f64,
    },
    /// A lognormal variable known to lie between two bounds.
    TruncatedLognormal {
        /// Median before truncation.
        median: f64,
        /// Standard deviation of the logarithm before truncation.
        log_sd: f64,
        /// Lower bound, above 0.
        low: f64,
        /// Upper bound.
        high: f64,
    },
    /// Density rising linearly from `low` to `mode` and falling linearly to `high`.
    Triangular {
        /// Lower bound.
        low: f64,
        /// Most likely value; may equal a bound.
        mode: f64,
        /// Upper bound.
        high: f64,
    },
    /// One of the listed values, each entry as likely as any other.
    Empirical {
        /// The values; `checked` puts them in ascending order.
        values: Vec<f64>,
    },
}

/// What each family answers. Internal: users speak to [`Family`].
pub(super) trait Distribution {
    fn quantile(&self, u: f64) -> f64;
    fn density(&self, x: f64) -> Option<f64>;
    fn cdf(&self, x: f64) -> f64;
    fn mean(&self) -> f64;
    fn sd(&self) -> f64;
    fn support(&self) -> (f64, f64);
}

impl Family {
    /// Inverse CDF: the smallest value whose CDF reaches `u`, for `u` in the open interval (0, 1).
    pub fn quantile(&self, u: f64) -> f64 {
        crate::check!(u > 0.0 && u < 1.0, "a quantile was asked at {u}, outside (0, 1)");
        self.ask(|d| d.quantile(u))
    }

    /// The value at a standard normal score: that score's quantile.
    pub fn at_score(&self, score: f64) -> f64 {
        self.quantile(cdf(score))
    }

    /// Probability density at `x`, per unit of the variable; 0 outside the support. `None` for the constant and the
    /// empirical family: all their probability sits in points, so no function is their density.
    pub fn density(&self, x: f64) -> Option<f64> {
        self.ask(|d| d.density(x))
    }

    /// Probability of a value up to and including `x`.
    pub fn cdf(&self, x: f64) -> f64 {
        self.ask(|d| d.cdf(x))
    }

    /// Mean of the variable (of the truncated variable, for the truncated normal).
    pub fn mean(&self) -> f64 {
        self.ask(|d| d.mean())
    }

    /// Standard deviation of the variable (of the truncated variable, for the truncated normal; of the list as a
    /// whole population, for the empirical family).
    pub fn sd(&self) -> f64 {
        self.ask(|d| d.sd())
    }

    /// Smallest and largest value; infinite where there is no bound.
    pub fn support(&self) -> (f64, f64) {
        self.ask(|d| d.support())
    }

    /// One draw: the quantile of exactly one uniform of the stream. The constant takes one too, so that exchanging the
    /// family of a quantity leaves later draws from the same stream where they were.
    pub fn sample(&self, stream: &mut Stream) -> f64 {
        self.quantile(stream.uniform())
    }

    /// The distribution of `factor` times the variable, for a change of unit; `factor` is above 0.
    pub fn scaled(self, factor: f64) -> Family {
        crate::check!(factor > 0.0, "a distribution was scaled by {factor}, which is not above 0");
        match self {
            Family::Constant { value } => Family::Constant { value: value * factor },
            Family::Uniform { low, high } => Family::Uniform { low: low * factor, high: high * factor },
            Family::Normal { mean, sd } => Family::Normal { mean: mean * factor, sd: sd * factor },
            Family::TruncatedNormal { mean, sd, low, high } => Family::TruncatedNormal {
                mean: mean * factor,
                sd: sd * factor,
                low: low * factor,
                high: high * factor,
            },
            Family::Lognormal { mean, sd } => Family::Lognormal { mean: mean * factor, sd: sd * factor },
            Family::TruncatedLognormal { median, log_sd, low, high } => Family::TruncatedLognormal {
                median: median * factor,
                log_sd,
                low: low * factor,
                high: high * factor,
            },
            Family::Triangular { low, mode, high } => {
                Family::Triangular { low: low * factor, mode: mode * factor, high: high * factor }
            }
            Family::Empirical { values } => {
                Family::Empirical { values: values.into_iter().map(|value| value * factor).collect() }
            }
        }
    }

    /// The distribution with deviations from the mean that are `factor` times as large, for the same uniforms; `factor` is
    /// above 0. A lognormal keeps its mean and its family, and has a standard deviation so many times as large; a
    /// truncated one keeps its median, and its logarithm is widened.
    pub fn widened(self, factor: f64) -> Family {
        crate::check!(factor > 0.0, "a distribution was widened by {factor}, which is not above 0");
        let centre = self.mean();
        let out = |x: f64| centre + factor * (x - centre);
        match self {
            Family::Constant { value } => Family::Constant { value },
            Family::Uniform { low, high } => Family::Uniform { low: out(low), high: out(high) },
            Family::Normal { mean, sd } => Family::Normal { mean, sd: sd * factor },
            Family::TruncatedNormal { mean, sd, low, high } => {
                Family::TruncatedNormal { mean: out(mean), sd: sd * factor, low: out(low), high: out(high) }
            }
            Family::Lognormal { mean, sd } => Family::Lognormal { mean, sd: sd * factor },
            Family::TruncatedLognormal { median, log_sd, low, high } => {
                let out = |x: f64| median * exp(factor * ln(x / median));
                Family::TruncatedLognormal { median, log_sd: log_sd * factor, low: out(low), high: out(high) }
            }
            Family::Triangular { low, mode, high } => {
                Family::Triangular { low: out(low), mode: out(mode), high: out(high) }
            }
            Family::Empirical { values } => {
                Family::Empirical { values: values.into_iter().map(out).collect() }
            }
        }
    }

    fn ask<R>(&self, question: impl FnOnce(&dyn Distribution) -> R) -> R {
        match *self {
            Family::Constant { value } => question(&Constant { value }),
            Family::Uniform { low, high } => question(&Uniform { low, high }),
            Family::Normal { mean, sd } => question(&Normal { mean, sd }),
            Family::TruncatedNormal { mean, sd, low, high } => {
                question(&TruncatedNormal::new(mean, sd, low, high))
            }
            Family::Lognormal { mean, sd } => question(&Lognormal::new(mean, sd)),
            Family::TruncatedLognormal { median, log_sd, low, high } => {
                question(&TruncatedLognormal::new(median, log_sd, low, high))
            }
            Family::Triangular { low, mode, high } => question(&Triangular { low, mode, high }),
            Family::Empirical { ref values } => question(&Empirical { values }),
        }
    }
}
