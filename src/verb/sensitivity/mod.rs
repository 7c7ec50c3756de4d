//! Where the scatter of walls comes from.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod work;

pub use answer::{SensitivitySummary, ShareEntry, running, sensitivity_document, sensitivity_warnings};
