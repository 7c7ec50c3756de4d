//! Which readings of a study explain what was published.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod work;

pub use answer::{Extent, ReadingEntry, ReadingsSummary, readings_document};
