//! The discrepancy beyond error and natural scatter: the features that joints within their priors do not explain.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::critic::discrepancy::across::across;
use crate::critic::discrepancy::features::{Feature, Scale, features};
use crate::critic::simulate::{Campaign, Design, PRIOR_WIDENING, Truth, World};
use crate::random::Streams;
use crate::stats;

/// Campaigns that the scale of the readings comes from.
const SCALING: u64 = 300;
/// A feature counts that so large a share of the campaigns without effect have.
const COMMON: f64 = 0.5;

/// The base model as a design sees it.
#[derive(Debug)]
pub struct Reference {
    /// What readings are set against.
    pub scale: Scale,
    /// The features, in order.
    pub features: Vec<Feature>,
    /// Sums of them across families, which say nothing new to a distance, and what is off in one respect at a glance.
    across: Vec<(Feature, Vec<(usize, f64)>)>,
    mean: DVector<f64>,
    /// How the features go with the scores of the joints.
    slopes: DMatrix<f64>,
    /// Inverse of the covariance of what the joints leave.
    precision: DMatrix<f64>,
    /// Standard deviation of what a fit of the joints leaves, by feature, those across families last.
    spread: DVector<f64>,
}

/// No feature is known better than this, in standard deviations of independent readings: where the base model draws nothing,
/// walls that differ by a step of a protractor would be off beyond all measure.
const LEAST_SPREAD: f64 = 0.3;

/// What is off in a campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct Discrepancy {
    /// The excess of every feature over what the best joints explain, in standard deviations of campaigns without effect; `None`
    /// where the campaign does not show the feature.
    pub excess: BTreeMap<Feature, Option<f64>>,
    /// Scores of the joints that explain most, by kind of joint.
    pub joints: Vec<[f64; 3]>,
    /// How far all features together are from what the best joints explain: square of the Mahalanobis distance.
    pub distance: f64,
}

impl Discrepancy {
    /// The largest excess, without its sign.
    pub fn largest(&self) -> f64 {
        self.excess.values().flatten().fold(0.0, |largest, x| largest.max(x.abs()))
    }
}

impl Reference {
    /// From `count` campaigns of the base model with the joints drawn from their priors; a pure function of the world, the design
    /// and the seed. `None` where most campaigns show no feature.
    pub fn new(world: &World<'_>, design: &Design, count: u64, seed: u64) -> Option<Reference> {
        let one = |campaign: u64| -> (Truth, Campaign) {
            let streams = Streams::new(seed, campaign);
            let truth = world.drawn(None, &streams);
            let shown = world.campaign(design, &truth, &streams);
            (truth, shown)
        };
        let scaling: Vec<Campaign> = (0..SCALING).into_par_iter().map(|k| one(k).1).collect();
        let scale = Scale::of(design, &scaling);
        let simulated: Vec<(Vec<f64>, BTreeMap<Feature, f64>)> = (SCALING..SCALING + count)
            .into_par_iter()
            .map(|k| {
                let (truth, campaign) = one(k);
                (
                    truth.joints.concat().iter().map(|z| z / PRIOR_WIDENING).collect(),
                    features(design, &scale, &campaign),
                )
            })
            .collect();
        let mut seen: BTreeMap<Feature, usize> = BTreeMap::new();
        simulated.iter().flat_map(|(_, found)| found.keys()).for_each(|f| *seen.entry(*f).or_default() += 1);
        let enough = |n: &usize| *n as f64 >= COMMON * count as f64;
        let kept: Vec<Feature> = seen.iter().filter(|(_, n)| enough(n)).map(|(f, _)| *f).collect();
        if kept.is_empty() {
            return None;
        }
        let column =
            |f: &Feature| simulated.iter().filter_map(|(_, found)| found.get(f).copied()).collect::<Vec<_>>();
        let mean =
            DVector::from_iterator(kept.len(), kept.iter().map(|f| stats::mean(&column(f)).unwrap_or(0.0)));
        // What a campaign does not show is taken to be as always, for the slopes alone.
        let shown = DMatrix::from_fn(simulated.len(), kept.len(), |row, k| {
            simulated[row].1.get(&kept[k]).map_or(0.0, |x| x - mean[k])
        });
        let inputs = simulated[0].0.len();
        let scores = DMatrix::from_fn(simulated.len(), inputs, |row, k| simulated[row].0[k]);
        let normal = scores.transpose() * &scores;
        let slopes = normal.cholesky()?.solve(&(scores.transpose() * &shown)).transpose();
        let left = &shown - &scores * slopes.transpose();
        let mut covariance = left.transpose() * &left / simulated.len() as f64;
        for k in 0..kept.len() {
            covariance[(k, k)] = covariance[(k, k)].max(LEAST_SPREAD * LEAST_SPREAD) * (1.0 + 1e-6);
        }
        let precision = covariance.cholesky()?.inverse();
        let across = across(world, &kept);
        let spread = DVector::from_element(kept.len() + across.len(), 1.0);
        let mut reference = Reference { scale, features: kept, across, mean, slopes, precision, spread };
        let excesses: Vec<Vec<Option<f64>>> =
            simulated.iter().map(|(_, found)| reference.excess(found).by_feature).collect();
        for k in 0..reference.spread.len() {
            let squares: Vec<f64> = excesses.iter().filter_map(|e| e[k]).map(|x| x * x).collect();
            reference.spread[k] =
                (stats::sum(&squares) / squares.len().max(1) as f64).sqrt().max(LEAST_SPREAD);
        }
        Some(reference)
    }

