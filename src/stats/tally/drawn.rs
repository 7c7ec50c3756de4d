//! Runs whose points are independent: their counts are those of one sample.

use super::{Counts, Pooled, Strata, Weighted, probability, unseen};
use crate::stats::{clopper_pearson_at, weighted_interval};

/// The interval is that of Clopper and Pearson.
pub(super) fn plain(runs: &[&Counts], miss: f64) -> Pooled {
    let Counts { worse, of } = summed(runs.iter().copied());
    let share = worse as f64 / of as f64;
    Pooled {
        probability: share,
        interval: Some(clopper_pearson_at(worse as usize, of as usize, 1.0 - miss)),
        cov: (worse > 0).then(|| ((1.0 - share) / worse as f64).sqrt()),
        at_most: None,
    }
}

/// The interval is that of Fay and Feuer.
pub(super) fn weighted(runs: &[&Weighted], miss: f64) -> Pooled {
    let all = runs.iter().map(|run| run.of).sum::<u64>() as f64;
    let counts: Vec<f64> = runs.iter().flat_map(|run| run.worse.iter().map(|own| own / all)).collect();
    let (sum, squares) =
        counts.iter().fold((0.0, 0.0), |(sum, squares), own| (sum + own, squares + own * own));
    let largest = runs.iter().map(|run| run.largest).fold(0.0, f64::max) / all;
    let next = unseen(counts.len(), counts.iter().copied().fold(0.0, f64::max), largest);
    by_weight(sum, squares, [next, largest], miss)
}

/// The same of strata: those of all runs are one sample with more points. To the variance that Fay and Feuer know of, that of the strata's
/// shares is added.
pub(super) fn strata(runs: &[&Strata], miss: f64) -> Pooled {
    let mut all = Strata::default();
    for run in runs {
        for (at, own) in run.counts.iter().enumerate() {
            all.sizes[at] += run.sizes[at];
            all.counts[at] = summed([&all.counts[at], own]);
        }
    }
    let (sum, weights) = (all.share(), all.weights());
    let counted = weights.iter().zip(&all.counts).map(|(weight, own)| weight * weight * own.worse as f64);
    let points: u64 = all.sizes.iter().sum();
    let squares = all.sizes.iter().zip(&all.counts).filter(|(_, own)| own.of > 0).map(|(size, own)| {
        let share = own.worse as f64 / own.of as f64;
        *size as f64 / points as f64 * share * share
    });
    let sorted = (squares.sum::<f64>() - sum * sum).max(0.0) / points as f64;
    let near = unseen(all.worse(), all.largest_seen(), all.largest_near());
    let largest = weights.into_iter().fold(0.0, f64::max);
    // Counts are binomial, which is less than Poisson's variance in strata of which most are on the worse side. One more point on each side:
    // a stratum of which all are does not vary by nothing.
    let binomial = weights.iter().zip(&all.counts).map(|(weight, own)| {
        let better = (own.of - own.worse + 1) as f64 / (own.of + 1) as f64;
        weight * weight * own.worse as f64 * better
    });
    let cov = (sum > 0.0).then(|| (binomial.sum::<f64>() + sorted).sqrt() / sum);
    Pooled { cov, ..by_weight(sum, counted.sum::<f64>() + sorted, [near, largest], miss) }
}

/// A sum of weights with its variance; of a failure that was not seen the weight that the interval takes it for, and the largest possible one.
fn by_weight(sum: f64, variance: f64, [next, largest]: [f64; 2], miss: f64) -> Pooled {
    let of = |next: f64| probability(weighted_interval(sum, variance, next, miss));
    Pooled {
        probability: sum.min(1.0),
        interval: Some(of(next)),
        cov: (sum > 0.0).then(|| variance.sqrt() / sum),
        at_most: (largest > next).then(|| of(largest)[1]),
    }
}

/// Counts of several samples.
pub(super) fn summed<'c>(all: impl IntoIterator<Item = &'c Counts>) -> Counts {
    let add = |sum: Counts, own: &Counts| Counts { worse: sum.worse + own.worse, of: sum.of + own.of };
    all.into_iter().fold(Counts::default(), add)
}
