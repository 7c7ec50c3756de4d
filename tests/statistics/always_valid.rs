//! Intervals that hold at every number of values at once: their closed form, how often they ever miss, and what is told of the next pair.

use pirca::math::{exp, ln, pow};
use pirca::random::{Family, Streams};
use pirca::stats::{
    Distributed, always_valid_mean, always_valid_quantile, always_valid_share, dominance, mean, next_pair,
    probability_above, sigma, student_quantile,
};

use pirca::stats::selection::FIRST;

use crate::support::near_share;

/// Sequences, and the longest of each.
const SEQUENCES: u64 = 1000;
const LONGEST: usize = 200;
const MISS: f64 = 0.05;

/// Share of sequences of a family in which `misses` ever says so, looking after every value.
fn ever(family: &Family, misses: impl Fn(&[f64]) -> bool) -> f64 {
    ever_from(2, family, misses)
}

/// The same from a first number of values on.
fn ever_from(first: usize, family: &Family, misses: impl Fn(&[f64]) -> bool) -> f64 {
    let missed = |k: &u64| {
        let mut stream = Streams::new(77, *k).of("sequence");
        let values: Vec<f64> = (0..LONGEST).map(|_| family.sample(&mut stream)).collect();
        (first..=LONGEST).any(|n| misses(&values[..n]))
    };
    (0..SEQUENCES).filter(missed).count() as f64 / SEQUENCES as f64
}

#[test]
fn the_ends_are_where_the_mixture_has_gained_one_over_the_probability_to_miss() {
    let values: Vec<f64> = (0..25).map(|k| f64::from(k * k % 11)).collect();
    let [low, high] = always_valid_mean(&values, MISS).expect("25 values");
    // Bayes factor of a normal prior of variance 1/2 on the standardised mean (Gronau, Ly and Wagenmakers 2020), by its own formula.
    let gain = |level: f64| {
        let n = values.len() as f64;
        let t = (mean(&values).unwrap() - level) / sigma(&values).unwrap() * n.sqrt();
        let g = 1.0 + 0.5 * n;
        let ratio = (1.0 + t * t / (n - 1.0)) / (1.0 + t * t / (g * (n - 1.0)));
        pow(g, -0.5) * exp(0.5 * n * ln(ratio))
    };
    for end in [low, high] {
        assert!((gain(end) * MISS - 1.0).abs() < 1e-9, "{}", gain(end));
    }
    assert_eq!(always_valid_mean(&[2.0; 9], MISS), Some([2.0, 2.0]));
    // Four values at a probability of 1e-6 bound nothing.
    assert_eq!(always_valid_mean(&values[..4], 1e-6), None);
}

#[test]
fn a_mean_is_ever_missed_as_seldom_as_stated_where_students_interval_is_not() {
    let normal = Family::Normal { mean: 3.0, sd: 1.0 };
    let outside = |[low, high]: [f64; 2], truth: f64| truth < low || truth > high;
    let own = ever(&normal, |values| always_valid_mean(values, MISS).is_some_and(|ends| outside(ends, 3.0)));
    // No more than stated, and not idly wide.
    assert!(own <= MISS && own > 0.2 * MISS, "{own}");
    let naive = ever(&normal, |values| {
        let half = student_quantile(0.975, (values.len() - 1) as f64) * sigma(values).unwrap()
            / (values.len() as f64).sqrt();
        (mean(values).unwrap() - 3.0).abs() > half
    });
    assert!(naive > 0.25, "whoever stops when he likes errs in {naive}");
    // Skewed values, looked at from the tenth on as a selection does: what the normal theory costs.
    for (sd, most) in [(0.2, MISS), (0.5, 1.6 * MISS)] {
        let skewed = Family::Lognormal { mean: 1.0, sd };
        let missed = |values: &[f64]| always_valid_mean(values, MISS).is_some_and(|ends| outside(ends, 1.0));
        let own = ever_from(FIRST, &skewed, missed);
        println!("lognormal of COV {sd}: ever missed in {own}");
        assert!(own <= most, "{sd}: {own}");
    }
}

#[test]
fn shares_and_quantiles_are_ever_missed_as_seldom_as_stated() {
    let uniform = Family::Uniform { low: 0.0, high: 1.0 };
    for p in [0.1, 0.5] {
        let share = ever(&uniform, |values| {
            let hits: Vec<bool> = values.iter().map(|x| *x < p).collect();
            always_valid_share(&hits, MISS).is_some_and(|[low, high]| p < low || p > high)
        });
        let quantile = ever(&uniform, |values| {
            always_valid_quantile(values, p, MISS).is_some_and(|[low, high]| p < low || p > high)
        });
        assert!(share <= MISS && quantile <= MISS, "{p}: {share}, {quantile}");
    }
    // 200 values bound a median well enough to be of use.
    let mut stream = Streams::new(5, 0).of("one");
    let values: Vec<f64> = (0..LONGEST).map(|_| uniform.sample(&mut stream)).collect();
    let [low, high] = always_valid_quantile(&values, 0.5, MISS).expect("200 values");
    assert!(high - low < 0.4 && low < 0.5 && high > 0.5, "{low} {high}");
}

