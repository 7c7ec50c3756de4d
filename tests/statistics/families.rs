//! Distribution families: against statrs, against themselves, and samples against their CDF.

use crate::support::{close, sample, simpson};
use pirca::math::exp;
use pirca::random::Family;
use pirca::stats::ks_statistic;
use statrs::distribution::{Continuous, ContinuousCDF};

const LEVELS: [f64; 9] = [1e-9, 1e-4, 0.025, 0.2, 0.5, 0.7, 0.975, 0.9999, 1.0 - 1e-9];

/// Tolerances: 1e-11 for densities and 1e-10 for probabilities, where both sides round and the tails magnify; 1e-8 sd
/// for quantiles, because the inverses of statrs stop there.
fn agree<D: Continuous<f64, f64> + ContinuousCDF<f64, f64>>(ours: &Family, theirs: &D) {
    for u in LEVELS {
        let x = ours.quantile(u);
        let scale = ours.sd();
        let inverse = theirs.inverse_cdf(u);
        assert!((x - inverse).abs() <= 1e-8 * scale, "{ours:?} at {u}: {x} and {inverse}");
        close(
            ours.density(x).expect("continuous"),
            theirs.pdf(x),
            1e-11,
            &format!("density of {ours:?} at {x}"),
        );
        close(ours.cdf(x), theirs.cdf(x), 1e-10, &format!("cdf of {ours:?} at {x}"));
    }
    for x in [ours.support().0 - 1.0, ours.support().1 + 1.0] {
        if x.is_finite() {
            assert_eq!((ours.density(x), ours.cdf(x)), (Some(0.0), theirs.cdf(x)), "{ours:?} at {x}");
        }
    }
}

#[test]
fn normal_uniform_lognormal_and_triangular_agree_with_statrs() {
    use statrs::distribution::{LogNormal, Normal, Triangular, Uniform};
    let normal = Family::Normal { mean: 0.12, sd: 0.03 };
    agree(&normal, &Normal::new(0.12, 0.03).expect("good"));
    let uniform = Family::Uniform { low: -0.1, high: 0.3 };
    agree(&uniform, &Uniform::new(-0.1, 0.3).expect("good"));
    // Mean and sd of the variable itself: exp(mu + s^2/2) and mean sqrt(exp(s^2) - 1).
    let (mu, s) = (-1.5_f64, 0.4_f64);
    let mean = exp(mu + 0.5 * s * s);
    let lognormal = Family::Lognormal { mean, sd: mean * (exp(s * s) - 1.0).sqrt() };
    agree(&lognormal, &LogNormal::new(mu, s).expect("good"));
    for mode in [0.1, 0.15, 0.3] {
        let triangular = Family::Triangular { low: 0.1, mode, high: 0.3 };
        agree(&triangular, &Triangular::new(0.1, 0.3, mode).expect("good"));
    }
}

fn continuous() -> Vec<Family> {
    vec![
        Family::Normal { mean: 0.12, sd: 0.03 },
        Family::Uniform { low: -0.1, high: 0.3 },
        Family::Lognormal { mean: 0.2, sd: 0.1 },
        Family::Lognormal { mean: 0.2, sd: 1e-5 },
        Family::Triangular { low: 0.1, mode: 0.15, high: 0.3 },
        Family::Triangular { low: 0.1, mode: 0.3, high: 0.3 },
        Family::TruncatedNormal { mean: 0.0, sd: 2.0, low: -1.0, high: 5.0 },
        Family::TruncatedNormal { mean: 1.0, sd: 0.1, low: 1.2, high: 1.3 },
        Family::TruncatedNormal { mean: 1.0, sd: 0.1, low: 0.0, high: 0.8 },
        Family::TruncatedLognormal { median: 0.2, log_sd: 0.5, low: 0.05, high: 1.0 },
        Family::TruncatedLognormal { median: 0.2, log_sd: 0.5, low: 0.5, high: 3.0 },
        Family::TruncatedLognormal { median: 2.0, log_sd: 1.5, low: 0.02, high: 1.0 },
    ]
}

/// The CDF's slope turns a rounding of x into density times x times 1e-16; the lognormal of COV 5e-5 has the steepest,
/// 8e3 x 2 x 1e-16.
#[test]
fn cdf_undoes_quantile() {
    for family in continuous() {
        for k in 1..200 {
            let u = f64::from(k) / 200.0;
            let back = family.cdf(family.quantile(u));
            assert!((back - u).abs() < 1e-11, "{family:?} at {u}: {back}");
        }
    }
}

/// Simpson's rule between the quantiles 1e-14 and 1 - 1e-14, split at the kink of a triangle. The tails left out carry
/// 2e-14 of the probability at less than 20 standard deviations.
#[test]
fn mean_and_sd_are_those_of_the_density() {
    for family in continuous() {
        let [low, high] = [1e-14, 1.0 - 1e-14].map(|u| family.quantile(u));
        let kink = if let Family::Triangular { mode, .. } = family { mode } else { 0.5 * (low + high) };
        let density = |x: f64| family.density(x).expect("continuous");
        let integral = |of: &dyn Fn(f64) -> f64| {
            simpson(low, kink, 4000, |x| of(x) * density(x))
                + simpson(kink, high, 4000, |x| of(x) * density(x))
        };
        close(integral(&|_| 1.0), 1.0, 1e-9, &format!("mass of {family:?}"));
        let mean = family.mean();
        assert!(integral(&|x| x - mean).abs() < 1e-9 * family.sd(), "mean of {family:?}");
        close(integral(&|x| (x - mean) * (x - mean)).sqrt(), family.sd(), 1e-8, &format!("sd of {family:?}"));
    }
}

/// Kolmogorov's test at the level 0.1 %: d (sqrt n + 0.12 + 0.11 / sqrt n) exceeds 1.9495 by chance once in a thousand.
#[test]
fn samples_follow_their_cdf() {
    let n = 10_000;
    for (member, family) in continuous().into_iter().enumerate() {
        let mut values = sample(&family, n, member as u64, "kolmogorov");
        values.sort_by(f64::total_cmp);
        let d = ks_statistic(&values, |x| family.cdf(x));
        assert!(d * (100.0 + 0.12 + 0.0011) < 1.9495, "{family:?}: {d}");
    }
}

/// Each of three entries with probability 1/3 from 30,000 draws: sd 81.6, four of them.
#[test]
fn empirical_entries_are_equally_likely() {
    let family = Family::Empirical { values: vec![5.0, 1.0, 3.0] }.checked().expect("good");
    let values = sample(&family, 30_000, 0, "entries");
    for entry in [1.0, 3.0, 5.0] {
        let count = values.iter().filter(|&&v| v == entry).count() as f64;
        assert!((count - 10_000.0).abs() < 327.0, "{entry}: {count}");
    }
}
