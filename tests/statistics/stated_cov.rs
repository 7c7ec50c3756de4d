//! The test of a stated coefficient of variation: how often it doubts what is right, and what is wrong.

use crate::support::{near_share, sample, share};
use pirca::random::Family;
use pirca::stats::{CovTest, Scatter, Shape};

const CASES: u64 = 4000;

fn doubted(shape: Shape, n: usize, cov: f64, stated: f64, side: Scatter) -> f64 {
    let family = match shape {
        Shape::Normal => Family::Normal { mean: 20.0, sd: 20.0 * cov },
        Shape::Lognormal => Family::Lognormal { mean: 20.0, sd: 20.0 * cov },
    };
    share(CASES, |k| {
        CovTest::of(&sample(&family, n, k, "stated"), stated, shape).unwrap().doubt() == Some(side)
    })
}

/// Each side is doubted in 2.5 of 100 cases. Of logarithms the test is exact; McKay's statistic is off by less than half a case in a
/// hundred up to a COV of 0.3.
#[test]
fn a_stated_variation_that_is_right_is_doubted_in_five_of_a_hundred_cases() {
    for n in [2, 3, 5, 10, 30] {
        for cov in [0.05, 0.1, 0.3] {
            for (shape, bias) in [(Shape::Lognormal, 0.0), (Shape::Normal, 0.005)] {
                for side in [Scatter::Larger, Scatter::Smaller] {
                    let found = doubted(shape, n, cov, cov, side);
                    near_share(found, 0.025, CASES, bias, &format!("{shape:?}, {n} at {cov}, {side:?}"));
                }
            }
        }
    }
}

/// Of five specimens that scatter by twice as much as was stated more than a half are doubted; by four times nine in ten.
#[test]
fn a_stated_variation_that_is_too_small_is_doubted() {
    for shape in [Shape::Normal, Shape::Lognormal] {
        let found = [0.2, 0.4].map(|cov| doubted(shape, 5, cov, 0.1, Scatter::Larger));
        println!("{shape:?}: {found:?}");
        assert!(found[0] > 0.5 && found[1] > 0.9, "{shape:?}: {found:?}");
    }
    let angles = [9.0, 12.0, 18.0, 24.0, 30.0];
    for (shape, statistic) in [(Shape::Normal, 73.6), (Shape::Lognormal, 97.54)] {
        let found = CovTest::of(&angles, 0.1, shape).unwrap();
        // 4 s^2 of the logarithms is 0.9705 and ln(1.01) 0.00995; s over the mean is 0.4619.
        assert!((found.chi_square - statistic).abs() < 0.1, "{found:?}");
        assert_eq!((found.degrees_of_freedom, found.doubt()), (4, Some(Scatter::Larger)));
        assert!(found.p_value < 1e-13);
    }
}

/// Very many values are tested by the normal law of the cube root.
#[test]
fn very_many_values_are_tested_too() {
    let family = Family::Normal { mean: 20.0, sd: 2.0 };
    let values = sample(&family, 1_000_100, 1, "many");
    let right = CovTest::of(&values, 0.1, Shape::Normal).unwrap();
    assert!(right.p_value > 0.01, "{right:?}");
    let wrong = CovTest::of(&values, 0.0995, Shape::Normal).unwrap();
    assert_eq!(wrong.doubt(), Some(Scatter::Larger));
}

#[test]
fn what_has_no_variation_is_not_tested() {
    for values in [&[][..], &[20.0]] {
        assert_eq!(CovTest::of(values, 0.1, Shape::Normal), None);
    }
    assert_eq!(CovTest::of(&[-1.0, 1.0], 0.1, Shape::Normal), None);
    assert_eq!(CovTest::of(&[0.0, 1.0], 0.1, Shape::Lognormal), None);
    let alike = CovTest::of(&[20.0; 5], 0.1, Shape::Normal).unwrap();
    assert_eq!(alike.doubt(), Some(Scatter::Smaller));
}
