//! A model discrepancy that may be anything smooth (Kennedy and O'Hagan 2001): Gaussian processes over the tilt for every quantity
//! and for what the left end has more than the right and the centre more than the ends, in part common to all families, and a straight
//! line over the order of the tests. It shows the components of what no cause explains, and how much there is to be gained.

#[cfg(test)]
mod tests;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::critic::compare::reading_variance;
use crate::critic::discrepancy::predicted::{Predicted, Score, normal_score};
use crate::critic::simulate::{Campaign, Design, Seen};
use crate::math::{degrees, exp, ln};
use crate::stats;
use crate::study::{MeasuredQuantity, Measurement};

/// Over so many degrees of tilt a discrepancy changes.
const LENGTH_DEG: f64 = 5.0;
/// Over so large a factor on the drift (its logarithm) one does.
const LENGTH_LN_DRIFT: f64 = 1.0;
/// Share of its variance that is common to all families.
const COMMON: f64 = 0.5;
/// Variance of the left end less that of the middle, of the centre less that of the mean, and of the last test less that of a middle
/// one, in that of a reading's level.
const TWISTING: f64 = 0.5;
const BENDING: f64 = 0.5;
const DRIFTING: f64 = 0.5;
/// Standard deviations of the discrepancy that are tried, in those of the base model's readings; the likeliest is taken.
const TRIED: [f64; 7] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];
/// Variance (in those units) that no reading is without, so that covariances can be factored.
const NUGGET: f64 = 1e-6;

/// A reading that was seen.
struct At<'d> {
    place: (usize, usize),
    family: usize,
    m: &'d Measurement,
    seen: Seen,
    /// The base model's standard deviation of it.
    unit: f64,
    /// What the base model expects.
    mean: f64,
    known: bool,
    /// 1 for the left end, -1 for the right one.
    side: f64,
    /// What a bow moves it by: 1 at the centre, -1/2 at the ends.
    bow: f64,
    /// Where the test lies in the order of all: -1 the first, 1 the last; 0 where that is not known.
    order: f64,
}

/// The discrepancy, given the known readings.
pub struct SmoothDiscrepancy<'d> {
    all: Vec<At<'d>>,
    known: Vec<usize>,
    /// Covariances of the discrepancy at all readings, part by part, in units of its variance.
    smooth: [DMatrix<f64>; 4],
    /// That variance, in the readings' units.
    variance: f64,
    /// Covariance of the readings.
    whole: DMatrix<f64>,
    factored: Cholesky<f64, Dyn>,
    /// Inverse covariance of the known readings times what they are off by.
    weights: DVector<f64>,
    /// From the middle of the tests to the last (tests).
    half: f64,
}

/// The components of a discrepancy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Of readings as they are, whatever the order of the tests.
    Level,
    /// Of the left end less the right one.
    Twist,
    /// Of the centre less the mean of the ends, where these were read each.
    Bow,
    /// Of a reading from each test to the next.
    Drift,
}

/// A component of the discrepancy at a reading of a family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComponentEstimate {
    /// Which component.
    pub part: Component,
    /// Index of the family's arm.
    pub family: usize,
    /// What was read; of a twist the left end's displacement, of a bow the centre's.
    pub quantity: MeasuredQuantity,
    /// At which tilt (rad); `None` where the quantity has none of its own.
    pub tilt: Option<f64>,
    /// At which drift; `None` where the quantity has none of its own.
    pub drift: Option<f64>,
    /// Measured less base model (SI).
    pub value: f64,
    /// Its standard deviation (SI).
    pub sd: f64,
}

