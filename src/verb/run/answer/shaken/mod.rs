//! What comes of walls that are shaken: fragility curves, what scatters, which arm is better, which measure predicts.

mod campaigns;
mod csv;
mod entry;
mod plot;
mod text;

use std::path::Path;

use anyhow::Result;

use crate::ensemble::{Row, replace_file};
use crate::study::Study;
use crate::verb::run::answer::files::{FRAGILITY, write_captioned};
use crate::verb::run::answer::shaken::csv::{curves_csv, records_csv, stripes_csv};
use crate::verb::run::answer::shaken::entry::summarised;
pub use crate::verb::run::answer::shaken::entry::{
    MeasureEntry, RatioEntry, RecordEntry, ShakenCurve, ShakenSummary, StripeEntry, TiltEntry,
};
use crate::verb::run::answer::shaken::plot::shaken_figure;
pub(crate) use crate::verb::run::answer::shaken::text::text;

/// File name of the lognormal curves.
const CURVES_CSV: &str = "curves.csv";
/// File name of the records.
const RECORDS_CSV: &str = "records.csv";

/// Sums up the rows of a study whose walls are shaken; `None` of any other.
pub(crate) fn shaken(study: &Study, rows: &[Row]) -> Option<ShakenSummary> {
    study.earthquakes.as_ref().map(|earthquakes| summarised(study, earthquakes, rows))
}

/// Writes the curves, the stripes and the records as tables, and the figure.
pub(crate) fn write_shaken(summary: &ShakenSummary, title: &str, dir: &Path) -> Result<()> {
    replace_file(&dir.join(CURVES_CSV), &curves_csv(summary))?;
    replace_file(&dir.join(RECORDS_CSV), &records_csv(summary))?;
    replace_file(&dir.join(format!("{FRAGILITY}.csv")), &stripes_csv(summary))?;
    write_captioned(dir, &shaken_figure(title, summary))
}
