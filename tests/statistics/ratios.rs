//! Ratios of means: closed forms, degenerate cases, independent derivation.

use crate::support::close;
use pirca::stats::{Summary, paired_ratio_of_means, ratio_of_means};

/// Against one deterministic wall the ratio is the mean over a constant: its interval is Student's, scaled.
#[test]
fn a_single_value_below_the_line_is_a_constant() {
    let walls = [1.1, 0.8, 1.3, 0.9, 1.4];
    let [low, high] = Summary::of(&walls).mean.interval.expect("an interval");
    let ratio = ratio_of_means(&walls, &[2.0]);
    close(ratio.value.expect("a ratio"), 0.55, 1e-15, "ratio");
    let found = ratio.interval.expect("an interval");
    close(found[0], low / 2.0, 1e-14, "lower end");
    close(found[1], high / 2.0, 1e-14, "upper end");
}

/// A constant over a mean: the ends are those of Student's interval, inverted.
#[test]
fn a_single_value_above_the_line_is_a_constant() {
    let walls = [1.1, 0.8, 1.3, 0.9, 1.4];
    let [low, high] = Summary::of(&walls).mean.interval.expect("an interval");
    let found = ratio_of_means(&[2.0], &walls).interval.expect("an interval");
    close(found[0], 2.0 / high, 1e-14, "lower end");
    close(found[1], 2.0 / low, 1e-14, "upper end");
}

/// At both ends rho the paired test of a - rho b must be at its 5 % point: |mean| = t s / sqrt n.
#[test]
fn ends_of_the_paired_interval_are_just_rejected() {
    let a = [3.1, 2.7, 4.0, 3.6, 2.9, 3.3];
    let b = [4.2, 3.9, 4.9, 5.1, 4.0, 4.3];
    let found = paired_ratio_of_means(&a, &b);
    let interval = found.interval.expect("an interval");
    assert!(interval[0] < found.value.expect("a ratio") && found.value.expect("a ratio") < interval[1]);
    for (end, side) in interval.into_iter().zip([0, 1]) {
        let differences: Vec<f64> = a.iter().zip(&b).map(|(x, y)| x - end * y).collect();
        let at_zero = Summary::of(&differences).mean.interval.expect("an interval")[1 - side];
        // One end of Student's interval touches zero; 1e-12 is rounding on numbers of order 1.
        let touching =
            at_zero.abs().min(Summary::of(&differences).mean.interval.expect("an interval")[side].abs());
        assert!(touching < 1e-12, "end {end}: {touching}");
    }
}

/// Two independent samples with equal variances and sizes at a ratio of 1: Satterthwaite gives 2 (n - 1) degrees of
/// freedom, and the ends solve (a - rho b)^2 = t^2 (1 + rho^2) s^2 / n. Here a = b = 10, s = 1, n = 3, t = 2.776445.
#[test]
fn independent_samples_by_hand() {
    let found = ratio_of_means(&[9.0, 10.0, 11.0], &[9.0, 10.0, 11.0]);
    let g = 2.7764451051977934_f64 * 2.7764451051977934 / 3.0;
    // (100 - g) rho^2 - 200 rho + (100 - g) = 0.
    let half = 100.0 / (100.0 - g);
    let root = (half * half - 1.0).sqrt();
    let interval = found.interval.expect("an interval");
    close(interval[0], half - root, 1e-9, "lower end");
    close(interval[1], half + root, 1e-9, "upper end");
}

#[test]
fn pairs_in_a_fixed_ratio_have_no_scatter() {
    let b = [4.2, 3.9, 4.9, 5.1];
    let a = b.map(|v| 0.75 * v);
    let found = paired_ratio_of_means(&a, &b);
    let interval = found.interval.expect("an interval");
    // Residuals are roundings only.
    assert!(interval.iter().all(|end| (end - 0.75).abs() < 1e-14), "{interval:?}");
}

#[test]
fn undefined_and_unbounded_ratios() {
    assert_eq!(ratio_of_means(&[], &[1.0, 2.0]).value, None);
    assert_eq!(ratio_of_means(&[1.0], &[-1.0, 1.0]).value, None);
    let exact = ratio_of_means(&[3.0], &[4.0]);
    assert_eq!((exact.value, exact.interval), (Some(0.75), None));
    let pair = paired_ratio_of_means(&[3.0], &[4.0]);
    assert_eq!((pair.value, pair.interval), (Some(0.75), None));
    // The mean below the line, 0.5 with a standard error of 1.5, may be 0.
    let unbounded = ratio_of_means(&[1.0, 1.1, 0.9], &[2.0, -1.0]);
    assert!(unbounded.value.is_some() && unbounded.interval.is_none());
    let fixed = ratio_of_means(&[3.0, 3.0], &[4.0, 4.0]);
    assert_eq!((fixed.value, fixed.interval), (Some(0.75), Some([0.75, 0.75])));
    assert!(std::panic::catch_unwind(|| paired_ratio_of_means(&[1.0, 2.0], &[1.0])).is_err());
}
