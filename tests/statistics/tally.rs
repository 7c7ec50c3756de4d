//! How often the intervals of small probabilities hold the truth, for each method and from a tenth of a failure to ten of them that plain
//! sampling would meet in the mean.

use pirca::random::standard_normal::{cdf, quantile};
use pirca::random::{Stream, Streams};
use pirca::stats::importance::{defended, is_shifted, weight};
use pirca::stats::strata::{STRATA, allocated, chosen, stratum};
use pirca::stats::subset::{Settings, is_stuck, run};
use pirca::stats::tally::{Chains, Counts, Pooled, Strata, Tally, Weighted, Within};
use pirca::stats::{Statistic, above_zero, clopper_pearson, effort};

use crate::rare::Normals;

/// Failures that plain sampling with as many points would meet in the mean.
const EXPECTED: [f64; 5] = [0.1, 0.5, 1.0, 3.0, 10.0];
/// Independent runs of each answer.
const RUNS: u64 = 10;
const SEEDS: u64 = 1000;
/// Chains take longer.
const FEW_SEEDS: u64 = 100;

/// The share of seeds whose interval holds the truth, of those whose interval lies below it, and the mean upper end over the truth.
fn held(seeds: u64, truth: f64, of: impl Fn(u64) -> Pooled) -> [f64; 3] {
    let mut all = [0.0; 3];
    for seed in 0..seeds {
        let Pooled { probability, interval, .. } = of(seed);
        let [low, high] = interval.expect("runs bound it");
        assert!(high > 0.0 && low <= probability && probability <= high, "{low} {probability} {high}");
        let of = [
            f64::from(u8::from(low <= truth && truth <= high)),
            f64::from(u8::from(high < truth)),
            high / truth,
        ];
        all.iter_mut().zip(of).for_each(|(sum, own)| *sum += own / seeds as f64);
    }
    all
}

/// Holds at least 93 in 100 and ends at most so many times above the truth in the mean, at each number of expected failures.
fn well(name: &str, seeds: u64, points: f64, most: [f64; 5], of: impl Fn(f64, u64) -> Pooled) {
    // Two standard errors of a coverage of 0.95.
    let error = 2.0 * (0.95 * 0.05 / seeds as f64).sqrt();
    for (expected, most) in EXPECTED.into_iter().zip(most) {
        let truth = expected / points;
        let [share, below, high] = held(seeds, truth, |seed| of(truth, seed));
        println!(
            "{name}, {expected} failures expected: held {share:.3}, below it {below:.3}, upper end {high:.1}"
        );
        assert!(share >= 0.945 - error, "{name}, {expected}: {share}");
        assert!(high < most, "{name}, {expected}: {high}");
    }
}

fn normal(stream: &mut Stream) -> f64 {
    quantile(stream.uniform())
}

#[test]
fn plain_counts_hold_what_ten_runs_taken_for_normal_do_not() {
    const EACH: u64 = 150;
    let runs = |truth: f64, seed: u64| -> Vec<Counts> {
        let mut stream = Streams::new(30, seed).of("plain");
        let worse = |stream: &mut Stream| (0..EACH).filter(|_| stream.uniform() < truth).count() as u64;
        (0..RUNS).map(|_| Counts { worse: worse(&mut stream), of: EACH }).collect()
    };
    well("plain", SEEDS, (RUNS * EACH) as f64, [40.0, 10.0, 6.0, 3.0, 2.0], |truth, seed| {
        Pooled::of(&runs(truth, seed).into_iter().map(Tally::Plain).collect::<Vec<_>>(), 0.05)
    });
    // The same runs by Student: a third of the intervals are [0, 0] where one failure is expected.
    let [by_student, below, _] = held(SEEDS, 1.0 / 1500.0, |seed| {
        let shares: Vec<f64> =
            runs(1.0 / 1500.0, seed).iter().map(|own| own.worse as f64 / own.of as f64).collect();
        let own = above_zero(Statistic::Mean.of(&shares, 0.05));
        let interval = own.interval.map(|[low, high]| [low, high.max(f64::MIN_POSITIVE)]);
        Pooled { probability: own.value.unwrap(), interval, cov: None, at_most: None }
    });
    assert!(by_student < 0.7 && below > 0.3, "{by_student} {below}");
    let none = Pooled::of(&vec![Tally::Plain(Counts { worse: 0, of: 300 }); 10], 0.05);
    assert_eq!((none.probability, none.interval), (0.0, Some(clopper_pearson(0, 3000))));
}

