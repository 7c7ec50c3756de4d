//! The figures of a run, for its files and for its page.

use crate::ensemble::{Quantity, Row};
use crate::render::document::Captioned;
use crate::study::Study;
use crate::verb::run::answer::beside::Earlier;
use crate::verb::run::answer::drift::{drift, drift_curves};
use crate::verb::run::answer::figure::{curves, ladders, title};
use crate::verb::run::answer::files::{CALIBRATION, FRAGILITY};
use crate::verb::run::answer::force_drift::{force_curves, force_drift};
use crate::verb::run::answer::fragility::{fragility, shares};
use crate::verb::run::answer::measured::CalibrationPlot;
use crate::verb::run::answer::plot::over_kn;
use crate::verb::run::answer::summary::Summary;
use crate::verb::run::answer::sweep::over_key;

/// The figures that a summary has: the quantity over kn with the means of an earlier run if one is given, and of a capacity its fragility
/// curves; the quantity over a swept key; drift over length; the calibration of kn.
pub(crate) fn figures<'s>(summary: &'s Summary, beside: Option<&Earlier>) -> Vec<Captioned<'s>> {
    let title = title(summary);
    let mut all: Vec<Captioned<'s>> = over_kn(&title, &curves(summary), beside).into_iter().collect();
    all.extend(over_key(&title, summary));
    let steps = ladders(summary);
    if !steps.is_empty() {
        let caption = "Share of walls that have collapsed over the tilt, at the middle stiffness: a step per wall, with the 95 % band of \
                       Clopper and Pearson at each tilt.";
        let (quantity, chart) = (Quantity::CollapseAngle, fragility(&title, &steps, Quantity::CollapseAngle));
        let figure = Captioned::chart(FRAGILITY, "Fragility", caption, chart);
        all.push(figure.with_read_off(shares(&steps, quantity)));
    }
    all.extend(drift(&title, &drift_curves(summary)));
    if let Some(measured) = summary.measured.as_ref().filter(|measured| !measured.calibration.is_empty()) {
        let caption = "Calibration: how likely each stiffness of the joints is by the collapse angles that were measured.";
        all.push(Captioned::new(CALIBRATION, "Calibration", caption, move |scale| {
            CalibrationPlot::new(
                title.clone(),
                measured.calibration.iter().map(|entry| &entry.panel).collect(),
                scale,
            )
        }));
    }
    all
}

/// The figure of the pushes over the drift, if walls were sheared.
pub(crate) fn force_figure<'s>(study: &Study, rows: &[Row], summary: &Summary) -> Option<Captioned<'s>> {
    force_drift(&title(summary), &force_curves(study, rows), &study.measured)
}
