//! The verdict on a base model: `verdict.json`, the figures, the page that shows them, and what is printed.

mod components;
mod conclusion;
mod family;
mod family_plot;
mod fit;
mod fit_plot;
mod page;
mod painter;
mod parameter;
mod residual;
mod residual_plot;
mod scope;
mod signs;
mod sketch;
mod summary;
mod text;
mod words;

#[cfg(test)]
pub use conclusion::headline;
pub use family::FamilyFigure;
pub use fit::FitFigure;
#[cfg(test)]
pub use fit::Misfit;
pub use page::{DiagnosisPage, diagnosis_page};
#[cfg(test)]
pub use parameter::parameters;
#[cfg(test)]
pub use residual::{ExpectedEntry, GroupEntry};
pub use scope::{ScopeEntry, enumerated};
pub use summary::{DataEntry, DiagnosisSummary};
pub use text::diagnosis_text;
#[cfg(test)]
pub use words::lines;

use std::path::Path;

use anyhow::{Context, Result};

use crate::ensemble::replace_file;
use crate::render::document::{Captioned, Drawing};
use crate::verb::diagnose::answer::family_plot::FamilyPlot;
use crate::verb::diagnose::answer::fit_plot::FitPlot;
use crate::verb::diagnose::answer::residual_plot::ResidualPlot;
use crate::verb::run::answer::files::write_captioned;

/// File name, without ending, of the figure of all readings.
const RESIDUALS: &str = "residuals";

/// File name, without ending, of the figure of both models on the readings.
const FIT: &str = "best-fit";

/// The figures of a verdict, as a page shows them.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagnosisDrawings {
    /// The base model at its best fit beside the best cause; `None` where no reading has a place in it.
    pub fit: Option<Drawing>,
    /// One of each family, and that of all readings.
    pub others: Vec<Drawing>,
}

/// Writes `verdict.json`, the figure of both models on the readings, one per family and one of all readings (SVG and PNG) into an
/// existing folder. The same diagnosis gives the same bytes.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_diagnosis(
    summary: &DiagnosisSummary,
    families: &[FamilyFigure],
    fit: &FitFigure,
    dir: &Path,
) -> Result<DiagnosisDrawings> {
    let json = serde_json::to_string_pretty(summary).context("the verdict cannot be written as JSON")? + "\n";
    replace_file(&dir.join("verdict.json"), json.as_bytes())?;
    let mut others = Vec::new();
    for family in families {
        // No family's name has a dot.
        let own = [RESIDUALS, FIT].into_iter().find(|own| family.family == *own);
        let name = own.map_or_else(|| family.family.clone(), |own| format!("{own}.family"));
        let caption = format!(
            "Family {}: what was measured on what walls of the base model show. The bands end where half of them have fallen, the line \
             of a cause where half of its own have. Specimens read at one tilt stand side by side.",
            family.family
        );
        let title = format!("Family {}", family.family);
        let at = |scale| FamilyPlot::new(&summary.study, family, scale);
        others.push(written(dir, &Captioned::new(name, &title, caption, at))?);
    }
    let caption =
        "Every reading against what the base model shows of it, with joints anywhere in their priors.";
    let at = |scale| ResidualPlot::new(&summary.study, &summary.residuals, scale);
    others.push(written(dir, &Captioned::new(RESIDUALS, "All readings", caption, at))?);
    let at = |scale| FitPlot::new(&summary.study, fit, scale);
    let of_fit = || written(dir, &Captioned::new(FIT, "Both models on the readings", fit.caption(), at));
    let drawn = if fit.misfits().is_empty() { None } else { Some(of_fit()?) };
    Ok(DiagnosisDrawings { fit: drawn, others })
}

/// A figure for the page, once its files are written.
fn written(dir: &Path, figure: &Captioned<'_>) -> Result<Drawing> {
    write_captioned(dir, figure)?;
    figure.drawing()
}
