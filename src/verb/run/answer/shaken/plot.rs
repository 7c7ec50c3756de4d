//! The figure of fragility under records: shares at each intensity, the lognormal curve, and the band of the isotonic one.

use crate::render::axes::{Axes, Axis};
use crate::render::chart::{Chart, Mark, Series};
use crate::render::document::Captioned;
use crate::render::number::{or_dash, range, shortened, stiffness};
use crate::verb::run::answer::files::FRAGILITY;
use crate::verb::run::answer::shaken::entry::{ShakenCurve, ShakenSummary};

/// Names longer than this are cut in the figure.
const LONGEST_NAME: usize = 24;
/// Points of a curve.
const POINTS: usize = 200;

/// The figure of a study's curves.
pub(crate) fn shaken_figure<'a>(title: &str, summary: &ShakenSummary) -> Captioned<'a> {
    let [_, high] = range(summary.intensities.iter().copied()).unwrap_or([0.0, 1.0]);
    let (end, shown) = (1.08 * high, summary.shown);
    let series = summary.curves.iter().enumerate().map(|(index, curve)| {
        let steps = || curve.stripes.iter().map(|stripe| &stripe.step);
        let band = steps().filter_map(|step| Some((step.intensity, step.probability.interval?)));
        let mut marks = vec![Mark::Band(band.collect())];
        marks.extend(curve.lognormal.fit.curve.map(|lognormal| {
            let level = |k: usize| end * k as f64 / POINTS as f64;
            Mark::Line((1..=POINTS).map(|k| (level(k), lognormal.probability(level(k)))).collect())
        }));
        marks.push(Mark::Dots(steps().map(|step| (step.intensity, step.share)).collect()));
        Series { index, label: label(summary, curve), marks }
    });
    let over = format!("{} ({})", shown.name(), shown.unit());
    let chart = Chart {
        caption: title.to_owned(),
        axes: Axes { x: Axis::new(over, [0.0, end], 10), y: Axis::new("probability of collapse", [0.0, 1.02], 6) },
        series: series.collect(),
        remarks: vec![
            "points: share of runs; line: lognormal; band: 95 % about the isotonic curve, over records and walls".to_owned(),
        ],
    };
    let caption = "Probability of collapse over the intensity of the records: share of runs, lognormal curve, isotonic band.";
    Captioned::chart(FRAGILITY, "Fragility under records", caption, chart)
}

fn label(summary: &ShakenSummary, curve: &ShakenCurve) -> String {
    let unit = summary.shown.unit();
    let (theta, beta) = (or_dash(curve.lognormal.theta.value, 3), or_dash(curve.lognormal.beta.value, 2));
    let name = shortened(&curve.arm, LONGEST_NAME);
    format!("{name}, kn = {}: theta {theta} {unit}, beta {beta}", stiffness(curve.kn_pa_per_m))
}
