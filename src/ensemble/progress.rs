//! How a run tells what it is doing.

use crate::ensemble::{Row, Task};

/// Is told how a run goes; called from the worker threads, in the order in which members finish. Nothing that it does
/// can change a result.
pub trait Progress: Sync {
    /// Before the first member: how many evaluations the run has in all, and which of them were recorded before.
    fn begin(&self, total: usize, recorded: &[&Row]);
    /// A member is evaluated and recorded.
    fn finished(&self, row: &Row);
    /// A member broke an invariant and is not recorded.
    fn broken(&self, task: Task);
    /// No member is being evaluated any more.
    fn end(&self);
}

/// Tells nobody.
pub struct Silent;

impl Progress for Silent {
    fn begin(&self, _total: usize, _recorded: &[&Row]) {}
    fn finished(&self, _row: &Row) {}
    fn broken(&self, _task: Task) {}
    fn end(&self) {}
}
