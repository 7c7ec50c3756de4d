//! The columns that a run's tables have only where some wall brings a value.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::ensemble::{Row, StepRow};

/// Columns beyond those of every table. They follow from all rows of a table together: who writes the rows one by one knows them
/// beforehand, joined over the parts that the rows come from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AddedColumns {
    /// Parameters that some wall drew as a whole; a column each in the table of members.
    pub drawn: BTreeSet<String>,
    /// Whether some wall is sheared: the columns of capacity, stiffness and mode in the table of members.
    pub sheared: bool,
    /// Whether some wall is pushed by a jack: the columns of its drift and force in the table of load steps.
    pub pushed: bool,
    /// Whether rigid blocks leave the value of some wall open: the columns of what stiff joints bear, in the table of members.
    #[serde(default)]
    pub undecided: bool,
    /// Whether some wall is shaken: the columns of what came of each record, in both tables.
    #[serde(default)]
    pub shaken: bool,
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
        self.sheared |= row.shear.is_some();
        self.pushed |= row.load_steps.iter().any(is_pushed);
        self.undecided |= row.undecided.is_some();
        self.shaken |= row.load_steps.iter().any(is_shaken);
    }

    /// Adds those that other rows need.
    pub fn join(&mut self, other: &AddedColumns) {
        self.drawn.extend(other.drawn.iter().cloned());
        self.sheared |= other.sheared;
        self.pushed |= other.pushed;
        self.undecided |= other.undecided;
        self.shaken |= other.shaken;
    }

    /// Whether a row finds a place for all that it holds.
    pub fn hold(&self, row: &Row) -> bool {
        row.drawn.keys().all(|key| self.drawn.contains(key))
            && (self.sheared || row.shear.is_none())
            && (self.pushed || !row.load_steps.iter().any(is_pushed))
            && (self.undecided || row.undecided.is_none())
            && (self.shaken || !row.load_steps.iter().any(is_shaken))
    }
}

fn is_shaken(step: &StepRow) -> bool {
    step.shaken.is_some()
}

fn is_pushed(step: &StepRow) -> bool {
    step.force_n.is_some()
}
