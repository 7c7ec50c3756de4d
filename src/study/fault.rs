//! Faults of input files: where, which key, what was found, what is allowed, and how to mend it.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// A text file as it was read, kept so that faults can point into it.
#[derive(Debug, PartialEq, Eq)]
pub struct Source {
    /// Name shown to the user, relative to the study's folder or to the folder above `distributions`.
    pub name: String,
    /// Order in which faults of several files are listed.
    pub rank: usize,
    /// The text.
    pub text: String,
}

/// A stretch of a source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub source: Arc<Source>,
    /// Bytes from and to.
    pub span: Range<usize>,
}

impl Place {
    /// Line (from 1) and column in characters (from 1) of the beginning, as an editor counts them: a byte order mark is no
    /// character, and a line ends with a line feed, a carriage return, or both.
    pub fn line_and_column(&self) -> (usize, usize) {
        let (line, span) = self.line();
        let before = self.source.text.get(span.start..self.start()).unwrap_or_default();
        (line, before.chars().count() + 1)
    }

    /// Number (from 1) and stretch of the line of the beginning.
    fn line(&self) -> (usize, Range<usize>) {
        let start = self.start();
        let lines = lines(&self.source.text).enumerate();
        let found = lines.take_while(|(index, line)| *index == 0 || line.start <= start).last();
        found.map_or((1, 0..0), |(index, line)| (index + 1, line))
    }

    /// The line of the beginning with carets under the stretch; a tab is shown as one blank, so that the carets stand right.
    fn excerpt(&self) -> String {
        let (line, column) = self.line_and_column();
        let text = self.source.text.get(self.line().1).unwrap_or_default().replace('\t', " ");
        let left = (text.chars().count() + 1).saturating_sub(column).max(1);
        let end = self.span.end.min(self.source.text.len());
        let wanted = self.source.text.get(self.start()..end).map_or(1, |s| s.chars().count());
        let gutter = line.to_string().len().max(4);
        let marks = "^".repeat(wanted.clamp(1, left));
        format!("{line:>gutter$} | {text}\n{:>gutter$} | {}{marks}", "", " ".repeat(column - 1))
    }

    /// First byte, moved to a character boundary inside the text.
    fn start(&self) -> usize {
        let text = &self.source.text;
        let mut start = self.span.start.min(text.len());
        while !text.is_char_boundary(start) {
            start -= 1;
        }
        start
    }
}

/// The lines of a text without their ends, at least one: a line feed, a carriage return or both end a line. The byte order mark
/// that spreadsheets write is no part of the first.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Range<usize>> {
    let begin = text.find(|c| c != '\u{feff}').unwrap_or(text.len());
    let mut next = Some(begin);
    std::iter::from_fn(move || {
        let begin = next?;
        let end = text[begin..].find(['\n', '\r']).map_or(text.len(), |length| begin + length);
        let behind = if text[end..].starts_with("\r\n") { end + 2 } else { end + 1 };
        next = (end < text.len()).then_some(behind);
        Some(begin..end)
    })
}

/// What was found at a key.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Found {
    /// A value, as written in the file.
    Value(String),
    /// Nothing, where something is required.
    Missing,
    /// Something else, in words that follow the key ("is not a known key").
    Words(String),
}

/// One fault of an input file.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Fault {
    /// File, relative to the study's folder or to the folder above `distributions`.
    pub file: String,
    /// Line, from 1; 0 when the fault is the file's as a whole.
    pub line: usize,
    /// Column in characters, from 1; 0 when the fault is the file's as a whole.
    pub column: usize,
    /// Path of the key, as `arm.irregular.dip_deg`; empty for the file as a whole.
    pub key: String,
    /// What was found.
    pub found: Found,
    /// What is allowed.
    pub allowed: String,
    /// How to mend it.
    pub fix: String,
    /// The line with carets below; empty for the file as a whole.
    pub excerpt: String,
    /// Lines with more faults of the same key that are mended alike, ascending.
    pub more_lines: Vec<usize>,
    #[serde(skip)]
    order: (usize, usize),
}

impl Fault {
    /// A fault at a place.
    pub fn at(
        place: &Place,
        key: &str,
        found: Found,
        allowed: impl Into<String>,
        fix: impl Into<String>,
    ) -> Fault {
        let (line, column) = place.line_and_column();
        Fault {
            file: place.source.name.clone(),
            line,
            column,
            key: key.to_owned(),
            found,
            allowed: allowed.into(),
            fix: fix.into(),
            excerpt: place.excerpt(),
            more_lines: Vec::new(),
            order: (place.source.rank, place.span.start),
        }
    }

    /// A fault of a whole file: `found` reads as a sentence part after the file's name.
    pub fn of_file(file: &str, rank: usize, found: &str, allowed: &str, fix: impl Into<String>) -> Fault {
        Fault {
            file: file.to_owned(),
            line: 0,
            column: 0,
            key: String::new(),
            found: Found::Words(found.to_owned()),
            allowed: allowed.to_owned(),
            fix: fix.into(),
            excerpt: String::new(),
            more_lines: Vec::new(),
            order: (rank, 0),
        }
    }

