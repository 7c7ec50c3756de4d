//! What a verb answers: in words, as one JSON object, and the folder of its files.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::terminal::failure::Failure;
use crate::terminal::output;

/// What a verb answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// For people.
    pub text: String,
    /// For programs: one JSON object, as `--json` prints it.
    pub json: String,
    /// Where the files were written.
    pub out: Option<PathBuf>,
    /// What looks wrong; the JSON object has it as well.
    pub warnings: Vec<String>,
    /// The exit code: 0, unless a program that waits for it asked for more than was shown.
    pub code: u8,
    /// Whether the text is for a file or a program, and is printed as it is.
    is_verbatim: bool,
}

impl Answer {
    /// In words and as an object.
    pub(crate) fn of(text: String, object: &impl Serialize) -> Result<Answer, Failure> {
        let json = serde_json::to_string_pretty(object)
            .map_err(|error| Failure::Run(format!("cannot write JSON: {error}")))?;
        Ok(Answer { text, json: json + "\n", out: None, warnings: Vec::new(), code: 0, is_verbatim: false })
    }

    /// A text that a file or a program takes, and an object of it.
    pub(crate) fn verbatim(text: String, object: &impl Serialize) -> Result<Answer, Failure> {
        Ok(Answer { is_verbatim: true, ..Answer::of(text, object)? })
    }

    /// The same with files in a folder, or a file.
    pub(crate) fn in_place(self, out: &Path) -> Answer {
        Answer { out: Some(out.to_path_buf()), ..self }
    }

    /// The same with another exit code.
    pub(crate) fn with_code(self, code: u8) -> Answer {
        Answer { code, ..self }
    }

    /// The same with what looks wrong.
    pub(crate) fn with_warnings(self, warnings: Vec<String>) -> Answer {
        Answer { warnings, ..self }
    }

    /// Prints it: the object alone, or the warnings on standard error and the text.
    pub(crate) fn tell(&self, as_json: bool) -> Result<(), Failure> {
        if as_json {
            return output::print_as_it_is(&self.json);
        }
        self.warnings.iter().for_each(|warning| output::warning(warning));
        if self.is_verbatim { output::print_as_it_is(&self.text) } else { output::print(&self.text) }
    }
}
