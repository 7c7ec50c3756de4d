//! How many specimens tell what: the reference's numbers, and what the numbers promise.

use pirca::random::Streams;
use pirca::random::standard_normal::quantile;
use pirca::stats::{
    Aim, Shape, Variation, below_mean, characteristic_loss, mean, pairs_to_see, power_of_groups,
    predictive_factor, sigma, smallest_seen, specimens_for_characteristic, specimens_to_see,
    student_quantile,
};

use crate::support::near_share;

const AIM: Aim = Aim { confidence: 0.95, power: 0.8 };

/// Table D10 of the reference: a difference of 5 %.
#[test]
fn pairs_to_see_five_per_cent_are_those_of_the_reference() {
    for (cov, alone, paired) in [(0.053, 17.6, 3.5), (0.10, 63.0, 12.6), (0.22, 304.0, 61.0)] {
        let [own, own_paired] = [0.0, 0.8].map(|correlation| pairs_to_see(cov, correlation, 0.05, AIM));
        // To the digits that are given.
        assert!(
            (own - alone).abs() < 0.5 && (own_paired - paired).abs() < 0.25,
            "V {cov}: {own}, {own_paired}"
        );
    }
    assert!(pairs_to_see(0.1, 0.0, 0.0, AIM).is_infinite());
}

/// R: power.t.test(power = 0.8, delta = 1) has n 16.71; delta 0.5: 63.77; delta 2: 5.09.
#[test]
fn specimens_of_two_groups_are_those_of_students_test() {
    for (effect, n) in [(1.0, 17), (0.5, 64), (2.0, 6)] {
        assert_eq!(specimens_to_see(effect, AIM), Some(n));
        assert!(power_of_groups(effect, n - 1, 0.95) < 0.8 && power_of_groups(effect, n, 0.95) >= 0.8);
    }
    let smallest = smallest_seen(3, AIM).expect("three");
    assert!((power_of_groups(smallest, 3, 0.95) - 0.8).abs() < 1e-9);
    // No difference is called one as often as the confidence leaves.
    assert!((power_of_groups(0.0, 7, 0.95) - 0.05).abs() < 1e-6);
    assert_eq!(
        (power_of_groups(3.0, 1, 0.95), smallest_seen(1, AIM), specimens_to_see(0.0, AIM)),
        (0.0, None, None)
    );
}

#[test]
fn a_difference_is_seen_as_often_as_promised() {
    const REPEATS: u64 = 4000;
    for (n, effect) in [(3, 2.5), (8, 1.5)] {
        let seen = |k: u64| {
            let mut draws = Streams::new(63, k).of("groups");
            let mut group =
                |shift: f64| -> Vec<f64> { (0..n).map(|_| quantile(draws.uniform()) + shift).collect() };
            let (a, b) = (group(0.0), group(effect));
            let pooled = (0.5
                * (sigma(&a).unwrap() * sigma(&a).unwrap() + sigma(&b).unwrap() * sigma(&b).unwrap()))
            .sqrt();
            let t = (mean(&b).unwrap() - mean(&a).unwrap()) / pooled / (2.0 / n as f64).sqrt();
            t.abs() > student_quantile(0.975, 2.0 * n as f64 - 2.0)
        };
        let share = (0..REPEATS).filter(|k| seen(*k)).count() as f64 / REPEATS as f64;
        near_share(share, power_of_groups(effect, n, 0.95), REPEATS, 0.0, &format!("{n} specimens"));
    }
}

#[test]
fn a_characteristic_value_loses_in_the_mean_what_is_said() {
    const REPEATS: u64 = 4000;
    let (n, cov) = (5, 0.1);
    let factor = predictive_factor(n, 0.05, Variation::Unknown).expect("five");
    let value = |k: u64| {
        let mut draws = Streams::new(64, k).of("sample");
        let values: Vec<f64> = (0..n).map(|_| 1.0 + cov * quantile(draws.uniform())).collect();
        below_mean(&values, factor, Shape::Normal, Variation::Unknown).expect("values")
    };
    let values: Vec<f64> = (0..REPEATS).map(value).collect();
    let truth = 1.0 - 1.644_854 * cov;
    let lost = 1.0 - mean(&values).unwrap() / truth;
    let told = characteristic_loss(n, 0.05, cov).expect("a fractile above 0");
    // The sample's sigma is 0.94 of the truth in the mean of five values: the loss is that much smaller than told.
    let error = 4.0 * sigma(&values).unwrap() / truth / (REPEATS as f64).sqrt();
    let expected = told - 0.06 * factor * cov / truth;
    assert!((lost - expected).abs() < error + 0.002, "{lost} against {expected}");
    let enough = specimens_for_characteristic(0.05, cov, 0.02).expect("some");
    assert!(characteristic_loss(enough, 0.05, cov).unwrap() <= 0.02);
    assert!(characteristic_loss(enough - 1, 0.05, cov).unwrap() > 0.02);
    // A COV of 0.7 has its fractile below 0, and one specimen has no scatter.
    assert_eq!(
        (specimens_for_characteristic(0.05, 0.7, 0.1), characteristic_loss(1, 0.05, 0.1)),
        (None, None)
    );
}
