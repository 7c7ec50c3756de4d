//! A table of a document.

use serde::Serialize;

use crate::render::text::{aligned, aligned_to, side_by_side, wrapped};

/// A table; `summary` stands above it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Table {
    /// What it holds.
    pub summary: String,
    /// What its cells mean: above it on a page, below it in text.
    pub caption: String,
    /// Heads of the columns.
    pub heads: Vec<String>,
    /// Its rows.
    pub rows: Vec<Line>,
    /// How text has it.
    #[serde(skip)]
    pub layout: Layout,
}

/// How text has a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Below its summary, names of rows cut.
    #[default]
    Titled,
    /// The same with whole names.
    Whole,
    /// Without its summary.
    Bare,
    /// The same, in as many tables side by side as the width needs.
    Split,
    /// Not at all.
    OnPage,
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
            layout: Layout::default(),
        }
    }

    /// Its text for a terminal.
    pub(crate) fn text(&self) -> String {
        if self.rows.is_empty() || self.layout == Layout::OnPage {
            return String::new();
        }
        let rows = self.rows.iter().map(|row| row.cells.clone());
        let rows: Vec<Vec<String>> = std::iter::once(self.heads.clone()).chain(rows).collect();
        let title = || wrapped("", &self.summary);
        let table = match self.layout {
            Layout::Titled => title() + &aligned(rows),
            Layout::Whole => title() + &aligned_to(rows, usize::MAX),
            Layout::Split => {
                let column = |k: usize| rows.iter().map(|row| row[k].clone()).collect::<Vec<_>>();
                side_by_side(&column(0), &(1..self.heads.len()).map(column).collect::<Vec<_>>())
            }
            Layout::Bare | Layout::OnPage => aligned(rows),
        };
        let caption = if self.caption.is_empty() { String::new() } else { wrapped("", &self.caption) };
        format!("\n{table}{caption}")
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
