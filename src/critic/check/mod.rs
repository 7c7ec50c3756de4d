//! Whether a cause explains all that was seen: the posterior predictive check. And whether what was seen belongs together.

mod nearest;
mod parts;
mod posterior;
mod relation;

pub use posterior::Check;
pub use relation::Relation;
