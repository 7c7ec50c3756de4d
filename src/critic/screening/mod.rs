//! What looks odd about the measurements, before any cause is thought of.

mod contradictions;
mod note;
mod notes;
mod outliers;
#[cfg(test)]
mod tests;
mod units;

pub use note::{DataNote, Extent};
pub use notes::{data_notes, data_notes_by_simulation};
