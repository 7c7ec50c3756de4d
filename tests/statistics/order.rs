//! Quantiles, their distribution-free interval, and the Kolmogorov distance.

use pirca::stats::{ks_p_value, ks_statistic, quantile, quantile_interval, smallest};

/// Type 7 of Hyndman and Fan: with n values the k-th smallest sits at (k - 1) / (n - 1).
#[test]
fn type_7_quantiles_by_hand() {
    let values = [4.0, 1.0, 3.0, 2.0, 10.0];
    for (p, expected) in [(0.0, 1.0), (0.25, 2.0), (0.5, 3.0), (0.6, 3.4), (0.875, 7.0), (1.0, 10.0)] {
        let found = quantile(&values, p).expect("values");
        assert!((found - expected).abs() < 1e-14, "at {p}: {found}");
    }
    assert_eq!(quantile(&[], 0.5), None);
    assert_eq!(quantile(&[7.0], 0.3), Some(7.0));
}

/// Ranks of the interval of the median from binomial tables: 6 values (1, 6), 10 values (2, 9), 30 values (10, 21);
/// none for 5, whose extremes miss the median with probability 2/32 > 5 %.
#[test]
fn ranks_that_bound_the_median() {
    for (n, ranks) in [
        (0, None),
        (1, None),
        (5, None),
        (6, Some([1.0, 6.0])),
        (10, Some([2.0, 9.0])),
        (30, Some([10.0, 21.0])),
    ] {
        let values: Vec<f64> = (1..=n).rev().map(f64::from).collect();
        assert_eq!(quantile_interval(&values, 0.5), ranks, "n = {n}");
    }
    // 0.95^n must fall below 2.5 % before the largest value exceeds the 95 % quantile: n = 72 (0.95^71 = 2.62 %).
    let values = |n: u32| (1..=n).map(f64::from).collect::<Vec<_>>();
    assert_eq!(quantile_interval(&values(71), 0.95), None);
    assert_eq!(quantile_interval(&values(72), 0.95).map(|i| i[1]), Some(72.0));
}

#[test]
fn kolmogorov_distance_by_hand() {
    let uniform = |x: f64| x;
    assert!((ks_statistic(&[0.5], uniform) - 0.5).abs() < 1e-15);
    assert!((ks_statistic(&[0.1, 0.2, 0.6], uniform) - (2.0 / 3.0 - 0.2)).abs() < 1e-15);
    assert!((ks_statistic(&[0.7, 0.8, 0.9], uniform) - 0.7).abs() < 1e-15);
}

/// Exact probabilities from an own program after Marsaglia, Tsang and Wang (2003), which gives their published
/// P(D_10 < 0.274) = 0.62847 to five digits. Tolerances as documented.
#[test]
fn kolmogorov_probability_against_the_exact_law() {
    let exact = [
        (10, 0.274, 0.37152038454349556, 0.025),
        (10, 0.192054, 0.78919, 0.025),
        (10, 0.41, 0.04932075782870493, 0.002),
        (30, 0.2, 0.1579691610154742, 0.025),
        (30, 0.24, 0.05263551637809549, 0.002),
        (100, 0.136, 0.04486029979085471, 0.002),
    ];
    for (n, d, p, tolerance) in exact {
        let found = ks_p_value(d, n);
        assert!((found - p).abs() < tolerance, "n = {n}, d = {d}: {found} instead of {p}");
    }
    assert_eq!((ks_p_value(0.0, 10), ks_p_value(1.0, 10000)), (1.0, 0.0));
    // The two series meet at lambda = 1: P = 0.2699996716735 (Kolmogorov's table).
    let n = 1_000_000;
    let at = |lambda: f64| ks_p_value(lambda / (1000.0 + 0.12 + 0.00011), n);
    for lambda in [1.0 - 1e-9, 1.0 + 1e-9] {
        assert!((at(lambda) - 0.2699996716735).abs() < 1e-8, "{}", at(lambda));
    }
}

#[test]
fn the_smallest_values_are_told_by_their_places() {
    let values = [3.0, -1.0, 2.0, -1.0, 7.0, 0.5];
    let of = |count: usize| smallest(values.into_iter().zip(0..), count);
    assert_eq!(of(3), [1, 3, 5]);
    assert_eq!((of(0), of(1)), (vec![], vec![1]));
    assert_eq!(of(9), [1, 3, 5, 2, 0, 4]);
}
