//! The truncated normal against closed forms with 80 digits, in the middle and far in the tails.

use crate::support::{close, sample};
use pirca::random::Family;

/// Bounds (a, b) of a standard normal; mean, sd and 30 % quantile from mpmath with 80 digits, by the closed
/// forms that lose too many of them in double precision: mean (phi(a) - phi(b)) / Z, variance
/// 1 + (a phi(a) - b phi(b)) / Z - mean^2 with Z = Phi(b) - Phi(a), and the root of the complementary error function.
const EXACT: [(f64, f64, f64, f64, f64); 7] = [
    (-1.0, 2.0, 0.229637179091329, 0.7209455868590458, -0.2424038178892268),
    (2.0, 3.0, 2.315821326743782, 0.24803382748022488, 2.136236723579322),
    (8.0, 9.0, 8.121188992979798, 0.11894764723502567, 8.04379213039024),
    (30.0, 31.0, 30.03325966743362, 0.03322305693092197, 30.011873653870605),
    (-31.0, -30.0, -30.03325966743362, 0.03322305693092197, -30.04006129367795),
    (5.0, 1000.0, 5.186503967125842, 0.1808215546253052, 5.068334263013016),
    (37.0, 37.5, 37.02698768210814, 0.02696805686448863, 37.00963158530542),
];

/// Moments: 1e-13 (quadrature to rounding). Quantile: an error of 1e-16 z^2 in the tail's logarithm moves z by 1e-16 z.
#[test]
fn moments_and_quantiles_hold_in_the_tails() {
    for (a, b, mean, sd, at_30) in EXACT {
        let family = Family::TruncatedNormal { mean: 0.0, sd: 1.0, low: a, high: b }.checked().expect("good");
        let what = format!("[{a}, {b}]");
        close(family.mean(), mean, 1e-13, &what);
        close(family.sd(), sd, 1e-13, &what);
        close(family.quantile(0.3), at_30, 1e-14, &what);
        // The rounding of z^2/2 in the exponent, 1e-16 x 700, bounds the CDF.
        close(family.cdf(at_30), 0.3, 1e-11, &what);
    }
}

/// Location and scale enter as x = mean + sd z.
#[test]
fn location_and_scale() {
    let family = Family::TruncatedNormal { mean: 0.2, sd: 0.05, low: 0.15, high: 0.3 };
    let (_, _, mean, sd, at_30) = EXACT[0];
    close(family.mean(), 0.2 + 0.05 * mean, 1e-13, "mean");
    close(family.sd(), 0.05 * sd, 1e-13, "sd");
    close(family.quantile(0.3), 0.2 + 0.05 * at_30, 1e-14, "quantile");
}

/// Rejection sampling from the parent is another way to the same variable: both sample means must agree within four
/// standard errors, sd / sqrt n each.
#[test]
fn rejection_from_the_parent_gives_the_same_mean() {
    let parent = Family::Normal { mean: 0.0, sd: 1.0 };
    let kept: Vec<f64> =
        sample(&parent, 40_000, 1, "parent").into_iter().filter(|z| (-0.5..=1.5).contains(z)).collect();
    let family = Family::TruncatedNormal { mean: 0.0, sd: 1.0, low: -0.5, high: 1.5 };
    let found = kept.iter().sum::<f64>() / kept.len() as f64;
    let error = family.sd() / (kept.len() as f64).sqrt();
    assert!((found - family.mean()).abs() < 4.0 * error, "{found} instead of {}", family.mean());
}

/// A narrow interval is nearly uniform: mean in the middle less slope, sd = width / sqrt 12 to second order.
#[test]
fn a_narrow_interval_is_nearly_uniform() {
    let family = Family::TruncatedNormal { mean: 0.0, sd: 1.0, low: 1.0, high: 1.0001 };
    close(family.sd(), 1e-4 / 12.0_f64.sqrt(), 1e-7, "sd");
    for u in [0.01, 0.3, 0.99] {
        let x = family.quantile(u);
        assert!((x - (1.0 + 1e-4 * u)).abs() < 1e-8 && (family.cdf(x) - u).abs() < 1e-10, "{u}: {x}");
    }
}
