//! The columns of a long table, a row per value: one table from which the header is checked and the reference of columns is printed.

use std::sync::Arc;

use crate::study::fault::{Fault, Source};

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
    required(
        "value",
        "the value, or the bound of a censored reading; of an outcome `fell` or `stood`, its unit, error and kind left empty",
    ),
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
    optional(
        "drift_percent",
        "drift at the reading, displacement over the height of the push (%); of a force_at_drift alone, which needs it",
    ),
    optional(
        "record",
        "name of the record that moved the base, with or without its folder and its end; of an outcome, a peak_displacement or a residual_displacement, which need it",
    ),
    optional("scale", "factor on that record; empty for 1, as it was recorded"),
    optional("resolution", "distance of neighbouring values of a rounded reading"),
    optional("order", "place of the specimen in the order of the tests, from 1"),
    optional(
        "stage",
        "place of the reading in the sequence on its specimen, from 0; a displacement read at 0 deg after an earlier stage is a remainder",
    ),
];

/// How a table may be written, for the reference of columns.
pub const FORMS: &str = "\
As spreadsheets write it: cells separated by commas, semicolons or tabs (the header tells which; a first line `sep=;` may); decimals
with a point, or with a comma where commas do not separate, the same in the whole file; any line ends; a byte order mark. Lines that
begin with `#` and rows of nothing but separators are read over. So are rows without a value: a warning names them, unless the
specimen had fallen at a smaller tilt. Names of columns may be in capitals, and have their unit in brackets: `Left (mm)`.

A wide table has a row per specimen and tilt and a column per quantity, in the place of quantity and value:

| column of a wide table | in its cells |
|---|---|
| `specimen`, `family`, `tilt_deg`, `order`, `stage` | as above |
| `left`, `centre`, `right`, `mean`, `centre_minus_ends` | a displacement; `displacement_left` and so on are the same |
| `collapse_angle_deg` | the collapse angle, in any one row of its specimen or the same in all; its own `collapse_angle_error` (deg) is needed |
| `outcome`, with `record` and `scale` beside it | `fell` or `stood`; a row per shaking of a specimen, numbered in the column `stage` |
| any other quantity, with its unit behind it: `joint_phi_deg`, `remainder_mean_mm` | its value |
| `unit` | unit of the lengths whose columns have none in their name; `left_mm` needs none |
| `error`, `common_error`, `resolution`, `kind` | said of all lengths; `error_mm` where these are `left_mm` |
| `mean_error`, `collapse_angle_kind` and so on | said of one quantity: a mean has another error than a point |

An empty cell is no reading. Without a kind a reading is exact, or rounded where a resolution is given; `<5` is below, `>30` above.";

const fn required(name: &'static str, doc: &'static str) -> Column {
    Column { name, required: true, doc }
}

const fn optional(name: &'static str, doc: &'static str) -> Column {
    Column { name, required: false, doc }
}

/// The column of a long table of that name.
pub fn named(name: &str) -> Option<&'static Column> {
    COLUMNS.iter().find(|column| column.name == name)
}

/// The fault of a file of comments and blanks.
pub fn no_header(source: &Arc<Source>) -> Fault {
    let columns: Vec<&str> = COLUMNS.iter().filter(|c| c.required).map(|c| c.name).collect();
    let fix = format!("begin with {}", columns.join(","));
    Fault::of_file(&source.name, source.rank, "has no header", "a line with the names of the columns", fix)
}

/// The fault of a file without a value: a header alone, or a template that nobody filled in.
pub fn no_rows(source: &Arc<Source>) -> Fault {
    let fix = "fill in a row, or take the file away if nothing was measured";
    Fault::of_file(
        &source.name,
        source.rank,
        "has no rows with a value",
        "a header and at least one measurement",
        fix,
    )
}
