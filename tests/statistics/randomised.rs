//! Intervals from independent randomisations of a design.

use pirca::random::{Design, Place, RANDOMISATIONS};
use pirca::stats::{Sample, Trials, by_randomisations, clopper_pearson, mean, sigma, student_quantile};

#[test]
fn the_interval_of_a_mean_is_students_over_the_means_of_the_randomisations() {
    let shared: Vec<Vec<f64>> = (0..5).map(|r| (0..4).map(|k| f64::from(r * r + 3 * k)).collect()).collect();
    let means: Vec<f64> = shared.iter().map(|own| mean(own).unwrap()).collect();
    let half = student_quantile(0.975, 4.0) * sigma(&means).unwrap() / 5.0_f64.sqrt();
    let found = by_randomisations(&shared, mean);
    let [low, high] = found.interval.unwrap();
    assert!((found.value.unwrap() - mean(&means).unwrap()).abs() < 1e-12);
    assert!((high - low - 2.0 * half).abs() < 1e-12, "{low} {high} {half}");
    assert_eq!(by_randomisations(&shared[..2], mean).interval, None);
    assert_eq!(by_randomisations::<f64>(&[], mean).value, None);
}

/// A mean of a smooth function by a scrambled net: its interval is far shorter than that of independent points, and holds the truth.
#[test]
fn designs_have_short_intervals_that_hold_the_truth() {
    let (points, repeats) = (16, 200);
    let mut lengths = Vec::new();
    for design in [Design::LatinHypercube, Design::Sobol] {
        let (mut held, mut length) = ([0; 2], 0.0);
        for seed in 0..repeats {
            let value = |member: u64| {
                let of = |name, number| design.uniform(Place { seed, member, points }, name, number);
                let (x, y) = (of("x", 0).unwrap(), of("y", 1).unwrap());
                (member, x + y * y + 0.5 * x * y)
            };
            let sample = Sample::of((0..points * RANDOMISATIONS).map(value), RANDOMISATIONS);
            let summary = sample.summary();
            let [low, high] = summary.mean.interval.unwrap();
            length += (high - low) / repeats as f64;
            let exact = 0.5 + 1.0 / 3.0 + 0.125;
            held[0] += u32::from(low <= exact && exact <= high);
            // Its median, from a sum over a fine grid.
            let [low, high] = sample.quantile(0.5).interval.unwrap();
            held[1] += u32::from(low <= 0.9156 && 0.9156 <= high);
        }
        println!("{design:?}: {held:?} of {repeats}, length {length:.2e}");
        // Three standard errors of 200 intervals at 95 % are 9.
        assert!(held[0] >= 180 && held[1] >= 176, "{design:?}: {held:?}");
        lengths.push(length);
    }
    // 256 independent points: 2 x 1.97 x 0.517 / 16 = 0.127. What is left of a Latin hypercube's error is the interaction of x and y,
    // which a net evens out as well.
    assert!(lengths[0] < 0.02 && lengths[1] < 0.8 * lengths[0], "{lengths:?}");
}

/// The share of walls that fall in some way is the mean of ones and zeros, and so is its interval over the randomisations.
#[test]
fn a_share_from_counts_is_that_of_ones_and_zeros() {
    let falls_so = |member: u64| member.is_multiple_of(3) || member.is_multiple_of(7);
    let mut trials = Trials::none(RANDOMISATIONS);
    let mut shared = vec![Vec::new(); RANDOMISATIONS as usize];
    // The last walls are missing, so that the randomisations differ in size.
    for member in 0..10 * RANDOMISATIONS - 5 {
        trials.take(member, falls_so(member));
        shared[(member % RANDOMISATIONS) as usize].push(f64::from(u8::from(falls_so(member))));
    }
    let (found, wanted) = (trials.share(), by_randomisations(&shared, mean));
    assert!((found.value.unwrap() - wanted.value.unwrap()).abs() < 1e-14);
    for (found, wanted) in found.interval.unwrap().into_iter().zip(wanted.interval.unwrap()) {
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
    // An interval of a probability ends at 0 and 1, and without a trial there is none.
    let mut rare = Trials::none(RANDOMISATIONS);
    (0..64).for_each(|member| rare.take(member, member == 5));
    assert_eq!(rare.share().interval.unwrap()[0], 0.0);
    // What was never so is not impossible, nor is what was so always certain.
    for all in [false, true] {
        let mut trials = Trials::none(RANDOMISATIONS);
        (0..64).for_each(|member| trials.take(member, all));
        assert_eq!(trials.share().interval, Some(clopper_pearson(if all { 64 } else { 0 }, 64)));
    }
    assert_eq!(Trials::none(RANDOMISATIONS).share().value, None);
    assert_eq!(Trials::none(1).share().interval, None);
}
