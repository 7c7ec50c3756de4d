//! The figure over kn: the quantity against the stiffness of the joints, and the means of an earlier run.

use crate::render::axes::{Axes, Axis, exponent, superscript};
use crate::render::chart::{Chart, Mark, Series, runs};
use crate::render::document::{Captioned, ReadOff, Scale, Trace};
use crate::render::number::{range, shortened};
use crate::verb::run::answer::beside::Earlier;
use crate::verb::run::answer::figure::{Curve, LONGEST_NAME, Point};

/// The figure of curves; `None` where there are none, or one stiffness alone and no earlier run beside it: the table shows more than a
/// figure of one point.
pub fn over_kn<'a>(title: &str, curves: &[Curve], beside: Option<&Earlier>) -> Option<Captioned<'a>> {
    let quantity = curves.first()?.quantity;
    let kn = range(curves.iter().flat_map(|curve| &curve.points).map(|point| point.kn));
    if beside.is_none() && kn.is_some_and(|[low, high]| low == high) {
        return None;
    }
    let caption = format!(
        "The {} of each arm over the normal stiffness kn of the joints; of random arms the mean with its 95 % interval and a band of \
         one standard deviation. The numbers are in the table of arms.",
        quantity.axis()
    );
    let power = kn.map_or(0, |[low, _]| exponent(low));
    // A power of ten by its digits is exact.
    let unit: f64 = format!("1e{power}").parse().unwrap_or(1.0);
    let mut series: Vec<Series> = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        series.extend(curve_series(index, curve, unit));
    }
    let mut more = curves.len()..;
    for (arm, means) in beside.iter().flat_map(|earlier| &earlier.arms) {
        // An arm that is not in this figure has a colour of its own.
        let place = curves.iter().position(|curve| curve.arm == *arm);
        let run = beside.map_or("", |earlier| &earlier.label);
        series.push(Series {
            index: place.or_else(|| more.next()).unwrap_or_default(),
            label: format!("{}: mean of an earlier run ({run})", shortened(arm, LONGEST_NAME)),
            marks: vec![Mark::Outlines(means.iter().map(|mean| (mean.kn / unit, mean.shown)).collect())],
        });
    }
    let title_of_kn = format!("normal stiffness of the joints kn (10{} Pa/m)", superscript(power));
    let [x, y] = ends(curves, beside, unit);
    let chart = Chart {
        caption: title.to_owned(),
        axes: Axes { x: Axis::new(title_of_kn, x, 10), y: Axis::new(quantity.axis(), y, 8) },
        series,
        remarks: curves.iter().filter_map(Curve::remark).map(|remark| format!("! {remark}")).collect(),
    };
    let trace = |curve: &Curve| {
        Trace::through(&curve.arm, curve.points.iter().map(|point| (point.kn, point.mean, point.mean_ci)))
    };
    let [x, y] = [Scale::of("kn (Pa/m)").by_powers(), Scale::of(quantity.axis())];
    let figure = Captioned::chart(quantity.figure(), "Over the stiffness of the joints", caption, chart);
    Some(figure.with_read_off(ReadOff::with(x, y, curves.iter().map(trace))))
}

/// A curve: lines between neighbouring means, bars, markers; and its band of one standard deviation.
pub(crate) fn curve_series(index: usize, curve: &Curve, unit: f64) -> Vec<Series> {
    let kn = |point: &Point| point.kn / unit;
    let means = runs(&curve.points, |point| Some((kn(point), point.mean?)));
    let bars =
        curve.points.iter().filter(|_| curve.random).filter_map(|point| Some((kn(point), point.mean_ci?)));
    let over = [Mark::Bars(bars.collect()), Mark::Markers(means.concat())];
    let marks = means.into_iter().map(Mark::Line).chain(over).collect();
    let mut all = vec![Series { index, label: curve.label(), marks }];
    if curve.has_band() {
        let bands = runs(&curve.points, |point| Some((kn(point), point.band?)));
        let label = format!("{}: mean \u{b1} one standard deviation of the walls", curve.name());
        all.push(Series { index, label, marks: bands.into_iter().map(Mark::Band).collect() });
    }
    all
}

/// Ends of the axes: kn with some room at both sides; the quantity from zero (or below) to above the highest mark.
pub(crate) fn ends(curves: &[Curve], beside: Option<&Earlier>, unit: f64) -> [[f64; 2]; 2] {
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let earlier = || beside.iter().flat_map(|earlier| &earlier.arms).flat_map(|(_, means)| means);
    let kn = points().map(|point| point.kn).chain(earlier().map(|mean| mean.kn));
    let [low, high] = range(kn.map(|kn| kn / unit)).unwrap_or([0.0, 1.0]);
    let room = if high > low { 0.06 * (high - low) } else { 0.1 * high.abs() };
    let ends = |ends: Option<[f64; 2]>| ends.into_iter().flatten();
    let heights = points().flat_map(|p| p.mean.into_iter().chain(ends(p.mean_ci)).chain(ends(p.band)));
    let [bottom, top] =
        range(heights.chain(earlier().map(|mean| mean.shown)).chain([0.0])).unwrap_or([0.0, 0.0]);
    let height = if top > bottom { top - bottom } else { 1.0 };
    let below = if bottom < 0.0 { 0.05 * height } else { 0.0 };
    [[low - room, high + room], [bottom - below, bottom + 1.08 * height]]
}
