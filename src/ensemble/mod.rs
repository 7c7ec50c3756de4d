//! From a study to a table of members: plan, run in parallel, record, resume.

mod record;

pub use record::{Row, StepRow};
