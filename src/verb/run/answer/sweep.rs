//! The quantity over the values of a swept key: the figure and the table beside it.

use crate::render::axes;
use crate::render::axes::{Axes, Axis};
use crate::render::chart::Chart;
use crate::render::csv::{Cell, Csv};
use crate::render::document::{Captioned, ReadOff, Scale, Trace};
use crate::study::{SweptArm, SweptValue};
use crate::verb::run::answer::figure::{Curve, Point, middle_kn};
use crate::verb::run::answer::plot::{curve_series, ends};
use crate::verb::run::answer::summary::{ArmSummary, Summary};

/// File name, without ending, of the table and the figure.
pub(crate) const SWEEP: &str = "sweep";

/// The figure over the first key whose values are numbers, with a curve for each arm of the study at each combination of the other keys, at the
/// middle kn (the lower of two); `None` where nothing was swept, or no key has numbers alone.
pub(crate) fn over_key<'a>(title: &str, summary: &Summary) -> Option<Captioned<'a>> {
    let first = summary.sweep.first()?;
    let is_number = |key: &&SweptValue| {
        let mut all = summary.sweep.iter().flat_map(|arm| &arm.settings).filter(|own| own.key == key.key);
        all.all(|own| own.number.is_some())
    };
    let key = first.settings.iter().find(is_number)?.key.clone();
    let curves = curves_over(summary, &key, middle_kn(summary)?);
    let quantity = curves.first()?.quantity;
    let over = axes::over_key(&key);
    let caption = format!(
        "The {} over {key}, the {over}; of random arms the mean with its 95 % interval and a band of one standard deviation. The numbers are in the \
         table of arms.",
        quantity.axis()
    );
    let [x, y] = ends(&curves, None, 1.0);
    let chart = Chart {
        caption: title.to_owned(),
        axes: Axes { x: Axis::new(over.clone(), x, 10), y: Axis::new(quantity.axis(), y, 8) },
        series: curves
            .iter()
            .enumerate()
            .flat_map(|(index, curve)| curve_series(index, curve, 1.0))
            .collect(),
        remarks: curves.iter().filter_map(Curve::remark).map(|remark| format!("! {remark}")).collect(),
    };
    let trace = |curve: &Curve| {
        Trace::through(&curve.arm, curve.points.iter().map(|point| (point.kn, point.mean, point.mean_ci)))
    };
    let read_off = ReadOff::with(Scale::of(&over), Scale::of(quantity.axis()), curves.iter().map(trace));
    Some(Captioned::chart(SWEEP, &format!("Over {over}"), caption, chart).with_read_off(read_off))
}

/// The curves over a key; points have its value in the place of kn, and are in its order.
fn curves_over(summary: &Summary, key: &str, kn: f64) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for entry in summary.arms.iter().filter(|entry| entry.kn_pa_per_m == kn) {
        let Some((name, value)) = summary.sweep.iter().find_map(|arm| curve_of(arm, entry, key)) else {
            continue;
        };
        let point = Point { kn: value, ..Point::of(entry) };
        match curves.iter_mut().find(|curve| curve.arm == name) {
            Some(curve) => {
                curve.random |= entry.random;
                curve.points.push(point);
            }
            None => {
                let (quantity, random) = (entry.shown, entry.random);
                curves.push(Curve { quantity, arm: name, random, points: vec![point] });
            }
        }
    }
    curves.iter_mut().for_each(|curve| curve.points.sort_by(|a, b| a.kn.total_cmp(&b.kn)));
    curves
}

/// The name of the curve that an arm is a point of, and the key's value there.
fn curve_of(arm: &SweptArm, entry: &ArmSummary, key: &str) -> Option<(String, f64)> {
    let at = arm.settings.iter().position(|own| own.key == key).filter(|_| arm.arm == entry.arm)?;
    let others = arm.settings.iter().enumerate().filter(|(other, _)| *other != at);
    let words = others.map(|(_, own)| format!(", {} {}", short(&own.key), own.value));
    Some((format!("{}{}", arm.of, words.collect::<String>()), arm.settings[at].number?))
}

/// The last word of a path.
fn short(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// All arms of a sweep at all kn, with what was set, as CSV.
pub(crate) fn sweep_csv(summary: &Summary) -> Vec<u8> {
    let mut keys: Vec<&str> = Vec::new();
    for own in summary.sweep.iter().flat_map(|arm| &arm.settings) {
        if !keys.contains(&own.key.as_str()) {
            keys.push(&own.key);
        }
    }
    let heads: String = keys.iter().map(|key| format!("{key},")).collect();
    let unit = summary.arms.first().map_or("", |entry| entry.shown.shown_unit());
    let mut csv = Csv::new(format!(
        "arm,made_from,{heads}kn_pa_per_m,walls_in_mean,mean_{unit},mean_low_{unit},mean_high_{unit},sigma_{unit},sigma_low_{unit},\
         sigma_high_{unit},cov,cov_low,cov_high"
    ));
    let shown = |entry: &ArmSummary, value: Option<f64>| value.map(|value| entry.shown.shown(value));
    let both =
        |entry: &ArmSummary, ends: Option<[f64; 2]>| ends.map(|ends| ends.map(|end| entry.shown.shown(end)));
    for entry in &summary.arms {
        let Some(arm) = summary.sweep.iter().find(|arm| arm.arm == entry.arm) else { continue };
        let value =
            |key: &&str| arm.settings.iter().find(|own| own.key == **key).map_or("", |own| &own.value);
        let values: Vec<&str> = keys.iter().map(value).collect();
        let mut cells: Vec<&dyn Cell> = vec![&arm.arm, &arm.of];
        cells.extend(values.iter().map(|value| value as &dyn Cell));
        let (mean, sigma) = (shown(entry, entry.mean), shown(entry, entry.sigma));
        let (mean_ci, sigma_ci) = (both(entry, entry.mean_ci), both(entry, entry.sigma_ci));
        cells.extend([
            &entry.kn_pa_per_m as &dyn Cell,
            &entry.in_mean,
            &mean,
            &mean_ci,
            &sigma,
            &sigma_ci,
            &entry.cov,
            &entry.cov_ci,
        ]);
        csv.line(&cells);
    }
    csv.bytes()
}
