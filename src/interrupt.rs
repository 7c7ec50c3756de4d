//! Long work that is told to stop, as by Ctrl-C where the library serves another program.
//!
//! Work stops by unwinding to [`stoppable`], from the next place that [`look`]s, on whichever thread that is. Nothing is printed, and
//! what was recorded until then stays. So does `salsa` cancel queries, and `polars` a collection that is interrupted from Python.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The work of this process.
static WORK: Work = Work { asked: AtomicBool::new(false), going_on: Mutex::new(0) };

/// Work that can be stopped.
struct Work {
    /// Whether it is to stop.
    asked: AtomicBool,
    /// How much of it goes on.
    going_on: Mutex<usize>,
}

/// Work that stopped because it was asked to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("stopped")]
pub struct Stopped;

/// Does some work that can be stopped. A panic of the work goes on from here.
///
/// # Errors
/// [`Stopped`] if it was asked to stop and came by a place that looks.
pub fn stoppable<T>(work: impl FnOnce() -> T) -> Result<T, Stopped> {
    WORK.stoppable(work)
}

/// Asks all stoppable work of this process to stop; nothing where none goes on.
pub fn ask() {
    WORK.ask();
}

/// Stops here if it was asked for. For loops that may go on for long; it costs no more than reading a number.
pub fn look() {
    WORK.look();
}

impl Work {
    fn stoppable<T>(&self, work: impl FnOnce() -> T) -> Result<T, Stopped> {
        *self.going_on() += 1;
        let done = catch_unwind(AssertUnwindSafe(work));
        let mut left = self.going_on();
        *left -= 1;
        if *left == 0 {
            self.asked.store(false, Ordering::Relaxed);
        }
        drop(left);
        done.or_else(|cause| if cause.is::<Stopped>() { Err(Stopped) } else { resume_unwind(cause) })
    }

    fn ask(&self) {
        if *self.going_on() > 0 {
            self.asked.store(true, Ordering::Relaxed);
        }
    }

    fn look(&self) {
        if self.asked.load(Ordering::Relaxed) {
            resume_unwind(Box::new(Stopped));
        }
    }

    fn going_on(&self) -> MutexGuard<'_, usize> {
        self.going_on.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_stops_where_it_looks_and_the_next_work_does_not() {
        // Not the work of the process: other tests do that meanwhile.
        let own = Work { asked: AtomicBool::new(false), going_on: Mutex::new(0) };
        own.ask();
        assert_eq!(own.stoppable(|| own.look()), Ok(()), "nothing went on when it was asked");
        let stopped = own.stoppable(|| {
            own.ask();
            own.look();
        });
        assert_eq!(stopped, Err(Stopped));
        assert_eq!(own.stoppable(|| own.look()), Ok(()), "it was asked of work that has ended");
        let broken = catch_unwind(AssertUnwindSafe(|| own.stoppable(|| panic!("as asked"))));
        assert_eq!(broken.unwrap_err().downcast_ref::<&str>(), Some(&"as asked"));
    }
}
