//! The detectability map: its numbers, and how they are told.

mod document;
mod entry;
mod plot;

pub use document::detectability_document;
pub use entry::DetectabilitySummary;
