//! Samples of another library's distributions follow our CDFs: an independent check of parameters and formulas.

use pirca::random::Family;
use pirca::stats::{ks_p_value, ks_statistic};
use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;
use rand_distr::{Distribution, LogNormal, Normal, Triangular, Uniform};

/// KS p-value of 10 000 samples of `theirs` against the CDF of `ours`, on a fixed seed.
fn p_value(theirs: &impl Distribution<f64>, ours: &Family) -> f64 {
    let mut rng = ChaCha12Rng::seed_from_u64(20_260_101);
    let mut sample: Vec<f64> = theirs.sample_iter(&mut rng).take(10_000).collect();
    sample.sort_by(f64::total_cmp);
    ks_p_value(ks_statistic(&sample, |x| ours.cdf(x)), sample.len())
}

#[test]
fn samples_of_rand_distr_follow_our_cdfs() {
    // On a fixed seed the test either holds for good or not at all; 1 % is where it would call a right one wrong.
    let level = 0.01;
    let uniform = Uniform::new(-0.35, 0.35).expect("a proper interval");
    assert!(p_value(&uniform, &Family::Uniform { low: -0.35, high: 0.35 }) > level);
    let normal = Normal::new(0.4, 0.08).expect("a proper sd");
    assert!(p_value(&normal, &Family::Normal { mean: 0.4, sd: 0.08 }) > level);
    let lognormal = LogNormal::from_mean_cv(0.4, 0.2).expect("a proper COV");
    assert!(p_value(&lognormal, &Family::Lognormal { mean: 0.4, sd: 0.08 }) > level);
    let triangular = Triangular::new(0.1, 0.5, 0.2).expect("a proper mode");
    assert!(p_value(&triangular, &Family::Triangular { low: 0.1, mode: 0.2, high: 0.5 }) > level);
}

#[test]
fn a_wrong_parameter_is_noticed() {
    let normal = Normal::new(0.4, 0.08).expect("a proper sd");
    assert!(p_value(&normal, &Family::Normal { mean: 0.4, sd: 0.085 }) < 1e-3);
}
