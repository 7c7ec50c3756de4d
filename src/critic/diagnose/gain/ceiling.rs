//! How much there is to be gained: the base model with a discrepancy that is free to be anything smooth (Kennedy and O'Hagan
//! 2001), a Gaussian process over the tilt for every quantity, in part common to all families.

use nalgebra::{DMatrix, DVector};

use crate::critic::compare::reading_variance;
use crate::critic::diagnose::design::{Campaign, Design};
use crate::critic::diagnose::gain::fold::Fold;
use crate::critic::diagnose::gain::predicted::{Predicted, Score, normal_score};
use crate::math::{degrees, exp, ln};
use crate::study::{MeasuredQuantity, Measurement};

/// Over so many degrees of tilt a discrepancy changes.
const LENGTH_DEG: f64 = 5.0;
/// Share of its variance that is common to all families.
const COMMON: f64 = 0.5;
/// Standard deviations of the discrepancy that are tried, in those of the base model's readings; the likeliest is taken.
const TRIED: [f64; 7] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// A reading that was seen.
struct At<'d> {
    specimen: usize,
    reading: usize,
    family: usize,
    m: &'d Measurement,
    unit: f64,
    /// What was seen less what the base model expects; a bound counts as lying on it.
    off: f64,
    mean: f64,
    known: bool,
}

/// Scores of what is held out, by specimen and reading; `units` are the base model's standard deviations of the readings.
pub fn ceiling(
    design: &Design,
    campaign: &Campaign,
    fold: &Fold,
    base: &Predicted,
    units: &[Vec<f64>],
) -> Vec<((usize, usize), Score)> {
    let mut all: Vec<At<'_>> = Vec::new();
    for (specimen, own) in design.specimens.iter().enumerate() {
        for (reading, m) in own.readings.iter().enumerate() {
            let Some(told) = campaign.specimens[specimen][reading].told(m) else { continue };
            let mean = crate::stats::mean(&base.reading(specimen, reading)).unwrap_or(told);
            let (unit, known) = (units[specimen][reading], fold.known[specimen][reading]);
            all.push(At { specimen, reading, family: own.family, m, unit, off: told - mean, mean, known });
        }
    }
    // In units of the base model's standard deviations.
    let draws = base.walls.len() as f64;
    let columns = DMatrix::from_fn(base.walls.len(), all.len(), |draw, k| {
        (base.walls[draw][all[k].specimen][all[k].reading] - all[k].mean) / all[k].unit
    });
    let mut walls = columns.transpose() * &columns / (draws - 1.0);
    for (k, at) in all.iter().enumerate() {
        walls[(k, k)] +=
            (reading_variance(at.m) + at.m.common_error * at.m.common_error) / (at.unit * at.unit) + 1e-6;
    }
    let known: Vec<usize> = (0..all.len()).filter(|&k| all[k].known).collect();
    let out: Vec<usize> = (0..all.len()).filter(|&k| !all[k].known).collect();
    let smooth = DMatrix::from_fn(all.len(), all.len(), |a, b| alike(&all[a], &all[b]));
    let off = DVector::from_fn(known.len(), |k, _| all[known[k]].off / all[known[k]].unit);
    let fitted = TRIED.into_iter().filter_map(|sigma| {
        let whole = &walls + &smooth * (sigma * sigma);
        let factored = part(&whole, &known, &known).cholesky()?;
        let half: f64 = (0..known.len()).fold(0.0, |sum, k| sum + ln(factored.l_dirty()[(k, k)]));
        let weights = factored.solve(&off);
        Some((-0.5 * off.dot(&weights) - half, whole, factored, weights))
    });
    let Some((_, whole, factored, weights)) = fitted.max_by(|a, b| a.0.total_cmp(&b.0)) else {
        return Vec::new();
    };
    let across = part(&whole, &out, &known);
    let moved = &across * weights;
    out.iter()
        .enumerate()
        .filter_map(|(row, &k)| {
            let at = &all[k];
            let told = across.row(row).transpose();
            let variance = (whole[(k, k)] - told.dot(&factored.solve(&told))).max(1e-6);
            let mean = at.mean + at.unit * moved[row];
            let seen = campaign.specimens[at.specimen][at.reading];
            let score = normal_score(at.m, seen, mean, at.unit * variance.sqrt(), at.unit)?;
            Some(((at.specimen, at.reading), score))
        })
        .collect()
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
