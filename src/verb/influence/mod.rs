//! Where the scatter of walls comes from.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod work;

pub use answer::{InfluenceSummary, ShareEntry, influence_document, influence_warnings, running};
