//! How many processors a command may use.

use std::num::NonZero;

use rayon::ThreadPoolBuilder;

use crate::ensemble::RunError;
use crate::terminal::failure::Failure;

/// Does all of a command's work on so many threads, one per processor if none are named.
pub(crate) fn on<T: Send>(
    threads: Option<NonZero<usize>>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.map_or(0, NonZero::get)).build();
    pool.map_err(RunError::from)?.install(work)
}
