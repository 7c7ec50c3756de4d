//! The sensitivity map: `sensitivity.json`, `sensitivity.csv`, the heat map, and what is printed.

mod csv;
mod entry;
mod plot;
mod text;

use std::path::Path;

use anyhow::{Context, Result};

pub use entry::SensitivitySummary;
pub use text::sensitivity_text;

use crate::ensemble::replace_file;
use crate::render::draw::IMAGE_SCALE;
use crate::verb::run::answer::files::write_figure;
use crate::verb::sensitivity::answer::plot::HeatMap;

/// File name, without ending, of the map's files.
const SENSITIVITY: &str = "sensitivity";

/// Writes the map as JSON, CSV, SVG and PNG into an existing folder. The same map gives the same bytes.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_sensitivity(summary: &SensitivitySummary, dir: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(summary).context("the map cannot be written as JSON")? + "\n";
    replace_file(&dir.join(format!("{SENSITIVITY}.json")), json.as_bytes())?;
    replace_file(&dir.join(format!("{SENSITIVITY}.csv")), csv::csv(summary).as_bytes())?;
    let figure = |scale| HeatMap::new(summary, scale);
    write_figure(dir, SENSITIVITY, &figure(1), &figure(IMAGE_SCALE))
}
