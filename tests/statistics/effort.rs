//! Stratified and importance sampling are unbiased, and take what their formulas say.

use pirca::random::standard_normal::{cdf, quantile};
use pirca::random::{Stream, Streams};
use pirca::stats::strata::{STRATA, allocated, chosen, counts, stratum};
use pirca::stats::subset::Settings;
use pirca::stats::{effort, importance, mean, sigma};

fn normal(stream: &mut Stream) -> f64 {
    quantile(stream.uniform())
}

/// Mean of the runs over the exact probability, its standard error, and the effort: squared coefficient of variation times values.
fn found(probabilities: &[f64], exact: f64, values: f64) -> [f64; 3] {
    let (mean, sigma) = (mean(probabilities).unwrap(), sigma(probabilities).unwrap());
    let cov = sigma / mean;
    [mean / exact, sigma / exact / (probabilities.len() as f64).sqrt(), cov * cov * values]
}

/// A value of which a cheaper one leaves little open: of a correlation and an index.
#[test]
fn stratified_sampling_is_unbiased_at_the_effort_of_neyman() {
    for (index, rho) in [(1.5, 0.9), (2.5, 0.95), (2.0, 0.6)] {
        let left = (1.0_f64 - rho * rho).sqrt();
        let cost = 0.05;
        let dear = 200;
        let cheap = (dear as f64 * effort::cheap_per_dear(index, rho, cost)) as usize;
        let mut solved = 0;
        let runs: Vec<f64> = (0..400)
            .map(|run| {
                let mut stream = Streams::new(5, run).of("stratified");
                let pairs: Vec<[f64; 2]> = (0..cheap)
                    .map(|_| {
                        let x = normal(&mut stream);
                        [x, rho * x + left * normal(&mut stream)]
                    })
                    .collect();
                let mut strata: [Vec<usize>; STRATA] = Default::default();
                for (at, [x, _]) in pairs.iter().enumerate() {
                    strata[stratum((rho * x + index) / left)].push(at);
                }
                let sizes = strata.each_ref().map(Vec::len);
                let taken = allocated(&sizes, dear);
                solved += taken.iter().sum::<usize>();
                (0..STRATA)
                    .map(|of| {
                        let worse = |at: &usize| pairs[*at][1] <= -index;
                        let own = chosen(&strata[of], taken[of], stream.uniform());
                        let hits = own.into_iter().filter(worse).count();
                        if taken[of] == 0 { 0.0 } else { hits as f64 * counts(&sizes, &taken, of) }
                    })
                    .sum()
            })
            .collect();
        let values = solved as f64 / 400.0 + cost * cheap as f64;
        let [ratio, error, own] = found(&runs, cdf(-index), values);
        let expected = effort::stratified(index, rho, cost);
        let plain = effort::plain(index);
        println!(
            "index {index}, rho {rho}: {ratio:.3} +- {error:.3}, effort {own:.1} of {expected:.1}, plain {plain:.1}"
        );
        assert!((ratio - 1.0).abs() < 4.0 * error, "{ratio} {error}");
        // A tenth looks far beyond the level, and seven strata are not infinitely many.
        assert!(own > 0.8 * expected && own < 1.7 * expected, "{own} {expected}");
    }
    // What has nothing to do with the value costs more than it brings; what says all costs its own price.
    assert!(effort::stratified(2.0, 0.0, 0.05) > effort::plain(2.0));
    let free = effort::stratified(2.0, 0.999_999, 0.05) / effort::plain(2.0);
    assert!((free - 0.05).abs() < 0.01, "{free}");
}

/// Some of the variance is that of normals that are shifted, the rest is left as it is.
#[test]
fn importance_sampling_is_unbiased_at_the_effort_of_its_formula() {
    for (index, explained) in [(3.0, 1.0), (3.7, 0.9), (2.0, 0.5)] {
        let (expected, far) = effort::importance(index, explained);
        let shift = [0.6 * far, 0.8 * far];
        let (r, left) = (f64::sqrt(explained), f64::sqrt(1.0 - explained));
        let points = 400;
        let mut weights = Vec::new();
        let runs: Vec<f64> = (0..400)
            .map(|run| {
                let mut stream = Streams::new(6, run).of("importance");
                let one = |k: u64| {
                    let by = if importance::is_shifted(k) { shift } else { [0.0; 2] };
                    let z = by.map(|by| normal(&mut stream) + by);
                    let value = r * (0.6 * z[0] + 0.8 * z[1]) + left * normal(&mut stream);
                    let weight = importance::weight(&z, &shift, importance::defended(points as usize));
                    weights.push(weight);
                    if value >= index { weight } else { 0.0 }
                };
                (0..points).map(one).sum::<f64>() / points as f64
            })
            .collect();
        let [ratio, error, own] = found(&runs, cdf(-index), points as f64);
        println!("index {index}, {explained}: {ratio:.3} +- {error:.3}, effort {own:.1} of {expected:.1}");
        assert!((ratio - 1.0).abs() < 4.0 * error, "{ratio} {error}");
        // One in ten is not shifted.
        assert!(own > 0.8 * expected && own < 1.5 * expected, "{own} {expected}");
        let (all, spread) = (mean(&weights).unwrap(), sigma(&weights).unwrap());
        assert!((all - 1.0).abs() < 4.0 * spread / (weights.len() as f64).sqrt(), "{all}");
        assert!(weights.iter().all(|weight| *weight <= importance::DEFENCE as f64));
    }
    // Shifting what has no part in it brings nothing.
    assert!((effort::importance(2.0, 0.0).0 / effort::plain(2.0) - 1.0).abs() < 1e-9);
}

/// Own runs of 1000 points, d 100: beta 3.5 has a coefficient of variation of 0.30 at 3700 values, beta 4.5 of 0.47 at 5509.
#[test]
fn the_effort_of_subset_simulation_is_that_of_its_runs() {
    for (index, cov, values) in [(3.5, 0.30, 3700.0), (4.5, 0.47, 5509.0)] {
        let run = effort::subset_run(index) * Settings::default().points as f64;
        assert!((run / values - 1.0).abs() < 0.15, "{run} {values}");
        let ratio = effort::subset(index) / (cov * cov * values);
        assert!(ratio > 0.6 && ratio < 1.7, "{ratio}");
    }
    assert!(effort::plain(1.0) < effort::subset(1.0) && effort::plain(3.5) > effort::subset(3.5));
}

/// Each stratum has two points at least, and none more than it holds; the last one has a tenth.
#[test]
fn strata_are_allocated_by_their_size_and_by_how_open_they_are() {
    assert_eq!([-9.0, -2.0, -1.9, 0.0, 0.1, 4.0, 4.1].map(stratum), [0, 0, 1, 2, 3, 5, 6]);
    let taken = allocated(&[10, 10, 10, 10, 10, 10, 1000], 40);
    assert_eq!(taken[6], 4);
    assert!(taken[0] == 2 && taken[2] == taken[3] && taken[3] <= 10 && taken[2] > taken[1], "{taken:?}");
    assert_eq!(allocated(&[0, 1, 0, 5, 0, 0, 0], 100), [0, 1, 0, 5, 0, 0, 0]);
    // Evenly over the order from any start, each once.
    let all: Vec<usize> = (0..7).collect();
    for start in [0.01, 0.5, 0.99] {
        let own = chosen(&all, 3, start);
        assert!(own.windows(2).all(|pair| pair[1] - pair[0] >= 2), "{own:?}");
    }
    assert_eq!(chosen(&all, 7, 0.999), all);
}
