//! A bank that has been computed, as a table: `bank.parquet`, a row per wall, with the hash of the design it was made for.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Cursor;

use polars::prelude::{Column, DataFrame, NamedFrom, PolarsError, Series};
use polars_io::prelude::{ParquetReader, SerReader};

use crate::critic::simulate::bank::path::{NUMBERS, Path};
use crate::critic::simulate::bank::plan::{BASE, Plan};
use crate::critic::simulate::bank::test::Test;
use crate::ensemble::{Row, RunError, parquet};

/// Name of the file.
pub const BANK: &str = "bank.parquet";

/// The walls of a [`Plan`], in its order.
#[derive(Clone, Debug, PartialEq)]
pub struct Bank {
    /// Each wall's path; `None` for one that has none, see `Test::path`.
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
    #[error("it was made for another design: {differs} (hash {found}, here {wanted})")]
    Design {
        /// What differs, in words.
        differs: String,
        /// Hash of what it was made for.
        found: String,
        /// Hash of the plan.
        wanted: String,
    },
}

/// What a table has walls of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Held {
    /// Names of the families, each once.
    pub families: BTreeSet<String>,
    /// Points in the priors for each mechanism.
    pub points: u64,
}

impl Held {
    /// From the names of walls; `None` where they are none that a plan gives.
    fn of(walls: &[String]) -> Option<Held> {
        let (mut families, mut points) = (BTreeSet::new(), 0);
        for wall in walls {
            let [family, _, point] = wall.split('/').collect::<Vec<_>>().try_into().ok()?;
            families.insert(family.to_owned());
            points = points.max(point.parse::<u64>().ok()? + 1);
        }
        Some(Held { families, points: points / BASE })
    }

    /// What makes it another one than is wanted, in words.
    fn differs(&self, wanted: &Held) -> String {
        let listed = |held: &Held| held.families.iter().cloned().collect::<Vec<_>>().join(", ");
        if self.families != wanted.families {
            return format!("its walls are of {}, wanted are those of {}", listed(self), listed(wanted));
        }
        if self.points != wanted.points {
            return format!("it has {} points, wanted are {}: see --points", self.points, wanted.points);
        }
        "study, priors or version have changed".to_owned()
    }
}

impl Bank {
    /// From the rows of a plan, one per wall in its order.
    pub fn of(plan: &Plan, rows: &[Row]) -> Bank {
        let test = Test::of(&plan.study);
        Bank {
            paths: rows.iter().map(|row| test.path(&plan.study, row)).collect(),
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
        for (number, name) in Test::of(&plan.study).names(&plan.study).into_iter().enumerate() {
            let values: Vec<Option<f64>> =
                self.paths.iter().map(|path| path.as_ref().map(|path| path.numbers[number])).collect();
            columns.push(Column::from(Series::new(name.into(), values)));
        }
        parquet(BANK, n, columns)
    }

    /// What a table has walls of, whatever plan it was made for.
    ///
    /// # Errors
    /// See [`NotThisBank`].
    pub fn held(bytes: &[u8]) -> Result<Held, NotThisBank> {
        let frame = ParquetReader::new(Cursor::new(bytes)).finish()?;
        let lacking = || NotThisBank::Column("wall".to_owned());
        Held::of(&texts(&frame, "wall").ok_or_else(lacking)?).ok_or_else(lacking)
    }

    /// The walls of a plan of fewer families among those of this one's plan; `None` where it has not all of them.
    pub fn part(&self, own: &Plan, plan: &Plan) -> Option<Bank> {
        let walls = own.study.arms.iter().enumerate().map(|(wall, arm)| (arm.name.as_str(), wall));
        let places: BTreeMap<&str, usize> = walls.collect();
        let at = plan.study.arms.iter().map(|arm| places.get(arm.name.as_str()).copied());
        let at = at.collect::<Option<Vec<usize>>>()?;
        Some(Bank {
            paths: at.iter().map(|&wall| self.paths[wall].clone()).collect(),
            endings: at.iter().map(|&wall| self.endings[wall].clone()).collect(),
        })
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
            let own: Vec<String> = plan.study.arms.iter().map(|arm| arm.name.clone()).collect();
            let differs = match (Held::of(&text("wall")?), Held::of(&own)) {
                (Some(held), Some(own)) => held.differs(&own),
                _ => "its walls have other names".to_owned(),
            };
            return Err(NotThisBank::Design { differs, found, wanted });
        }
        let names = Test::of(&plan.study).names(&plan.study);
        let numbers = names
            .iter()
            .map(|name| {
                let column = frame.column(name).and_then(|column| column.f64().cloned());
                column.map(|values| values.iter().collect()).map_err(|_| NotThisBank::Column(name.clone()))
            })
            .collect::<Result<Vec<Vec<Option<f64>>>, NotThisBank>>()?;
        let path = |wall: usize| {
            let own: Vec<f64> = numbers.iter().map(|column| column[wall]).collect::<Option<_>>()?;
            let mut numbers = [0.0; NUMBERS];
            numbers[..own.len()].copy_from_slice(&own);
            Some(Path { numbers })
        };
        Ok(Bank { paths: (0..designs.len()).map(path).collect(), endings: text("outcome")? })
    }
}

fn texts(frame: &DataFrame, name: &str) -> Option<Vec<String>> {
    let values = frame.column(name).ok()?.str().ok()?;
    values.iter().map(|value| value.map(str::to_string)).collect()
}
