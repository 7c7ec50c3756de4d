//! Does a cause act as strongly as its physical prior allows? The prior predictive check of Evans and Moshonov (2006): how far a
//! campaign lies from those that the physical prior predicts, along what the data pin down. That is not the parameter, whose
//! estimate may run along a ridge of the likelihood and have no power, but the directions of the readings' features in which the
//! search prior spreads campaigns most beyond the physical one.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rayon::prelude::*;

use crate::critic::causes::inputs;
use crate::critic::discrepancy::Reference;
use crate::critic::simulate::{Campaign, Causes, Design, Truth, World};
use crate::random::Streams;

/// Campaigns of each prior that the directions come from, and further ones of the physical prior that the p-value is a share of.
const CAMPAIGNS: u64 = 600;
/// So many directions at most: what one or two parameters move, more than once bent.
const MOST_DIRECTIONS: usize = 3;
/// A direction counts along which the search prior has so many times the variance of the physical one.
const SPREAD: f64 = 2.0;
/// Added to the variance of every feature, as a share of the mean variance: 600 campaigns do not tell a hundred features apart.
const RIDGE: f64 = 0.05;

/// What the physical prior of a cause predicts of a design's campaigns.
#[derive(Debug)]
pub struct PriorPredictive {
    mean: DVector<f64>,
    /// Columns; along each the physical prior's campaigns have a variance of 1.
    directions: DMatrix<f64>,
    /// Squares of the distances of campaigns of the physical prior, ascending.
    distances: Vec<f64>,
}

impl PriorPredictive {
    /// Of causes; a pure function of its arguments.
    pub fn of(
        world: &World<'_>,
        design: &Design,
        reference: &Reference,
        causes: impl Into<Causes>,
        seed: u64,
    ) -> PriorPredictive {
        let causes = causes.into();
        let seen = |from: u64, drawn: &(dyn Fn(&Streams) -> Truth + Sync)| -> Vec<DVector<f64>> {
            let of = |k: u64| {
                let streams = Streams::new(seed, k);
                let campaign = world.campaign(design, &drawn(&streams), &streams);
                features(design, reference, &campaign)
            };
            (from..from + CAMPAIGNS).into_par_iter().map(of).collect()
        };
        let expected = seen(0, &|streams| world.expected(causes, streams));
        let searched = seen(0, &|streams| world.drawn(causes, streams));
        let (mean, mut within) = moments(&expected);
        let ridge = RIDGE * within.diagonal().mean();
        let wide = moments(&searched).1;
        for k in 0..mean.len() {
            within[(k, k)] += ridge.max(f64::MIN_POSITIVE);
        }
        let directions = beyond(within, &wide);
        let mut predictive = PriorPredictive { mean, directions, distances: Vec::new() };
        let further = seen(CAMPAIGNS, &|streams| world.expected(causes, streams));
        predictive.distances = further.iter().map(|seen| predictive.distance(seen)).collect();
        predictive.distances.sort_by(f64::total_cmp);
        predictive
    }

    /// Share of the campaigns that the physical prior predicts which lie as far out as this one of the same design; 1 where the
    /// design's readings pin nothing down that tells the priors apart.
    pub fn p_value(&self, design: &Design, reference: &Reference, campaign: &Campaign) -> f64 {
        if self.directions.ncols() == 0 {
            return 1.0;
        }
        let own = self.distance(&features(design, reference, campaign));
        let as_far = self.distances.len() - self.distances.partition_point(|distance| *distance < own);
        (as_far + 1) as f64 / (self.distances.len() + 1) as f64
    }

    fn distance(&self, seen: &DVector<f64>) -> f64 {
        (self.directions.transpose() * (seen - &self.mean)).norm_squared()
    }
}

/// What the ranking sees of a campaign.
fn features(design: &Design, reference: &Reference, campaign: &Campaign) -> DVector<f64> {
    DVector::from_vec(inputs(&reference.discrepancy(design, campaign)))
}

fn moments(seen: &[DVector<f64>]) -> (DVector<f64>, DMatrix<f64>) {
    let (count, size) = (seen.len() as f64, seen[0].len());
    let mean = seen.iter().fold(DVector::zeros(size), |sum, own| sum + own) / count;
    let mut covariance = DMatrix::zeros(size, size);
    for own in seen {
        let off = own - &mean;
        covariance.ger(1.0 / count, &off, &off, 1.0);
    }
    (mean, covariance)
}

