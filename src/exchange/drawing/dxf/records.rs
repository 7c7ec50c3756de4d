//! The records of an ASCII DXF file: pairs of lines, a group code and a value; a record begins with code 0.

use std::borrow::Cow;

use crate::exchange::drawing::gather::{Unread, cut};
use crate::exchange::fault::Fault;

/// A code and its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<'a> {
    /// Line of the value, from 1.
    pub line: usize,
    pub code: i32,
    pub value: &'a str,
}

impl Group<'_> {
    /// The value as a number.
    pub fn number(&self, what: &str) -> Result<f64, Unread> {
        let read = self.value.parse().ok().filter(|number: &f64| number.is_finite());
        read.ok_or_else(|| Unread::number(self.line, what, self.value))
    }
}

/// What begins with code 0: an entity, a vertex, the beginning or end of something.
#[derive(Clone, Debug)]
pub(super) struct Record<'a> {
    /// `LINE`, `SECTION`.
    pub kind: &'a str,
    /// Its line, from 1.
    pub line: usize,
    pub groups: Vec<Group<'a>>,
}

impl<'a> Record<'a> {
    /// The first group of a code.
    pub fn group(&self, code: i32) -> Option<&Group<'a>> {
        self.groups.iter().find(|group| group.code == code)
    }

    /// The value of a code, or nothing.
    pub fn text(&self, code: i32) -> &'a str {
        self.group(code).map_or("", |group| group.value)
    }

    /// The number of a code; `usual` where the record has none.
    pub fn number(&self, code: i32, usual: f64) -> Result<f64, Unread> {
        self.group(code)
            .map_or(Ok(usual), |group| group.number(&format!("group {code} of {}", cut(self.kind))))
    }

    /// The whole number of a code; 0 where the record has none or something else.
    pub fn flags(&self, code: i32) -> i64 {
        self.text(code).parse().unwrap_or(0)
    }

    /// The point whose first number has this code, its others the codes 10 and 20 above.
    pub fn point(&self, code: i32) -> Result<[f64; 3], Unread> {
        Ok([self.number(code, 0.0)?, self.number(code + 10, 0.0)?, self.number(code + 20, 0.0)?])
    }
}

/// The records of a text in order; the last one may be a fault.
pub(super) struct Records<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    /// The group that begins the next record.
    begun: Option<Group<'a>>,
    ended: bool,
}

impl<'a> Records<'a> {
    pub fn of(text: &'a str) -> Records<'a> {
        Records { lines: text.lines().enumerate(), begun: None, ended: false }
    }

    /// The next group; `None` at the end of the text.
    fn group(&mut self) -> Result<Option<Group<'a>>, Box<Fault>> {
        loop {
            let Some((at, code_line)) = self.lines.next() else { return Ok(None) };
            let value = self.lines.next();
            let Ok(code) = code_line.trim().parse::<i32>() else {
                if code_line.trim().is_empty() && value.is_none() {
                    return Ok(None);
                }
                let found = format!("\"{}\" stands where a group code is expected", cut(code_line.trim()));
                let allowed = "pairs of lines: a whole number, and its value";
                let fix = "save the drawing again as ASCII DXF";
                return Err(Fault::of("", found, allowed, fix).at(at + 1, 0).into());
            };
            let Some((value_at, value)) = value else { return Err(truncated(at + 1)) };
            // Comments.
            if code != 999 {
                return Ok(Some(Group { line: value_at + 1, code, value: value.trim() }));
            }
        }
    }

    fn record(&mut self) -> Result<Option<Record<'a>>, Box<Fault>> {
        let begun = match self.begun.take() {
            Some(begun) => Some(begun),
            None => self.group()?,
        };
        let Some(begun) = begun else { return Ok(None) };
        if begun.code != 0 {
            let found = format!("group code {} stands where a record is expected", begun.code);
            let fix = "save the drawing again as ASCII DXF";
            return Err(Fault::of("", found, "code 0 first", fix).at(begun.line, 0).into());
        }
        let mut groups = Vec::new();
        while let Some(group) = self.group()? {
            if group.code == 0 {
                self.begun = Some(group);
                break;
            }
            groups.push(group);
        }
        Ok(Some(Record { kind: begun.value, line: begun.line, groups }))
    }
}

impl<'a> Iterator for Records<'a> {
    type Item = Result<Record<'a>, Box<Fault>>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let next = self.record();
        self.ended = !matches!(next, Ok(Some(_)));
        next.transpose()
    }
}

/// The fault of a file without its end.
pub(super) fn truncated(line: usize) -> Box<Fault> {
    let found = "the file ends too early: it is truncated";
    Fault::of("", found, "a whole drawing, up to the record EOF", "write or copy it again").at(line, 0).into()
}

/// The text of a file: UTF-8, or else a byte per character, as files before 2007 have it.
pub(super) fn text(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text.trim_start_matches('\u{feff}')),
        Err(_) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_begin_with_code_0_and_name_their_lines() {
        let all: Vec<Record> = Records::of("999\nhello\n0\nLINE\n 8\nA\n10\n1.5\n20\nnan\n0\nEOF\n")
            .map(Result::unwrap)
            .collect();
        assert_eq!(
            all.iter().map(|own| (own.kind, own.line)).collect::<Vec<_>>(),
            [("LINE", 4), ("EOF", 12)]
        );
        assert_eq!(
            (all[0].text(8), all[0].number(10, 0.0).ok(), all[0].number(30, 7.0).ok()),
            ("A", Some(1.5), Some(7.0))
        );
        let unread = all[0].point(10).unwrap_err();
        assert_eq!((unread.line, unread.found.as_str()), (10, "group 20 of LINE is \"nan\""));
    }

    #[test]
    fn what_is_no_pair_of_lines_ends_the_reading() {
        let fault =
            |text: &str| Records::of(text).find_map(Result::err).map(|fault| (fault.line, fault.found));
        assert_eq!(
            fault("0\nLINE\nx\n1\n"),
            Some((3, "\"x\" stands where a group code is expected".to_owned()))
        );
        assert_eq!(fault("0\nLINE\n10\n"), Some((3, "the file ends too early: it is truncated".to_owned())));
        assert_eq!(fault("8\nA\n").map(|fault| fault.0), Some(2));
        assert_eq!(text(b"T\xfcr"), "Tür");
    }
}
