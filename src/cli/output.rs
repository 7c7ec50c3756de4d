//! Standard output and standard error.

use std::fs;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};

use crate::cli::failure::Failure;
use crate::cli::session;
use crate::study::Study;

/// Writes text to standard output, its sentences broken to the width of a terminal.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let terminal = console::Term::stdout();
    match terminal.is_term() {
        true => write(&fitted(text, usize::from(terminal.size().1))),
        false => write(text),
    }
}

/// The text with lines of at most so many characters; the rows of tables, whose columns stand two spaces apart, stay whole.
fn fitted(text: &str, width: usize) -> String {
    let mut fitted = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let words = line.trim_start();
        let indent = line.len() - words.len();
        if line.trim_end().chars().count() <= width || words.trim_end().contains("  ") {
            fitted.push_str(line);
            continue;
        }
        let (mut used, mut first) = (0, true);
        for word in words.split_whitespace() {
            let length = word.chars().count();
            if first || used + 1 + length > width {
                let lead = if first { indent } else { indent + HANGING };
                fitted.push_str(if first { "" } else { "\n" });
                fitted.push_str(&" ".repeat(lead));
                used = lead;
            } else {
                fitted.push(' ');
                used += 1;
            }
            fitted.push_str(word);
            (used, first) = (used + length, false);
        }
        fitted.push_str(if line.ends_with('\n') { "\n" } else { "" });
    }
    fitted
}

/// Spaces before the second line of a sentence, beyond those before its first.
const HANGING: usize = 2;

/// Writes text as it is. A reader that has gone away (`pirca ... | head`) has read what it wanted.
pub(super) fn write(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Run(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes a value to standard output as indented JSON.
pub(crate) fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let text =
        serde_json::to_string_pretty(value).map_err(|e| Failure::Run(format!("cannot write JSON: {e}")))?;
    write(&format!("{text}\n"))
}

/// Where the results of a study are written by default: by its name and its variant's, so that no variant takes another's place.
/// `what` they are comes behind; empty for those of a run.
pub(crate) fn default_folder(study: &Study, what: &str) -> PathBuf {
    let parts =
        [Some(study.name.as_str()), study.variant.as_deref(), Some(what).filter(|what| !what.is_empty())];
    PathBuf::from("runs").join(parts.into_iter().flatten().collect::<Vec<_>>().join("-"))
}

/// Makes the folder that results are written to.
pub(crate) fn folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path)
        .map_err(|error| Failure::Run(format!("cannot create the folder {}: {error}", path.display())))
}

/// Says a line on the way: on standard error, where nobody is left to tell if nobody reads it, or to whoever hears it.
pub(crate) fn note(text: &str) {
    if let Some(hear) = session::heard_by() {
        return hear(text);
    }
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Whether what is said on the way is drawn on a terminal, where a line can be drawn anew.
pub(crate) fn is_drawn() -> bool {
    session::heard_by().is_none() && std::io::stderr().is_terminal()
}

/// Says why a verb failed: on standard error, or as an object on standard output if that was asked for.
pub(crate) fn failed(failure: &Failure) {
    match failure {
        Failure::Said(_) => drop(write(&format!("{}\n", failure.message()))),
        _ => note(&format!("error: {}", failure.message())),
    }
}

/// Answers arguments that make no sense, or a request for help or the version.
pub(crate) fn usage(error: &clap::Error) -> u8 {
    // As in `print`: whoever closed the pipe has read enough.
    let _ = error.print();
    u8::try_from(error.exit_code()).unwrap_or(2)
}

/// Lets a write beyond the file size limit (`ulimit -f`) fail with an error that says so, as a full disk does.
/// By default the signal SIGXFSZ would end the process without a word.
pub(crate) fn report_full_files() {
    #[cfg(target_os = "linux")]
    {
        const SIGXFSZ: i32 = 25;
        const SIG_IGN: usize = 1;
        unsafe extern "C" {
            fn signal(number: i32, handler: usize) -> usize;
        }
        // Safe: the C library's `signal` is called before any thread is started, with a handler that is no function.
        unsafe { signal(SIGXFSZ, SIG_IGN) };
    }
}

#[cfg(test)]
mod tests {
    use super::fitted;

    #[test]
    fn sentences_are_broken_and_tables_are_not() {
        let text = "  one two three four\narm          mean   sigma  COV\nshort\n";
        assert_eq!(
            fitted(text, 12),
            "  one two\n    three\n    four\narm          mean   sigma  COV\nshort\n"
        );
        assert_eq!(fitted(text, 80), text);
    }
}
