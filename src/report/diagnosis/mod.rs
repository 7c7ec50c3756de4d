//! The verdict on a base model: `verdict.json`, the figures, the page that shows them, and what is printed.

mod components;
mod conclusion;
mod family;
mod family_plot;
mod page;
mod residual;
mod residual_plot;
mod signs;
mod summary;
mod text;
mod words;

pub use family::FamilyFigure;
#[cfg(test)]
pub use residual::{ExpectedEntry, GroupEntry};
pub use summary::{DataEntry, DiagnosisSummary};
pub use text::diagnosis_text;
#[cfg(test)]
pub use words::lines;

use std::path::Path;

use anyhow::{Context, Result};

use crate::ensemble::replace_file;
use crate::report::diagnosis::family_plot::FamilyPlot;
use crate::report::diagnosis::page::page;
use crate::report::diagnosis::residual_plot::ResidualPlot;
use crate::report::draw::{IMAGE_SCALE, svg};
use crate::report::files::write_figure;
use crate::report::page::Drawing;

/// File name, without ending, of the figure of all readings.
const RESIDUALS: &str = "residuals";

/// Writes `verdict.json`, a figure per family and one of all readings (SVG and PNG), and `verdict.html` with all of it into an
/// existing folder. The same diagnosis gives the same bytes.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_diagnosis(summary: &DiagnosisSummary, families: &[FamilyFigure], dir: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(summary).context("the verdict cannot be written as JSON")? + "\n";
    replace_file(&dir.join("verdict.json"), json.as_bytes())?;
    let mut drawings = Vec::new();
    for family in families {
        let figure = |scale| FamilyPlot::new(&summary.study, family, scale);
        // No family's name has a dot.
        let name = if family.family == RESIDUALS { "residuals.family" } else { &family.family };
        write_figure(dir, name, &figure(1), &figure(IMAGE_SCALE))?;
        let caption = format!(
            "Family {}: what was measured on what walls of the base model show. The bands end where half of them have fallen, the line \
             of a cause where half of its own have. Specimens read at one tilt stand side by side.",
            family.family
        );
        let title = format!("Family {}", family.family);
        drawings.push(Drawing::picture(&format!("figure-{name}"), &title, &caption, &svg(&figure(1))?));
    }
    let figure = |scale| ResidualPlot::new(&summary.study, &summary.residuals, scale);
    write_figure(dir, RESIDUALS, &figure(1), &figure(IMAGE_SCALE))?;
    let caption =
        "Every reading against what the base model shows of it, with joints anywhere in their priors.";
    drawings.push(Drawing::picture("figure-residuals", "All readings", caption, &svg(&figure(1))?));
    Ok(replace_file(&dir.join("verdict.html"), page(summary, &drawings).as_bytes())?)
}
