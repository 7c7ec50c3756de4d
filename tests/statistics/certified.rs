//! Certified means and standard deviations (NIST Statistical Reference Datasets, univariate summary statistics), and
//! intervals from quantiles computed with 30 digits.

use crate::support::close;
use pirca::stats::{Summary, cov, mean, sigma, sum};

const MICHELSON: [f64; 100] = [
    299.85, 299.74, 299.90, 300.07, 299.93, 299.85, 299.95, 299.98, 299.98, 299.88, 300.00, 299.98, 299.93,
    299.65, 299.76, 299.81, 300.00, 300.00, 299.96, 299.96, 299.96, 299.94, 299.96, 299.94, 299.88, 299.80,
    299.85, 299.88, 299.90, 299.84, 299.83, 299.79, 299.81, 299.88, 299.88, 299.83, 299.80, 299.79, 299.76,
    299.80, 299.88, 299.88, 299.88, 299.86, 299.72, 299.72, 299.62, 299.86, 299.97, 299.95, 299.88, 299.91,
    299.85, 299.87, 299.84, 299.84, 299.85, 299.84, 299.84, 299.84, 299.89, 299.81, 299.81, 299.82, 299.80,
    299.77, 299.76, 299.74, 299.75, 299.76, 299.91, 299.92, 299.89, 299.86, 299.88, 299.72, 299.84, 299.85,
    299.85, 299.78, 299.89, 299.84, 299.78, 299.81, 299.76, 299.81, 299.79, 299.81, 299.82, 299.85, 299.87,
    299.87, 299.81, 299.74, 299.81, 299.94, 299.95, 299.80, 299.81, 299.87,
];

fn alternating(first: f64, low: f64, high: f64) -> Vec<f64> {
    (0..1001)
        .map(|k| {
            if k == 0 {
                first
            } else if k % 2 == 1 {
                low
            } else {
                high
            }
        })
        .collect()
}

/// (name, values, certified mean, certified sigma, relative tolerance of sigma). The values of NumAcc3 and NumAcc4 are
/// no binary fractions: their rounding, 1e-16 of the mean, weighs 1e-16 mean / sigma in sigma.
#[test]
fn nist_certified_mean_and_sigma() {
    let cases = [
        ("Michelso", MICHELSON.to_vec(), 299.8524, 0.0790105478190518, 1e-12),
        ("NumAcc1", vec![10000001.0, 10000003.0, 10000002.0], 10000002.0, 1.0, 1e-15),
        ("NumAcc2", alternating(1.2, 1.1, 1.3), 1.2, 0.1, 1e-14),
        ("NumAcc3", alternating(1000000.2, 1000000.1, 1000000.3), 1000000.2, 0.1, 1e-9),
        ("NumAcc4", alternating(10000000.2, 10000000.1, 10000000.3), 10000000.2, 0.1, 1e-8),
    ];
    for (name, values, certified_mean, certified_sigma, tolerance) in cases {
        let summary = Summary::of(&values);
        close(summary.mean.value.expect("a mean"), certified_mean, 1e-15, name);
        close(summary.sigma.value.expect("a sigma"), certified_sigma, tolerance, name);
        close(summary.cov.value.expect("a COV"), certified_sigma / certified_mean, tolerance, name);
        assert_eq!(
            (mean(&values), sigma(&values), cov(&values)),
            (summary.mean.value, summary.sigma.value, summary.cov.value)
        );
    }
}

/// Half-width t sigma / sqrt n, sigma sqrt(v/u), and for the COV the example of Vangel (1996); quantiles from mpmath's
/// incomplete beta and gamma functions with 30 digits. 1e-9: what the quantiles of statrs promise.
#[test]
fn intervals_from_high_precision_quantiles() {
    let t_99 = 1.98421695158642;
    let michelson = Summary::of(&MICHELSON);
    let [low, high] = michelson.mean.interval.expect("an interval");
    close(high - low, 2.0 * t_99 * 0.0790105478190518 / 10.0, 1e-9, "t interval");
    close(0.5 * (low + high), 299.8524, 1e-14, "centre");

    let three = Summary::of(&[9.0, 10.0, 11.0]);
    let [low, high] = three.mean.interval.expect("an interval");
    close(high - low, 2.0 * 4.302652729749464 / 3.0_f64.sqrt(), 1e-9, "t interval of three");
    let [low, high] = three.sigma.interval.expect("an interval");
    close(low, (2.0 / 7.377758908227873_f64).sqrt(), 1e-9, "lower end of sigma");
    close(high, (2.0 / 0.05063561596857975_f64).sqrt(), 1e-9, "upper end of sigma");

    let vangel = Summary::of(&[326.0, 302.0, 307.0, 299.0, 329.0]);
    close(vangel.cov.value.expect("a COV"), 0.0445910220389, 1e-11, "COV");
    let [low, high] = vangel.cov.interval.expect("an interval");
    close(low, 0.026700444660647, 1e-9, "lower end of the COV");
    close(high, 0.12866730800672, 1e-9, "upper end of the COV");
}

#[test]
fn what_a_sample_does_not_define_is_none() {
    let nothing = Summary::of(&[]);
    assert_eq!(
        (nothing.n, nothing.mean.value, nothing.sigma.value, nothing.cov.value),
        (0, None, None, None)
    );
    let one = Summary::of(&[14.5]);
    assert_eq!((one.n, one.mean.value, one.mean.interval), (1, Some(14.5), None));
    assert_eq!(
        (one.sigma.value, one.sigma.interval, one.cov.value, one.cov.interval),
        (None, None, None, None)
    );
    let centred = Summary::of(&[-1.0, 1.0]);
    assert_eq!((centred.mean.value, centred.cov.value, centred.cov.interval), (Some(0.0), None, None));
    assert!(centred.sigma.value.is_some());
    // Three values at a COV of 0.78 are compatible with any larger COV.
    let wide = Summary::of(&[0.9, 0.9, 3.1]);
    assert!(wide.cov.value.is_some() && wide.cov.interval.is_none());
}

#[test]
fn equal_values_have_no_scatter_at_all() {
    let walls = Summary::of(&[0.1; 7]);
    assert_eq!((walls.mean.value, walls.mean.interval), (Some(0.1), Some([0.1, 0.1])));
    assert_eq!((walls.sigma.value, walls.sigma.interval), (Some(0.0), Some([0.0, 0.0])));
    assert_eq!((walls.cov.value, walls.cov.interval), (Some(0.0), Some([0.0, 0.0])));
}

#[test]
fn a_negative_mean_has_the_cov_of_its_mirror_image() {
    let mirrored = Summary::of(&[-9.0, -10.0, -11.0]);
    let plain = Summary::of(&[9.0, 10.0, 11.0]);
    assert_eq!(mirrored.cov, plain.cov);
}

/// Without compensation the ones are lost.
#[test]
fn sum_keeps_what_large_terms_hide() {
    assert_eq!(sum(&[1.0, 1e100, 1.0, -1e100]), 2.0);
    assert_eq!(sum(&[]), 0.0);
}

#[test]
fn values_that_are_not_finite_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, 1e151] {
        assert!(std::panic::catch_unwind(|| Summary::of(&[1.0, bad])).is_err());
    }
}
