//! The base model extended by the causes of a verdict, and what its walls do.

mod curve;
mod extension;
#[cfg(test)]
mod tests;

#[cfg(test)]
pub(super) use curve::over_the_tilt;
pub use curve::{Curve, FamilyCurves, base_curves, best_curves, cause_curves, fitted_curves};
pub use extension::{DRAWS, Extension, Known, extension};