    /// The same fault, of a key of its file.
    pub(super) fn of_key(self, key: &str) -> Fault {
        Fault { key: key.to_owned(), ..self }
    }

    /// The same fault, of a line (from 1) of its file.
    pub(super) fn in_line(self, line: usize) -> Fault {
        Fault { line, ..self }
    }

    /// The same fault, said to arise only under a variant.
    pub(super) fn in_variant(mut self, variant: &str) -> Fault {
        self.fix = format!("{} (variant \"{variant}\")", self.fix);
        self
    }

    /// Whether both speak of the same place in the same file.
    pub(super) fn is_at_the_place_of(&self, other: &Fault) -> bool {
        self.order == other.order && self.file == other.file
    }

    /// Whether a fault found where an arm's keys are laid over the table `name` is this one of that table itself.
    pub(super) fn is_of_the_shared_table(&self, laid: &Fault, name: &str) -> bool {
        let both_missing = self.found == Found::Missing && laid.found == Found::Missing;
        let key = laid.key.rsplit('.').next().unwrap_or_default();
        self.is_at_the_place_of(laid) || (both_missing && self.key == format!("{name}.{key}"))
    }

    /// Faults in the order of their places, those of one key that are mended alike as one with the lines of the others: whoever has
    /// one wrong unit in forty rows has one thing to mend.
    pub(super) fn gathered(mut faults: Vec<Fault>) -> Vec<Fault> {
        faults.sort_by_key(|fault| fault.order);
        let mut kept: Vec<Fault> = Vec::new();
        for fault in faults {
            let alike = |own: &Fault| {
                own.file == fault.file
                    && own.key == fault.key
                    && std::mem::discriminant(&own.found) == std::mem::discriminant(&fault.found)
                    && (&own.allowed, &own.fix) == (&fault.allowed, &fault.fix)
            };
            match kept.iter_mut().find(|own| alike(own)) {
                None => kept.push(fault),
                Some(own) if own.line == fault.line || own.more_lines.last() == Some(&fault.line) => {}
                Some(own) => own.more_lines.push(fault.line),
            }
        }
        kept
    }

    /// Whether both say the same about the same place.
    pub(super) fn repeats(&self, other: &Fault) -> bool {
        self.is_at_the_place_of(other)
            && self.key == other.key
            && self.found == other.found
            && self.allowed == other.allowed
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if self.line > 0 {
            write!(f, ":{}", self.line)?;
        }
        f.write_str(":")?;
        if !self.key.is_empty() {
            write!(f, " {}", self.key)?;
        }
        match &self.found {
            Found::Value(value) => write!(f, " = {value}")?,
            Found::Missing => write!(f, " is missing")?,
            Found::Words(words) => write!(f, " {words}")?,
        }
        write!(f, ": allowed is {}; {}", self.allowed, self.fix)?;
        if !self.more_lines.is_empty() {
            write!(f, " (so in {} as well)", listed(&self.more_lines))?;
        }
        if !self.excerpt.is_empty() {
            write!(f, "\n{}", self.excerpt)?;
        }
        Ok(())
    }
}

/// Lines of a file in words, long runs of them by their ends.
pub(crate) fn listed(lines: &[usize]) -> String {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for &line in lines {
        match runs.last_mut() {
            Some(run) if run.end == line => run.end += 1,
            Some(run) if run.contains(&line) => {}
            _ => runs.push(line..line + 1),
        }
    }
    let alone = runs.iter().map(Range::len).sum::<usize>() == 1;
    let words: Vec<String> = runs
        .into_iter()
        .flat_map(|run| match run.len() {
            // Short runs are easier to look up one by one.
            0..=3 => run.map(|line| line.to_string()).collect(),
            _ => vec![format!("{} to {}", run.start, run.end - 1)],
        })
        .collect();
    format!("line{} {}", if alone { "" } else { "s" }, words.join(", "))
}

/// All faults of a study and of the files it refers to, in the order of files and lines.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Faults {
    /// At least one.
    pub faults: Vec<Fault>,
}

impl Faults {
    /// Sorts by file and place and drops what was said before.
    pub(super) fn sorted(mut faults: Vec<Fault>) -> Faults {
        faults.sort_by_key(|fault| fault.order);
        let mut kept: Vec<Fault> = Vec::with_capacity(faults.len());
        for fault in faults {
            if !kept.iter().any(|k| k.repeats(&fault)) {
                kept.push(fault);
            }
        }
        Faults { faults: kept }
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let n = self.faults.len();
        writeln!(f, "{n} fault{} in the input:", if n == 1 { "" } else { "s" })?;
        for fault in &self.faults {
            writeln!(f, "{fault}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Faults {}
