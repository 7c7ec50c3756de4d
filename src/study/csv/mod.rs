//! Tables as people and spreadsheets write them: their lines as cells, the numbers in these, and names of columns.

pub mod cells;
pub mod numbers;

/// What such a file is meant to be.
pub const FORMAT: &str = "a text file of values separated by commas, semicolons or tabs";

/// A name of a column as it is compared: in small letters, a unit in brackets behind an underscore, as all others are.
pub fn compared(written: &str) -> String {
    let opened = written.to_ascii_lowercase().replace([' ', '(', '['], "_");
    let closed = opened.trim_end_matches([')', ']']);
    closed.split('_').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_")
}
