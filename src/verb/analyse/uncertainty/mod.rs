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
use crate::render::document::Drawing;
use crate::render::draw::svg;
use crate::verb::analyse::uncertainty::plot::PointsPlot;
use crate::verb::run::answer::files::write_figure;

/// File name, without ending, of what is written.
const UNCERTAINTY: &str = "uncertainty";

/// The figure for a page.
pub(crate) fn uncertainty_figure(summary: &UncertaintySummary) -> Drawing {
    let drawn = svg(&PointsPlot::new(summary, 1)).unwrap_or_default();
    let caption = "Each point is the wall with other values within the ranges; the band holds one more wall with a probability of 90 %, and the line \
                   is the answer with all parameters at their middle.";
    Drawing::picture("figure-uncertainty", "How sure the answer is", caption, &drawn)
}

/// Writes every evaluation as CSV, and the figure as SVG and PNG, into an existing folder. The same answer gives the same bytes.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_uncertainty(summary: &UncertaintySummary, dir: &Path) -> Result<()> {
    replace_file(&dir.join(format!("{UNCERTAINTY}.csv")), &csv::csv(summary))?;
    write_figure(dir, UNCERTAINTY, |scale| PointsPlot::new(summary, scale))
}
