//! Standard output and standard error. A terminal gets sentences of its width, headings in bold and errors in red, unless `NO_COLOR` is set;
//! files and pipes get the bare text.

use std::fs;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use console::Style;

use crate::study::Study;
use crate::terminal::failure::Failure;
use crate::terminal::session;

/// Whether standard error gets errors alone; decided once, by the arguments.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Lets standard error have errors alone, or all that is said.
pub(crate) fn set_quiet(quiet: bool) {
    QUIET.store(quiet, Ordering::Relaxed);
}

/// Whether progress can be drawn on standard error: it is a terminal, is to be written to, and nobody else hears what is said.
pub(crate) fn can_draw() -> bool {
    session::heard_by().is_none() && std::io::stderr().is_terminal() && !QUIET.load(Ordering::Relaxed)
}

/// Writes text to standard output, as a terminal likes it if it is one.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let terminal = console::Term::stdout();
    let fitted = match terminal.is_term() {
        true => fitted(text, usize::from(terminal.size().1)),
        false => text.to_owned(),
    };
    write(&emphasised(&fitted, &Style::new().bold()))
}

/// Writes text to standard output to be taken by a file or a program.
pub(crate) fn print_as_it_is(text: &str) -> Result<(), Failure> {
    write(text)
}

/// The text with its headings in a style: the heads of tables, which have a line of dashes below them, and lines of their own that end
/// in a colon.
fn emphasised(text: &str, style: &Style) -> String {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let is_rule =
        |line: &str| line.trim_end().len() > 2 && line.trim_end().chars().all(|c| c == '-' || c == ' ');
    let heads = |at: usize| {
        let line = lines[at].trim_end();
        let stands_over_a_table = lines.get(at + 1).is_some_and(|next| is_rule(next)) && !is_rule(line);
        stands_over_a_table || (line.ends_with(':') && !line.starts_with(' '))
    };
    let styled = |(at, line): (usize, &&str)| {
        let words = line.trim_end();
        match heads(at) && !words.is_empty() {
            true => format!("{}{}", style.apply_to(words), &line[words.len()..]),
            false => (*line).to_owned(),
        }
    };
    lines.iter().enumerate().map(styled).collect()
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
fn write(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Run(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Where the results of a study are written by default: by its name and its variant's, so that no variant takes another's place.
/// `what` they are comes behind; empty for those of a run.
pub(crate) fn default_folder(study: &Study, what: &str) -> PathBuf {
    // A variant may say what it sets, and a value hold what no folder is called by.
    let plain = |c: char| if c.is_alphanumeric() || "-_.=+".contains(c) { c } else { '_' };
    let variant = study.variant.as_ref().map(|variant| variant.chars().map(plain).collect::<String>());
    let parts = [Some(study.name.as_str()), variant.as_deref(), Some(what).filter(|what| !what.is_empty())];
    PathBuf::from("runs").join(parts.into_iter().flatten().collect::<Vec<_>>().join("-"))
}

/// Makes the folder that results are written to.
pub(crate) fn folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path)
        .map_err(|error| Failure::Run(format!("cannot create the folder {}: {error}", path.display())))
}

/// Says a line on the way, unless only errors are to be said: on standard error, or to whoever hears it.
pub(crate) fn note(text: &str) {
    if QUIET.load(Ordering::Relaxed) {
        return;
    }
    match session::heard_by() {
        Some(hear) => hear(text),
        None => tell(text),
    }
}

/// Says a warning, unless only errors are to be said.
pub(crate) fn warning(text: &str) {
    let style = match session::heard_by() {
        Some(_) => Style::new().force_styling(false),
        None => Style::new().for_stderr().yellow().bold(),
    };
    note(&format!("{} {text}", style.apply_to("warning:")));
}

/// Says why a verb failed: on standard error, or as an object on standard output if that was asked for.
pub(crate) fn failed(failure: &Failure) {
    let message = failure.message();
    match failure {
        // Where nobody reads it, there is nobody left to tell.
        Failure::Said(_) => drop(print_as_it_is(&format!("{message}\n"))),
        _ => tell(&format!("{} {message}", Style::new().for_stderr().red().bold().apply_to("error:"))),
    }
}

/// Writes a line to standard error; where nobody reads it, there is nobody left to tell.
fn tell(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
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
    use super::*;

    #[test]
    fn sentences_are_broken_and_tables_are_not() {
        let text = "  one two three four\narm          mean   sigma  COV\nshort\n";
        assert_eq!(
            fitted(text, 12),
            "  one two\n    three\n    four\narm          mean   sigma  COV\nshort\n"
        );
        assert_eq!(fitted(text, 80), text);
    }

    #[test]
    fn heads_of_tables_and_headings_are_emphasised_and_nothing_else() {
        let text = "study: 3 walls.\narm   mean\n----------\na     1.0\nOf arm a:\n  below:\n\n";
        let bold = Style::new().bold().force_styling(true);
        let [head, heading] = ["arm   mean", "Of arm a:"].map(|words| format!("\u{1b}[1m{words}\u{1b}[0m"));
        assert_eq!(
            emphasised(text, &bold),
            format!("study: 3 walls.\n{head}\n----------\na     1.0\n{heading}\n  below:\n\n")
        );
        assert_eq!(emphasised(text, &bold.force_styling(false)), text);
    }
}