    /// How far a campaign of the same design is off.
    pub fn discrepancy(&self, design: &Design, campaign: &Campaign) -> Discrepancy {
        let Excess { by_feature, scores, distance } = self.excess(&features(design, &self.scale, campaign));
        Discrepancy {
            excess: self
                .features
                .iter()
                .chain(self.across.iter().map(|(feature, _)| feature))
                .copied()
                .zip(by_feature)
                .collect(),
            joints: scores
                .chunks_exact(3)
                .map(|c| [PRIOR_WIDENING * c[0], PRIOR_WIDENING * c[1], PRIOR_WIDENING * c[2]])
                .collect(),
            distance,
        }
    }

    /// How far the causes of a truth move its campaigns from those of any joints without them, whatever a single campaign shows:
    /// Mahalanobis distance of the mean change of the features, with the same stones and errors, from what the best change of the
    /// joints does, less what the mean of `count` campaigns has of it by chance.
    pub fn shift(&self, world: &World<'_>, design: &Design, truth: &Truth, count: u64, seed: u64) -> f64 {
        let still = truth.still();
        let one = |campaign: u64| {
            let [with, without] = [truth, &still].map(|truth| {
                let shown = world.campaign(design, truth, &Streams::new(seed, campaign));
                features(design, &self.scale, &shown)
            });
            let change = |feature: &Feature| Some(with.get(feature)? - without.get(feature)?);
            self.features.iter().map(change).collect::<Vec<Option<f64>>>()
        };
        let changes: Vec<Vec<Option<f64>>> = (0..count).into_par_iter().map(one).collect();
        let mean = |k: usize| {
            let own: Vec<f64> = changes.iter().filter_map(|change| change[k]).collect();
            stats::mean(&own).filter(|_| own.len() as f64 >= COMMON * count as f64)
        };
        let means: Vec<Option<f64>> = (0..self.features.len()).map(mean).collect();
        let distance = |changes: &dyn Fn(usize) -> Option<f64>| {
            let shown = self.features.iter().enumerate();
            let shown = shown.filter_map(|(k, feature)| Some((*feature, self.mean[k] + changes(k)?)));
            self.excess(&shown.collect()).distance
        };
        let off = |change: &Vec<Option<f64>>| distance(&|k| Some(change[k].unwrap_or(means[k]?) - means[k]?));
        let off: Vec<f64> = changes.iter().map(off).collect();
        let chance = stats::sum(&off) / (count * (count - 1)) as f64;
        (distance(&|k| means[k]) - chance).max(0.0).sqrt()
    }

    /// The excess of each feature over the joints that explain most (Gaussian, within their priors).
    fn excess(&self, found: &BTreeMap<Feature, f64>) -> Excess {
        let shown: Vec<bool> = self.features.iter().map(|feature| found.contains_key(feature)).collect();
        let off = DVector::from_fn(self.features.len(), |k, _| {
            found.get(&self.features[k]).map_or(0.0, |x| x - self.mean[k])
        });
        // What is not shown weighs nothing.
        let mut precision = self.precision.clone();
        for k in (0..shown.len()).filter(|&k| !shown[k]) {
            precision.row_mut(k).fill(0.0);
            precision.column_mut(k).fill(0.0);
        }
        let slopes = &self.slopes;
        let weighted = slopes.transpose() * &precision;
        let normal = &weighted * slopes + DMatrix::identity(slopes.ncols(), slopes.ncols());
        let scores = normal
            .cholesky()
            .map_or_else(|| DVector::zeros(slopes.ncols()), |normal| normal.solve(&(&weighted * &off)));
        let rest = &off - slopes * &scores;
        let left = shown.iter().enumerate().map(|(k, shown)| shown.then(|| rest[k]));
        let sum = |weights: &[(usize, f64)]| -> Option<f64> {
            weights.iter().try_fold(0.0, |sum, (k, weight)| shown[*k].then(|| sum + weight * rest[*k]))
        };
        let across = self.across.iter().map(|(_, weights)| sum(weights));
        let by_feature = left.chain(across).zip(&self.spread).map(|(left, spread)| Some(left? / spread));
        Excess {
            by_feature: by_feature.collect(),
            distance: rest.dot(&(&precision * &rest)),
            scores: scores.iter().copied().collect(),
        }
    }
}

/// What the best joints leave.
struct Excess {
    by_feature: Vec<Option<f64>>,
    scores: Vec<f64>,
    distance: f64,
}
