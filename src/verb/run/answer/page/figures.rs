//! The figures of a run, as its files have them.

use anyhow::Result;

use crate::ensemble::{Quantity, Row};
use crate::render::draw::svg;
use crate::study::Study;
use crate::verb::run::answer::drift::{DriftPlot, drift_curves};
use crate::verb::run::answer::figure::{curves, ladders, title};
use crate::verb::run::answer::force_drift::{ForceDriftPlot, force_curves};
use crate::verb::run::answer::fragility::FragilityPlot;
use crate::verb::run::answer::measured::CalibrationPlot;
use crate::verb::run::answer::page::chart::Chart;
use crate::verb::run::answer::page::drawing::Drawing;
use crate::verb::run::answer::plot::Plot;
use crate::verb::run::answer::summary::Summary;

/// All figures that the study has.
pub fn figures(study: &Study, rows: &[Row], summary: &Summary) -> Result<Vec<Drawing>> {
    let title = title(summary);
    let mut all = Vec::new();
    let mut add = |id: &str, (name, caption): (&str, &str), chart, figure: &dyn Fn() -> Result<String>| {
        all.push(Drawing::picture(id, name, caption, &figure()?).with_chart(chart));
        anyhow::Ok(())
    };
    let own = curves(summary);
    if let Some(first) = own.first() {
        let caption = format!(
            "The {} of each arm over the normal stiffness kn of the joints; of random arms the mean with its 95 % interval and a \
             band of one standard deviation. The numbers are in the table of arms.",
            first.quantity.axis()
        );
        add("figure-kn", ("Over the stiffness of the joints", &caption), Chart::of_curves(&own), &|| {
            svg(&Plot::new(&title, &own, 1))
        })?;
    }
    let steps = ladders(summary);
    if !steps.is_empty() {
        let caption = "Share of walls that have collapsed over the tilt, at the middle stiffness: a step per wall, with the 95 % band of \
                       Clopper and Pearson at each tilt.";
        let chart = Chart::of_ladders(&steps, Quantity::CollapseAngle);
        add("figure-fragility", ("Fragility", caption), chart, &|| {
            svg(&FragilityPlot::new(&title, &steps, 1))
        })?;
    }
    let forces = force_curves(study, rows);
    if !forces.is_empty() {
        let caption = "Push along the wall over the drift of its top: mean and band over the walls of an arm, and what was measured.";
        add("figure-force", ("Push over drift", caption), Chart::of_forces(&forces), &|| {
            svg(&ForceDriftPlot::new(&title, &forces, &study.measured, 1))
        })?;
    }
    let drifts = drift_curves(summary);
    if !drifts.is_empty() {
        let caption = "Drift at the top over the length of the wall, each a share of the wall's height.";
        add("figure-drift", ("Drift over length", caption), Chart::of_drifts(&drifts), &|| {
            svg(&DriftPlot::new(&title, &drifts, 1))
        })?;
    }
    if let Some(measured) = summary.measured.as_ref().filter(|measured| !measured.calibration.is_empty()) {
        let panels = || measured.calibration.iter().map(|entry| &entry.panel).collect();
        let caption = "Calibration: how likely each stiffness of the joints is by the collapse angles that were measured.";
        add("figure-calibration", ("Calibration", caption), None, &|| {
            svg(&CalibrationPlot::new(&title, panels(), 1))
        })?;
    }
    Ok(all)
}
