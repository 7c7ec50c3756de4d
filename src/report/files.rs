//! The files of a report, each written whole or not at all.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::ensemble::{Row, replace_file};
use crate::report::csv::csv;
use crate::report::draw::{png_into, svg};
use crate::report::figure::{Curve, curves, title};
use crate::report::summary::{Summary, summarise};
use crate::study::Study;

/// File name of the summary.
pub const SUMMARY_JSON: &str = "summary.json";
/// File name of the figure as vector graphics.
pub const FIGURE_SVG: &str = "figure-10.svg";
/// File name of the figure as an image.
pub const FIGURE_PNG: &str = "figure-10.png";
/// File name of the numbers behind the figure.
pub const FIGURE_CSV: &str = "figure-10.csv";

/// Sums up the rows and writes `summary.json` and Figure 10 (SVG, PNG, CSV) into an existing folder.
///
/// The same study and rows give the same bytes. Each file is written under a temporary name and renamed, so that a
/// reader never sees half of one.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_all(study: &Study, rows: &[Row], dir: &Path) -> Result<Summary> {
    let summary = summarise(study, rows);
    write_summary(&summary, dir)?;
    Ok(summary)
}

/// Writes the files of a summary.
pub(crate) fn write_summary(summary: &Summary, dir: &Path) -> Result<()> {
    let curves = curves(summary);
    let title = title(summary);
    let json = serde_json::to_string_pretty(summary).context("the summary cannot be written as JSON")? + "\n";
    replace_file(&dir.join(SUMMARY_JSON), json.as_bytes())?;
    replace_file(&dir.join(FIGURE_CSV), csv(&curves).as_bytes())?;
    replace_file(&dir.join(FIGURE_SVG), svg(&title, &curves)?.as_bytes())?;
    write_png(dir, &title, &curves)
}

/// Lets the image writer, which wants a path, write a temporary file, flushes it to the disk and gives it its name.
fn write_png(dir: &Path, title: &str, curves: &[Curve]) -> Result<()> {
    let path = dir.join(FIGURE_PNG);
    // The ending is kept: the image writer chooses its format by it.
    let temporary = dir.join(format!(".unfinished-{FIGURE_PNG}"));
    let written = png_into(&temporary, title, curves)
        .and_then(|()| Ok(fs::File::open(&temporary)?.sync_all()?))
        .and_then(|()| Ok(fs::rename(&temporary, &path)?));
    if written.is_err() {
        // The reason of the first failure is what matters; a leftover is overwritten next time.
        let _ = fs::remove_file(&temporary);
    }
    written.with_context(|| format!("cannot write {}", path.display()))
}
