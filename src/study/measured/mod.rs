//! measured.csv: what was measured in tests on specimens of the study's arms, every fault of the file at once.

mod cells;
mod columns;
mod measurement;
mod returned;
mod row;
mod together;
mod unit;

pub(super) use columns::COLUMNS;
pub use measurement::{MeasuredKind, MeasuredQuantity, Measurement};
pub use unit::Dimension;

use std::sync::Arc;

use crate::study::fault::{Fault, Source};

/// Name of the file, beside study.toml.
pub const FILE: &str = "measured.csv";
/// What it is meant to be.
pub(super) const FORMAT: &str = "a text file of values separated by commas";

/// Reads all measurements of a file; `arms` is `None` when the study's arms are faulty themselves.
///
/// # Errors
/// All faults of the file: of its cells, its header, its rows, and of rows against one another.
pub(super) fn read(source: &Arc<Source>, arms: Option<&[String]>) -> Result<Vec<Measurement>, Vec<Fault>> {
    let mut faults = Vec::new();
    let lines = cells::lines(source, &mut faults);
    let Some((header, rows)) = lines.split_first() else {
        faults.push(columns::no_header(source));
        return Err(faults);
    };
    let header = columns::header(header, &mut faults);
    if rows.is_empty() {
        faults.push(columns::no_rows(source));
    }
    let Some(header) = header else { return Err(faults) };
    let read: Vec<_> = rows.iter().filter_map(|cells| row::read(&header, cells, arms, &mut faults)).collect();
    together::check(&read, &mut faults);
    if faults.is_empty() {
        let mut rows: Vec<Measurement> = read.into_iter().map(|(measurement, _)| measurement).collect();
        returned::name_remainders(&mut rows);
        Ok(rows)
    } else {
        Err(faults)
    }
}
