//! Rows as tables: `members.parquet` and `steps.parquet`, the same as CSV, their schemas, and `timing.csv`. The bytes depend on the rows alone.

use polars::prelude::{DataFrame, NamedFrom, Series};
use polars_io::prelude::ParquetWriter;

use crate::ensemble::columns::{Column, Step, Value, of_members, of_steps};
use crate::ensemble::journal::Entry;
use crate::ensemble::schema::schema;
use crate::ensemble::{Row, RunError};

/// One row per member, in the order given; a value that a member does not have is null.
pub(crate) fn members(rows: &[Row]) -> Result<Vec<u8>, RunError> {
    let lines: Vec<&Row> = rows.iter().collect();
    let columns = of_members(rows).iter().map(|column| encoded(column, &lines)).collect();
    parquet("members.parquet", rows.len(), columns)
}

/// One row per load step of every member, in the order given.
pub(crate) fn steps(rows: &[Row]) -> Result<Vec<u8>, RunError> {
    let lines = steps_of(rows);
    let columns = of_steps(&lines).iter().map(|column| encoded(column, &lines)).collect();
    parquet("steps.parquet", lines.len(), columns)
}

/// `members.csv` and `steps.csv`: the same tables as text. What a member does not have is empty; numbers read back to the same bits.
pub fn tables_as_csv(rows: &[Row]) -> [(&'static str, String); 2] {
    let (lines, steps) = (rows.iter().collect::<Vec<_>>(), steps_of(rows));
    [("members.csv", csv(&of_members(rows), &lines)), ("steps.csv", csv(&of_steps(&steps), &steps))]
}

/// The schemas of the tables of a run with these rows, see [`schema`].
pub(crate) fn schemas(rows: &[Row]) -> [(&'static str, String); 2] {
    let steps = steps_of(rows);
    [
        ("members.schema.json", schema(&of_members(rows), &MEMBER)),
        ("steps.schema.json", schema(&of_steps(&steps), &STEP)),
    ]
}

/// What names a line of each table.
const MEMBER: [&str; 3] = ["arm", "point", "member"];
const STEP: [&str; 4] = ["arm", "point", "member", "load_step"];

fn steps_of(rows: &[Row]) -> Vec<Step<'_>> {
    let numbered = rows.iter().flat_map(|row| (0u64..).zip(&row.load_steps).map(move |of| (row, of)));
    numbered.map(|(row, (number, step))| Step { row, number, step }).collect()
}

fn encoded<T: Copy>(column: &Column<T>, lines: &[T]) -> polars::prelude::Column {
    let name = column.name.as_str().into();
    let lines = lines.iter().copied();
    polars::prelude::Column::from(match &column.value {
        Value::Text(of) => Series::new(name, lines.map(of).collect::<Vec<_>>()),
        Value::Count(of) => Series::new(name, lines.map(of).collect::<Vec<_>>()),
        Value::Real(of) => Series::new(name, lines.map(of).collect::<Vec<_>>()),
        Value::Drawn(of, key) => Series::new(name, lines.map(|line| of(line, key)).collect::<Vec<_>>()),
    })
}

fn csv<T: Copy>(columns: &[Column<T>], lines: &[T]) -> String {
    let cell = |column: &Column<T>, line: T| match &column.value {
        Value::Text(of) => of(line).map_or_else(String::new, |text| quoted(&text)),
        Value::Count(of) => of(line).to_string(),
        Value::Real(of) => of(line).map_or_else(String::new, |x| x.to_string()),
        Value::Drawn(of, key) => of(line, key).map_or_else(String::new, |x| x.to_string()),
    };
    let heads: Vec<String> = columns.iter().map(|column| quoted(&column.name)).collect();
    let mut text = heads.join(",") + "\n";
    for line in lines {
        let cells: Vec<String> = columns.iter().map(|column| cell(column, *line)).collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

/// Encodes sequentially, so that no thread count enters.
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

/// What each member took, on which machine: kept apart from the results, which must not depend on it.
pub(crate) fn timing(entries: &[Entry]) -> String {
    let mut text = String::from("arm,point,member,seconds,threads,host\n");
    for Entry { seconds, threads, host, row, .. } in entries {
        let line =
            format!("{},{},{},{seconds:.6},{threads},{host}\n", quoted(&row.arm), row.point, row.member);
        text.push_str(&line);
    }
    text
}

/// A CSV field: quoted when it holds what would end it.
fn quoted(field: &str) -> String {
    match field.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field.to_string(),
    }
}
