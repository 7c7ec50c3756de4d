//! The files of a report, each written whole or not at all.

use std::path::Path;

use anyhow::{Context, Result};

use crate::ensemble::{Row, remove_file, replace_file};
use crate::render::document::{Captioned, Document};
use crate::render::draw::Figure;
use crate::study::Study;
use crate::verb::run::answer::beside::Earlier;
use crate::verb::run::answer::csv::{csv, fragility_csv};
use crate::verb::run::answer::drift::{drift_csv, drift_curves};
use crate::verb::run::answer::figure::{curves, ladders, title};
use crate::verb::run::answer::figures::{figures, force_figure};
use crate::verb::run::answer::force_drift::{force_curves, force_drift_csv};
use crate::verb::run::answer::gathered::{Gathered, populations};
use crate::verb::run::answer::measured::{calibration_csv, comparison_csv};
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::shaken::write_shaken;
use crate::verb::run::answer::summary::{Summary, summary_of};
use crate::verb::run::answer::sweep::{SWEEP, sweep_csv};

/// File name of the summary.
pub const SUMMARY_JSON: &str = "summary.json";
/// File name, without ending, of the fragility curves and the figure of them.
pub const FRAGILITY: &str = "fragility";
/// File name, without ending, of the drift against the walls' length.
const DRIFT: &str = "drift";
/// File name, without ending, of the comparison with what was measured.
const COMPARISON: &str = "comparison";
/// File name, without ending, of the calibration's curves and the figure of them.
pub const CALIBRATION: &str = "calibration";

/// Sums up the rows and writes `summary.json` and the figures (SVG, PNG, CSV) into an existing folder: the quantity
/// over kn, with the means of an earlier run if one is given, and for a capacity its fragility curves; and where something
/// was measured the comparison with it and the calibration of kn; and of walls that are sheared the push over the drift.
///
/// The same study and rows give the same bytes. Each file is written under a temporary name and renamed, so that a
/// reader never sees half of one.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_all(study: &Study, rows: &[Row], dir: &Path, beside: Option<&Earlier>) -> Result<Summary> {
    write_results(study, populations(study, rows), rows, (dir, beside))
}

/// The same from rows that were gathered one by one; the study is the one that they were gathered for, with the number of walls that each
/// arm came to.
///
/// # Errors
/// As of [`write_all`].
pub fn write_gathered(
    study: &Study,
    gathered: Gathered,
    dir: &Path,
    beside: Option<&Earlier>,
) -> Result<Summary> {
    let (populations, rows) = gathered.end(study);
    write_results(study, populations, &rows, (dir, beside))
}

fn write_results(
    study: &Study,
    populations: Vec<Population>,
    rows: &[Row],
    (dir, beside): (&Path, Option<&Earlier>),
) -> Result<Summary> {
    let summary = summary_of(study, populations, rows);
    write_summary(&summary, dir, beside)?;
    if let Some(figure) = force_figure(study, rows, &summary) {
        let text = force_drift_csv(&force_curves(study, rows));
        replace_file(&dir.join(format!("{}.csv", figure.file)), text.as_bytes())?;
        write_captioned(dir, &figure)?;
    }
    Ok(summary)
}

/// Writes the files of a summary.
pub(crate) fn write_summary(summary: &Summary, dir: &Path, beside: Option<&Earlier>) -> Result<()> {
    let json = serde_json::to_string_pretty(summary).context("the summary cannot be written as JSON")? + "\n";
    replace_file(&dir.join(SUMMARY_JSON), json.as_bytes())?;
    if let Some(shaken) = &summary.shaken {
        return write_shaken(shaken, &title(summary), dir);
    }
    let write = |name: &str, text: &[u8]| replace_file(&dir.join(format!("{name}.csv")), text);
    let curves = curves(summary);
    write(curves.first().map_or("figure", |curve| curve.quantity.figure()), csv(&curves).as_bytes())?;
    if let Some(measured) = &summary.measured {
        write(COMPARISON, &comparison_csv(&measured.comparison))?;
        if !measured.calibration.is_empty() {
            write(CALIBRATION, &calibration_csv(&measured.calibration))?;
        }
    }
    if !summary.sweep.is_empty() {
        write(SWEEP, &sweep_csv(summary))?;
    }
    let drifts = drift_curves(summary);
    if !drifts.is_empty() {
        write(DRIFT, &drift_csv(&drifts))?;
    }
    if !ladders(summary).is_empty() {
        write(FRAGILITY, &fragility_csv(&summary.arms))?;
    }
    let figures = figures(summary, beside);
    figures.iter().try_for_each(|figure| write_captioned(dir, figure))?;
    // Without an earlier run beside it one stiffness has no figure, and may have had one.
    curves.first().map_or(Ok(()), |curve| match curve.quantity.figure() {
        over if figures.iter().any(|figure| figure.file == over) => Ok(()),
        over => without_figure(dir, over),
    })
}

/// Removes a figure that an earlier run wrote into a folder.
fn without_figure(dir: &Path, name: &str) -> Result<()> {
    for ending in ["svg", "png"] {
        remove_file(&dir.join(format!("{name}.{ending}")))?;
    }
    Ok(())
}

/// Writes a document into an existing folder: the answer as JSON under a name, the files beside it, its figures. The same answer gives the
/// same bytes.
///
/// # Errors
/// The file that could not be written, and why.
pub(crate) fn write_document(document: &Document<'_>, (name, json): (&str, &str), dir: &Path) -> Result<()> {
    replace_file(&dir.join(format!("{name}.json")), json.as_bytes())?;
    document.files.iter().try_for_each(|(name, bytes)| replace_file(&dir.join(name), bytes))?;
    document.figures().try_for_each(|figure| write_captioned(dir, figure))
}

/// Writes a figure as SVG and PNG, by how it is drawn at a scale.
pub(crate) fn write_figure<F: Figure>(dir: &Path, name: &str, at: impl Fn(u32) -> F + Clone) -> Result<()> {
    write_captioned(dir, &Captioned::new(name, "", "", at))
}

/// Writes a figure as SVG and PNG.
pub(crate) fn write_captioned(dir: &Path, figure: &Captioned<'_>) -> Result<()> {
    let name = &figure.file;
    replace_file(&dir.join(format!("{name}.svg")), figure.svg()?.as_bytes())?;
    Ok(replace_file(&dir.join(format!("{name}.png")), &figure.png()?)?)
}
