//! A discrepancy that is free to be anything smooth (Kennedy and O'Hagan 2001): a Gaussian process over the tilt for every quantity,
//! in part common to all families. It says which form something has that no cause explains, and how much there is to be gained.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::critic::compare::reading_variance;
use crate::critic::diagnose::design::{Campaign, Design, Seen};
use crate::critic::diagnose::predicted::{Predicted, Score, normal_score};
use crate::math::{degrees, exp, ln};
use crate::stats;
use crate::study::{MeasuredQuantity, Measurement};

/// Over so many degrees of tilt a discrepancy changes.
const LENGTH_DEG: f64 = 5.0;
/// Share of its variance that is common to all families.
const COMMON: f64 = 0.5;
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
}

/// The discrepancy as far as the known readings tell it.
pub struct Discrepancy<'d> {
    all: Vec<At<'d>>,
    known: Vec<usize>,
    /// Covariance of the discrepancy at all readings, in their units.
    smooth: DMatrix<f64>,
    /// That of the readings.
    whole: DMatrix<f64>,
    factored: Cholesky<f64, Dyn>,
    /// Inverse covariance of the known readings times what they are off by.
    weights: DVector<f64>,
}

/// The discrepancy at a reading of a family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bent {
    /// Index of its arm.
    pub family: usize,
    /// What was read.
    pub quantity: MeasuredQuantity,
    /// At which tilt (rad); `None` where the quantity has none of its own.
    pub tilt: Option<f64>,
    /// Measured less base model (SI).
    pub value: f64,
    /// Its standard deviation (SI).
    pub sd: f64,
}

impl<'d> Discrepancy<'d> {
    /// From the known readings of a campaign, what the base model expects of all of them, and its standard deviations of the
    /// readings. A bound tells it nothing. `None` where nothing is known.
    pub fn new(
        design: &'d Design,
        campaign: &Campaign,
        known: &[Vec<bool>],
        base: &Predicted,
        units: &[Vec<f64>],
    ) -> Option<Discrepancy<'d>> {
        let mut all: Vec<At<'d>> = Vec::new();
        for (specimen, own) in design.specimens.iter().enumerate() {
            for (reading, m) in own.readings.iter().enumerate() {
                let seen = campaign.specimens[specimen][reading];
                if seen == Seen::Nothing {
                    continue;
                }
                let mean = stats::mean(&base.reading(specimen, reading))?;
                let (unit, told) = (units[specimen][reading], seen != Seen::Beyond);
                let known = known[specimen][reading] && told;
                all.push(At { place: (specimen, reading), family: own.family, m, seen, unit, mean, known });
            }
        }
        let columns = DMatrix::from_fn(base.walls.len(), all.len(), |draw, k| {
            let (specimen, reading) = all[k].place;
            (base.walls[draw][specimen][reading] - all[k].mean) / all[k].unit
        });
        let mut walls = columns.transpose() * &columns / (base.walls.len() as f64 - 1.0);
        for (k, at) in all.iter().enumerate() {
            let error = reading_variance(at.m) + at.m.common_error * at.m.common_error;
            walls[(k, k)] += error / (at.unit * at.unit) + NUGGET;
        }
        let places: Vec<usize> = (0..all.len()).filter(|&k| all[k].known).collect();
        if places.is_empty() {
            return None;
        }
        let smooth = DMatrix::from_fn(all.len(), all.len(), |a, b| alike(&all[a], &all[b]));
        let off = DVector::from_fn(places.len(), |k, _| {
            let at = &all[places[k]];
            (at.seen.told(at.m).unwrap_or(at.mean) - at.mean) / at.unit
        });
        let tried = TRIED.into_iter().filter_map(|sigma| {
            let smooth = &smooth * (sigma * sigma);
            let whole = &walls + &smooth;
            let factored = part(&whole, &places, &places).cholesky()?;
            let half = (0..places.len()).fold(0.0, |sum, k| sum + ln(factored.l_dirty()[(k, k)]));
            let weights = factored.solve(&off);
            Some((-0.5 * off.dot(&weights) - half, smooth, whole, factored, weights))
        });
        let (_, smooth, whole, factored, weights) = tried.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Discrepancy { all, known: places, smooth, whole, factored, weights })
    }

    /// How the readings that were not known are predicted, by specimen and reading.
    pub fn scores(&self) -> Vec<((usize, usize), Score)> {
        // Bounds that were known are among them: they were not used.
        let out = (0..self.all.len()).filter(|&k| !self.all[k].known);
        out.filter_map(|k| {
            let at = &self.all[k];
            let told = self.told(&self.whole, k);
            let variance = (self.whole[(k, k)] - told.dot(&self.factored.solve(&told))).max(NUGGET);
            let mean = at.mean + at.unit * told.dot(&self.weights);
            let score = normal_score(at.m, at.seen, mean, at.unit * variance.sqrt(), at.unit)?;
            Some((at.place, score))
        })
        .collect()
    }

    /// The discrepancy itself, once for each family, quantity and tilt that was read.
    pub fn form(&self) -> Vec<Bent> {
        let mut form: Vec<Bent> = Vec::new();
        for (k, at) in self.all.iter().enumerate() {
            let alike = |bent: &Bent| {
                bent.family == at.family && bent.quantity == at.m.quantity && bent.tilt == at.m.tilt
            };
            if at.seen == Seen::Beyond || form.iter().any(alike) {
                continue;
            }
            let told = self.told(&self.smooth, k);
            let variance = (self.smooth[(k, k)] - told.dot(&self.factored.solve(&told))).max(0.0);
            form.push(Bent {
                family: at.family,
                quantity: at.m.quantity,
                tilt: at.m.tilt,
                value: at.unit * told.dot(&self.weights),
                sd: at.unit * variance.sqrt(),
            });
        }
        form
    }

    /// Covariances of a reading with those that are known.
    fn told(&self, covariance: &DMatrix<f64>, k: usize) -> DVector<f64> {
        DVector::from_fn(self.known.len(), |j, _| covariance[(k, self.known[j])])
    }
}

