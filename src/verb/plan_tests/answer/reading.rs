//! What might be read of a specimen: the quantity of the study, and displacements on the way.

use std::collections::BTreeMap;

use crate::ensemble::{Observed, Quantity, Row, StepRow};
use crate::math::degrees;
use crate::render::number::significant;
use crate::study::{MeasuredQuantity, Measurement, Study};
use crate::verb::plan_tests::answer::Asked;

/// Levels of a load are the same within this.
const SAME_LEVEL: f64 = 1e-9;
/// So many levels of a load are looked at, spread over those that all walls reach.
const LEVELS: usize = 12;

/// A reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What is read.
    pub name: String,
    /// The unit in which it is shown, and how many of them one of its own unit is.
    pub unit: &'static str,
    /// See `unit`.
    pub shown: f64,
    /// Whether it is the quantity that the study is about.
    pub is_quantity: bool,
    /// Standard deviation of the error of the instrument, in the reading's own unit.
    pub error: f64,
    /// By arm, the values of its walls by member.
    pub values: Vec<BTreeMap<u64, f64>>,
}

/// What specimens of a family were read, in the unit of the quantity; none where only displacements on the way were, or bounds.
pub fn specimens(study: &Study, quantity: Quantity, family: &str) -> Vec<f64> {
    let is_one = |m: &&Measurement| {
        m.family == family && m.quantity == MeasuredQuantity::CollapseAngle && !m.kind.is_censored()
    };
    match quantity {
        Quantity::CollapseAngle => study.measured.iter().filter(is_one).map(|m| degrees(m.value)).collect(),
        _ => Vec::new(),
    }
}

/// The readings that the walls of a study allow, at one kn point: its quantity, then displacements at levels that all walls with a value
/// of the quantity came to rest at.
pub fn readings(study: &Study, rows: &[Row], asked: &Asked) -> Vec<Reading> {
    let quantity = Quantity::of(study);
    let own: Vec<&Row> = rows.iter().filter(|row| row.point == asked.point).collect();
    let by_arm = |value: &dyn Fn(&Row) -> Option<f64>| -> Vec<BTreeMap<u64, f64>> {
        let of = |arm: usize| {
            let own = own.iter().filter(|row| row.arm_index as usize == arm);
            own.filter_map(|row| Some((row.member, value(row)?))).collect()
        };
        (0..study.arms.len()).map(of).collect()
    };
    let value = |row: &Row| match quantity.observed(row) {
        Observed::Value(value) => Some(value),
        Observed::Above(_) | Observed::Nothing => None,
    };
    let error = match quantity {
        Quantity::CollapseAngle => asked.error_deg,
        Quantity::TopDisplacement => asked.error_m,
        // A load cell, and a shaking table, are exact beside the scatter of walls.
        Quantity::ShearCapacity
        | Quantity::LoadFactor
        | Quantity::CollapseIntensity(_)
        | Quantity::RetainedHeight => 0.0,
    };
    let mut all = vec![Reading {
        name: quantity.name().replace('_', " "),
        unit: quantity.shown_unit(),
        shown: quantity.shown(1.0),
        is_quantity: true,
        error,
        values: by_arm(&value),
    }];
    let told: Vec<&Row> = own.iter().copied().filter(|row| value(row).is_some()).collect();
    for (level, words) in levels(&told) {
        let displacement =
            |row: &Row| value(row).and_then(|_| at(row, level)).and_then(|step| step.top.top_displacement_m);
        let values = by_arm(&displacement);
        all.push(Reading {
            name: words,
            unit: "mm",
            shown: 1e3,
            is_quantity: false,
            error: asked.error_m,
            values,
        });
    }
    all
}

/// Levels of the load at which all these walls came to rest, beyond none, with what is read there. The last one of a displacement is the
/// quantity itself.
fn levels(rows: &[&Row]) -> Vec<(f64, String)> {
    let Some(first) = rows.first() else { return Vec::new() };
    let all = first.load_steps.iter().filter_map(level).filter(|level| *level > 0.0);
    let shared = |level: &f64| {
        rows.iter().all(|row| at(row, *level).is_some_and(|step| step.top.top_displacement_m.is_some()))
    };
    let mut shared: Vec<f64> = all.filter(shared).collect();
    shared.sort_by(f64::total_cmp);
    shared.dedup();
    let every = shared.len().div_ceil(LEVELS).max(1);
    // The highest ones tell most: they are counted from the end.
    let mut chosen: Vec<f64> = shared.into_iter().rev().step_by(every).collect();
    chosen.reverse();
    let is_tilt = first.load_steps.iter().any(|step| step.tilt_deg.is_some());
    let words = |level: f64| match is_tilt {
        true => format!("displacement at {} deg", significant(level, 3)),
        false => format!("displacement at {} of the load", significant(level, 2)),
    };
    chosen.into_iter().map(|level| (level, words(level))).collect()
}

/// The tilt, or the share of a service load. A push along a wall is read by its capacity.
fn level(step: &StepRow) -> Option<f64> {
    step.tilt_deg.or(step.load_factor)
}

/// The step of a wall at a level.
fn at(row: &Row, wanted: f64) -> Option<&StepRow> {
    row.load_steps.iter().find(|step| level(step).is_some_and(|own| (own - wanted).abs() < SAME_LEVEL))
}
