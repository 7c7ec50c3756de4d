//! `figure-10.csv`: the numbers behind the figure.

use crate::report::figure::Curve;

const HEADER: &str =
    "arm,kn_pa_per_m,walls,walls_in_mean,mean_mm,mean_low_mm,mean_high_mm,sigma_mm,band_low_mm,band_high_mm";

/// One line per arm and kn: the mean with its 95 % interval, sigma, and mean -+ sigma; empty where not defined.
/// Numbers are written so that they read back to the same bits.
pub fn csv(curves: &[Curve]) -> String {
    let mut text = format!("{HEADER}\n");
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

fn cell(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

fn ends(interval: Option<[f64; 2]>) -> [String; 2] {
    interval.map_or_else(Default::default, |ends| ends.map(|end| end.to_string()))
}

/// A name as a CSV field (RFC 4180).
fn quoted(name: &str) -> String {
    match name.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", name.replace('"', "\"\"")),
        false => name.to_string(),
    }
}
