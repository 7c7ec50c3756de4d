//! Whether a cause explains all that was seen: the posterior predictive check.

mod nearest;
mod parts;
mod posterior;

pub use posterior::Check;
