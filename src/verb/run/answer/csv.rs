//! The numbers behind the figures.

use crate::render::csv::Csv;
use crate::verb::run::answer::figure::Curve;
use crate::verb::run::answer::summary::ArmSummary;

/// One line per arm and kn: the mean with its 95 % interval, sigma, and mean -+ sigma; empty where not defined.
/// Numbers are written so that they read back to the same bits.
pub fn csv(curves: &[Curve]) -> String {
    let unit = curves.first().map_or("", |curve| curve.quantity.shown_unit());
    let columns = ["mean", "mean_low", "mean_high", "sigma", "band_low", "band_high"];
    let columns = columns.map(|name| format!("{name}_{unit}")).join(",");
    let mut csv = Csv::new(format!("arm,kn_pa_per_m,walls,walls_in_mean,{columns}"));
    for curve in curves {
        for p in &curve.points {
            csv.line(&[&curve.arm, &p.kn, &p.members, &p.in_mean, &p.mean, &p.mean_ci, &p.sigma, &p.band]);
        }
    }
    csv.text()
}

/// `fragility.csv`: one line per arm, kn and step of the empirical distribution.
pub fn fragility_csv(arms: &[ArmSummary]) -> Vec<u8> {
    let mut csv = Csv::new(
        "arm,kn_pa_per_m,walls,collapse_angle_deg,collapsed,probability,pointwise_low,pointwise_high,\
         simultaneous_low,simultaneous_high",
    );
    for arm in arms {
        let walls = arm.outcomes.get("collapsed").copied().unwrap_or(0) + arm.stood_to_the_end;
        for step in &arm.fragility {
            csv.line(&[
                &arm.arm,
                &arm.kn_pa_per_m,
                &walls,
                &step.value,
                &step.count,
                &step.probability,
                &step.pointwise,
                &step.simultaneous,
            ]);
        }
    }
    csv.bytes()
}
