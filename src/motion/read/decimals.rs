//! Decimals of a table: with a point or with a comma, the same in the whole file.

use std::borrow::Cow;

use crate::motion::BadRecord;

/// Where a table first has decimals of each kind.
#[derive(Default)]
pub(super) struct Decimals {
    point: Option<usize>,
    comma: Option<usize>,
    /// Whether some comma cannot group thousands.
    is_decimal: bool,
}

impl Decimals {
    /// A cell with a point for its decimal comma, and a hyphen for the typographer's minus. Whether the comma was one is known at the end.
    pub fn pointed<'w>(&mut self, word: &'w str, line: usize) -> Cow<'w, str> {
        if word.contains('.') {
            self.point.get_or_insert(line);
        }
        if word.contains(',') {
            self.comma.get_or_insert(line);
            self.is_decimal |= !may_group(word);
        }
        match word.contains([',', '\u{2212}']) {
            true => Cow::Owned(word.replacen(',', ".", 1).replace('\u{2212}', "-")),
            false => Cow::Borrowed(word),
        }
    }

    /// That all decimals are of one kind, and that commas are decimal ones.
    pub fn agree(&self) -> Result<(), BadRecord> {
        let Some(line) = self.comma else { return Ok(()) };
        let fix = "write all decimals with a point";
        match self.point {
            Some(other) => {
                let found = format!("a comma is among the digits, and line {other} has a decimal point");
                Err(BadRecord::at(line, found, "decimals of one kind in the whole file", fix))
            }
            None if !self.is_decimal => {
                let found = "the commas may be decimal ones, or group thousands";
                Err(BadRecord::at(line, found, "numbers that can be read in one way", fix))
            }
            None => Ok(()),
        }
    }
}

/// Whether a comma may group thousands: `1,371`, and neither `0,371` nor `1,37`.
fn may_group(word: &str) -> bool {
    let Some((before, behind)) = word.split_once(',') else { return false };
    let before = before.trim_start_matches(['+', '-', '\u{2212}']);
    let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    (1..=3).contains(&before.len())
        && !before.starts_with('0')
        && behind.len() == 3
        && is_digits(before)
        && is_digits(behind)
}
