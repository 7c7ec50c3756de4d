//! Which arm of a study is the best, and how sure that is.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod work;

pub use answer::{
    ArmDifference, ArmShown, SelectedArm, SelectionSummary, ShareLevels, selection_document,
    selection_running,
};
