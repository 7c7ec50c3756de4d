//! Which mechanisms the measurements of a study could show.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod work;

pub use answer::{DetectabilitySummary, detectability_document};
