//! Where the scatter of walls comes from: `influence.json`, `influence.csv`, the figure, the table of all evaluations, and what is
//! printed.

mod csv;
mod entry;
mod page;
mod plot;
mod text;

use std::path::Path;

use anyhow::{Context, Result};

pub use entry::{InfluenceSummary, ShareEntry, running};
pub use page::influence_page;
pub use text::{influence_text, influence_warnings};

use crate::ensemble::replace_file;
use crate::render::draw::IMAGE_SCALE;
use crate::verb::influence::answer::plot::SharesPlot;
use crate::verb::run::answer::files::write_figure;

/// File name, without ending, of what is written.
const INFLUENCE: &str = "influence";

/// Writes the answer as JSON, CSV, SVG and PNG into an existing folder, and the table of the evaluations. The same answer gives the
/// same bytes.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_influence(summary: &InfluenceSummary, evaluations: &[u8], dir: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(summary).context("the answer cannot be written as JSON")? + "\n";
    replace_file(&dir.join(format!("{INFLUENCE}.json")), json.as_bytes())?;
    replace_file(&dir.join(format!("{INFLUENCE}.csv")), csv::csv(summary).as_bytes())?;
    replace_file(&dir.join(format!("{INFLUENCE}.parquet")), evaluations)?;
    let figure = |scale| SharesPlot::new(summary, scale);
    write_figure(dir, INFLUENCE, &figure(1), &figure(IMAGE_SCALE))
}
