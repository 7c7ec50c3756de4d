//! A table of a page.

use serde::Serialize;

/// A table; `summary` stands above it where it may be folded away.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Table {
    /// What it holds.
    pub summary: String,
    /// A sentence above it.
    pub caption: String,
    /// Heads of the columns.
    pub heads: Vec<String>,
    /// Its rows.
    pub rows: Vec<Line>,
}

/// A row.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Line {
    /// What links lead to it by; empty where none does.
    pub id: String,
    /// Whether it stands out.
    pub marked: bool,
    /// Its cells.
    pub cells: Vec<String>,
}

impl Table {
    /// A table with these heads.
    pub fn new(summary: &str, heads: &[&str], rows: Vec<Vec<String>>) -> Table {
        let heads = heads.iter().map(ToString::to_string).collect();
        let line = |cells| Line { cells, ..Line::default() };
        Table {
            summary: summary.to_owned(),
            caption: String::new(),
            heads,
            rows: rows.into_iter().map(line).collect(),
        }
    }

    /// A table whose first row holds the heads, as tables on a terminal have them.
    pub fn headed(summary: &str, mut rows: Vec<Vec<String>>) -> Table {
        let heads = if rows.is_empty() { Vec::new() } else { rows.remove(0) };
        Table { heads, ..Table::new(summary, &[], rows) }
    }

    /// A table of things with their values.
    pub fn of_pairs<'p>(rows: impl IntoIterator<Item = (&'p str, String)>) -> Table {
        let rows = rows.into_iter().map(|(name, value)| vec![name.to_owned(), value]).collect();
        Table::new("", &["what", "value"], rows)
    }
}