#[test]
fn dominance_is_shown_where_it_is_and_of_equals_hardly_ever() {
    let normal = Family::Normal { mean: 0.0, sd: 1.0 };
    let draw = |k: u64, name: &str, shift: f64| -> Vec<Option<f64>> {
        let mut stream = Streams::new(31, k).of(name);
        (0..120).map(|_| Some(normal.sample(&mut stream) + shift)).collect()
    };
    let (mut seen, mut wrong) = (0, 0);
    for k in 0..400 {
        let (a, b, c) = (draw(k, "a", 0.0), draw(k, "b", 0.0), draw(k, "c", 1.5));
        let [a, b, c] = [&a, &b, &c].map(|values| Distributed::Drawn(values));
        let equal = dominance(a, b, MISS).expect("120 values");
        wrong += usize::from(equal.stronger.is_some() || equal.weaker.is_some());
        let shifted = dominance(c, a, MISS).expect("120 values");
        seen += usize::from(shifted.stronger.is_some_and(|[low, high]| low < 0.5 && high > 0.5));
        wrong += usize::from(shifted.weaker.is_some());
        // What it may be weaker by anywhere is less than what it is stronger by somewhere.
        assert!(shifted.weaker_by_at_most < shifted.stronger_by_at_most);
    }
    assert!(seen > 390 && wrong <= 20, "{seen} seen, {wrong} wrong");
    // A fixed value beside its own sample, and lost walls that may lie anywhere.
    let values = draw(0, "a", 0.0);
    let fixed = dominance(Distributed::Fixed(5.0), Distributed::Drawn(&values), MISS).expect("one is drawn");
    assert!(fixed.stronger.is_some() && fixed.weaker.is_none());
    let mut lost = values.clone();
    lost.iter_mut().for_each(|value| *value = value.filter(|x| *x > 0.0));
    let fixed = dominance(Distributed::Fixed(-5.0), Distributed::Drawn(&lost), MISS).expect("one is drawn");
    let told = fixed.weaker.expect("it is weaker than those that are known").map(|end| end < 0.0);
    assert!(told[0], "{fixed:?}");
    assert!(fixed.stronger_by_at_most > 0.0, "those that are lost may be weaker still");
    assert!(dominance(Distributed::Fixed(1.0), Distributed::Fixed(2.0), MISS).is_none());
}

#[test]
fn the_next_pair_counts_ties_and_lost_pairs_on_both_sides() {
    let pairs: Vec<(Option<f64>, Option<f64>)> = [(2.0, 1.0), (1.0, 2.0), (1.0, 1.005), (3.0, 1.0)]
        .iter()
        .cycle()
        .take(36)
        .map(|(a, b)| (Some(*a), Some(*b)))
        .chain((0..4).map(|_| (None, Some(1.0))))
        .collect();
    let found = next_pair(&pairs, 0.01, MISS);
    assert_eq!(found.pairs, [18, 9, 9, 4]);
    assert_eq!(found.probability, Some(22.5 / 36.0));
    let [low, high] = found.interval.expect("40 pairs");
    let sure: Vec<bool> = pairs.iter().map(|(a, b)| a.zip(*b).is_some_and(|(a, b)| a - b > 0.01)).collect();
    assert_eq!(Some(low), always_valid_share(&sure, MISS).map(|ends| ends[0]));
    assert!(low < 0.3 && high > 0.9, "{low} {high}");
    assert_eq!(next_pair(&[], 0.0, MISS).probability, None);
}

#[test]
fn the_probability_of_a_mean_above_a_level_is_students() {
    let values = [1.0, 2.0, 3.0, 4.0];
    let level = mean(&values).unwrap() - student_quantile(0.9, 3.0) * sigma(&values).unwrap() / 2.0;
    assert!((probability_above(&values, level).unwrap() - 0.9).abs() < 1e-9);
    assert_eq!(probability_above(&[1.0; 3], 0.0), Some(1.0));
    assert_eq!(probability_above(&[1.0; 3], 1.0), Some(0.5));
    assert_eq!(probability_above(&[1.0], 0.0), None);
    // Of samples of the level itself it is uniform: below 0.1 in a tenth of them.
    let normal = Family::Normal { mean: 0.0, sd: 1.0 };
    let low = |k: u64| {
        let mut stream = Streams::new(8, k).of("sample");
        let values: Vec<f64> = (0..6).map(|_| normal.sample(&mut stream)).collect();
        probability_above(&values, 0.0).unwrap() < 0.1
    };
    near_share((0..4000).filter(|k| low(*k)).count() as f64 / 4000.0, 0.1, 4000, 0.0, "below 0.1");
}
