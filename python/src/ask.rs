//! Commands on a thread of their own, while Python goes on and looks for Ctrl-C.

use std::ffi::OsString;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use pirca::cli::{self, Answer, Failure};
use pirca::{ensemble, interrupt};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

/// How long Ctrl-C may wait.
const PATIENCE: Duration = Duration::from_millis(50);
/// As of the first thread of a program.
const STACK: usize = 8 << 20;

/// The parts of an [`Answer`]: text, JSON, place of the files, warnings.
type Answered = (String, String, Option<PathBuf>, Vec<String>);

/// Does what arguments ask, and gives the answer. Calls `hear` with every line that the command says meanwhile. The interpreter is free; what `hear` raises, and Ctrl-C, stops the command and is raised.
pub fn ask(hear: &Bound<'_, PyAny>, arguments: Vec<OsString>) -> PyResult<Answered> {
    let py = hear.py();
    let (say, mut said) = mpsc::channel::<String>();
    let work = move || cli::answered(arguments, Arc::new(move |line| drop(say.send(line.to_owned()))));
    let worker = thread::Builder::new().name("pirca".to_owned()).stack_size(STACK).spawn(work)?;
    loop {
        // The channel goes there and comes back, as one thread at a time may listen.
        let (line, listened) = py.detach(move || (said.recv_timeout(PATIENCE), said));
        said = listened;
        let heard = match line {
            Ok(line) => hear.call1((line,)).map(drop),
            Err(RecvTimeoutError::Timeout) => Ok(()),
            Err(RecvTimeoutError::Disconnected) => break,
        };
        if let Err(raised) = heard.and_then(|()| py.check_signals()) {
            py.detach(|| stop(worker));
            return Err(raised);
        }
    }
    let done = py.detach(|| worker.join()).unwrap_or_else(|panic| resume_unwind(panic));
    let parts = |Answer { text, json, out, warnings, .. }| (text, json, out, warnings);
    done.map(parts).map_err(|failure| raised(py, &failure))
}

/// Raises what is wrong with a folder that should hold a run which has ended.
pub fn holds_run(py: Python<'_>, folder: &Path) -> PyResult<()> {
    ensemble::identity(folder).map(drop).map_err(|error| raised(py, &error.into()))
}

/// Stops a command and waits until it has stopped. It may not have begun when it is first asked to.
fn stop<T>(worker: JoinHandle<T>) {
    while !worker.is_finished() {
        interrupt::ask();
        thread::sleep(PATIENCE);
    }
    // How it ended does not matter any more.
    drop(worker.join());
}

/// The exception for a failure.
fn raised(py: Python<'_>, failure: &Failure) -> PyErr {
    let name = match failure {
        Failure::Run(_) => "RunError",
        Failure::Usage(_) => "UsageError",
        Failure::Input(_) | Failure::Said(_) => "InputError",
        Failure::Stopped => return PyKeyboardInterrupt::new_err(()),
    };
    let errors = py.import("pirca.errors");
    let exception = errors.and_then(|errors| errors.getattr(name)?.call1((failure.message(),)));
    exception.map_or_else(|missing| missing, PyErr::from_value)
}
