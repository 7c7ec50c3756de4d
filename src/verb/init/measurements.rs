//! `pirca init FILE --measured STUDY`: an empty table of measurements for a spreadsheet.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::Path;

use serde_json::json;

use crate::study::{Template, template};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::arguments::Which;
use crate::verb::locate;

/// Writes the table for the arms, the specimens and the tilts of a study, never over a file: it may be the filled one.
pub(super) fn begin(path: &Path, which: &Which, wanted: Template) -> Result<Answer, Failure> {
    let study = locate::measurable(which)?.study;
    let text = template(&study, wanted).ok_or_else(|| {
        let text = "the study tilts no platform: what is measured on walls is measured on a tilting table";
        Failure::Input(format!("{}: {text}", study.name))
    })?;
    let opened = OpenOptions::new().write(true).create_new(true).open(path);
    opened.and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| {
        Failure::Run(match error.kind() {
            ErrorKind::AlreadyExists => {
                format!("{} is there already, and may hold measurements: name another file", path.display())
            }
            _ => format!("cannot write {}: {error}", path.display()),
        })
    })?;
    let object = json!({"study": study.name, "variant": study.variant, "file": path, "template": text});
    Ok(Answer::of(format!("written to {}\n", path.display()), &object)?.in_place(path))
}
