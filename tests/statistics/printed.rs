//! How often what is printed holds: every 95 % interval and every fractile, in 2,000 cases with known answers, at the numbers of
//! walls that people test. An interval is to hold the truth in 93 to 97 of 100 cases, which is 95 with four standard errors of 2,000
//! cases at each side. Where one does not, its exact or known share is stated with the reason, and it is held to that. Intervals that
//! hold at every number of walls at once are in `always_valid`, those of designs in `randomised` and `sensitivity`, those at a stop
//! in `sequential`.

use crate::support::{near_share, sample, share};
use pirca::math::pow;
use pirca::random::Family;
use pirca::random::standard_normal::{cdf, quantile};
use pirca::stats::{
    DESIGN_PROBABILITY, Estimate, Shape, Statistic, Summary, Variation, above_zero, below_mean,
    clopper_pearson, mean, paired_ratio_of_means, predictive_factor, predictive_quantile, quantile_interval,
    ratio_of_means, sigma, tolerance_factor,
};

const CASES: u64 = 2000;
const WALLS: [usize; 4] = [3, 5, 10, 30];

/// Mean 5 and this coefficient of variation.
fn normal(cov: f64) -> Family {
    Family::Normal { mean: 5.0, sd: 5.0 * cov }
}

fn lognormal(cov: f64) -> Family {
    Family::Lognormal { mean: 5.0, sd: 5.0 * cov }
}

/// Of estimates that come with an interval, the share whose interval holds the truth; and the share that come with one.
fn held(truth: f64, estimate: impl Fn(u64) -> Estimate) -> [f64; 2] {
    let intervals: Vec<[f64; 2]> = (0..CASES).filter_map(|k| estimate(k).interval).collect();
    let inside = intervals.iter().filter(|[low, high]| *low <= truth && truth <= *high).count();
    [inside as f64 / intervals.len() as f64, intervals.len() as f64 / CASES as f64]
}

fn in_93_to_97(what: &str, truth: f64, estimate: impl Fn(u64) -> Estimate) {
    let [held, printed] = held(truth, estimate);
    println!("{what}: {held:.3} of {printed:.3}");
    assert!((0.93..=0.97).contains(&held), "{what}: {held}");
}

#[test]
fn moments_hold_the_truth_in_93_to_97_of_100_cases() {
    for n in WALLS {
        for cov in [0.05, 0.2] {
            let walls = |k| sample(&normal(cov), n, k, "printed");
            in_93_to_97(&format!("mean, {n} at {cov}"), 5.0, |k| Summary::of(&walls(k)).mean);
            in_93_to_97(&format!("sigma, {n} at {cov}"), 5.0 * cov, |k| Summary::of(&walls(k)).sigma);
            // The mean of angles of collapse, of normal and of skewed ones.
            in_93_to_97(&format!("mean above 0, {n} at {cov}"), 5.0, |k| {
                Summary::of_positive(&walls(k)).mean
            });
        }
        let skewed = |k| sample(&lognormal(0.3), n, k, "printed skewed");
        in_93_to_97(&format!("mean above 0, {n} skewed"), 5.0, |k| Summary::of_positive(&skewed(k)).mean);
    }
}

/// Three walls at a COV of 0.2 have no interval in 15 of 100 cases: when they scatter by more than 0.28, no COV is too large for them.
/// Most of these would have held the truth had they had an upper end of infinity, and with them it would be 95 of all 100; of those
/// that are printed it is 97. The shares are those of an independent program in a million cases.
#[test]
fn a_cov_holds_the_truth_where_it_has_an_interval() {
    for n in WALLS {
        for cov in [0.05, 0.1, 0.2] {
            let [held, printed] = held(cov, |k| Summary::of(&sample(&normal(cov), n, k, "printed COV")).cov);
            println!("COV, {n} at {cov}: {held:.3} of {printed:.3}");
            let [expected, with_one] = match (n, cov) {
                (3, 0.2) => [0.971, 0.854],
                (5, 0.2) => [0.95, 0.9997],
                _ => [0.95, 1.0],
            };
            near_share(held, expected, CASES, 0.002, &format!("COV, {n} at {cov}"));
            near_share(printed, with_one, CASES, 0.002, &format!("with an interval, {n} at {cov}"));
        }
    }
}

