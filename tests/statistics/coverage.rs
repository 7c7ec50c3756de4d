//! How often each 95 % interval holds the truth, by simulation. Tolerance: four binomial standard errors, plus a stated
//! bias where the interval is approximate.

use crate::support::{near_share, sample, share};
use pirca::random::{Family, Streams};
use pirca::stats::{
    Estimate, Summary, cov_bootstrap, paired_ratio_of_means, quantile_interval, ratio_of_means,
    sigma_bootstrap,
};

const REPEATS: u64 = 2000;

/// Mean 5, sigma 1, COV 0.2.
const NORMAL: Family = Family::Normal { mean: 5.0, sd: 1.0 };

fn holds(estimate: Estimate, truth: f64) -> bool {
    estimate.interval.is_some_and(|[low, high]| low <= truth && truth <= high)
}

fn summary_share(n: usize, name: &str, check: impl Fn(Summary) -> bool) -> f64 {
    share(REPEATS, |k| check(Summary::of(&sample(&NORMAL, n, k, name))))
}

#[test]
fn mean_interval_is_exact() {
    for n in [2, 5, 30] {
        let found = summary_share(n, "mean", |s| holds(s.mean, 5.0));
        near_share(found, 0.95, REPEATS, 0.0, &format!("mean, n = {n}"));
    }
}

#[test]
fn sigma_interval_is_exact() {
    for n in [2, 5, 30] {
        let found = summary_share(n, "sigma", |s| holds(s.sigma, 1.0));
        near_share(found, 0.95, REPEATS, 0.0, &format!("sigma, n = {n}"));
    }
}

/// Vangel's approximation errs by less than 0.005 at a COV of 0.2. An interval without upper end counts as holding the
/// truth only if the truth cannot be excluded from below either; with five values at this COV there is none.
#[test]
fn cov_interval_is_nearly_exact() {
    for n in [5, 30] {
        let found = summary_share(n, "cov", |s| holds(s.cov, 0.2));
        near_share(found, 0.95, REPEATS, 0.005, &format!("COV, n = {n}"));
    }
}

/// Order statistics 10 and 21 of 30 hold the median with the binomial probability 1 - 2 P(Bin(30, 1/2) <= 9) = 0.95723,
/// whatever the distribution.
#[test]
fn median_interval_is_free_of_the_distribution() {
    let skew = Family::Lognormal { mean: 1.0, sd: 1.0 };
    for family in [NORMAL, skew] {
        let median = family.quantile(0.5);
        let found = share(REPEATS, |k| {
            let interval = quantile_interval(&sample(&family, 30, k, "median"), 0.5);
            interval.is_some_and(|[low, high]| low <= median && median <= high)
        });
        near_share(found, 0.95723, REPEATS, 0.0, "median");
    }
}

/// Unequal sizes and variances; Satterthwaite's approximation errs by less than 0.005 here.
#[test]
fn ratio_of_independent_means() {
    let wide = Family::Normal { mean: 4.0, sd: 1.2 };
    let found = share(REPEATS, |k| {
        let (a, b) = (sample(&wide, 8, k, "above"), sample(&NORMAL, 20, k, "below"));
        holds(ratio_of_means(&a, &b), 0.8)
    });
    near_share(found, 0.95, REPEATS, 0.005, "independent ratio");
}

/// One side a deterministic wall: exact.
#[test]
fn ratio_to_a_deterministic_wall() {
    let found = share(REPEATS, |k| holds(ratio_of_means(&[4.0], &sample(&NORMAL, 10, k, "one")), 0.8));
    near_share(found, 0.95, REPEATS, 0.0, "constant over mean");
}

/// a = 0.8 b + scatter: exact for normal pairs. Treated as independent, the interval would be needlessly long.
#[test]
fn ratio_of_paired_means() {
    let scatter = Family::Normal { mean: 0.0, sd: 0.3 };
    let pair = |k| {
        let b = sample(&NORMAL, 10, k, "shared");
        let a: Vec<f64> = b.iter().zip(sample(&scatter, 10, k, "own")).map(|(b, e)| 0.8 * b + e).collect();
        (a, b)
    };
    let found = share(REPEATS, |k| {
        let (a, b) = pair(k);
        holds(paired_ratio_of_means(&a, &b), 0.8)
    });
    near_share(found, 0.95, REPEATS, 0.0, "paired ratio");
    let width = |estimate: Estimate| estimate.interval.map_or(f64::INFINITY, |[low, high]| high - low);
    let shorter = share(REPEATS, |k| {
        let (a, b) = pair(k);
        width(paired_ratio_of_means(&a, &b)) < width(ratio_of_means(&a, &b))
    });
    assert!(shorter > 0.95, "paired intervals are the shorter ones in {shorter} of all samples");
}

/// BCa of a sigma is known to fall short of 95 % at 30 normal values, by some 3 %; a plain mistake (one-sided,
/// uncorrected percentiles of a biased statistic) costs more than 6 %.
#[test]
fn bootstrap_coverage_is_modestly_short() {
    let repeats = 500;
    let found = |estimate: fn(&[f64], usize, &mut pirca::random::Stream) -> Estimate, truth: f64| {
        share(repeats, |k| {
            let values = sample(&NORMAL, 30, k, "bootstrapped");
            holds(estimate(&values, 800, &mut Streams::new(9, k).of("bootstrap")), truth)
        })
    };
    near_share(found(sigma_bootstrap, 1.0), 0.93, repeats, 0.01, "BCa sigma");
    near_share(found(cov_bootstrap, 0.2), 0.93, repeats, 0.01, "BCa COV");
}
