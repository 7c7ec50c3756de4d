//! What the base model shows of a number, and from where the number's uncertainty comes.

use crate::critic::discrepancy::residual::band::Band;
use crate::stats;

/// Of fewer simulated campaigns that show a number nothing is said.
const LEAST: usize = 100;

/// Standard deviation of a number in three parts that do not depend on one another. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts {
    /// Of the readings: random errors, rounding and the error that readings share.
    pub measurement: f64,
    /// Of the specimens: from one wall to another under the same parameters, by its stones and by the stiffness of its joints. What a
    /// finite simulation does not know of one wall is a part of it.
    pub scatter: f64,
    /// Of the parameters: kn, phi and kn/ks within their priors.
    pub parameters: f64,
}

impl Parts {
    /// All three together.
    pub fn sd(&self) -> f64 {
        let Parts { measurement, scatter, parameters } = self;
        (measurement * measurement + scatter * scatter + parameters * parameters).sqrt()
    }
}

/// What the base model shows of a number. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Mean, without the readings' errors.
    pub mean: f64,
    /// From where the difference to a measured number has its standard deviation.
    pub parts: Parts,
    /// Where the simulated numbers lie.
    pub band: Band,
}

impl Expected {
    /// From a number of simulated campaigns by truth, the error of its measurement, and its band; `None` where too few campaigns have it.
    ///
    /// Analysis of variance in one way, truths being of different sizes (Searle, Casella and McCulloch 1992, section 3.6).
    pub(super) fn of(by_truth: &[Vec<f64>], measurement: f64, band: Band) -> Option<Expected> {
        let all = by_truth.concat();
        if all.len() < LEAST {
            return None;
        }
        let n = all.len() as f64;
        let mean = stats::mean(&all)?;
        let sets: Vec<(f64, f64)> =
            by_truth.iter().filter_map(|own| Some((own.len() as f64, stats::mean(own)?))).collect();
        let sum =
            |terms: &dyn Fn(&(f64, f64)) -> f64| stats::sum(&sets.iter().map(terms).collect::<Vec<_>>());
        let square = |x: f64| x * x;
        let (truths, apart) = (sets.len() as f64, sum(&|(size, own)| size * square(own - mean)));
        let whole = stats::sum(&all.iter().map(|x| square(x - mean)).collect::<Vec<_>>());
        // Means of truths, and sets about them; where every truth shows one set, the two cannot be told apart.
        let across = if truths > 1.0 { apart / (truths - 1.0) } else { 0.0 };
        let within = if n > truths { (whole - apart).max(0.0) / (n - truths) } else { 0.0 };
        let size = (n - sum(&|(size, _)| size * size) / n) / (truths - 1.0).max(1.0);
        let between = if size > 0.0 { ((across - within) / size).max(0.0) } else { 0.0 };
        let parameters = (between + across / n).sqrt();
        Some(Expected { mean, parts: Parts { measurement, scatter: within.sqrt(), parameters }, band })
    }

    /// How far a measured number lies above the mean, in standard deviations; `None` where there are none.
    pub fn in_sd(&self, measured: f64) -> Option<f64> {
        let sd = self.parts.sd();
        (sd > 0.0).then(|| (measured - self.mean) / sd)
    }
}
