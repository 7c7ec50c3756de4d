//! Distribution families (skeleton).

/// A distribution of one real variable, with checked parameters.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "family", rename_all = "snake_case")]
pub enum Family {
    /// Always the same value.
    Constant { value: f64 },
    /// Uniform.
    Uniform { low: f64, high: f64 },
    /// Normal.
    Normal { mean: f64, sd: f64 },
    /// Normal with parent mean and sd, restricted to [low, high].
    TruncatedNormal { mean: f64, sd: f64, low: f64, high: f64 },
    /// Lognormal with the given mean and sd of the variable itself.
    Lognormal { mean: f64, sd: f64 },
    /// Triangular.
    Triangular { low: f64, mode: f64, high: f64 },
    /// One of the listed values, each as likely.
    Empirical { values: Vec<f64> },
}

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
    /// Checks the parameters.
    pub fn checked(self) -> Result<Self, Vec<BadFamily>> {
        unimplemented!()
    }
    /// Inverse CDF of `u` in (0, 1).
    pub fn quantile(&self, _u: f64) -> f64 {
        unimplemented!()
    }
    /// Density.
    pub fn density(&self, _x: f64) -> f64 {
        unimplemented!()
    }
    /// CDF.
    pub fn cdf(&self, _x: f64) -> f64 {
        unimplemented!()
    }
    /// Mean.
    pub fn mean(&self) -> f64 {
        unimplemented!()
    }
    /// Standard deviation.
    pub fn sd(&self) -> f64 {
        unimplemented!()
    }
    /// Smallest and largest value possible.
    pub fn support(&self) -> (f64, f64) {
        unimplemented!()
    }
    /// One draw: the quantile of one uniform.
    pub fn sample(&self, _stream: &mut super::Stream) -> f64 {
        unimplemented!()
    }
}
