//! Where the scatter of walls comes from: the numbers, and how they are told.

mod document;
mod entry;
mod plot;
mod text;

pub use document::sensitivity_document;
pub use entry::{SensitivitySummary, ShareEntry, running};
pub use text::sensitivity_warnings;
