//! Whether a cause explains all that was seen: the posterior predictive check.

mod nearest;
mod posterior;

pub use nearest::Nearest;
pub use posterior::Check;
