//! A bank that has been computed, as a table: `bank.parquet`, a row per wall, with the hash of the design it was made for.

use std::io::Cursor;

use polars::prelude::{Column, DataFrame, NamedFrom, PolarsError, Series};
use polars_io::prelude::{ParquetReader, SerReader};

use crate::critic::bank::path::{KINDS, NUMBERS, PLACES, Path};
use crate::critic::bank::plan::Plan;
use crate::ensemble::{Row, RunError, parquet};

/// Name of the file.
pub const BANK: &str = "bank.parquet";

/// The walls of a [`Plan`], in its order.
#[derive(Clone, Debug, PartialEq)]
pub struct Bank {
    /// Each wall's path; `None` for one that has none, see [`Path::of`].
    pub paths: Vec<Option<Path>>,
    /// How each wall ended.
    pub endings: Vec<String>,
}

/// Why a file is not the bank of a plan.
#[derive(Debug, thiserror::Error)]
pub enum NotThisBank {
    /// It is no such table.
    #[error("it is no bank: {0}")]
    Table(#[from] PolarsError),
    /// It has other columns.
    #[error("it is no bank: its column {0} is missing or of another kind")]
    Column(String),
    /// It was made for something else.
    #[error(
        "it was made for another design: study, priors, number of points or version have changed (hash {found}, here {wanted})"
    )]
    Design {
        /// Hash of what it was made for.
        found: String,
        /// Hash of the plan.
        wanted: String,
    },
}

impl Bank {
    /// From the rows of a plan, one per wall in its order.
    pub fn of(rows: &[Row]) -> Bank {
        Bank {
            paths: rows.iter().map(Path::of).collect(),
            endings: rows.iter().map(|row| row.outcome.name().to_string()).collect(),
        }
    }

    /// The table; the bytes depend on the walls and the plan alone.
    ///
    /// # Errors
    /// [`RunError::Table`].
    pub fn table(&self, plan: &Plan) -> Result<Vec<u8>, RunError> {
        let n = self.paths.len();
        let arms: Vec<&str> = plan.study.arms.iter().map(|arm| arm.name.as_str()).collect();
        let mut columns = vec![
            Column::from(Series::new("design".into(), vec![plan.study.hash.as_str(); n])),
            Column::from(Series::new("wall".into(), arms)),
            Column::from(Series::new("outcome".into(), &self.endings)),
        ];
        for number in 0..NUMBERS {
            let values: Vec<Option<f64>> =
                self.paths.iter().map(|path| path.as_ref().map(|path| path.numbers[number])).collect();
            columns.push(Column::from(Series::new(name(number).into(), values)));
        }
        parquet(BANK, n, columns)
    }

    /// Reads the table of a plan.
    ///
    /// # Errors
    /// See [`NotThisBank`].
    pub fn read(bytes: &[u8], plan: &Plan) -> Result<Bank, NotThisBank> {
        let frame = ParquetReader::new(Cursor::new(bytes)).finish()?;
        let text = |name: &str| texts(&frame, name).ok_or_else(|| NotThisBank::Column(name.to_string()));
        let wanted = plan.study.hash.clone();
        let designs = text("design")?;
        let found = designs.first().cloned().unwrap_or_default();
        if designs.len() != plan.places.len() || designs.iter().any(|design| *design != wanted) {
            return Err(NotThisBank::Design { found, wanted });
        }
        let numbers = (0..NUMBERS)
            .map(|number| {
                let column = frame.column(&name(number)).and_then(|column| column.f64().cloned());
                column.map(|values| values.iter().collect()).map_err(|_| NotThisBank::Column(name(number)))
            })
            .collect::<Result<Vec<Vec<Option<f64>>>, NotThisBank>>()?;
        let path = |wall: usize| {
            let own: Option<Vec<f64>> = numbers.iter().map(|column| column[wall]).collect();
            own?.try_into().ok().map(|numbers| Path { numbers })
        };
        Ok(Bank { paths: (0..designs.len()).map(path).collect(), endings: text("outcome")? })
    }
}

fn texts(frame: &DataFrame, name: &str) -> Option<Vec<String>> {
    let values = frame.column(name).ok()?.str().ok()?;
    values.iter().map(|value| value.map(str::to_string)).collect()
}

/// Name of a number's column.
fn name(number: usize) -> String {
    match number.checked_sub(1) {
        None => "ln_collapse_rad".to_string(),
        Some(k) => format!("{}_{}", KINDS[k / PLACES.len()], k % PLACES.len()),
    }
}
