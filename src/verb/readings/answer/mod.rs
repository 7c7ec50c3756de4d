//! The readings of a study beside what was published: the verdicts, and how they are told.

mod document;
mod entry;
mod plot;

pub use document::readings_document;
pub use entry::{Extent, ReadingEntry, ReadingsSummary};
