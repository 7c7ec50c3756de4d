//! Why a verb did not do what it was asked, and its exit code.

use serde_json::Value;

use crate::ensemble::RunError;
use crate::interrupt::Stopped;
use crate::study::Faults;

/// A verb that failed, by whose fault.
#[derive(Debug)]
pub enum Failure {
    /// The run, or one of its files: exit code 1.
    Run(String),
    /// The arguments: exit code 2.
    Usage(String),
    /// The study or the wall file: exit code 3.
    Input(String),
    /// The study or the wall file, where an object was asked for, which says what is wrong: exit code 3.
    Said(Value),
    /// It was asked to stop: exit code 130, as of a program that Ctrl-C has ended.
    Stopped,
}

impl Failure {
    /// What the user is told.
    pub fn message(&self) -> String {
        match self {
            Failure::Run(text) | Failure::Usage(text) | Failure::Input(text) => text.trim_end().to_string(),
            Failure::Said(object) => format!("{object:#}"),
            Failure::Stopped => Stopped.to_string(),
        }
    }

    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Failure::Run(_) => 1,
            Failure::Usage(_) => 2,
            Failure::Input(_) | Failure::Said(_) => 3,
            Failure::Stopped => 130,
        }
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        Failure::Run(error.to_string())
    }
}

impl From<Faults> for Failure {
    fn from(faults: Faults) -> Self {
        Failure::Input(faults.to_string())
    }
}

impl From<Stopped> for Failure {
    fn from(Stopped: Stopped) -> Self {
        Failure::Stopped
    }
}