/// Ratios as a run prints them, of members that share their random numbers and of others, and the paired differences of mechanisms. Of
/// three pairs at a COV of 0.2 two in a hundred have none: their mean below the line does not differ from 0.
#[test]
fn ratios_and_differences_hold_the_truth_in_93_to_97_of_100_cases() {
    let own = Family::Normal { mean: 0.0, sd: 0.3 };
    for n in WALLS {
        let below = |k| sample(&normal(0.2), n, k, "shared");
        let above = |k| -> Vec<f64> {
            below(k).iter().zip(sample(&own, n, k, "own")).map(|(b, e)| 0.8 * b + e).collect()
        };
        let difference = |k| -> Vec<f64> { above(k).iter().zip(below(k)).map(|(a, b)| a - b).collect() };
        in_93_to_97(&format!("paired ratio, {n}"), 0.8, |k| paired_ratio_of_means(&above(k), &below(k)));
        in_93_to_97(&format!("paired difference, {n}"), -1.0, |k| Summary::of(&difference(k)).mean);
        for scatter in [0.3, 1.2] {
            let other = Family::Normal { mean: 4.0, sd: scatter };
            in_93_to_97(&format!("ratio, {n}, {scatter} over 1"), 0.8, |k| {
                ratio_of_means(&sample(&other, n, k, "other"), &below(k))
            });
        }
        in_93_to_97(&format!("fixed over mean, {n}"), 0.8, |k| ratio_of_means(&[4.0], &below(k)));
    }
}

/// P(a number of hits), from none to all.
fn binomial(n: usize, p: f64) -> Vec<f64> {
    let mut all = vec![pow(1.0 - p, n as f64)];
    for k in 0..n {
        all.push(all[k] * (n - k) as f64 / (k + 1) as f64 * p / (1.0 - p));
    }
    all
}

/// Between two order statistics the share is that of a binomial number between their ranks, whatever the distribution: a step at least
/// as large as 95 %, so that it is more than that, and of few values beyond it more than 97. Of fewer than six walls there is no interval of
/// the median, and of fewer than 72 none of the 5 % fractile.
#[test]
fn quantiles_hold_the_truth_with_the_share_of_their_ranks() {
    for (p, n, expected) in [(0.5, 10, 0.9785), (0.5, 30, 0.9572), (0.25, 30, 0.9678), (0.05, 100, 0.9826)] {
        let ranks: Vec<f64> = (1..=n).map(|rank| rank as f64).collect();
        let [low, high] = quantile_interval(&ranks, p).unwrap().map(|rank| rank as usize);
        let exact: f64 = binomial(n, p)[low..high].iter().sum();
        assert!(exact >= 0.95 && (exact - expected).abs() < 5e-5, "{p} of {n}: {exact}");
        for family in [normal(0.2), lognormal(1.0)] {
            let [found, printed] = held(family.quantile(p), |k| Estimate {
                value: None,
                interval: quantile_interval(&sample(&family, n, k, "printed quantile"), p),
            });
            println!("quantile {p} of {n}: {found:.3} of {printed}, exact {exact:.4}");
            near_share(found, exact, CASES, 0.0, &format!("quantile {p} of {n}"));
        }
    }
    for (p, n) in [(0.5, 3), (0.5, 5), (0.05, 30), (0.05, 71)] {
        assert_eq!(quantile_interval(&sample(&normal(0.2), n, 0, "few"), p), None);
    }
}

/// Clopper and Pearson's interval leaves out 2.5 % at each end at most: the number of hits is whole, and of few walls it leaves out next
/// to nothing. Its share is summed over all numbers of hits, at every per cent; least and most are those of an independent program.
#[test]
fn a_probability_is_held_in_at_least_95_of_100_cases() {
    for (n, [least, most]) in
        WALLS.into_iter().zip([[0.9756, 1.0], [0.9762, 1.0], [0.9623, 0.9972], [0.9538, 0.9967]])
    {
        let holds = |k: usize, p: f64| {
            let [low, high] = clopper_pearson(k, n);
            low <= p && p <= high
        };
        let exact = |p: f64| -> f64 {
            binomial(n, p).iter().enumerate().filter(|(k, _)| holds(*k, p)).map(|own| own.1).sum()
        };
        let all: Vec<f64> = (1..100).map(|percent| exact(f64::from(percent) / 100.0)).collect();
        let ends = [f64::min, f64::max].map(|of| all.iter().copied().reduce(of).unwrap());
        println!("probability, {n}: {ends:?}");
        assert!(ends[0] >= 0.95, "{n}: {}", ends[0]);
        assert!((ends[0] - least).abs() < 1e-4 && (ends[1] - most).abs() < 1e-4, "{n}: {ends:?}");
        let unit = Family::Uniform { low: 0.0, high: 1.0 };
        for p in [0.05, 0.3, 0.5] {
            let hits = |k| sample(&unit, n, k, "hits").into_iter().filter(|u| *u < p).count();
            let found = share(CASES, |k| holds(hits(k), p));
            near_share(found, exact(p), CASES, 0.0, &format!("probability {p} of {n}"));
        }
    }
}

