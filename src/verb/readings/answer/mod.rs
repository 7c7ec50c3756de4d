//! The readings of a study beside what was published: `readings.json`, `readings.csv`, the figure, and what is printed.

mod csv;
mod entry;
mod plot;
mod text;

use std::path::Path;

use anyhow::{Context, Result};

pub use entry::{Extent, ReadingEntry, ReadingsSummary};
pub use text::readings_text;

use crate::ensemble::replace_file;
use crate::render::draw::IMAGE_SCALE;
use crate::verb::readings::answer::plot::Grid;
use crate::verb::run::answer::files::write_figure;

/// File name, without ending, of what is written.
const READINGS: &str = "readings";

/// Writes the readings as JSON, CSV, SVG and PNG into an existing folder. The same readings give the same bytes.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_readings(summary: &ReadingsSummary, dir: &Path) -> Result<()> {
    let json =
        serde_json::to_string_pretty(summary).context("the readings cannot be written as JSON")? + "\n";
    replace_file(&dir.join(format!("{READINGS}.json")), json.as_bytes())?;
    replace_file(&dir.join(format!("{READINGS}.csv")), csv::csv(summary).as_bytes())?;
    let figure = |scale| Grid::new(summary, scale);
    write_figure(dir, READINGS, &figure(1), &figure(IMAGE_SCALE))
}
