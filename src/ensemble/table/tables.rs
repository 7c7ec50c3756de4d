//! The tables of a run, written row by row: what is kept of them in memory does not grow with the number of walls.

use std::path::{Path, PathBuf};

use crate::ensemble::columns::{Members, Step, Steps, of_members, of_steps};
use crate::ensemble::files::replace_file;
use crate::ensemble::table::schemas;
use crate::ensemble::table::sheet::Sheet;
use crate::ensemble::{AddedColumns, Row, RunError};

/// `members.parquet` and `steps.parquet` of a run that are being written. Their bytes follow from the rows and the columns alone.
/// Dropped before their end they leave nothing behind, and what was there before is untouched.
pub struct Tables {
    folder: PathBuf,
    added: AddedColumns,
    members: Sheet<Members>,
    steps: Sheet<Steps>,
}

impl Tables {
    /// Begins them in an existing folder, with the columns that all their rows together need.
    ///
    /// # Errors
    /// [`RunError::File`] and [`RunError::Table`], as of all that follows.
    pub fn begin(folder: &Path, added: AddedColumns) -> Result<Tables, RunError> {
        Ok(Tables {
            members: Sheet::begin(folder, "members.parquet", of_members(&added))?,
            steps: Sheet::begin(folder, "steps.parquet", of_steps(&added))?,
            folder: folder.to_path_buf(),
            added,
        })
    }

    /// Takes the next row in the order of the results (arm, point, member), with its load steps.
    ///
    /// # Errors
    /// See [`Tables::begin`].
    pub fn take(&mut self, row: &Row) -> Result<(), RunError> {
        crate::check!(self.added.hold(row), "the tables have no column for all of member {}", row.member);
        self.members.take(row)?;
        for (number, step) in (0..).zip(&row.load_steps) {
            self.steps.take(Step { row, number, step })?;
        }
        Ok(())
    }

    /// Puts both tables in place, and what their columns hold.
    ///
    /// # Errors
    /// See [`Tables::begin`].
    pub fn end(self) -> Result<(), RunError> {
        // Nothing is in place before both are whole.
        let (members, steps) = (self.members.end()?, self.steps.end()?);
        members.end()?;
        steps.end()?;
        for (name, schema) in schemas(&self.added) {
            replace_file(&self.folder.join(name), schema.as_bytes())?;
        }
        Ok(())
    }
}
