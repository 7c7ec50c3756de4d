//! The lines of a CSV file as cells with their places (RFC 4180, with comments).
//!
//! Cells are separated by commas; quotes around a cell let it hold commas, and a doubled quote in it is one quote. A cell
//! ends on its line. Lines that are blank, and those that begin with `#`, are skipped. The byte order mark that
//! spreadsheets write, and the carriage return before a line's end, are no part of a cell.

use std::ops::Range;
use std::sync::Arc;

use crate::study::fault::{Fault, Found, Place, Source};

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
}

/// Every line that holds cells, first the header; a line that cannot be cut into cells is noted and left out.
pub fn lines(source: &Arc<Source>, faults: &mut Vec<Fault>) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut start = source.text.find(|c| c != '\u{feff}').unwrap_or(0);
    for line in source.text[start..].split_inclusive('\n') {
        let text = line.trim_end_matches(['\n', '\r']);
        let from = start;
        start += line.len();
        if text.trim().is_empty() || text.trim_start().starts_with('#') {
            continue;
        }
        match cells(source, from..from + text.len()) {
            Ok(cells) => lines.push(Line { cells, place: place(source, from..from + text.len()) }),
            Err(fault) => faults.push(*fault),
        }
    }
    lines
}

fn place(source: &Arc<Source>, span: Range<usize>) -> Place {
    Place { source: source.clone(), span }
}

/// Cuts one line.
fn cells(source: &Arc<Source>, line: Range<usize>) -> Result<Vec<Cell>, Box<Fault>> {
    let mut cells = Vec::new();
    let mut from = line.start;
    loop {
        let rest = &source.text[from..line.end];
        let blank = rest.len() - rest.trim_start().len();
        let length = if rest[blank..].starts_with('"') {
            quoted_length(&rest[blank..]).map(|length| blank + length)
        } else {
            Ok(rest.find(',').unwrap_or(rest.len()))
        };
        let length = length.map_err(|words| {
            let at = place(source, from + blank..line.end);
            let allowed = "a cell of which the quotes come in pairs, with a comma behind it";
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
        from += 1;
    }
}

/// Bytes up to the comma or the end behind a cell that begins with a quote.
fn quoted_length(text: &str) -> Result<usize, &'static str> {
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
    let blank = behind.len() - behind.trim_start().len();
    match behind[blank..].chars().next() {
        None => Ok(text.len()),
        Some(',') => Ok(at + 1 + blank),
        Some(_) => Err("goes on behind a closing quote"),
    }
}
