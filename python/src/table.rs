//! Tables that other libraries take without a copy, by the Arrow C stream
//! (<https://arrow.apache.org/docs/format/CDataInterface/PyCapsuleInterface.html>).

use std::fs::File;
use std::path::PathBuf;

use polars::prelude::{CompatLevel, DataFrame};
use polars_arrow::array::{Array, StructArray};
use polars_arrow::datatypes::{ArrowDataType, Field};
use polars_arrow::ffi::{ArrowArrayStream, export_iterator};
use polars_io::SerReader;
use polars_io::prelude::ParquetReader;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyCapsule, PyDict, PyTuple};

/// Reads a Parquet file: the names of its columns, the number of its rows, and a function that gives a capsule with an Arrow C stream
/// of it each time that it is called.
pub fn read(py: Python<'_>, path: PathBuf) -> PyResult<Py<PyAny>> {
    let frame = py.detach(|| frame(&path))?;
    let names: Vec<String> = frame.get_column_names().iter().map(ToString::to_string).collect();
    let rows = frame.height();
    let give = move |arguments: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| {
        PyCapsule::new_with_value(arguments.py(), stream(&frame), c"arrow_array_stream")?
            .into_py_any(arguments.py())
    };
    (names, rows, PyCFunction::new_closure(py, Some(c"stream"), None, give)?).into_py_any(py)
}

fn frame(path: &PathBuf) -> PyResult<DataFrame> {
    let file = File::open(path)
        .map_err(|error| PyOSError::new_err(format!("cannot read {}: {error}", path.display())))?;
    let mut frame = ParquetReader::new(file)
        .finish()
        .map_err(|error| PyValueError::new_err(format!("{} is no table: {error}", path.display())))?;
    frame.rechunk_mut();
    Ok(frame)
}

/// The table as a stream of one batch, in text that every reader knows.
fn stream(frame: &DataFrame) -> ArrowArrayStream {
    let level = CompatLevel::oldest();
    let columns = || frame.columns().iter().map(|column| column.as_materialized_series());
    let fields: Vec<Field> = columns().map(|series| series.field().to_arrow(level)).collect();
    let arrays: Vec<Box<dyn Array>> = columns().map(|series| series.to_arrow(0, level)).collect();
    let kind = ArrowDataType::Struct(fields);
    let batch = StructArray::new(kind.clone(), frame.height(), arrays, None).boxed();
    export_iterator(Box::new(std::iter::once(Ok(batch))), Field::new("".into(), kind, false))
}
