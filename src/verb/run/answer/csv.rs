//! The numbers behind the figures.

use crate::render::csv::{cell, ends, quoted};
use crate::verb::run::answer::figure::Curve;
use crate::verb::run::answer::summary::ArmSummary;

const HEADER: [&str; 4] = ["arm", "kn_pa_per_m", "walls", "walls_in_mean"];
const IN_UNIT: [&str; 6] = ["mean", "mean_low", "mean_high", "sigma", "band_low", "band_high"];

/// One line per arm and kn: the mean with its 95 % interval, sigma, and mean -+ sigma; empty where not defined.
/// Numbers are written so that they read back to the same bits.
pub fn csv(curves: &[Curve]) -> String {
    let unit = curves.first().map_or("", |curve| curve.quantity.shown_unit());
    let header = HEADER.map(str::to_string).into_iter().chain(IN_UNIT.map(|name| format!("{name}_{unit}")));
    let mut text = header.collect::<Vec<_>>().join(",") + "\n";
    for curve in curves {
        for point in &curve.points {
            let [low, high] = ends(point.mean_ci);
            let [band_low, band_high] = ends(point.band);
            let cells = [
                quoted(&curve.arm),
                point.kn.to_string(),
                point.members.to_string(),
                point.in_mean.to_string(),
                cell(point.mean),
                low,
                high,
                cell(point.sigma),
                band_low,
                band_high,
            ];
            text.push_str(&cells.join(","));
            text.push('\n');
        }
    }
    text
}

/// `fragility.csv`: one line per arm, kn and step of the empirical distribution.
pub fn fragility_csv(arms: &[ArmSummary]) -> String {
    let mut text =
        "arm,kn_pa_per_m,walls,collapse_angle_deg,collapsed,probability,pointwise_low,pointwise_high,\
         simultaneous_low,simultaneous_high\n"
            .to_string();
    for arm in arms {
        let walls = arm.outcomes.get("collapsed").copied().unwrap_or(0) + arm.stood_to_the_end;
        for step in &arm.fragility {
            let [low, high] = step.pointwise;
            let [least, most] = step.simultaneous;
            text.push_str(&format!(
                "{},{},{walls},{},{},{},{low},{high},{least},{most}\n",
                quoted(&arm.arm),
                arm.kn_pa_per_m,
                step.value,
                step.count,
                step.probability
            ));
        }
    }
    text
}