impl<'d> SmoothDiscrepancy<'d> {
    /// From the known readings of a campaign, what the base model expects of all of them, and its standard deviations of the
    /// readings. A bound adds nothing. `None` where nothing is known.
    pub fn new(
        design: &'d Design,
        campaign: &Campaign,
        known: &[Vec<bool>],
        base: &Predicted,
        units: &[Vec<f64>],
    ) -> Option<SmoothDiscrepancy<'d>> {
        let mut all: Vec<At<'d>> = Vec::new();
        let orders = || design.specimens.iter().filter_map(|specimen| specimen.order).map(f64::from);
        let (first, last) = (orders().fold(f64::INFINITY, f64::min), orders().fold(0.0, f64::max));
        let half = 0.5 * (last - first).max(0.0);
        for (specimen, own) in design.specimens.iter().enumerate() {
            for (reading, m) in own.readings.iter().enumerate() {
                let seen = campaign.specimens[specimen][reading];
                if seen == Seen::Nothing {
                    continue;
                }
                let mean = stats::mean(&base.reading(specimen, reading))?;
                let (unit, is_value) = (units[specimen][reading], seen != Seen::Beyond);
                let known = known[specimen][reading] && is_value;
                let (side, bow) = match m.quantity {
                    MeasuredQuantity::DisplacementLeft | MeasuredQuantity::RemainderLeft => (1.0, -0.5),
                    MeasuredQuantity::DisplacementRight | MeasuredQuantity::RemainderRight => (-1.0, -0.5),
                    MeasuredQuantity::DisplacementCentre | MeasuredQuantity::RemainderCentre => (0.0, 1.0),
                    _ => (0.0, 0.0),
                };
                let order = own.order.map_or(0.0, |order| (f64::from(order) - first) / half.max(0.5) - 1.0);
                let place = (specimen, reading);
                all.push(At { place, family: own.family, m, seen, unit, mean, known, side, bow, order });
            }
        }
        let columns = DMatrix::from_fn(base.walls.len(), all.len(), |draw, k| {
            let (specimen, reading) = all[k].place;
            (base.walls[draw][specimen][reading] - all[k].mean) / all[k].unit
        });
        let mut walls = columns.transpose() * &columns / (base.walls.len() as f64 - 1.0);
        for (k, at) in all.iter().enumerate() {
            walls[(k, k)] += reading_variance(at.m) / (at.unit * at.unit) + NUGGET;
            let shares_error = |other: &At<'_>| other.m.quantity.instrument() == at.m.quantity.instrument();
            for (j, other) in all.iter().enumerate().filter(|(_, other)| shares_error(other)) {
                walls[(k, j)] += at.m.common_error / at.unit * (other.m.common_error / other.unit);
            }
        }
        let places: Vec<usize> = (0..all.len()).filter(|&k| all[k].known).collect();
        if places.is_empty() {
            return None;
        }
        let smooth = PARTS
            .map(|part| DMatrix::from_fn(all.len(), all.len(), |a, b| covariance(part, &all[a], &all[b])));
        let off = DVector::from_fn(places.len(), |k, _| {
            let at = &all[places[k]];
            (at.seen.number(at.m).unwrap_or(at.mean) - at.mean) / at.unit
        });
        let tried = TRIED.into_iter().filter_map(|sigma| {
            let variance = sigma * sigma;
            let whole = smooth.iter().fold(walls.clone(), |whole, part| whole + part * variance);
            let factored = part(&whole, &places, &places).cholesky()?;
            let half = (0..places.len()).fold(0.0, |sum, k| sum + ln(factored.l_dirty()[(k, k)]));
            let weights = factored.solve(&off);
            Some((-0.5 * off.dot(&weights) - half, variance, whole, factored, weights))
        });
        let (_, variance, whole, factored, weights) = tried.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(SmoothDiscrepancy { all, known: places, smooth, variance, whole, factored, weights, half })
    }

    /// How the readings that were not known are predicted, by specimen and reading.
    pub fn scores(&self) -> Vec<((usize, usize), Score)> {
        // Bounds that were known are among them: they were not used.
        let out = (0..self.all.len()).filter(|&k| !self.all[k].known);
        out.filter_map(|k| {
            let at = &self.all[k];
            let with_known = self.with_known(&self.whole, k);
            let variance =
                (self.whole[(k, k)] - with_known.dot(&self.factored.solve(&with_known))).max(NUGGET);
            let mean = at.mean + at.unit * with_known.dot(&self.weights);
            let score = normal_score(at.m, at.seen, mean, at.unit * variance.sqrt(), at.unit)?;
            Some((at.place, score))
        })
        .collect()
    }

    /// The discrepancy itself: of each quantity once for each family and tilt that was read, its twist once for each at which both
    /// ends were, its bow at which the centre and an end were; and of each kind of quantity its drift at the first reading, where the
    /// order of the tests is known. A drift goes as the readings' standard deviations do, and so is another one at another reading.
    pub fn components(&self) -> Vec<ComponentEstimate> {
        let mut components: Vec<ComponentEstimate> = Vec::new();
        for (k, at) in self.all.iter().enumerate().filter(|(_, at)| at.seen != Seen::Beyond) {
            let (family, quantity, place) = (at.family, at.m.quantity, at.m.at());
            let beside = |is: fn(&At<'_>) -> bool| {
                self.all.iter().position(|other| {
                    other.seen != Seen::Beyond
                        && (other.family, other.m.at()) == (family, place)
                        && kind(other.m.quantity) == kind(quantity)
                        && is(other)
                })
            };
            let mut add = |part: Component, of: &[(usize, f64)]| {
                let is_there = |estimate: &ComponentEstimate| {
                    let own = estimate.tilt.or(estimate.drift);
                    let same = (estimate.family, own, estimate.quantity) == (family, place, quantity);
                    estimate.part == part
                        && (same || part == Component::Drift && kind(estimate.quantity) == kind(quantity))
                };
                if !components.iter().any(is_there) {
                    let (value, sd) =
                        self.estimate(if part == Component::Drift { &PARTS[3..] } else { &PARTS[..3] }, of);
                    let (tilt, drift) = (at.m.tilt, at.m.drift);
                    components.push(ComponentEstimate { part, family, quantity, tilt, drift, value, sd });
                }
            };
            add(Component::Level, &[(k, 1.0)]);
            let ends: Vec<usize> = [beside(|other| other.side > 0.0), beside(|other| other.side < 0.0)]
                .into_iter()
                .flatten()
                .collect();
            match ends[..] {
                [_, right] if at.side > 0.0 => add(Component::Twist, &[(k, 1.0), (right, -1.0)]),
                [_, ..] if at.bow > 0.0 => {
                    let share = -1.0 / ends.len() as f64;
                    let ends = ends.iter().map(|end| (*end, share));
                    add(Component::Bow, &std::iter::once((k, 1.0)).chain(ends).collect::<Vec<_>>());
                }
                _ => {}
            }
            if at.order.abs() == 1.0 && self.half > 0.0 {
                add(Component::Drift, &[(k, at.order / self.half)]);
            }
        }
        components
    }

    /// Some components of the discrepancy together, summed over readings that each count so often, and the sum's standard
    /// deviation (SI).
    fn estimate(&self, parts: &[Component], of: &[(usize, f64)]) -> (f64, f64) {
        let of: Vec<(usize, f64)> = of.iter().map(|(k, times)| (*k, times * self.all[*k].unit)).collect();
        let with = |other: usize| {
            let one = |(k, times): &(usize, f64)| {
                times * parts.iter().fold(0.0, |sum, part| sum + self.smooth[*part as usize][(*k, other)])
            };
            self.variance * of.iter().fold(0.0, |sum, own| sum + one(own))
        };
        let with_known = DVector::from_fn(self.known.len(), |j, _| with(self.known[j]));
        let before = of.iter().fold(0.0, |sum, (k, times)| sum + times * with(*k));
        let variance = (before - with_known.dot(&self.factored.solve(&with_known))).max(0.0);
        (with_known.dot(&self.weights), variance.sqrt())
    }

    /// Covariances of a reading with those that are known.
    fn with_known(&self, covariance: &DMatrix<f64>, k: usize) -> DVector<f64> {
        DVector::from_fn(self.known.len(), |j, _| covariance[(k, self.known[j])])
    }
}

