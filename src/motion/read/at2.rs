//! PEER's AT2: a few header lines, then values in columns.

use crate::motion::read::number::{number, shortened, values};
use crate::motion::read::samples::{Samples, Unit, checked_step};
use crate::motion::read::unit::{Said, said};
use crate::motion::read::{HEAD, Lines};
use crate::motion::{BadRecord, Motion};

/// How the number of values and the step are written.
const FORMS: &str = "\"NPTS= 4000, DT= .0050 SEC\" or \"4000 0.0050 NPTS, DT\"";

/// Whether a line belongs to such a file alone.
pub(super) fn is_mark(line: &str) -> bool {
    let line = line.to_ascii_uppercase();
    line.contains("NPTS") || line.contains("UNITS OF G") || line.contains("STRONG MOTION DATABASE RECORD")
}

/// What the header says.
struct Header {
    /// Number of values.
    count: usize,
    /// Time between them (s).
    step: f64,
    /// Unit of the values.
    unit: Unit,
    /// Line of their number.
    line: usize,
    /// Place in the lines after which values may begin.
    end: usize,
}

/// A record along x, from the lines of a file.
pub(super) fn read(name: &str, lines: Lines) -> Result<Motion, BadRecord> {
    let header = header(lines)?;
    let body: Vec<_> = lines[header.end..].iter().filter(|(_, line)| !line.is_empty()).collect();
    // Some files have further lines of header.
    let begin = body.iter().take(HEAD).position(|(_, line)| values(line).is_ok()).unwrap_or(0);
    let mut samples = Samples::default();
    // Lengths of the lines: the last one may be short.
    let (mut full, mut last) = (0, 0);
    for (at, (line, text)) in body[begin..].iter().enumerate() {
        let found = values(text).map_err(|found| {
            let allowed = "values alone, once they have begun";
            BadRecord::at(*line, found, allowed, "remove or mend what is no value")
        })?;
        if at == 0 {
            full = found.len();
        }
        last = found.len();
        for value in found {
            samples.push(value, *line)?;
        }
    }
    let count = samples.len();
    // A last line that lost its end costs less than a line of values, at the end of the coda.
    let cut = header.count > count && last < full && header.count - count <= full - last;
    if count != header.count && !cut {
        let found = format!("the header states {} values, and there are {count}", header.count);
        let fix = "get the whole file, or correct NPTS if the values are all there";
        return Err(BadRecord::at(header.line, found, "as many as stated", fix));
    }
    if let Some(fault) = samples.weakness(header.unit) {
        return Err(fault);
    }
    let (record, mut notes) = samples.record(header.step, header.unit)?;
    if cut {
        notes.push(format!("the last line is short: {count} of {} values are there", header.count));
    }
    Ok(Motion::of_record(name, record).noted(notes))
}

fn header(lines: Lines) -> Result<Header, BadRecord> {
    let upper = |line: &str| line.to_ascii_uppercase();
    let Some(place) = lines.iter().take(HEAD).position(|(_, line)| upper(line).contains("NPTS")) else {
        let found = "NPTS and DT are missing";
        return Err(BadRecord::at(0, found, format!("a line {FORMS}"), "add that line after the header"));
    };
    let unit = unit(&lines[..place.saturating_add(3).min(lines.len())])?;
    let (line, text) = lines[place];
    let text = upper(text);
    let (count, step) = match text.split_once('=') {
        Some(_) => (after(&text, "NPTS"), after(&text, "DT")),
        None => {
            let before = text.split("NPTS").next().unwrap_or_default();
            let mut words = before.split([' ', '\t', ',']).filter(|word| !word.is_empty());
            (words.next(), words.next())
        }
    };
    let refused = |what: &str, found: Option<&str>| {
        let found = match found {
            None => format!("{what} is missing"),
            Some(word) => format!("{what} is {:?}", shortened(word)),
        };
        BadRecord::at(line, found, FORMS, format!("state {what}"))
    };
    let of_word = |word: Option<&str>| word.and_then(|word| number(word).ok());
    let stated = of_word(count).filter(|n| n.fract() == 0.0 && *n >= 1.0 && *n < 1e9);
    let stated = stated.ok_or_else(|| refused("NPTS", count))?;
    let step = checked_step(of_word(step).ok_or_else(|| refused("DT", step))?, line)?;
    Ok(Header { count: stated as usize, step, unit, line, end: place + 1 })
}

/// The word after `KEY =`.
fn after<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(key)?;
    let rest = rest.trim_start().strip_prefix('=')?;
    // A unit may follow without a blank.
    rest.split([' ', '\t', ',']).find(|word| !word.is_empty()).map(|word| word.trim_end_matches("SEC"))
}

/// The unit, which must be stated, and be the same wherever it is.
fn unit(head: Lines) -> Result<Unit, BadRecord> {
    let allowed = "\"ACCELERATION TIME SERIES IN UNITS OF G\" or \"Acceleration in g\"";
    let said = || head.iter().filter_map(|(line, text)| Some((*line, *text, said(text)?)));
    let stated = || {
        said().filter_map(|(line, _, said)| match said {
            Said::Acceleration(unit) => Some((line, unit)),
            Said::Other | Said::Unknown => None,
        })
    };
    if let Some((first, unit)) = stated().next() {
        return match stated().find(|(_, other)| *other != unit) {
            None => Ok(unit),
            Some((line, other)) => {
                let found =
                    format!("the header states {}, and line {first} states {}", other.name(), unit.name());
                Err(BadRecord::at(line, found, "one unit", "keep the unit that the values have"))
            }
        };
    }
    let Some((line, text, said)) = said().next() else {
        return Err(BadRecord::at(
            0,
            "the header states no unit",
            allowed,
            "add that line before NPTS, if it is so",
        ));
    };
    let fix = match said {
        Said::Other => "give the file of accelerations (.AT2)",
        _ => "convert it to CSV with the unit in the header, as a_cm_per_s2",
    };
    let found = format!("the header says {:?}", shortened(text));
    Err(BadRecord::at(line, found, allowed, fix))
}
