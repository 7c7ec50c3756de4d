//! One line of the comparison, in the units of files.

use crate::critic::{Beside, Ours, Walls};
use crate::math::degrees;
use crate::stats::Summary;
use crate::study::MeasuredQuantity;
use crate::study::measured::Dimension;

/// One quantity of one family at one tilt and one kn. Intervals are at 95 %; what is not defined is null.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ComparisonEntry {
    /// The arm.
    pub family: String,
    /// What was measured.
    pub quantity: &'static str,
    /// Tilt of the reading; null where the quantity has none of its own.
    pub tilt_deg: Option<f64>,
    /// Drift of the reading; only where the quantity has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift_percent: Option<f64>,
    /// Unit of all numbers below that have one.
    pub unit: &'static str,
    /// Normal stiffness of the joints of our walls (Pa/m); null where there are none.
    pub kn_pa_per_m: Option<f64>,
    /// The measured values.
    pub measured: MomentsEntry,
    /// Measured values of which only an upper bound is known; in no statistic.
    pub measured_below: u64,
    /// Measured values of which only a lower bound is known.
    pub measured_above: u64,
    /// Error of the measured mean that comes from the readings, one standard deviation.
    pub measured_mean_error: Option<f64>,
    /// Our walls.
    pub simulated: MomentsEntry,
    /// Our walls that fell before the tilt of the reading; in no statistic.
    pub fell_before: u64,
    /// Our walls that stood to the end of the load path.
    pub stood_to_the_end: u64,
    /// Our walls that the solver lost or that could not be built.
    pub lost: u64,
    /// Simulated mean less measured mean.
    pub difference: Option<f64>,
    /// Its standard deviation, of which the three below are parts.
    pub difference_sd: Option<f64>,
    /// Part of the readings' errors.
    pub difference_sd_measurement: Option<f64>,
    /// Part of the scatter between specimens.
    pub difference_sd_scatter: Option<f64>,
    /// Part of the sampling error of our mean.
    pub difference_sd_ensemble: Option<f64>,
    /// The difference over its standard deviation.
    pub difference_in_sd: Option<f64>,
    /// Share of our walls that agree with the measured bounds.
    pub agreeing_share: Option<f64>,
    /// Why there is nothing of ours; null where there is.
    pub note: Option<&'static str>,
}

/// Mean, sigma and COV with their intervals.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct MomentsEntry {
    /// Number of values.
    pub n: u64,
    /// Mean.
    pub mean: Option<f64>,
    /// Its interval (Student's t).
    pub mean_ci: Option<[f64; 2]>,
    /// Standard deviation.
    pub sigma: Option<f64>,
    /// Its interval (chi-square).
    pub sigma_ci: Option<[f64; 2]>,
    /// Coefficient of variation, a fraction.
    pub cov: Option<f64>,
    /// Its interval (modified McKay, Vangel 1996).
    pub cov_ci: Option<[f64; 2]>,
}

impl ComparisonEntry {
    /// From a line of the comparison.
    pub fn of(line: &Beside) -> Self {
        let quantity = line.quantity;
        let number = |x: f64| in_unit(quantity, x);
        let (walls, note) = match &line.ours {
            Ours::Walls(walls) => (Some(walls), None),
            Ours::None(why) => (None, Some(*why)),
        };
        let count = |of: fn(&Walls) -> u64| walls.map_or(0, of);
        let difference = walls.and_then(|walls| walls.difference);
        ComparisonEntry {
            family: line.family.clone(),
            quantity: quantity.name(),
            tilt_deg: line.tilt.map(tidy_degrees),
            drift_percent: line.drift.map(tidy_percent),
            unit: unit(quantity),
            kn_pa_per_m: walls.map(|walls| walls.kn),
            measured: MomentsEntry::of(&line.measured.values, quantity),
            measured_below: line.measured.below,
            measured_above: line.measured.above,
            measured_mean_error: line.measured.error.map(number),
            simulated: MomentsEntry::of(
                &walls.map_or_else(|| Summary::of(&[]), |walls| walls.values),
                quantity,
            ),
            fell_before: count(|walls| walls.fell_before),
            stood_to_the_end: count(|walls| walls.stood),
            lost: count(|walls| walls.lost),
            difference: difference.map(|d| number(d.value)),
            difference_sd: difference.map(|d| number(d.sd())),
            difference_sd_measurement: difference.map(|d| number(d.measurement)),
            difference_sd_scatter: difference.map(|d| number(d.scatter)),
            difference_sd_ensemble: difference.map(|d| number(d.ensemble)),
            difference_in_sd: difference.map(|d| d.in_sd()),
            agreeing_share: walls.and_then(|walls| walls.agreeing),
            note,
        }
    }
}

impl MomentsEntry {
    fn of(values: &Summary, quantity: MeasuredQuantity) -> Self {
        let number = |x: f64| in_unit(quantity, x);
        MomentsEntry {
            n: values.n as u64,
            mean: values.mean.value.map(number),
            mean_ci: values.mean.interval.map(|ci| ci.map(number)),
            sigma: values.sigma.value.map(number),
            sigma_ci: values.sigma.interval.map(|ci| ci.map(number)),
            cov: values.cov.value,
            cov_ci: values.cov.interval,
        }
    }
}

/// Unit of a quantity in files.
pub fn unit(quantity: MeasuredQuantity) -> &'static str {
    match quantity.dimension() {
        Dimension::Length => "m",
        Dimension::Angle => "deg",
        Dimension::Stiffness => "Pa/m",
        Dimension::Force => "N",
        Dimension::Outcome => "1",
    }
}

/// An SI number in that unit.
pub fn in_unit(quantity: MeasuredQuantity, x: f64) -> f64 {
    if quantity.dimension() == Dimension::Angle { tidy_degrees(x) } else { x }
}

/// Percents to a billionth, as degrees are.
pub fn tidy_percent(share: f64) -> f64 {
    (share * 1e11).round() / 1e9
}

/// Degrees to a billionth: an angle that was written as 13.5 is 13.5 again.
pub fn tidy_degrees(angle: f64) -> f64 {
    (degrees(angle) * 1e9).round() / 1e9
}
