//! A model discrepancy that may be anything smooth (Kennedy and O'Hagan 2001): Gaussian processes over the tilt for every quantity
//! and for what the left end has more than the right and the centre more than the ends, in part common to all families, and a straight
//! line over the order of the tests. It shows the components of what no cause explains, and how much there is to be gained.

#[cfg(test)]
mod tests;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::critic::compare::reading_variance;
use crate::critic::discrepancy::form::{Component, Lies, PARTS, half_of_order, kind};
use crate::critic::discrepancy::predicted::{Predicted, Score, normal_score};
use crate::critic::simulate::{Campaign, Design, Seen};
use crate::math::ln;
use crate::stats;
use crate::study::MeasuredQuantity;

/// Standard deviations of the discrepancy that are tried, in those of the base model's readings; the likeliest is taken.
const TRIED: [f64; 7] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];
/// Variance (in those units) that no reading is without, so that covariances can be factored.
const NUGGET: f64 = 1e-6;

/// A reading that was seen.
struct At<'d> {
    place: (usize, usize),
    lies: Lies<'d>,
    seen: Seen,
    /// The base model's standard deviation of it.
    unit: f64,
    /// What the base model expects.
    mean: f64,
    known: bool,
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
        let half = half_of_order(design);
        for (place, lies) in Lies::all(design) {
            let (specimen, reading) = place;
            let seen = campaign.specimens[specimen][reading];
            if seen == Seen::Nothing {
                continue;
            }
            let mean = stats::mean(&base.reading(specimen, reading))?;
            let (unit, is_value) = (units[specimen][reading], seen.is_value());
            let known = known[specimen][reading] && is_value;
            all.push(At { place, lies, seen, unit, mean, known });
        }
        let columns = DMatrix::from_fn(base.walls.len(), all.len(), |draw, k| {
            let (specimen, reading) = all[k].place;
            (base.walls[draw][specimen][reading] - all[k].mean) / all[k].unit
        });
        let mut walls = columns.transpose() * &columns / (base.walls.len() as f64 - 1.0);
        for (k, at) in all.iter().enumerate() {
            walls[(k, k)] += reading_variance(at.lies.m) / (at.unit * at.unit) + NUGGET;
            let shares_error =
                |other: &At<'_>| other.lies.m.quantity.instrument() == at.lies.m.quantity.instrument();
            for (j, other) in all.iter().enumerate().filter(|(_, other)| shares_error(other)) {
                walls[(k, j)] += at.lies.m.common_error / at.unit * (other.lies.m.common_error / other.unit);
            }
        }
        let places: Vec<usize> = (0..all.len()).filter(|&k| all[k].known).collect();
        if places.is_empty() {
            return None;
        }
        let smooth = PARTS.map(|part| {
            DMatrix::from_fn(all.len(), all.len(), |a, b| all[a].lies.covariance(part, &all[b].lies))
        });
        let off = DVector::from_fn(places.len(), |k, _| {
            let at = &all[places[k]];
            (at.seen.number(at.lies.m).unwrap_or(at.mean) - at.mean) / at.unit
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
            let score = normal_score(at.lies.m, at.seen, mean, at.unit * variance.sqrt(), at.unit)?;
            Some((at.place, score))
        })
        .collect()
    }

    /// The discrepancy itself: of each quantity once for each family and tilt that was read, its twist once for each at which both
    /// ends were, its bow at which the centre and an end were; and of each kind of quantity its drift at the first reading, where the
    /// order of the tests is known. A drift goes as the readings' standard deviations do, and so is another one at another reading.
    pub fn components(&self) -> Vec<ComponentEstimate> {
        let mut components: Vec<ComponentEstimate> = Vec::new();
        for (k, at) in self.all.iter().enumerate().filter(|(_, at)| at.seen.is_value()) {
            let (family, quantity, place) = (at.lies.family, at.lies.m.quantity, at.lies.m.at());
            let beside = |is: fn(&At<'_>) -> bool| {
                self.all.iter().position(|other| {
                    other.seen.is_value()
                        && (other.lies.family, other.lies.m.at()) == (family, place)
                        && kind(other.lies.m.quantity) == kind(quantity)
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
                    let (tilt, drift) = (at.lies.m.tilt, at.lies.m.drift);
                    components.push(ComponentEstimate { part, family, quantity, tilt, drift, value, sd });
                }
            };
            add(Component::Level, &[(k, 1.0)]);
            let ends: Vec<usize> =
                [beside(|other| other.lies.side > 0.0), beside(|other| other.lies.side < 0.0)]
                    .into_iter()
                    .flatten()
                    .collect();
            match ends[..] {
                [_, right] if at.lies.side > 0.0 => add(Component::Twist, &[(k, 1.0), (right, -1.0)]),
                [_, ..] if at.lies.bow > 0.0 => {
                    let share = -1.0 / ends.len() as f64;
                    let ends = ends.iter().map(|end| (*end, share));
                    add(Component::Bow, &std::iter::once((k, 1.0)).chain(ends).collect::<Vec<_>>());
                }
                _ => {}
            }
            if at.lies.order.abs() == 1.0 && self.half > 0.0 {
                add(Component::Drift, &[(k, at.lies.order / self.half)]);
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

fn part(whole: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), columns.len(), |a, b| whole[(rows[a], columns[b])])
}
