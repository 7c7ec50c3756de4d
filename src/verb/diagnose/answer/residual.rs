//! How far readings and groups lie from the base model, in the units of files.

use crate::critic::{Expected, Group, Residual, Seen, Side};
use crate::study::{MeasuredKind, MeasuredQuantity, Study};
use crate::verb::run::answer::measured::{in_unit, tidy_degrees, tidy_percent, unit};

/// What the base model shows of a number.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ExpectedEntry {
    /// Mean.
    pub mean: f64,
    /// Median; of a reading without errors, of a group's mean with the errors of its readings.
    pub median: f64,
    /// What half of the simulated numbers lie in.
    pub band_50: [f64; 2],
    /// What nine in ten of them lie in.
    pub band_90: [f64; 2],
    /// Standard deviation of measured less simulated, of which the three below are parts.
    pub sd: f64,
    /// Part of the readings: errors, rounding.
    pub sd_measurement: f64,
    /// Part of the stones.
    pub sd_scatter: f64,
    /// Part of the parameters: joints within their priors.
    pub sd_parameters: f64,
}

/// A reading.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ResidualEntry {
    /// Its line in the file.
    pub line: usize,
    /// Its specimen.
    pub specimen: String,
    /// The arm.
    pub family: String,
    /// Whether the ends of the arm's walls are held.
    pub ends_held: bool,
    /// Weight of one of their stones as it is stated, in the mean over a wall.
    pub stone_weight_n: f64,
    /// What was measured.
    pub quantity: &'static str,
    /// Tilt of the reading; null where the quantity has none of its own.
    pub tilt_deg: Option<f64>,
    /// Drift of the reading; left out where the quantity has none of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift_percent: Option<f64>,
    /// Unit of all numbers below that have one.
    pub unit: &'static str,
    /// How the value is to be read: exact, rounded, or a bound.
    pub kind: MeasuredKind,
    /// The value or the bound.
    pub measured: f64,
    /// What the base model shows; null where too few simulated walls stand.
    pub simulated: Option<ExpectedEntry>,
    /// Share of the simulated walls that had fallen.
    pub fallen_share: f64,
    /// Measured less simulated mean, in standard deviations; null for a bound.
    pub in_sd: Option<f64>,
    /// Share of the simulated readings that lie on the bound's side; null without a bound.
    pub agreeing_share: Option<f64>,
    /// Place of the specimen in the order of the tests.
    pub order: Option<u32>,
}

/// The mean over the specimens of a family of one quantity at one tilt or drift.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct GroupEntry {
    /// The arm.
    pub family: String,
    /// What was measured.
    pub quantity: &'static str,
    /// Tilt of the readings; null where the quantity has none of its own.
    pub tilt_deg: Option<f64>,
    /// Drift of the readings; left out where the quantity has none of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift_percent: Option<f64>,
    /// Unit of all numbers below that have one.
    pub unit: &'static str,
    /// Number of readings.
    pub readings: usize,
    /// Of these, so many are known to be below a bound and no more.
    pub below: usize,
    /// And so many to be above one.
    pub above: usize,
    /// Their mean, a bound as if it were the value; null where nothing was seen.
    pub measured: Option<f64>,
    /// What the base model shows; null where too few simulated walls stand.
    pub simulated: Option<ExpectedEntry>,
    /// Share of the simulated walls that had fallen.
    pub fallen_share: f64,
    /// Measured less simulated mean, in standard deviations; null where a bound is among the readings.
    pub in_sd: Option<f64>,
    /// Share of the simulated readings that lie on the bounds' sides; null without bounds.
    pub agreeing_share: Option<f64>,
    /// Share of simulated campaigns whose mean is as far off; not corrected for the number of groups.
    pub p_value: Option<f64>,
    /// within, above or below what nine in ten simulated campaigns show.
    pub stands: &'static str,
}

impl ExpectedEntry {
    fn of(expected: &Expected, quantity: MeasuredQuantity) -> ExpectedEntry {
        let number = |x: f64| in_unit(quantity, x);
        let Expected { mean, parts, band } = expected;
        ExpectedEntry {
            mean: number(*mean),
            median: number(band.median),
            band_50: band.half.map(number),
            band_90: band.most.map(number),
            sd: number(parts.sd()),
            sd_measurement: number(parts.measurement),
            sd_scatter: number(parts.scatter),
            sd_parameters: number(parts.parameters),
        }
    }
}

impl ResidualEntry {
    /// From a residual.
    pub fn of(study: &Study, residual: &Residual) -> ResidualEntry {
        let m = &residual.reading;
        let value = if let Seen::Value(value) = residual.seen { value } else { m.value };
        ResidualEntry {
            line: m.line,
            specimen: m.specimen.clone(),
            family: study.arms[residual.family].name.clone(),
            ends_held: residual.held,
            stone_weight_n: residual.stone_weight,
            quantity: m.quantity.name(),
            tilt_deg: m.tilt.map(tidy_degrees),
            drift_percent: m.drift.map(tidy_percent),
            unit: unit(m.quantity),
            kind: m.kind,
            measured: in_unit(m.quantity, value),
            simulated: residual.expected.map(|expected| ExpectedEntry::of(&expected, m.quantity)),
            fallen_share: residual.fallen,
            in_sd: residual.in_sd,
            agreeing_share: residual.agreeing,
            order: m.order,
        }
    }
}

impl GroupEntry {
    /// From a group.
    pub fn of(study: &Study, group: &Group) -> GroupEntry {
        GroupEntry {
            family: study.arms[group.family].name.clone(),
            quantity: group.quantity.name(),
            tilt_deg: group.tilt.map(tidy_degrees),
            drift_percent: group.drift.map(tidy_percent),
            unit: unit(group.quantity),
            readings: group.seen,
            below: group.below,
            above: group.above,
            measured: group.measured.map(|x| in_unit(group.quantity, x)),
            simulated: group.expected.map(|expected| ExpectedEntry::of(&expected, group.quantity)),
            fallen_share: group.fallen,
            in_sd: group.in_sd,
            agreeing_share: group.agreeing,
            p_value: group.p_value,
            stands: match group.side {
                Side::Within => "within",
                Side::Above => "above",
                Side::Below => "below",
            },
        }
    }
}
