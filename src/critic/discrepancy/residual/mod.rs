//! How far single readings, and the means of groups of them, lie from the base model, and what makes that uncertain.
//!
//! These residuals are plain: they stand against all walls of the base model, with joints as uncertain as their priors and no
//! more known of them. The excess of a [`Discrepancy`](crate::critic::Discrepancy) stands against the joints that explain the
//! campaign best. So joints that lie at one end of their priors move many plain residuals together and no excess, and an effect
//! that hides within the priors of the joints shows in the excess alone.

mod band;
mod baseline;
mod group;
mod nested;
mod parts;
mod reading;
#[cfg(test)]
mod tests;

pub use band::Band;
pub use baseline::{Baseline, Residuals};
pub use group::{Group, Side};
pub use parts::{Expected, Parts};
pub use reading::Residual;