/// Directions in which one covariance is widest beyond another, each of variance 1 in the latter: generalised eigenvectors.
fn beyond(within: DMatrix<f64>, wide: &DMatrix<f64>) -> DMatrix<f64> {
    let size = within.nrows();
    let Some(lower) = within.cholesky().map(|c| c.unpack()) else { return DMatrix::zeros(size, 0) };
    let Some(half) = lower.solve_lower_triangular(wide) else { return DMatrix::zeros(size, 0) };
    let Some(whitened) = lower.solve_lower_triangular(&half.transpose()) else {
        return DMatrix::zeros(size, 0);
    };
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(whitened);
    let mut order: Vec<usize> = (0..size).filter(|&k| eigenvalues[k] >= SPREAD).collect();
    order.sort_by(|&a, &b| eigenvalues[b].total_cmp(&eigenvalues[a]));
    order.truncate(MOST_DIRECTIONS);
    let columns: Vec<DVector<f64>> = order
        .iter()
        .filter_map(|&k| lower.transpose().solve_upper_triangular(&eigenvectors.column(k).into_owned()))
        .collect();
    match columns.is_empty() {
        true => DMatrix::zeros(size, 0),
        false => DMatrix::from_columns(&columns),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::judged;

    #[test]
    fn causes_within_their_prior_are_flagged_as_often_as_the_level_says_and_far_ones_nearly_always() {
        let (made, judge) = judged();
        let creep = made.cause("creep");
        let predictive = PriorPredictive::of(judge.world, &judge.design, &judge.reference, Some(creep), 3);
        assert!(predictive.directions.ncols() > 0);
        let flagged = |truth: &dyn Fn(&Streams) -> Truth| {
            let shown = |k: u64| {
                let streams = Streams::new(91, k);
                judge.world.campaign(&judge.design, &truth(&streams), &streams)
            };
            let p_value = |k| predictive.p_value(&judge.design, &judge.reference, &shown(k));
            (0..400).filter(|&k| p_value(k) < 0.05).count()
        };
        let within = flagged(&|streams| judge.world.expected(Some(creep), streams));
        let far = flagged(&|streams| {
            let mut truth = judge.world.drawn(Some(creep), streams);
            // 99 % of the search prior's rates are lower: 0.36 per degree, the physical prior ends at 0.1.
            truth.parameters[0] = 2.33;
            truth
        });
        println!("{within} and {far} of 400");
        // 5 % of 400 are 20 +- 4.4; the level itself comes from 600 campaigns, +- 3.6.
        assert!((6..=37).contains(&within), "{within}");
        assert!(far > 300, "{far}");
    }

    #[test]
    fn truths_of_the_physical_prior_lie_in_it_and_weights_give_it_back() {
        let (made, judge) = judged();
        let creep = made.cause("creep");
        let rate = |truth: &Truth| judge.world.parameters(truth)[0];
        let expected: Vec<f64> =
            (0..2000).map(|k| rate(&judge.world.expected(Some(creep), &Streams::new(92, k)))).collect();
        assert!(expected.iter().all(|x| (0.0..=0.1001).contains(x)));
        // A triangle from 0.1 at its mode of 0: mean a third of it, sd 0.0236 / sqrt(2000) = 5e-4.
        let mean = crate::stats::mean(&expected).expect("many");
        assert!((mean - 0.1 / 3.0).abs() < 2e-3, "{mean}");
        let drawn: Vec<Truth> =
            (0..20_000).map(|k| judge.world.drawn(Some(creep), &Streams::new(93, k))).collect();
        let weights: Vec<f64> =
            drawn.iter().map(|truth| crate::math::exp(judge.world.log_weight(truth))).collect();
        let weighed = drawn.iter().zip(&weights).fold(0.0, |sum, (truth, w)| sum + w * rate(truth))
            / crate::stats::sum(&weights);
        // Of 20,000 draws two of whose parameters must lie in a quarter each, some 4,000 count.
        assert!((weighed - 0.1 / 3.0).abs() < 3e-3, "{weighed}");
    }
}
