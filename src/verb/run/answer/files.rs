//! The files of a report, each written whole or not at all.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::ensemble::{Row, replace_file};
use crate::render::draw::{Figure, IMAGE_SCALE, png_into, svg};
use crate::study::Study;
use crate::verb::run::answer::beside::Earlier;
use crate::verb::run::answer::csv::{csv, fragility_csv};
use crate::verb::run::answer::drift::{DriftPlot, drift_csv, drift_curves};
use crate::verb::run::answer::figure::{curves, ladders, title};
use crate::verb::run::answer::force_drift::{ForceDriftPlot, force_curves, force_drift_csv};
use crate::verb::run::answer::fragility::FragilityPlot;
use crate::verb::run::answer::gathered::{Gathered, populations};
use crate::verb::run::answer::measured::{CalibrationPlot, calibration_csv, comparison_csv};
use crate::verb::run::answer::plot::Plot;
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::shaken::write_shaken;
use crate::verb::run::answer::summary::{Summary, summary_of};

/// File name of the summary.
pub const SUMMARY_JSON: &str = "summary.json";
/// File name, without ending, of the fragility curves and the figure of them.
pub const FRAGILITY: &str = "fragility";
/// File name, without ending, of the drift against the walls' length.
const DRIFT: &str = "drift";
/// File name, without ending, of the pushes over the drift, and the figure of them.
const FORCE_DRIFT: &str = "force-drift";
/// File name of the comparison with what was measured.
pub const COMPARISON_CSV: &str = "comparison.csv";
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
    write_force_drift(study, rows, &title(&summary), dir)?;
    Ok(summary)
}

/// Writes the pushes over the drift, if walls were sheared.
fn write_force_drift(study: &Study, rows: &[Row], title: &str, dir: &Path) -> Result<()> {
    let curves = force_curves(study, rows);
    if curves.is_empty() {
        return Ok(());
    }
    replace_file(&dir.join(format!("{FORCE_DRIFT}.csv")), force_drift_csv(&curves).as_bytes())?;
    let figure = |scale| ForceDriftPlot::new(title, &curves, &study.measured, scale);
    write_figure(dir, FORCE_DRIFT, &figure(1), &figure(IMAGE_SCALE))
}

/// Writes the files of a summary.
pub(crate) fn write_summary(summary: &Summary, dir: &Path, beside: Option<&Earlier>) -> Result<()> {
    let curves = curves(summary);
    let title = title(summary);
    let json = serde_json::to_string_pretty(summary).context("the summary cannot be written as JSON")? + "\n";
    replace_file(&dir.join(SUMMARY_JSON), json.as_bytes())?;
    if let Some(shaken) = &summary.shaken {
        return write_shaken(shaken, &title, dir);
    }
    let name = curves.first().map_or("figure", |curve| curve.quantity.figure());
    replace_file(&dir.join(format!("{name}.csv")), csv(&curves).as_bytes())?;
    let plot = |scale| Plot::new(&title, &curves, scale).beside(beside);
    write_figure(dir, name, &plot(1), &plot(IMAGE_SCALE))?;
    write_measured(summary, &title, dir)?;
    write_drift(summary, &title, dir)?;
    let ladders = ladders(summary);
    if ladders.is_empty() {
        return Ok(());
    }
    replace_file(&dir.join(format!("{FRAGILITY}.csv")), fragility_csv(&summary.arms).as_bytes())?;
    let figure = |scale| FragilityPlot::new(&title, &ladders, scale);
    write_figure(dir, FRAGILITY, &figure(1), &figure(IMAGE_SCALE))
}

/// Writes the drift against the walls' length, if arms are points of such a curve.
fn write_drift(summary: &Summary, title: &str, dir: &Path) -> Result<()> {
    let curves = drift_curves(summary);
    if curves.is_empty() {
        return Ok(());
    }
    replace_file(&dir.join(format!("{DRIFT}.csv")), drift_csv(&curves).as_bytes())?;
    let figure = |scale| DriftPlot::new(title, &curves, scale);
    write_figure(dir, DRIFT, &figure(1), &figure(IMAGE_SCALE))
}

/// Writes what was measured beside what was simulated, if anything was.
fn write_measured(summary: &Summary, title: &str, dir: &Path) -> Result<()> {
    let Some(measured) = &summary.measured else { return Ok(()) };
    replace_file(&dir.join(COMPARISON_CSV), comparison_csv(&measured.comparison).as_bytes())?;
    if measured.calibration.is_empty() {
        return Ok(());
    }
    replace_file(&dir.join(format!("{CALIBRATION}.csv")), calibration_csv(&measured.calibration).as_bytes())?;
    let panels = || measured.calibration.iter().map(|entry| &entry.panel).collect();
    let figure = |scale| CalibrationPlot::new(title, panels(), scale);
    write_figure(dir, CALIBRATION, &figure(1), &figure(IMAGE_SCALE))
}

/// Writes a figure as SVG and PNG; `large` is the same one at [`IMAGE_SCALE`].
pub(crate) fn write_figure(dir: &Path, name: &str, figure: &impl Figure, large: &impl Figure) -> Result<()> {
    replace_file(&dir.join(format!("{name}.svg")), svg(figure)?.as_bytes())?;
    // Lets the image writer, which wants a path and chooses its format by the ending, write a temporary file, flushes it to
    // the disk and gives it its name.
    let (path, temporary) = (dir.join(format!("{name}.png")), dir.join(format!(".unfinished-{name}.png")));
    let written = png_into(&temporary, large)
        .and_then(|()| Ok(fs::File::open(&temporary)?.sync_all()?))
        .and_then(|()| Ok(fs::rename(&temporary, &path)?));
    if written.is_err() {
        // The reason of the first failure is what matters; a leftover is overwritten next time.
        let _ = fs::remove_file(&temporary);
    }
    written.with_context(|| format!("cannot write {}", path.display()))
}
