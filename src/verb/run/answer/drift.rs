//! Drift against the wall's length over its height: arms that belong to one curve, and how the figure looks.

use crate::ensemble::Quantity;
use crate::render::axes::{Axes, Axis};
use crate::render::chart::{Chart, Mark, Series};
use crate::render::csv::Csv;
use crate::render::document::{Captioned, ReadOff, Scale, Trace};
use crate::render::number::{compact, range, shortened, stiffness};
use crate::verb::run::answer::summary::{ArmSummary, Summary};

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 24;

/// One curve: arms of one name at one kn, by growing length.
#[derive(Clone, Debug, PartialEq)]
pub struct DriftCurve {
    /// Name of the curve.
    pub curve: String,
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Its points.
    pub points: Vec<DriftPoint>,
}

/// One arm.
#[derive(Clone, Debug, PartialEq)]
pub struct DriftPoint {
    /// Name of the arm.
    pub arm: String,
    /// Length over height.
    pub slenderness: f64,
    /// Mean displacement at the top over the height (mm/m); `None` when no wall brings a value.
    pub drift: Option<f64>,
    /// Its 95 % interval.
    pub interval: Option<[f64; 2]>,
}

/// The curves of a study whose arms belong to some, in the order of their first arms.
pub fn drift_curves(summary: &Summary) -> Vec<DriftCurve> {
    let mut curves: Vec<DriftCurve> = Vec::new();
    for arm in summary.arms.iter().filter(|arm| arm.shown == Quantity::TopDisplacement) {
        let Some((curve, point)) = point(arm) else { continue };
        let kn = arm.kn_pa_per_m;
        match curves.iter_mut().find(|c| c.curve == curve && c.kn == kn) {
            Some(known) => known.points.push(point),
            None => curves.push(DriftCurve { curve, kn, points: vec![point] }),
        }
    }
    for curve in &mut curves {
        curve.points.sort_by(|a, b| a.slenderness.total_cmp(&b.slenderness));
    }
    curves
}

fn point(arm: &ArmSummary) -> Option<(String, DriftPoint)> {
    let number = |key: &str| arm.parameters.get(key).and_then(serde_json::Value::as_f64);
    let curve = arm.parameters.get("curve")?.as_str()?.to_string();
    let (length, height) = (number("length_m")?, number("height_m")?);
    let drift = |x: f64| 1e3 * x / height;
    let point = DriftPoint {
        arm: arm.arm.clone(),
        slenderness: length / height,
        drift: arm.mean.map(drift),
        interval: arm.mean_ci.map(|ci| ci.map(drift)),
    };
    Some((curve, point))
}

/// The curves as CSV.
pub fn drift_csv(curves: &[DriftCurve]) -> Vec<u8> {
    let mut csv = Csv::new("curve,kn_pa_per_m,arm,length_over_height,drift_mm_per_m,low,high");
    for curve in curves {
        let kn = format!("{:e}", curve.kn);
        for p in &curve.points {
            csv.line(&[&curve.curve, &kn, &p.arm, &p.slenderness, &p.drift, &p.interval]);
        }
    }
    csv.bytes()
}

/// The figure of curves; `None` where there are none.
pub fn drift<'a>(title: &str, curves: &[DriftCurve]) -> Option<Captioned<'a>> {
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let [from, to] = range(points().map(|p| p.slenderness))?;
    let tops = points().filter_map(|p| p.interval.map(|ci| ci[1]).or(p.drift));
    let top = range(tops).map_or(1.0, |[_, top]| 1.1 * top);
    let room = 0.05 * (to - from).max(1.0);
    let series = curves.iter().enumerate().map(|(index, curve)| {
        let line: Vec<(f64, f64)> =
            curve.points.iter().filter_map(|p| p.drift.map(|drift| (p.slenderness, drift))).collect();
        let bars = curve.points.iter().filter_map(|p| Some((p.slenderness, p.interval?))).collect();
        Series {
            index,
            label: label(curve),
            marks: vec![Mark::Bars(bars), Mark::Dots(line.clone()), Mark::Line(line)],
        }
    });
    let [x, y] = ["length over height", "drift: displacement of the top over height (mm/m)"];
    let chart = Chart {
        caption: title.to_owned(),
        axes: Axes { x: Axis::new(x, [from - room, to + room], 12), y: Axis::new(y, [0.0, top], 8) },
        series: series.collect(),
        remarks: Vec::new(),
    };
    let trace = |curve: &DriftCurve| {
        let points = curve.points.iter().map(|point| (point.slenderness, point.drift, point.interval));
        Trace::through(format!("{}, kn {}", curve.curve, compact(curve.kn)), points)
    };
    let caption = "Drift at the top over the length of the wall, each a share of the wall's height.";
    let read_off = ReadOff::with(Scale::of(x), Scale::of("drift (mm/m)"), curves.iter().map(trace));
    Some(Captioned::chart("drift", "Drift over length", caption, chart).with_read_off(read_off))
}

fn label(curve: &DriftCurve) -> String {
    let random = curve.points.iter().any(|point| point.interval.is_some());
    let bars = if random { "; bars: 95 % interval of the mean" } else { "; nothing random" };
    format!("{}, kn = {}{bars}", shortened(&curve.curve, LONGEST_NAME), stiffness(curve.kn))
}
