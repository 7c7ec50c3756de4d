//! Who sees a wall while it is loaded. Nothing that is done there can change the result.

use crate::model::Level;
use crate::protocol::watch::Watch;
use crate::protocol::{Recorder, Task};
use crate::solve::Assembly;

/// Who sees a wall while it is loaded.
#[derive(Clone, Copy)]
pub struct Witness<'w> {
    /// Is told of every level at which the wall came to rest.
    pub tell: &'w dyn Fn(Level),
    /// Notes its states for a replay; a wall that falls is then followed further down than the test needs.
    pub recorder: Option<&'w Recorder>,
}

impl Witness<'_> {
    /// Nobody.
    pub const NOBODY: Witness<'static> = Witness { tell: &|_| {}, recorder: None };

    pub(super) fn begins(&self, task: &Task<'_>, built: &Assembly<'_>) {
        if let Some(recorder) = self.recorder {
            recorder.begins(task, built);
        }
    }

    pub(super) fn rests(&self, level: Level, assembly: &Assembly<'_>) {
        (self.tell)(level);
        if let Some(recorder) = self.recorder {
            recorder.rests(level, assembly);
        }
    }

    /// A wall is on the move.
    pub(super) fn moves(&self, level: Level, assembly: &Assembly<'_>) {
        (self.tell)(level);
        if let Some(recorder) = self.recorder {
            recorder.moves(level, assembly);
        }
    }

    /// See [`Recorder::falls`].
    pub(super) fn falls<'a>(&self, task: &Task<'a>, at_rest: &Assembly<'a>, way: (f64, f64), watch: &Watch) {
        if let Some(recorder) = self.recorder {
            recorder.falls(task, at_rest, way, watch);
        }
    }
}