/// The share of all walls that lie below a value, in the mean over samples; and how often it is more than 5 %.
fn undercut(family: &Family, n: usize, value: impl Fn(&[f64]) -> Option<f64>) -> ([f64; 2], f64) {
    let shares: Vec<f64> =
        (0..CASES).map(|k| family.cdf(value(&sample(family, n, k, "fractile")).unwrap())).collect();
    let error = sigma(&shares).unwrap() / (CASES as f64).sqrt();
    let more = shares.iter().filter(|share| **share > 0.05).count();
    ([mean(&shares).unwrap(), error], more as f64 / CASES as f64)
}

/// The next wall lies below a characteristic value in 5 of 100 cases and below a design value in 1 of 1,000, and more than 5 % of all
/// walls lie below a tolerance limit in 5 of 100.
#[test]
fn fractiles_and_tolerance_limits_keep_their_promise() {
    let known = Variation::Known(0.2);
    for n in WALLS {
        for (shape, variation) in [
            (Shape::Normal, Variation::Unknown),
            (Shape::Lognormal, Variation::Unknown),
            (Shape::Normal, known),
            (Shape::Lognormal, known),
        ] {
            let family = if shape == Shape::Normal { normal(0.2) } else { lognormal(0.2) };
            let what = format!("{n} {shape:?} {variation:?}");
            let at =
                |factor: f64| undercut(&family, n, move |walls| below_mean(walls, factor, shape, variation));
            // A known COV times the mean that was found is too low a sigma where the mean is too low. So it is undercut less often
            // than stated: the next wall less (1 - k V) times the mean is normal with the variance 1 + (1 - k V)^2 / n.
            let of_mean = shape == Shape::Normal && variation == known;
            let count = n as f64;
            for probability in [0.05, DESIGN_PROBABILITY] {
                let k = predictive_factor(n, probability, variation).unwrap();
                let left = 1.0 - 0.2 * k;
                let exact = if of_mean { cdf(-k / (1.0 + left * left / count).sqrt()) } else { probability };
                let ([found, error], _) = at(k);
                println!("{probability}, {what}: {found:.4} of {exact:.4}, error {error:.4}");
                assert!((found - exact).abs() < 4.0 * error, "{probability}, {what}: {found} of {exact}");
                assert!(exact <= probability + 1e-12);
            }
            let k = tolerance_factor(n, 0.05, 0.95, variation).unwrap();
            let limit = (1.0 + 0.2 * quantile(0.05)) / (1.0 - 0.2 * k);
            let exact = if of_mean { cdf(-(limit - 1.0) / 0.2 * count.sqrt()) } else { 0.05 };
            let (_, more) = at(k);
            println!("tolerance, {what}: {more:.4} of {exact:.4}");
            near_share(more, exact, CASES, 1.0 / CASES as f64, &format!("tolerance, {what}"));
        }
    }
    // Between order statistics, whatever the distribution at a whole place, and nearly so between.
    for (n, bias) in [(19, 0.0), (30, 0.005)] {
        for family in [normal(0.2), lognormal(1.0)] {
            let ([found, error], _) = undercut(&family, n, |walls| predictive_quantile(walls, 0.05));
            println!("next of {n}: {found:.4}");
            assert!((found - 0.05).abs() < 4.0 * error + bias, "next of {n}: {found}");
        }
    }
}

/// Ten independent repeats as subset simulation has them: the mean of what is skewed is found too low where no large one is among
/// the ten, and then so is its error. Expected are the shares of an independent program in 200,000 cases. On the logarithm the interval
/// is better than Student's own, which holds the truth in 94, 92.5, 90.5 and 87 of 100.
#[test]
fn ten_skewed_repeats_hold_the_truth_the_less_the_more_they_scatter() {
    for (cov, expected) in [(0.3, 0.945), (0.5, 0.935), (0.7, 0.925), (1.0, 0.905), (1.5, 0.873)] {
        let repeats = |k| sample(&lognormal(cov), 10, k, "repeats");
        let [found, _] = held(5.0, |k| above_zero(Statistic::Mean.of(&repeats(k), 0.05)));
        println!("ten repeats at {cov}: {found:.3} for {expected}");
        near_share(found, expected, CASES, 0.0, &format!("ten repeats at {cov}"));
    }
}
