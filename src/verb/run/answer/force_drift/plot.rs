//! The figure of the push over the drift: arm by arm the mean, the band of one more wall, and what was measured.

use crate::render::axes::{Axes, Axis};
use crate::render::chart::{Chart, Mark, Series};
use crate::render::document::{Captioned, ReadOff, Scale, Trace};
use crate::render::number::{compact, range, shortened, stiffness};
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};
use crate::verb::run::answer::force_drift::curve::{ForceCurve, ForcePoint};

/// Names longer than this are cut.
const LONGEST_NAME: usize = 24;
/// Its file name without ending, and its axes.
const FILE: &str = "force-drift";
const AXES: [&str; 2] = ["drift (%)", "push (kN)"];

/// The figure of curves, with the readings of their arms; `None` where there are none.
pub fn force_drift<'a>(
    title: &str,
    curves: &[ForceCurve],
    measured: &[Measurement],
) -> Option<Captioned<'a>> {
    if curves.is_empty() {
        return None;
    }
    let series = curves.iter().enumerate().map(|(index, curve)| {
        let read = readings(curve, measured);
        let mean = curve.points.iter().filter_map(|p| Some((p.drift_percent, kilo(p.mean.value?)))).collect();
        let band = curve.points.iter().filter_map(|p| Some((p.drift_percent, band(p)?))).collect();
        let label = label(curve, !read.is_empty());
        Series { index, label, marks: vec![Mark::Band(band), Mark::Line(mean), Mark::Markers(read)] }
    });
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let read = || curves.iter().flat_map(|curve| readings(curve, measured));
    let forces = points().flat_map(|p| [p.mean.value, p.high.value]).flatten().map(kilo);
    let top = range(forces.chain(read().map(|at| at.1))).map_or(1.0, |[_, top]| 1.1 * top).max(1e-9);
    let drifts = points().map(|p| p.drift_percent).chain(read().map(|at| at.0));
    let end = range(drifts).map_or(1.0, |[_, end]| 1.03 * end);
    let chart = Chart {
        caption: title.to_owned(),
        axes: Axes { x: Axis::new(AXES[0], [0.0, end], 10), y: Axis::new(AXES[1], [0.0, top], 8) },
        series: series.collect(),
        remarks: Vec::new(),
    };
    let trace = |curve: &ForceCurve| {
        let of = |p: &ForcePoint| (p.drift_percent, p.mean.value.map(kilo), band(p).filter(|_| curve.random));
        Trace::through(format!("{}, kn {}", curve.arm, compact(curve.kn)), curve.points.iter().map(of))
    };
    let caption = "Push along the wall over the drift of its top: mean and band over the walls of an arm, and what was measured.";
    let [x, y] = AXES.map(Scale::of);
    let read_off = ReadOff::with(x, y, curves.iter().map(trace));
    Some(Captioned::chart(FILE, "Push over drift", caption, chart).with_read_off(read_off))
}

fn kilo(x: f64) -> f64 {
    1e-3 * x
}

/// The band that one more wall lies in (kN).
fn band(p: &ForcePoint) -> Option<[f64; 2]> {
    Some([p.low.value?, p.high.value?].map(kilo))
}

/// What was measured of the arm of a curve: drift (%) and force (kN).
fn readings(curve: &ForceCurve, measured: &[Measurement]) -> Vec<(f64, f64)> {
    let is_read = |m: &&Measurement| {
        m.quantity == MeasuredQuantity::ForceAtDrift
            && m.family == curve.arm
            && matches!(m.kind, MeasuredKind::Exact | MeasuredKind::Rounded)
    };
    measured.iter().filter(is_read).filter_map(|m| Some((100.0 * m.drift?, kilo(m.value)))).collect()
}

/// Text of the legend for a curve.
fn label(curve: &ForceCurve, is_measured: bool) -> String {
    let walls = match range(curve.points.iter().map(|p| p.walls as f64)) {
        Some([low, high]) if low != high => format!("{low} to {high} walls"),
        Some([1.0, _]) => "1 wall".to_string(),
        Some([n, _]) => format!("{n} walls"),
        None => "no wall".to_string(),
    };
    let has_band = curve.points.iter().any(|p| p.low.value.is_some());
    let band = match (curve.random, has_band) {
        (true, true) => ", band: 5 to 95 %",
        (true, false) => ", too few for a band",
        (false, _) => ", nothing random",
    };
    let marks = if is_measured { "; marks: measured" } else { "" };
    let name = shortened(&curve.arm, LONGEST_NAME);
    format!("{name}, kn = {}: {walls}{band}{marks}", stiffness(curve.kn))
}
