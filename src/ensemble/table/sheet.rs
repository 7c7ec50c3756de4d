//! One Parquet table written line by line, in little memory.

use std::io::Write;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use polars::prelude::{
    ChunkedBuilder, Column as Encoded, DataFrame, DataType, Field, Float64Type, IntoColumn, PolarsError,
    PrimitiveChunkedBuilder, Schema, StringChunkedBuilder, UInt64Type,
};
use polars_io::parquet::write::BatchedWriter;
use polars_io::prelude::ParquetWriter;

use crate::ensemble::RunError;
use crate::ensemble::columns::{Column, Table};
use crate::ensemble::field::{Cell, Kind};
use crate::ensemble::files::Replacement;

/// A table that is being written: its lines are kept until they fill a row group. All groups but the last are as large as the table says,
/// so that its bytes follow from its lines alone.
pub(super) struct Sheet<T: Table> {
    name: &'static str,
    columns: Vec<Column<T>>,
    /// Lines that are not encoded yet, column by column.
    kept: Vec<Filled>,
    lines: usize,
    encoder: BatchedWriter<Bytes>,
    /// What is encoded and not written yet.
    encoded: Bytes,
    file: Replacement,
}

impl<T: Table> Sheet<T> {
    /// Begins a table of this name in a folder.
    pub fn begin(folder: &Path, name: &'static str, columns: Vec<Column<T>>) -> Result<Sheet<T>, RunError> {
        let encoded = Bytes::default();
        let schema: Schema =
            columns.iter().map(|column| Field::new(column.name.as_str().into(), kind(column.kind))).collect();
        // One thread, so that no count of threads enters the bytes.
        let encoder = ParquetWriter::new(encoded.clone())
            .set_parallel(false)
            .batched(&schema)
            .map_err(|error| fault(name, error))?;
        let file = Replacement::begin(&folder.join(name))?;
        Ok(Sheet { name, kept: empty(&columns), columns, lines: 0, encoder, encoded, file })
    }

    /// Takes the next line.
    pub fn take(&mut self, line: T::Line<'_>) -> Result<(), RunError> {
        for (column, kept) in self.columns.iter().zip(&mut self.kept) {
            kept.take((column.cell)(line));
        }
        self.lines += 1;
        if self.lines == T::GROUP { self.write_group() } else { Ok(()) }
    }

    /// Writes the last lines and the footer: the whole table, not yet in its place.
    pub fn end(mut self) -> Result<Replacement, RunError> {
        if self.lines > 0 {
            self.write_group()?;
        }
        self.encoder.finish().map_err(|error| fault(self.name, error))?;
        self.file.write(&self.encoded.held())?;
        Ok(self.file)
    }

    fn write_group(&mut self) -> Result<(), RunError> {
        let kept = std::mem::replace(&mut self.kept, empty(&self.columns));
        let group = DataFrame::new(self.lines, kept.into_iter().map(Filled::end).collect());
        group.and_then(|group| self.encoder.write_batch(&group)).map_err(|error| fault(self.name, error))?;
        self.lines = 0;
        let mut encoded = self.encoded.held();
        self.file.write(&encoded)?;
        encoded.clear();
        Ok(())
    }
}

fn fault(table: &'static str, error: PolarsError) -> RunError {
    RunError::Table { table, reason: error.to_string() }
}

/// The values of a column that are not encoded yet.
enum Filled {
    Text(StringChunkedBuilder),
    Count(PrimitiveChunkedBuilder<UInt64Type>),
    Real(PrimitiveChunkedBuilder<Float64Type>),
}

impl Filled {
    fn take(&mut self, cell: Cell) {
        match (self, cell) {
            (Filled::Text(kept), Cell::Text(text)) => kept.append_option(text),
            (Filled::Count(kept), Cell::Count(n)) => kept.append_value(n),
            (Filled::Real(kept), Cell::Real(x)) => kept.append_option(x),
            _ => unreachable!("`empty` makes one of the kind of each column"),
        }
    }

    fn end(self) -> Encoded {
        match self {
            Filled::Text(kept) => kept.finish().into_column(),
            Filled::Count(kept) => kept.finish().into_column(),
            Filled::Real(kept) => kept.finish().into_column(),
        }
    }
}

/// Columns without a line.
fn empty<T: Table>(columns: &[Column<T>]) -> Vec<Filled> {
    let empty = |column: &Column<T>| {
        let name = column.name.as_str().into();
        match column.kind {
            Kind::Text => Filled::Text(StringChunkedBuilder::new(name, 0)),
            Kind::Count => Filled::Count(PrimitiveChunkedBuilder::new(name, 0)),
            Kind::Real => Filled::Real(PrimitiveChunkedBuilder::new(name, 0)),
        }
    };
    columns.iter().map(empty).collect()
}

/// The type of a column's values in Parquet.
fn kind(kind: Kind) -> DataType {
    match kind {
        Kind::Text => DataType::String,
        Kind::Count => DataType::UInt64,
        Kind::Real => DataType::Float64,
    }
}

/// Bytes that the encoder writes to, and from which the file is written: its faults are then told from those of the encoder.
#[derive(Clone, Default)]
struct Bytes(Arc<Mutex<Vec<u8>>>);

impl Bytes {
    fn held(&self) -> MutexGuard<'_, Vec<u8>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Write for Bytes {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.held().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
