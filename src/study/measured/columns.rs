//! The columns of measured.csv: one table from which the header is checked and the reference of columns is printed.

use std::sync::Arc;

use crate::study::fault::{Fault, Found, Source};
use crate::study::measured::cells::{Cell, Line};
use crate::study::schema::suggestion;

/// A column.
#[derive(Debug)]
pub struct Column {
    /// Its name in the header.
    pub name: &'static str,
    /// Whether the header must have it.
    pub required: bool,
    /// What is in its cells, in one line.
    pub doc: &'static str,
}

/// All columns.
pub const COLUMNS: &[Column] = &[
    required("specimen", "name of the specimen; rows of one name belong to one wall"),
    required("family", "the arm of study.toml that it is a specimen of, in lower or upper case"),
    required(
        "tilt_deg",
        "tilt of the platform at the reading, for a remainder that from which it has gone back (deg); empty where the quantity has none of its own",
    ),
    required("quantity", "what was measured"),
    required("value", "the value, or the bound of a censored reading"),
    required("unit", "unit of value, error, common_error and resolution"),
    required(
        "error",
        "random error of this value, one standard deviation; that of an average or a difference is smaller or larger than that of the readings in it",
    ),
    required("kind", "exact; below or above, where only a bound is known; rounded, to the resolution"),
    optional(
        "common_error",
        "error that all readings of one instrument share, one standard deviation: displacements, remainders and fixed targets have the same, differences of points, collapse angles and what is measured apart their own; empty for none; `unknown` where nobody knows how much of `error` it is",
    ),
    optional("resolution", "distance of neighbouring values of a rounded reading"),
    optional("order", "place of the specimen in the order of the tests, from 1"),
    optional(
        "stage",
        "place of the reading in the sequence on its specimen, from 0; a displacement read at 0 deg after an earlier stage is a remainder",
    ),
];

const fn required(name: &'static str, doc: &'static str) -> Column {
    Column { name, required: true, doc }
}

const fn optional(name: &'static str, doc: &'static str) -> Column {
    Column { name, required: false, doc }
}

/// Which column stands where.
pub struct Header {
    /// Index into [`COLUMNS`], cell by cell.
    columns: Vec<usize>,
}

impl Header {
    /// Number of cells of a row.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// The cell of a column; `None` when the file does not have the column.
    pub fn cell<'l>(&self, line: &'l Line, name: &str) -> Option<&'l Cell> {
        let at = self.columns.iter().position(|&column| COLUMNS[column].name == name)?;
        line.cells.get(at)
    }
}

/// Reads the header; `None` when rows cannot be read by it, and the faults then say why.
pub fn header(line: &Line, faults: &mut Vec<Fault>) -> Option<Header> {
    let before = faults.len();
    let names: Vec<&str> = COLUMNS.iter().map(|column| column.name).collect();
    let allowed = format!("each of the columns {} at most once", names.join(", "));
    let mut columns: Vec<usize> = Vec::new();
    for cell in &line.cells {
        let mut fault = |words: &str, fix: String| {
            let found = Found::Words(words.to_owned());
            faults.push(Fault::at(&cell.place, &cell.text, found, allowed.clone(), fix));
        };
        match names.iter().position(|name| *name == cell.text) {
            Some(column) if columns.contains(&column) => {
                fault("is a column twice", "remove one of them".to_owned())
            }
            Some(column) => columns.push(column),
            None if cell.text.contains([';', '\t']) => {
                fault("is not a known column", "separate the cells by commas".to_owned());
            }
            None if cell.text.is_empty() => {
                fault("a column without a name", "name it or remove it".to_owned())
            }
            None => {
                let longer = names.iter().find(|name| name.starts_with(&format!("{}_", cell.text)));
                let fix = longer.map_or_else(
                    || suggestion(&cell.text, &names),
                    |name| format!("did you mean \"{name}\"?"),
                );
                fault("is not a known column", fix);
            }
        }
    }
    for (index, column) in COLUMNS.iter().enumerate() {
        if column.required && !columns.contains(&index) {
            let fix = "add it to the header and to every row";
            faults.push(Fault::at(
                &line.place,
                column.name,
                Found::Missing,
                format!("a column: {}", column.doc),
                fix,
            ));
        }
    }
    (faults.len() == before).then_some(Header { columns })
}

/// The fault of a file of comments and blanks.
pub fn no_header(source: &Arc<Source>) -> Fault {
    let columns: Vec<&str> = COLUMNS.iter().filter(|c| c.required).map(|c| c.name).collect();
    let fix = format!("begin with {}", columns.join(","));
    Fault::of_file(&source.name, source.rank, "has no header", "a line with the names of the columns", fix)
}

/// The fault of a file that is a header alone.
pub fn no_rows(source: &Arc<Source>) -> Fault {
    let fix = "add a row, or take the file away if nothing was measured";
    Fault::of_file(&source.name, source.rank, "has no rows", "a header and at least one measurement", fix)
}
