//! Whom the command line serves: the arguments as they were given, and who hears what is said on the way. As standard output and
//! standard error there is one in a process.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Hears a line that is said on the way: how far the work is, a note, or a warning, which begins with "warning: ".
pub type Hear = dyn Fn(&str) + Send + Sync;

static SESSION: Mutex<Session> = Mutex::new(Session { arguments: Vec::new(), hear: None });

struct Session {
    arguments: Vec<String>,
    hear: Option<Arc<Hear>>,
}

/// A session, which ends when this is dropped.
pub(crate) struct Served;

/// Begins with these arguments, without the name of the program. What is said goes to whoever hears it, or to standard error.
pub(crate) fn begin(arguments: Vec<String>, hear: Option<Arc<Hear>>) -> Served {
    *session() = Session { arguments, hear };
    Served
}

impl Drop for Served {
    fn drop(&mut self) {
        *session() = Session { arguments: Vec::new(), hear: None };
    }
}

/// The arguments as they were given.
pub(crate) fn arguments() -> Vec<String> {
    session().arguments.clone()
}

/// Who hears what is said; `None` where it goes to standard error.
pub(crate) fn heard_by() -> Option<Arc<Hear>> {
    session().hear.clone()
}

fn session() -> MutexGuard<'static, Session> {
    SESSION.lock().unwrap_or_else(PoisonError::into_inner)
}
