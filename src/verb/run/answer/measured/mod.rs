//! What was measured beside what was simulated: the key `measured` of summary.json, its tables, its text and its figure.

mod calibration;
mod comparison;
mod csv;
mod panel;
mod plot;
mod text;

pub use calibration::CalibrationEntry;
pub use comparison::ComparisonEntry;
pub(crate) use comparison::{in_unit, tidy_degrees, tidy_percent, unit};
pub(crate) use csv::{calibration_csv, comparison_csv};
pub(crate) use plot::CalibrationPlot;
pub(crate) use text::text;

use crate::critic::{calibrate_family, compare, other_friction};
use crate::ensemble::Row;
use crate::study::Study;

/// Measured beside simulated.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct MeasuredSummary {
    /// One entry per family, quantity, tilt and kn.
    pub comparison: Vec<ComparisonEntry>,
    /// One entry per arm with measured collapse angles and enough points in kn.
    pub calibration: Vec<CalibrationEntry>,
}

/// Sums up what was measured; `None` for a study without measured.csv.
pub fn measured(study: &Study, rows: &[Row]) -> Option<MeasuredSummary> {
    if study.measured.is_empty() {
        return None;
    }
    let calibration = study.arms.iter().enumerate().filter_map(|(index, arm)| {
        let (found, left_out) = calibrate_family(study, index, rows)?;
        let others = other_friction(study, index, rows);
        Some(CalibrationEntry::of(study, arm, &found, &left_out, &others))
    });
    Some(MeasuredSummary {
        comparison: compare(study, rows).iter().map(ComparisonEntry::of).collect(),
        calibration: calibration.collect(),
    })
}
