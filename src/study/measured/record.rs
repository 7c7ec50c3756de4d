//! What one reading is read from: the cells of a row of a long table, or some of those of a row of a wide one.

use std::collections::BTreeMap;

use crate::study::csv::cells::{Cell, Line};
use crate::study::fault::Place;

/// A cell and how the file calls its column.
#[derive(Clone)]
pub struct Field {
    /// Name of the column.
    pub name: String,
    /// The cell; empty where the row has nothing there.
    pub cell: Cell,
}

/// The fields of a reading, by the column of a long table that they stand for.
pub struct Record<'l> {
    /// The row.
    pub line: &'l Line,
    /// Those that the file has.
    pub fields: BTreeMap<&'static str, Field>,
}

impl Record<'_> {
    /// The cell of a column, if the file has it and it is not empty.
    pub fn given(&self, column: &str) -> Option<&Cell> {
        self.fields.get(column).map(|field| &field.cell).filter(|cell| !cell.text.is_empty())
    }

    /// How the file calls a column, or the column's own name.
    pub fn name<'n>(&'n self, column: &'n str) -> &'n str {
        self.fields.get(column).map_or(column, |field| &field.name)
    }

    /// Where the cell of a column stands, else the whole row.
    pub fn place(&self, column: &str) -> &Place {
        self.fields.get(column).map_or(&self.line.place, |field| &field.cell.place)
    }
}
