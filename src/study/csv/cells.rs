//! The lines of a table as cells with their places (RFC 4180, with comments), as people and spreadsheets write them.
//!
//! Cells are separated by commas, semicolons or tabs; quotes around a cell let it hold the separator, and a doubled quote in it is
//! one quote. A cell ends on its line. Lines that are blank, rows of nothing but separators, and lines that begin with `#`, are
//! skipped, and so is a first line `sep=;`, by which a spreadsheet is told the separator.

use std::ops::Range;
use std::sync::Arc;

use crate::study::fault::{self, Fault, Found, Place, Source};

/// Separators in the order in which they are preferred where nothing tells.
const SEPARATORS: [char; 3] = [',', ';', '\t'];

/// A cell.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Its text, without quotes and without blanks around it.
    pub text: String,
    /// Where it stands, quotes included.
    pub place: Place,
}

/// A line's cells, at least one.
pub struct Line {
    /// The cells.
    pub cells: Vec<Cell>,
    /// The whole line.
    pub place: Place,
    /// Its number, from 1.
    pub number: usize,
}

/// A file cut into cells.
pub struct Table {
    /// What stands between them.
    pub separator: char,
    /// Every line that holds cells, first the header.
    pub lines: Vec<Line>,
}

/// Cuts a file by the separator that makes the most known columns of its first line that holds cells, by `sep=` where two make as
/// many; a line that cannot be cut is noted and left out.
pub fn table(source: &Arc<Source>, is_column: impl Fn(&str) -> bool, faults: &mut Vec<Fault>) -> Table {
    let text = |span: &Range<usize>| &source.text[span.clone()];
    let mut spans = (1..).zip(fault::lines(&source.text)).peekable();
    let first = spans.next_if(|(_, first)| told_separator(text(first)).is_some());
    let told = first.and_then(|(_, first)| told_separator(text(&first)));
    let spans: Vec<(usize, Range<usize>)> = spans.filter(|(_, span)| !is_without_cells(text(span))).collect();
    let known = |separator: char| {
        let header = spans.first().and_then(|(_, span)| cells(source, span.clone(), separator).ok());
        header.map_or(0, |cells| cells.iter().filter(|cell| is_column(&cell.text)).count())
    };
    // The last of those that are best is taken.
    let preferred = SEPARATORS.into_iter().rev().chain(told);
    let separator = preferred.max_by_key(|separator| known(*separator)).unwrap_or(',');
    let mut lines = Vec::new();
    for (number, span) in spans {
        match cells(source, span.clone(), separator) {
            Ok(cells) => lines.push(Line { cells, place: place(source, span), number }),
            Err(fault) => faults.push(*fault),
        }
    }
    Table { separator, lines }
}

/// The separator that a line `sep=;` tells; `None` of any other line. A spreadsheet that takes it for a row adds empty cells.
fn told_separator(line: &str) -> Option<char> {
    let line = line.trim_matches([' ', '"']);
    let told = line.get(..4).filter(|start| start.eq_ignore_ascii_case("sep=")).and(line.get(4..))?;
    let separator = told.chars().next().filter(|c| !c.is_alphanumeric() && *c != '"')?;
    told.chars().all(|c| c == separator || c == '"' || SEPARATORS.contains(&c)).then_some(separator)
}

/// Whether a line is blank, a comment, or a row of nothing but separators.
fn is_without_cells(line: &str) -> bool {
    let written = line.trim().trim_start_matches('"').trim_start();
    written.starts_with('#')
        || line.chars().all(|c| c.is_whitespace() || c == '"' || c == '|' || SEPARATORS.contains(&c))
}

fn place(source: &Arc<Source>, span: Range<usize>) -> Place {
    Place { source: source.clone(), span }
}

/// Cuts one line.
fn cells(source: &Arc<Source>, line: Range<usize>, separator: char) -> Result<Vec<Cell>, Box<Fault>> {
    // A tab is a blank unless it separates.
    let is_blank = |c: char| c.is_whitespace() && c != separator;
    let mut cells = Vec::new();
    let mut from = line.start;
    loop {
        let rest = &source.text[from..line.end];
        let blank = rest.len() - rest.trim_start_matches(is_blank).len();
        let length = if rest[blank..].starts_with('"') {
            quoted_length(&rest[blank..], separator).map(|length| blank + length)
        } else {
            Ok(rest.find(separator).unwrap_or(rest.len()))
        };
        let length = length.map_err(|words| {
            let at = place(source, from + blank..line.end);
            let allowed = "a cell of which the quotes come in pairs, with a separator behind it";
            Box::new(Fault::at(
                &at,
                "",
                Found::Words(words.to_owned()),
                allowed,
                "mend the quotes; write \"\" for a quote within a cell",
            ))
        })?;
        let written = &rest[..length];
        let text = written.trim();
        let begin = from + (written.len() - written.trim_start().len());
        let inner = text.strip_prefix('"').and_then(|t| t.strip_suffix('"'));
        let unquoted =
            inner.map_or_else(|| text.to_owned(), |inner| inner.replace("\"\"", "\"").trim().to_owned());
        cells.push(Cell { text: unquoted, place: place(source, begin..begin + text.len()) });
        from += length;
        if from >= line.end {
            return Ok(cells);
        }
        from += separator.len_utf8();
    }
}

/// Bytes up to the separator or the end behind a cell that begins with a quote.
fn quoted_length(text: &str, separator: char) -> Result<usize, &'static str> {
    let bytes = text.as_bytes();
    let mut at = 1;
    loop {
        match bytes.get(at) {
            None => return Err("has a quote that is not closed on its line"),
            Some(b'"') if bytes.get(at + 1) == Some(&b'"') => at += 2,
            Some(b'"') => break,
            Some(_) => at += 1,
        }
    }
    let behind = &text[at + 1..];
    let blank = behind.len() - behind.trim_start_matches(|c: char| c.is_whitespace() && c != separator).len();
    match behind[blank..].chars().next() {
        None => Ok(text.len()),
        Some(c) if c == separator => Ok(at + 1 + blank),
        Some(_) => Err("goes on behind a closing quote"),
    }
}
