//! Rare probabilities with known answers: a plane, and four branches, in standard normal space.

use pirca::random::Streams;
use pirca::random::standard_normal::{cdf, quantile};
use pirca::stats::subset::{Rare, Settings, run};
use pirca::stats::{Statistic, above_zero, correlation, mean, sigma};

/// Independent runs of each problem.
const REPEATS: u64 = 100;

/// A limit state in so many standard normals.
struct Normals<'f> {
    dimensions: usize,
    seed: u64,
    value: &'f (dyn Fn(&[f64]) -> f64 + Sync),
}

impl Normals<'_> {
    fn normals(&self, name: &str, run: u64, number: u64) -> Vec<f64> {
        let mut draws = Streams::new(self.seed + run, number).of(name);
        (0..self.dimensions).map(|_| quantile(draws.uniform())).collect()
    }
}

impl Rare for Normals<'_> {
    type Point = Vec<f64>;

    fn drawn(&self, run: u64, k: u64) -> Vec<f64> {
        self.normals("drawn", run, k)
    }

    fn moved(&self, point: &Vec<f64>, keep: f64, run: u64, number: u64) -> Vec<f64> {
        let rest = (1.0 - keep * keep).sqrt();
        let other = self.normals("moved", run, number);
        point.iter().zip(other).map(|(own, other)| keep * own + rest * other).collect()
    }

    fn values(&self, points: &[Vec<f64>]) -> Vec<Option<f64>> {
        points.iter().map(|point| Some((self.value)(point))).collect()
    }
}

/// The mean over so many runs of the probability over the true one, its coefficient of variation, and the mean number of values.
fn ratios(problem: &Normals<'_>, exact: f64, runs: u64) -> [f64; 3] {
    let all: Vec<_> = (0..runs).map(|k| run(problem, 0.0, &Settings::default(), k)).collect();
    let ratios: Vec<f64> = all.iter().map(|run| run.probability / exact).collect();
    let mean_ratio = mean(&ratios).expect("runs");
    let values: Vec<f64> = all.iter().map(|run| run.values as f64).collect();
    [mean_ratio, sigma(&ratios).expect("runs") / mean_ratio, mean(&values).expect("runs")]
}

#[test]
fn a_plane_far_out_has_its_probability_at_a_thousandth_of_the_values() {
    for (beta, most_cov, most_values) in
        [(3.0, 0.4, 4_000.0), (3.5, 0.45, 4_500.0), (4.0, 0.55, 5_500.0), (4.5, 0.65, 6_500.0)]
    {
        let plane = |point: &[f64]| beta - point.iter().sum::<f64>() / (point.len() as f64).sqrt();
        let problem = Normals { dimensions: 100, seed: 100, value: &plane };
        let [ratio, cov, values] = ratios(&problem, cdf(-beta), REPEATS);
        println!("beta {beta}: {ratio:.3}, COV {cov:.2}, {values:.0} values");
        // Four standard errors.
        assert!((ratio - 1.0).abs() < 4.0 * cov / (REPEATS as f64).sqrt(), "beta {beta}: {ratio}");
        // An independent program has COV 0.30 at 3.5 and 0.47 at 4.5, with 3,700 and 5,509 values.
        assert!(cov < most_cov && values < most_values, "beta {beta}: {cov} {values}");
    }
}

#[test]
fn a_system_of_four_branches_has_its_probability() {
    for (k, exact) in [(6.0, 4.457_331e-3), (7.0, 2.222_795e-3)] {
        let branches = |x: &[f64]| {
            let (sum, difference) = ((x[0] + x[1]) / 2_f64.sqrt(), x[0] - x[1]);
            let near = 3.0 + 0.1 * difference * difference;
            let edge = k / 2_f64.sqrt();
            [near - sum, near + sum, difference + edge, edge - difference]
                .into_iter()
                .fold(f64::INFINITY, f64::min)
        };
        let problem = Normals { dimensions: 2, seed: 900, value: &branches };
        let [ratio, cov, values] = ratios(&problem, exact, REPEATS);
        println!("k {k}: {ratio:.3}, COV {cov:.2}, {values:.0} values");
        assert!((ratio - 1.0).abs() < 4.0 * cov / (REPEATS as f64).sqrt(), "k {k}: {ratio}");
        assert!(cov < 0.4 && values < 3_500.0, "k {k}: {cov} {values}");
    }
}

