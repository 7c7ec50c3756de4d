//! The sensitivity map: its numbers, and how they are told.

mod document;
mod entry;
mod plot;

pub use document::sensitivity_document;
pub use entry::SensitivitySummary;