/// Correlation of the discrepancies of two readings.
fn alike(a: &At<'_>, b: &At<'_>) -> f64 {
    let kind = |m: &Measurement| match m.quantity {
        MeasuredQuantity::CollapseAngle => 0,
        MeasuredQuantity::DisplacementCentreMinusEnds => 1,
        _ => 2,
    };
    if kind(a.m) != kind(b.m) {
        return 0.0;
    }
    let apart = degrees(a.m.tilt.unwrap_or(0.0) - b.m.tilt.unwrap_or(0.0)) / LENGTH_DEG;
    let families = if a.family == b.family { 1.0 } else { COMMON };
    families * exp(-0.5 * apart * apart)
}

fn part(whole: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), columns.len(), |a, b| whole[(rows[a], columns[b])])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::diagnose::tests::made;
    use crate::critic::diagnose::{Truth, World};
    use crate::random::Streams;

    /// The form of a campaign whose stones' displacements are off by so much (m).
    fn form(world: &World<'_>, design: &Design, off: f64) -> Vec<Bent> {
        let joints = vec![0.0; world.inputs(None)];
        let truth = world.truth(None, &joints);
        let mut campaign = world.campaign(design, &truth, &Streams::new(71, 1));
        for (specimen, seen) in design.specimens.iter().zip(&mut campaign.specimens) {
            for (m, seen) in specimen.readings.iter().zip(seen) {
                if let (1, Some(_), Seen::Value(value)) = (specimen.family, m.tilt, &*seen) {
                    *seen = Seen::Value(value + off);
                }
            }
        }
        let draws: Vec<Truth> = vec![truth; 40];
        let base = Predicted::of(world, design, &draws, 72);
        let known: Vec<Vec<bool>> = design.specimens.iter().map(|s| vec![true; s.readings.len()]).collect();
        let units: Vec<Vec<f64>> = design
            .specimens
            .iter()
            .map(|s| s.readings.iter().map(|m| if m.tilt.is_some() { 2e-3 } else { 0.01 }).collect())
            .collect();
        Discrepancy::new(design, &campaign, &known, &base, &units).expect("readings").form()
    }

    #[test]
    fn what_is_lacking_is_found_where_it_is_and_with_its_size() {
        let made = made();
        let (world, (design, _)) = (made.world(), Design::of(&made.study));
        let sure = |bent: &&Bent| bent.value.abs() > 2.0 * bent.sd;
        let bent = form(&world, &design, 8e-3);
        let own: Vec<&Bent> = bent.iter().filter(|b| b.family == 1 && b.tilt.is_some()).collect();
        assert!(!own.is_empty() && own.iter().copied().filter(|b| sure(b)).count() == own.len(), "{own:?}");
        // Three readings of 1.7 mm each, and what a smooth curve shrinks it by.
        assert!(own.iter().all(|b| (b.value - 8e-3).abs() < 3e-3), "{own:?}");
        assert!(bent.iter().filter(|b| b.tilt.is_none()).filter(sure).count() == 0, "{bent:?}");
        assert!(form(&world, &design, 0.0).iter().filter(sure).count() == 0);
    }
}
