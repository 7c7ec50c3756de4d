//! What comes of walls that are shaken: fragility curves, what scatters, which arm is better, which measure predicts.

mod campaigns;
mod csv;
mod entry;
mod plot;
mod text;

use std::path::Path;

use anyhow::Result;

use crate::ensemble::{Row, replace_file};
use crate::report::draw::IMAGE_SCALE;
use crate::report::files::{FRAGILITY, write_figure};
use crate::report::shaken::csv::{curves_csv, records_csv, stripes_csv};
use crate::report::shaken::entry::summarised;
pub use crate::report::shaken::entry::{
    MeasureEntry, RatioEntry, RecordEntry, ShakenCurve, ShakenSummary, StripeEntry, TiltEntry,
};
use crate::report::shaken::plot::ShakenPlot;
pub(super) use crate::report::shaken::text::text;
use crate::study::Study;

/// File name of the lognormal curves.
const CURVES_CSV: &str = "curves.csv";
/// File name of the records.
const RECORDS_CSV: &str = "records.csv";

/// Sums up the rows of a study whose walls are shaken; `None` of any other.
pub(super) fn shaken(study: &Study, rows: &[Row]) -> Option<ShakenSummary> {
    study.earthquakes.as_ref().map(|earthquakes| summarised(study, earthquakes, rows))
}

/// Writes the curves, the stripes and the records as tables, and the figure.
pub(super) fn write_shaken(summary: &ShakenSummary, title: &str, dir: &Path) -> Result<()> {
    replace_file(&dir.join(CURVES_CSV), curves_csv(summary).as_bytes())?;
    replace_file(&dir.join(RECORDS_CSV), records_csv(summary).as_bytes())?;
    replace_file(&dir.join(format!("{FRAGILITY}.csv")), stripes_csv(summary).as_bytes())?;
    let figure = |scale| ShakenPlot::new(title, summary, scale);
    write_figure(dir, FRAGILITY, &figure(1), &figure(IMAGE_SCALE))
}