/// All of them, as they are numbered.
const PARTS: [Component; 4] = [Component::Level, Component::Twist, Component::Bow, Component::Drift];

/// Quantities of different kinds have nothing in common.
fn kind(quantity: MeasuredQuantity) -> u8 {
    match quantity {
        MeasuredQuantity::CollapseAngle => 0,
        MeasuredQuantity::DisplacementCentreMinusEnds => 1,
        MeasuredQuantity::RemainderCentreMinusEnds => 2,
        other if other.is_remainder() => 3,
        _ => 4,
    }
}

/// Covariance of a component of the discrepancies of two readings, in the variance of a level.
fn covariance(part: Component, a: &At<'_>, b: &At<'_>) -> f64 {
    if kind(a.m.quantity) != kind(b.m.quantity) {
        return 0.0;
    }
    let apart = match (a.m.drift, b.m.drift) {
        (Some(one), Some(other)) => ln(one / other) / LENGTH_LN_DRIFT,
        _ => degrees(a.m.tilt.unwrap_or(0.0) - b.m.tilt.unwrap_or(0.0)) / LENGTH_DEG,
    };
    let families = if a.family == b.family { 1.0 } else { COMMON };
    let over_the_tilt = families * exp(-0.5 * apart * apart);
    match part {
        Component::Level => over_the_tilt,
        Component::Twist => TWISTING * a.side * b.side * over_the_tilt,
        Component::Bow => BENDING * a.bow * b.bow * over_the_tilt,
        Component::Drift => DRIFTING * a.order * b.order,
    }
}

fn part(whole: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), columns.len(), |a, b| whole[(rows[a], columns[b])])
}