/// A parameter that explains so much of the variance is shifted by so many times what pays best: less, nothing, and the wrong way as well.
fn shifted(truth: f64, seed: u64, explained: f64, times: f64) -> Pooled {
    const EACH: usize = 20;
    let index = -quantile(truth);
    let shift = [-times * effort::importance(index, explained).1];
    let (r, left) = (explained.sqrt(), (1.0 - explained).sqrt());
    let mut stream = Streams::new(31, seed).of("importance");
    let mut one = |k: u64| {
        let z = normal(&mut stream) + if is_shifted(k) { shift[0] } else { 0.0 };
        (r * z + left * normal(&mut stream) <= -index).then(|| weight(&[z], &shift, defended(EACH)))
    };
    let tallies: Vec<Tally> = (0..RUNS)
        .map(|_| {
            let worse = (0..EACH as u64).filter_map(&mut one).collect();
            Tally::Weighted(Weighted { worse, of: EACH as u64, largest: 1.0 / defended(EACH) })
        })
        .collect();
    Pooled::of(&tallies, 0.05)
}

/// A shift that leads to the failures meets them in every second point, so that a failure far from them hardly counts; one that does not
/// leaves a tenth of the points to bound them.
#[test]
fn weighted_counts_hold_the_truth_wherever_the_shift_leads() {
    for (explained, times, most) in [
        (1.0, 1.0, [2.0, 2.0, 2.0, 2.0, 2.0]),
        (0.9, 1.0, [3.0, 2.5, 2.5, 2.0, 2.0]),
        (0.5, 1.0, [400.0, 80.0, 40.0, 5.0, 3.0]),
        (0.9, 0.0, [400.0, 80.0, 40.0, 20.0, 6.0]),
        (0.9, -1.0, [400.0, 80.0, 45.0, 20.0, 8.0]),
    ] {
        let name = format!("importance, {explained} explained, shifted {times} times");
        well(&name, SEEDS, 200.0, most, |truth, seed| shifted(truth, seed, explained, times));
    }
    // Many failures near where the shift leads say nothing of others: the bound by the design is told as well.
    let own = shifted(1e-4, 0, 0.9, 1.0);
    assert!(own.at_most.unwrap() > 0.1 && own.interval.unwrap()[1] < 1e-3, "{own:?}");
    assert_eq!(shifted(1e-4, 0, 0.9, -1.0).at_most, None);
}

/// Points with a cheap value of this correlation; of a share of them the cheap value says nothing.
fn sorted(truth: f64, seed: u64, rho: f64, blind: f64) -> Pooled {
    const EACH: usize = 20;
    const CHEAP: usize = 200;
    let (index, left) = (-quantile(truth), (1.0 - rho * rho).sqrt());
    let mut stream = Streams::new(32, seed).of("strata");
    let tallies: Vec<Tally> = (0..RUNS)
        .map(|_| {
            let mut values = Vec::new();
            let mut strata: [Vec<usize>; STRATA] = Default::default();
            for at in 0..CHEAP {
                let cheap = normal(&mut stream);
                let rest = normal(&mut stream);
                values.push(if stream.uniform() < blind { rest } else { rho * cheap + left * rest });
                strata[stratum((rho * cheap + index) / left)].push(at);
            }
            let sizes = strata.each_ref().map(Vec::len);
            let taken = allocated(&sizes, EACH);
            let counts = std::array::from_fn(|of| {
                let own = chosen(&strata[of], taken[of], stream.uniform());
                let worse = own.iter().filter(|at| values[**at] <= -index).count() as u64;
                Counts { worse, of: own.len() as u64 }
            });
            Tally::Strata(Strata { sizes: sizes.map(|size| size as u64), counts })
        })
        .collect();
    Pooled::of(&tallies, 0.05)
}

/// A failure of a stratum that holds many points and of which few are evaluated counts much: the interval is wide where few are seen.
#[test]
fn strata_hold_the_truth_and_their_design_bounds_it_where_the_cheap_value_is_blind() {
    for (rho, most) in [(0.5, [200.0, 20.0, 10.0, 4.0, 2.5]), (0.8, [20.0, 8.0, 6.0, 3.0, 2.0])] {
        let name = format!("strata, correlation {rho}");
        well(&name, SEEDS, 200.0, most, |truth, seed| sorted(truth, seed, rho, 0.0));
    }
    // Of a third of all points the cheap value says nothing: what lies in the last stratum is bounded by its own points.
    let bound = |seed: u64| {
        let own = sorted(0.01, seed, 0.95, 0.3);
        Pooled { interval: own.at_most.map(|high| [0.0, high]).or(own.interval), ..own }
    };
    let [share, ..] = held(SEEDS, 0.01, bound);
    assert!(share > 0.97, "{share}");
}

