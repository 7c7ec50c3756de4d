//! Where the scatter of walls comes from: the numbers, and how they are told.

mod document;
mod entry;
mod plot;
mod text;

pub use document::influence_document;
pub use entry::{InfluenceSummary, ShareEntry, running};
pub use text::influence_warnings;
