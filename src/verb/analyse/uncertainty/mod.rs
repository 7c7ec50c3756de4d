//! How sure the answer about one wall is: `uncertainty.csv`, the figure, and what is printed.

mod csv;
mod entry;
mod plot;
mod text;

use std::path::Path;

use anyhow::Result;

pub use entry::{Answered, Asked as AskedOfWall, Ended, UncertaintySummary};
pub use text::uncertainty_text;

use crate::ensemble::replace_file;
use crate::verb::analyse::uncertainty::plot::PointsPlot;
use crate::verb::run::answer::files::write_figure;

/// File name, without ending, of what is written.
const UNCERTAINTY: &str = "uncertainty";

/// Writes every evaluation as CSV, and the figure as SVG and PNG, into an existing folder. The same answer gives the same bytes.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_uncertainty(summary: &UncertaintySummary, dir: &Path) -> Result<()> {
    replace_file(&dir.join(format!("{UNCERTAINTY}.csv")), &csv::csv(summary))?;
    write_figure(dir, UNCERTAINTY, |scale| PointsPlot::new(summary, scale))
}
