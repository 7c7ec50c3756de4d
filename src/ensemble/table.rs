//! Rows as tables: `members.parquet` and `steps.parquet`, the same as CSV, their schemas, and `timing.csv`. The bytes depend on the rows alone.

mod sheet;
mod tables;

use polars::prelude::DataFrame;
use polars_io::prelude::ParquetWriter;

use crate::ensemble::columns::{Column, Step, Table, of_members, of_steps};
use crate::ensemble::field::Cell;
use crate::ensemble::journal::{Entry, Place, Timing};
use crate::ensemble::schema::schema;
use crate::ensemble::{AddedColumns, Row, RunError};

pub use tables::Tables;

/// `members.csv` and `steps.csv`: the tables as text. What a member does not have is empty; numbers read back to the same bits.
pub fn tables_as_csv(rows: &[Row]) -> [(&'static str, String); 2] {
    let added = AddedColumns::of(rows);
    [
        ("members.csv", csv(&of_members(&added), rows.iter())),
        ("steps.csv", csv(&of_steps(&added), steps_of(rows))),
    ]
}

/// The schemas of the tables with these columns, see [`schema`].
fn schemas(added: &AddedColumns) -> [(&'static str, String); 2] {
    [
        ("members.schema.json", schema(&of_members(added), &MEMBER)),
        ("steps.schema.json", schema(&of_steps(added), &STEP)),
    ]
}

/// What names a line of each table.
const MEMBER: [&str; 3] = ["arm", "point", "member"];
const STEP: [&str; 4] = ["arm", "point", "member", "load_step"];

fn steps_of(rows: &[Row]) -> impl Iterator<Item = Step<'_>> {
    let numbered = rows.iter().flat_map(|row| (0u64..).zip(&row.load_steps).map(move |of| (row, of)));
    numbered.map(|(row, (number, step))| Step { row, number, step })
}

fn csv<'r, T: Table>(columns: &[Column<T>], lines: impl Iterator<Item = T::Line<'r>>) -> String {
    let cell = |column: &Column<T>, line: T::Line<'r>| match (column.cell)(line) {
        Cell::Text(text) => text.map_or_else(String::new, |text| quoted(&text)),
        Cell::Count(n) => n.to_string(),
        Cell::Real(x) => x.map_or_else(String::new, |x| x.to_string()),
    };
    let heads: Vec<String> = columns.iter().map(|column| quoted(&column.name)).collect();
    let mut text = heads.join(",") + "\n";
    for line in lines {
        let cells: Vec<String> = columns.iter().map(|column| cell(column, line)).collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

/// A table in Parquet. Encodes sequentially, so that no thread count enters.
pub(crate) fn parquet(
    table: &'static str,
    height: usize,
    columns: Vec<polars::prelude::Column>,
) -> Result<Vec<u8>, RunError> {
    let mut bytes = Vec::new();
    DataFrame::new(height, columns)
        .and_then(|mut frame| ParquetWriter::new(&mut bytes).set_parallel(false).finish(&mut frame))
        .map_err(|error| RunError::Table { table, reason: error.to_string() })?;
    Ok(bytes)
}

/// Name of the file of what each member took.
pub(crate) const TIMING: &str = "timing.csv";
/// Heads of its columns.
pub(crate) const TIMING_HEADS: &str = "arm,point,member,seconds,threads,host,processor\n";

/// What each member took, on which machine: kept apart from the results, which must not depend on it. Without the heads.
pub(crate) fn timing<'e>(entries: impl Iterator<Item = &'e Entry>) -> String {
    let line = |entry: &Entry| {
        let (row, Timing { seconds, place }) = (&entry.row, entry.timing.as_ref()?);
        let Place { threads, host, processor } = place;
        let [arm, host, processor] = [&row.arm, host, processor].map(|text| quoted(text));
        Some(format!("{arm},{},{},{seconds:.6},{threads},{host},{processor}\n", row.point, row.member))
    };
    entries.filter_map(line).collect()
}

/// A CSV field: quoted when it holds what would end it.
fn quoted(field: &str) -> String {
    match field.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field.to_string(),
    }
}
