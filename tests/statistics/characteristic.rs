//! Characteristic and design values: the factors of EN 1990, tolerance limits from independent tables, and the paper's three families.
//! What the limits promise is in `printed`.

use pirca::random::standard_normal::cdf;
use pirca::stats::{DESIGN_PROBABILITY, Shape, Variation, below_mean, predictive_factor, tolerance_factor};

/// Collapse angles of the source paper's Table 2 (deg).
const FAMILIES: [[f64; 3]; 3] = [[19.0, 19.0, 18.5], [14.5, 13.5, 15.0], [18.0, 19.0, 21.5]];

#[test]
fn factors_are_those_of_the_tables() {
    // EN 1990 Table D1 has them to two digits; these are computed independently from Student's t and the noncentral t.
    let predictive =
        [(3, 3.372), (4, 2.631), (5, 2.335), (6, 2.177), (8, 2.010), (10, 1.923), (20, 1.772), (30, 1.727)];
    for (n, factor) in predictive {
        let own = predictive_factor(n, 0.05, Variation::Unknown).expect("two or more");
        assert!((own - factor).abs() < 6e-4, "n {n}: {own}");
    }
    let tolerance =
        [(3, 7.656), (4, 5.144), (5, 4.203), (6, 3.708), (8, 3.187), (10, 2.911), (20, 2.396), (30, 2.220)];
    for (n, factor) in tolerance {
        let own = tolerance_factor(n, 0.05, 0.95, Variation::Unknown).expect("two or more");
        assert!((own - factor).abs() < 6e-4, "n {n}: {own}");
    }
    let design = [(4, 11.42), (5, 7.86), (6, 6.37), (8, 5.08), (10, 4.51), (20, 3.67), (30, 3.45)];
    for (n, factor) in design {
        let own = predictive_factor(n, DESIGN_PROBABILITY, Variation::Unknown).expect("two or more");
        assert!((own - factor).abs() < 6e-3, "n {n}: {own}");
    }
    // Known variation: 1.645 sqrt(1 + 1/n), for a single value too.
    for n in [1, 2, 10] {
        let own = predictive_factor(n, 0.05, Variation::Known(0.1)).expect("any number");
        assert!((own - 1.644_854 * (1.0 + 1.0 / n as f64).sqrt()).abs() < 1e-6);
    }
    assert_eq!(predictive_factor(1, 0.05, Variation::Unknown), None);
    assert_eq!(tolerance_factor(1, 0.05, 0.95, Variation::Unknown), None);
}

#[test]
fn three_walls_of_a_family_support_a_characteristic_value_and_no_design_value() {
    let unknown = Variation::Unknown;
    let normal = |values: &[f64], factor: Option<f64>| {
        below_mean(values, factor.expect("three"), Shape::Normal, unknown).expect("three")
    };
    let expected = [[17.86, 16.62, 11.99], [11.76, 8.49, -3.8], [13.42, 5.70, -23.0]];
    for (values, [predictive, tolerance, design]) in FAMILIES.iter().zip(expected) {
        let own = [
            normal(values, predictive_factor(3, 0.05, unknown)),
            normal(values, tolerance_factor(3, 0.05, 0.95, unknown)),
            // The reference takes the probability of 0.8 times 3.8 standard deviations.
            normal(values, predictive_factor(3, cdf(-0.8 * 3.8), unknown)),
        ];
        assert!((own[0] - predictive).abs() < 0.01 && (own[1] - tolerance).abs() < 0.01, "{own:?}");
        assert!((own[2] - design).abs() < 0.4, "{own:?}");
    }
    for (values, expected) in FAMILIES.iter().zip([15.57, 11.84, 16.08]) {
        let known = Variation::Known(0.1);
        let factor = predictive_factor(3, 0.05, known).expect("known");
        let own = below_mean(values, factor, Shape::Lognormal, known).expect("above 0");
        // The reference takes 0.1 for sqrt(ln 1.01) = 0.0998, and rounds to 0.01.
        assert!((own - expected).abs() < 0.015, "{own}");
    }
    assert_eq!(below_mean(&[1.0, 0.0], 2.0, Shape::Lognormal, unknown), None);
    assert_eq!(below_mean(&[], 2.0, Shape::Normal, unknown), None);
}
