//! Why a verb did not do what it was asked, and its exit code.

use std::process::ExitCode;

use crate::ensemble::RunError;
use crate::study::Faults;

/// A verb that failed, by whose fault.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The run, or one of its files: exit code 1.
    Run(String),
    /// The arguments: exit code 2.
    Usage(String),
    /// The study or the wall file: exit code 3.
    Input(String),
    /// The study or the wall file, and all that is to be said has been printed: exit code 3.
    Said,
}

impl Failure {
    /// What the user is told; empty when it has been said.
    pub fn message(&self) -> String {
        match self {
            Failure::Run(text) | Failure::Usage(text) | Failure::Input(text) => text.trim_end().to_string(),
            Failure::Said => String::new(),
        }
    }

    /// The exit code.
    pub fn code(&self) -> ExitCode {
        match self {
            Failure::Run(_) => ExitCode::from(1),
            Failure::Usage(_) => ExitCode::from(2),
            Failure::Input(_) | Failure::Said => ExitCode::from(3),
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
