//! What is off: how far a campaign lies from those of the base model.

mod across;
mod features;
mod form;
mod predicted;
mod reference;
mod residual;
mod smooth;
#[cfg(test)]
mod tests;

pub use features::{Contrast, Feature, Scale, features};
pub use form::{Component, Lies};
#[cfg(test)]
pub use predicted::normal_score;
pub use predicted::{Predicted, Score};
pub use reference::{Discrepancy, Reference};
pub use residual::{Band, Baseline, Expected, Group, Parts, Residual, Residuals, Side};
pub use smooth::{ComponentEstimate, SmoothDiscrepancy};