/// Ten runs of subset simulation, with as few points as `capacity` ever takes.
fn chained(truth: f64, seed: u64) -> Pooled {
    let index = -quantile(truth);
    let plane = |point: &[f64]| index + 0.8 * point[0] + 0.6 * point[1];
    let problem = Normals { dimensions: 2, seed: 40, value: &plane };
    let settings = Settings { points: 200, ..Settings::default() };
    let tallies: Vec<Tally> = (0..RUNS).map(|k| problem.tally(&settings, seed * RUNS + k)).collect();
    Pooled::of(&tallies, 0.05)
}

#[test]
fn chains_hold_the_truth_about_as_often_as_they_say() {
    well("subset", FEW_SEEDS, 6000.0, [6.0, 5.0, 5.0, 4.0, 3.0], chained);
}

#[test]
#[ignore = "slow: a minute of processor time"]
fn chains_hold_the_truth_about_as_often_as_they_say_on_a_thousand_seeds() {
    well("subset", SEEDS, 6000.0, [6.0, 5.0, 5.0, 4.0, 3.0], chained);
}

/// Chains of the cheap value go down to where failures are expected, and some of what they find is evaluated.
fn chained_strata(truth: f64, seed: u64) -> Pooled {
    const RHO: f64 = 0.95;
    let (index, left) = (-quantile(truth), (1.0 - RHO * RHO).sqrt());
    let above = |cheap: f64| (RHO * cheap + index) / left;
    let edge = -(index - 4.0 * left) / RHO;
    let cheap = |point: &[f64]| point[0];
    let problem = Normals { dimensions: 2, seed: 41, value: &cheap };
    let settings = Settings { points: 200, ..Settings::default() };
    let tallies: Vec<Tally> = (0..RUNS)
        .map(|k| {
            let found = run(&problem, edge, &settings, seed * RUNS + k);
            let mut strata: [Vec<usize>; STRATA] = Default::default();
            for (at, point) in found.within.iter().enumerate() {
                strata[stratum(above(point[0]))].push(at);
            }
            let sizes = strata.each_ref().map(Vec::len);
            let taken = allocated(&sizes, 20);
            let mut solved: Vec<&Vec<f64>> = Vec::new();
            let counts = std::array::from_fn(|of| {
                let own = chosen(&strata[of], taken[of], 0.5);
                let points: Vec<&Vec<f64>> = own.iter().map(|at| &found.within[*at]).collect();
                let worse =
                    points.iter().filter(|point| RHO * point[0] + left * point[1] <= -index).count() as u64;
                let of = points.len() as u64;
                solved.extend(points);
                Counts { worse, of }
            });
            let distinct = solved.iter().enumerate().filter(|(at, own)| !solved[..*at].contains(own)).count();
            Tally::Within(Within {
                probability: found.probability,
                strata: Strata { sizes: sizes.map(|size| size as u64), counts },
                repeated: solved.len() as f64 / distinct.max(1) as f64,
                more: 0.0,
                stuck: is_stuck(found.kept()),
            })
        })
        .collect();
    Pooled::of(&tallies, 0.05)
}

#[test]
fn strata_that_chains_lead_to_hold_the_truth() {
    well("chains and strata", FEW_SEEDS, 200.0, [4.0, 4.0, 3.0, 3.0, 3.0], chained_strata);
}

#[test]
#[ignore = "slow: a minute of processor time"]
fn strata_that_chains_lead_to_hold_the_truth_on_a_thousand_seeds() {
    well("chains and strata", SEEDS, 200.0, [4.0, 4.0, 3.0, 3.0, 3.0], chained_strata);
}

/// Where runs found nothing, or were stuck, the points that were drawn first bound the probability.
#[test]
fn runs_that_end_at_zero_or_are_stuck_are_bounded_by_their_first_points() {
    let of = |probability: f64, stuck: bool| {
        Tally::Chains(Chains { probability, first: Counts { worse: 0, of: 200 }, stuck })
    };
    let bound = clopper_pearson(0, 2000)[1];
    let ends = |all: &[Tally]| Pooled::of(all, 0.05).interval.unwrap();
    assert_eq!(ends(&vec![of(0.0, false); 10]), [0.0, bound]);
    let mut one = vec![of(1e-5, false); 9];
    let whole = ends(&[&one[..], &[of(1.1e-5, false)]].concat());
    assert!(whole[0] > 9e-6 && whole[1] < 1.2e-5, "{whole:?}");
    one.push(of(1e-5, true));
    assert_eq!(ends(&one), [0.0, bound]);
    one[9] = of(0.0, false);
    assert_eq!(ends(&one), [0.0, bound]);
    assert!((cdf(quantile(bound)) - bound).abs() < 1e-9);
}
