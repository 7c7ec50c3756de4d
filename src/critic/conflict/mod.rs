//! Prior against data: whether a cause acts as strongly as its physical prior allows.

mod physical_prior;
mod prior_predictive;

pub use prior_predictive::PriorPredictive;