#[test]
fn what_is_likely_is_a_share_and_what_is_never_reached_is_nothing() {
    let first = |point: &[f64]| point[0];
    let problem = Normals { dimensions: 3, seed: 7, value: &first };
    let likely = run(&problem, 0.0, &Settings::default(), 0);
    assert!((likely.probability - 0.5).abs() < 0.05 && likely.bounds.is_empty() && likely.values == 1000);
    let never = |point: &[f64]| cdf(point[0]) + 1.0;
    let problem = Normals { dimensions: 3, seed: 7, value: &never };
    let never = run(&problem, 0.5, &Settings { levels: 4, ..Settings::default() }, 0);
    assert_eq!((never.probability, never.bounds.len()), (0.0, 5));
    assert!(never.lowest.is_some_and(|(_, lowest)| lowest > 1.0));
}

/// The points of the last level on the worse side are handed over by their values.
#[test]
fn the_points_within_the_level_are_as_many_as_the_last_level_has() {
    let first = |point: &[f64]| point[0];
    let all = Normals { dimensions: 5, seed: 40, value: &first };
    for number in 0..5 {
        let reached = run(&all, -1.0, &Settings::default(), number);
        assert!((reached.probability - cdf(-1.0)).abs() < 0.06, "{}", reached.probability);
        assert_eq!(reached.within.len(), (reached.probability * 1000.0).round() as usize);
        assert!(reached.within.iter().all(|point| point[0] <= -1.0));
        assert!(reached.within.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
    }
}

/// The interval over ten runs as `capacity` prints it, with as few points as it ever takes. Few points find too much in the mean, which
/// is on the safe side and makes up for some of what skewed runs miss: see `printed`.
#[test]
fn ten_runs_of_few_points_find_too_much_rather_than_too_little() {
    const TENS: u64 = 500;
    let settings = Settings { points: 200, ..Settings::default() };
    for (beta, most_cov, most) in [(3.0, 0.65, 1.15), (3.7, 0.9, 1.25)] {
        let plane = |point: &[f64]| beta - point.iter().sum::<f64>() / (point.len() as f64).sqrt();
        let problem = Normals { dimensions: 8, seed: 5000, value: &plane };
        let exact = cdf(-beta);
        let all: Vec<f64> =
            (0..10 * TENS).map(|k| run(&problem, 0.0, &settings, k).probability / exact).collect();
        let [mut held, mut below] = [0.0; 2];
        for ten in all.chunks(10) {
            let [low, high] = above_zero(Statistic::Mean.of(ten, 0.05)).interval.expect("ten runs");
            held += f64::from(u8::from(low <= 1.0 && 1.0 <= high)) / TENS as f64;
            below += f64::from(u8::from(high < 1.0)) / TENS as f64;
        }
        let ratio = mean(&all).expect("runs");
        let cov = sigma(&all).expect("runs") / ratio;
        println!("beta {beta}: COV {cov:.2}, {ratio:.3} of it, held {held:.3}, below it {below:.3}");
        assert!(ratio > 1.0 && ratio < most && cov > 0.4 && cov < most_cov, "beta {beta}: {ratio} {cov}");
        // Four standard errors of 500 cases are 0.05 at 0.92, and 0.034 at 0.04.
        assert!((0.89..=0.97).contains(&held) && below < 0.07, "beta {beta}: {held} {below}");
    }
}

#[test]
fn a_correlation_is_that_of_pearson() {
    // By hand: deviations (-1, 0, 1) and (-4, -1, 5)/3: 3 / sqrt(2 * 42/9).
    let rho = correlation(&[1.0, 2.0, 3.0], &[2.0, 3.0, 5.0]).unwrap();
    assert!((rho - 3.0 / (2.0_f64 * 42.0 / 9.0).sqrt()).abs() < 1e-12, "{rho}");
    assert_eq!(correlation(&[1.0, 1.0], &[2.0, 3.0]), None);
    assert_eq!(correlation(&[1.0], &[2.0]), None);
}
