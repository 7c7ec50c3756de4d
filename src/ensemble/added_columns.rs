//! The columns that a run's tables have only where some wall brings a value.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::Block;
use crate::ensemble::reading::BLOCKS;
use crate::ensemble::record::Row;

/// Columns beyond those of every table. They follow from all rows of a table together: who writes the rows one by one knows them
/// beforehand, joined over the parts that the rows come from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AddedColumns {
    /// Parameters that some wall drew as a whole; a column each in the table of members.
    pub drawn: BTreeSet<String>,
    /// Blocks of columns by their names, and whether some wall fills them.
    #[serde(flatten)]
    filled: BTreeMap<String, bool>,
}

impl AddedColumns {
    /// Those that rows need together.
    pub fn of<'r>(rows: impl IntoIterator<Item = &'r Row>) -> AddedColumns {
        let mut added = AddedColumns::default();
        rows.into_iter().for_each(|row| added.take(row));
        added
    }

    /// Adds those that a row needs.
    pub fn take(&mut self, row: &Row) {
        for key in row.drawn.keys().filter(|key| !self.drawn.contains(*key)).collect::<Vec<_>>() {
            self.drawn.insert(key.clone());
        }
        for block in &BLOCKS {
            *self.filled.entry(block.name.to_owned()).or_default() |= (block.fills)(row);
        }
    }

    /// Adds those that other rows need.
    pub fn join(&mut self, other: &AddedColumns) {
        self.drawn.extend(other.drawn.iter().cloned());
        for (name, filled) in &other.filled {
            *self.filled.entry(name.clone()).or_default() |= filled;
        }
    }

    /// Whether some wall fills the block of this name.
    pub fn has(&self, block: &str) -> bool {
        self.filled.get(block).copied().unwrap_or_default()
    }

    /// The blocks that some wall fills, in the order of their columns.
    pub(super) fn blocks(&self) -> impl Iterator<Item = &'static Block> {
        BLOCKS.iter().filter(|block| self.has(block.name))
    }

    /// Whether a row finds a place for all that it holds.
    pub fn hold(&self, row: &Row) -> bool {
        row.drawn.keys().all(|key| self.drawn.contains(key))
            && BLOCKS.iter().all(|block| self.has(block.name) || !(block.fills)(row))
    }
}
