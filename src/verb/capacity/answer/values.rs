//! Values that a sample supports: what the next wall falls short of with a stated probability, and what a stated share of all walls
//! falls short of with a stated confidence.

use serde::Serialize;

use crate::stats::{
    CHARACTERISTIC_PROBABILITY, DESIGN_PROBABILITY, Shape, Variation, below_mean, predictive_factor,
    tolerance_factor,
};

/// Confidence of a tolerance limit.
const CONFIDENCE: f64 = 0.95;

/// A value with the factor k that it lies below the mean by, in standard deviations (of the logarithms, where it is lognormal).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SupportedValue {
    /// The factor.
    pub k: f64,
    /// The value, in the unit of the quantity.
    pub value: f64,
}

/// The values that a sample supports, by its own scatter or by one that is stated; none of a single wall of unknown variation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Supported {
    /// What the values are taken to be distributed as.
    pub shape: Shape,
    /// The coefficient of variation that is taken for known; null where it is that of the sample.
    pub known_cov: Option<f64>,
    /// The next wall lies below it with a probability of 5 %: the characteristic value of EN 1990 D7.2.
    pub characteristic: Option<SupportedValue>,
    /// No more than 5 % of all walls lie below it, with a confidence of 95 %.
    pub tolerance_95_95: Option<SupportedValue>,
    /// The next wall lies below it with a probability of 0.1 %: the design value of EN 1990 D7.3.
    pub design: Option<SupportedValue>,
}

impl Supported {
    /// By values that are all known.
    pub fn by(values: &[f64], shape: Shape, variation: Variation) -> Supported {
        let at = |factor: Option<f64>| {
            let k = factor?;
            Some(SupportedValue { k, value: below_mean(values, k, shape, variation)? })
        };
        let n = values.len();
        let some = |of: &dyn Fn() -> Option<f64>| if n == 0 { None } else { at(of()) };
        let known_cov = match variation {
            Variation::Known(cov) => Some(cov),
            Variation::Unknown => None,
        };
        Supported {
            shape,
            known_cov,
            characteristic: some(&|| predictive_factor(n, CHARACTERISTIC_PROBABILITY, variation)),
            tolerance_95_95: some(&|| tolerance_factor(n, CHARACTERISTIC_PROBABILITY, CONFIDENCE, variation)),
            design: some(&|| predictive_factor(n, DESIGN_PROBABILITY, variation)),
        }
    }
}
