//! What is wrong with a parameter of a motion, or with the file of a record.

/// A parameter that makes no motion.
#[derive(Clone, Debug, PartialEq, serde::Serialize, thiserror::Error)]
#[error("{parameter} = {found}: allowed is {allowed}")]
pub struct BadParameter {
    /// Name of the parameter, with its unit where it has one.
    pub parameter: &'static str,
    /// Value found.
    pub found: f64,
    /// What is allowed, in words.
    pub allowed: &'static str,
}

/// The first fault of the file of a record: where, what was found, what is allowed, how to mend it.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, thiserror::Error)]
#[error("{}: {found}; allowed is {allowed}; {fix}", place(.file, *.line))]
pub struct BadRecord {
    /// The file, as the user named it.
    pub file: String,
    /// Line in the file, from 1; 0 where no line is to blame.
    pub line: usize,
    /// What was found.
    pub found: String,
    /// What is allowed.
    pub allowed: String,
    /// How to mend it.
    pub fix: String,
}

impl BadRecord {
    /// A fault at a line of a file that is named later; line 0 where no line is to blame.
    pub(super) fn at(
        line: usize,
        found: impl Into<String>,
        allowed: impl Into<String>,
        fix: impl Into<String>,
    ) -> BadRecord {
        let file = String::new();
        BadRecord { file, line, found: found.into(), allowed: allowed.into(), fix: fix.into() }
    }
}

fn place(file: &str, line: usize) -> String {
    if line == 0 { file.to_owned() } else { format!("{file}:{line}") }
}

/// Faults of parameters, gathered one by one.
#[derive(Default)]
pub(super) struct Faults(Vec<BadParameter>);

impl Faults {
    /// Adds a fault unless the parameter is good, and says whether it is.
    pub(super) fn require(
        &mut self,
        good: bool,
        parameter: &'static str,
        found: f64,
        allowed: &'static str,
    ) -> bool {
        if !good {
            self.0.push(BadParameter { parameter, found, allowed });
        }
        good
    }

    /// The value where nothing is wrong.
    pub(super) fn none_or<T>(self, value: impl FnOnce() -> T) -> Result<T, Vec<BadParameter>> {
        if self.0.is_empty() { Ok(value()) } else { Err(self.0) }
    }
}
