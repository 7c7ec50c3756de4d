//! `force-drift.csv`.

use crate::render::csv::{cell, ends, quoted};
use crate::stats::Estimate;
use crate::verb::run::answer::force_drift::curve::ForceCurve;

/// One line per arm, kn and drift; empty where not defined. Numbers are written so that they read back to the same bits.
pub fn force_drift_csv(curves: &[ForceCurve]) -> String {
    let mut text =
        "arm,kn_pa_per_m,drift_percent,walls,fallen,lost,force_n_mean,force_n_mean_low,force_n_mean_high,\
                    force_n_5,force_n_5_low,force_n_5_high,force_n_95,force_n_95_low,force_n_95_high\n"
            .to_string();
    for curve in curves {
        for p in &curve.points {
            let mut cells = vec![
                quoted(&curve.arm),
                curve.kn.to_string(),
                p.drift_percent.to_string(),
                p.walls.to_string(),
                p.fallen.to_string(),
                p.lost.to_string(),
            ];
            for Estimate { value, interval } in [p.mean, p.low, p.high] {
                cells.push(cell(value));
                cells.extend(ends(interval));
            }
            text.push_str(&(cells.join(",") + "\n"));
        }
    }
    text
}
