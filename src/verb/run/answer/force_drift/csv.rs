//! `force-drift.csv`.

use crate::render::csv::Csv;
use crate::verb::run::answer::force_drift::curve::ForceCurve;

/// One line per arm, kn and drift.
pub fn force_drift_csv(curves: &[ForceCurve]) -> String {
    let mut csv = Csv::new(
        "arm,kn_pa_per_m,drift_percent,walls,fallen,lost,force_n_mean,force_n_mean_low,force_n_mean_high,\
         force_n_5,force_n_5_low,force_n_5_high,force_n_95,force_n_95_low,force_n_95_high",
    );
    for curve in curves {
        for p in &curve.points {
            let (mean, low, high) = (p.mean, p.low, p.high);
            csv.line(&[
                &curve.arm,
                &curve.kn,
                &p.drift_percent,
                &[p.walls, p.fallen, p.lost],
                &mean.value,
                &mean.interval,
                &low.value,
                &low.interval,
                &high.value,
                &high.interval,
            ]);
        }
    }
    csv.text()
}
