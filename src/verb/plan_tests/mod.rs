//! How many specimens to test, and what to read.

pub(crate) mod answer;
pub(crate) mod ask;
pub(crate) mod work;

pub use answer::{
    Asked, Otherwise, PlannedArm, PlannedDifference, Reading, TestPlan, test_plan_document,
    test_plan_warnings,
};
