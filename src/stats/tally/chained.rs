//! Runs of chains: only whole runs are independent.

use super::drawn::summed;
use super::{Chains, Pooled, Within, probability, unseen};
use crate::math::{exp, ln};
use crate::random::standard_normal;
use crate::stats::{clopper_pearson_at, mean, sigma, student_quantile, weighted_interval};

/// The interval about the mean of the runs on its logarithm, `m exp(-+ h)`. The half width h is the larger of two: Student's over the mean, and
/// that of the mean of lognormal values (Olsson 2005), `t sqrt(s^2 / n + s^4 / (2 (n - 1)))` with the standard deviation s of the
/// logarithms. Runs are skewed, and where no large one is among ten the first one is too narrow.
///
/// Where a run ended at 0 or its chains were stuck, nothing of that holds: others may have missed the same. Then the interval goes
/// from 0 to what the points bound that were drawn before any was moved (Clopper and Pearson), or to its upper end if that is larger.
pub(super) fn chains(runs: &[&Chains], miss: f64) -> Pooled {
    let found: Vec<f64> = runs.iter().map(|run| run.probability).collect();
    let first = summed(runs.iter().map(|run| &run.first));
    let bound = clopper_pearson_at(first.worse as usize, first.of as usize, 1.0 - miss)[1];
    let centre = mean(&found).unwrap_or(0.0);
    let half = log_half_width(&found, miss);
    let ends = half.map(|half| [centre * exp(-half), (centre * exp(half)).min(1.0)]);
    let interval = match ends {
        Some(ends) if !runs.iter().any(|run| run.stuck) => ends,
        ends => [0.0, ends.map_or(bound, |[_, high]| high.max(bound))],
    };
    Pooled {
        probability: centre,
        interval: Some(interval),
        cov: cov_of_mean(&found),
        at_most: (bound > interval[1]).then_some(bound),
    }
}

/// The half width on the logarithm; `None` where a run found nothing, or there is one alone.
fn log_half_width(found: &[f64], miss: f64) -> Option<f64> {
    if found.len() < 2 || found.iter().any(|own| *own <= 0.0) {
        return None;
    }
    let n = found.len() as f64;
    let logarithms: Vec<f64> = found.iter().map(|own| ln(*own)).collect();
    let spread = sigma(&logarithms)?;
    let square = spread * spread;
    let t = student_quantile(1.0 - 0.5 * miss, n - 1.0);
    let lognormal = (square / n + square * square / (2.0 * (n - 1.0))).sqrt();
    Some(t * lognormal.max(cov_of_mean(found)?))
}

/// The interval is that of Fay and Feuer, with the variance between the runs where that is larger than what counts say, and as much more as so few
/// runs may be wrong about it. `None` where the event was not reached, or chains were stuck on the way.
pub(super) fn within(runs: &[&Within], miss: f64) -> Pooled {
    let n = runs.len() as f64;
    let found: Vec<f64> = runs.iter().map(|run| run.probability * run.strata.share() + run.more).collect();
    let sum = mean(&found).unwrap_or(0.0);
    let square = |x: f64| x * x;
    let scaled = |run: &Within, weight: f64| run.probability * weight * run.repeated / n;
    let counted = |run: &Within| {
        let each = run.strata.weights().into_iter().zip(run.strata.counts);
        each.map(|(weight, own)| square(scaled(run, weight)) * own.worse as f64).sum::<f64>()
    };
    let largest = |of: fn(&super::Strata) -> f64| {
        runs.iter().map(|run| scaled(run, of(&run.strata))).fold(0.0, f64::max)
    };
    let between = sigma(&found).filter(|_| runs.len() > 1).map_or(0.0, |sigma| {
        let wider = student_quantile(1.0 - 0.5 * miss, n - 1.0) / standard_normal::quantile(1.0 - 0.5 * miss);
        square(wider * sigma) / n
    });
    let variance = runs.iter().map(|run| counted(run)).sum::<f64>().max(between);
    let worse = runs.iter().map(|run| run.strata.worse()).sum();
    let next = unseen(worse, largest(super::Strata::largest_seen), largest(super::Strata::largest_near));
    Pooled {
        probability: sum.min(1.0),
        interval: (next > 0.0 && !runs.iter().any(|run| run.stuck))
            .then(|| probability(weighted_interval(sum, variance, next, miss))),
        cov: cov_of_mean(&found),
        at_most: None,
    }
}

/// Coefficient of variation of the mean of runs.
fn cov_of_mean(found: &[f64]) -> Option<f64> {
    let centre = mean(found).filter(|centre| *centre > 0.0)?;
    Some(sigma(found)? / centre / (found.len() as f64).sqrt())
}
