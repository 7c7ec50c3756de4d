//! How much new readings would say about the cause, by simulation.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use crate::critic::causes::softmax;
use crate::critic::discrepancy::{Feature, Scale, features};
use crate::critic::simulate::{Design, Truth};
use crate::critic::verdict::Judge;
use crate::math::ln;
use crate::random::Streams;
use crate::stats;

/// Campaigns of each cause.
const SIMULATED: u64 = 240;
/// Campaigns of the base model that scale them.
const SCALING: u64 = 200;
/// Ridge on the covariance of features, in their variance.
const RIDGE: f64 = 0.05;

/// Expected information (nat), and its standard error.
#[derive(Default)]
pub(super) struct Information {
    pub value: f64,
    pub error: f64,
}

impl Information {
    /// An entropy less a cross entropy: `logs` are the logarithms of the probability of the right class, of campaigns of each.
    pub fn of(entropy: f64, weights: &[f64], logs: &[Vec<f64>]) -> Information {
        let (mut value, mut variance) = (entropy, 0.0);
        for (weight, own) in weights.iter().zip(logs) {
            value += weight * stats::mean(own).unwrap_or(0.0);
            let sigma = weight * stats::sigma(own).unwrap_or(0.0);
            variance += sigma * sigma / own.len() as f64;
        }
        Information { value, error: variance.sqrt() }
    }
}

/// Expected information of new readings about the cause: its entropy less the mean cross entropy of a Gaussian classifier on
/// campaigns that it has not seen, which can only be too little.
pub(super) fn information(
    judge: &Judge<'_>,
    design: &Design,
    possible: &[(f64, Vec<Truth>)],
    weights: &[f64],
    entropy: f64,
    seed: u64,
) -> Information {
    let shown = |truth: &Truth, k: u64| judge.world.campaign(design, truth, &Streams::new(seed, k));
    let scaling: Vec<_> = (0..SCALING)
        .map(|k| shown(&judge.world.drawn(None, &Streams::new(seed.wrapping_add(1), k)), k))
        .collect();
    let scale = Scale::of(design, &scaling);
    let seen: Vec<Vec<BTreeMap<Feature, f64>>> = possible
        .iter()
        .enumerate()
        .map(|(class, (_, draws))| {
            let draw = |k: u64| &draws[Streams::new(seed, k).of("offer").below(draws.len())];
            let first = class as u64 * SIMULATED;
            (0..SIMULATED).map(|k| features(design, &scale, &shown(draw(k), first + k))).collect()
        })
        .collect();
    let mut names: Vec<Feature> = seen.iter().flatten().flat_map(|found| found.keys().copied()).collect();
    names.sort();
    names.dedup();
    let vector = |found: &BTreeMap<Feature, f64>| {
        let tamed = |x: f64| x.signum() * ln(1.0 + x.abs());
        DVector::from_iterator(
            names.len(),
            names.iter().map(|name| tamed(found.get(name).copied().unwrap_or(0.0))),
        )
    };
    let points: Vec<Vec<DVector<f64>>> = seen.iter().map(|own| own.iter().map(vector).collect()).collect();
    // Learnt from the even campaigns, judged on the odd ones.
    let normals: Vec<Normal> =
        points.iter().filter_map(|own| Normal::of(&own.iter().step_by(2).collect::<Vec<_>>())).collect();
    if normals.len() < points.len() {
        return Information::default();
    }
    let judged = |(class, own): (usize, &Vec<DVector<f64>>)| -> Vec<f64> {
        let logs = own.iter().skip(1).step_by(2).map(|point| {
            let joint: Vec<f64> =
                normals.iter().zip(weights).map(|(normal, w)| normal.log(point) + ln(w.max(1e-12))).collect();
            // A classifier that is sure and wrong tells as little as one that knows nothing.
            ln(softmax(&joint, 1.0)[class]).max(ln(weights[class].max(1e-12)) - 1.0)
        });
        logs.collect()
    };
    Information::of(entropy, weights, &points.iter().enumerate().map(judged).collect::<Vec<_>>())
}

/// A normal distribution of features.
struct Normal {
    mean: DVector<f64>,
    lower: nalgebra::Cholesky<f64, nalgebra::Dyn>,
    half_log_determinant: f64,
}

impl Normal {
    fn of(points: &[&DVector<f64>]) -> Option<Normal> {
        let n = points.len() as f64;
        let size = points.first()?.len();
        let mean = points.iter().fold(DVector::zeros(size), |sum, point| sum + *point) / n;
        let mut covariance: DMatrix<f64> = DMatrix::zeros(size, size);
        for point in points {
            let off = *point - &mean;
            covariance += &off * off.transpose() / n;
        }
        for k in 0..size {
            covariance[(k, k)] = covariance[(k, k)] * (1.0 + RIDGE) + 1e-4;
        }
        let lower = covariance.cholesky()?;
        let half_log_determinant = (0..size).fold(0.0, |sum, k| sum + ln(lower.l_dirty()[(k, k)]));
        Some(Normal { mean, lower, half_log_determinant })
    }

    fn log(&self, point: &DVector<f64>) -> f64 {
        let off = point - &self.mean;
        -0.5 * off.dot(&self.lower.solve(&off)) - self.half_log_determinant
    }
}
