//! Which of several kinds is best: how often the answer is right, with how many values, and against equal allocation.
//!
//! A synthetic comparison draws normal values of known means; what the kinds share makes pairs correlate. The order is known, so that the
//! answer can be judged.

use pirca::random::Streams;
use pirca::random::standard_normal::quantile;
use pirca::stats::selection::{FIRST, Kind, Measure, Rule, Shown, Standing, pairs, round};

/// Kinds with these means, and a scatter of 1 of which a share is common to the members of the same number.
struct Synthetic {
    means: Vec<f64>,
    correlation: f64,
    /// Whether each kind has a scatter of its own, from 0.5 to 1.5.
    uneven: bool,
}

/// How a comparison ended.
struct Ended {
    best: usize,
    settled: bool,
    spent: usize,
    standing: Standing,
}

impl Synthetic {
    fn spaced(kinds: usize, step: f64) -> Synthetic {
        Synthetic { means: (0..kinds).map(|k| -step * k as f64).collect(), correlation: 0.5, uneven: false }
    }

    /// The value of a member, the same whatever else is drawn.
    fn value(&self, comparison: u64, kind: usize, member: usize) -> f64 {
        let normal = |name: &str| {
            let streams = Streams::new(comparison + 1000, member as u64);
            quantile(streams.of(name).uniform())
        };
        let sd = if self.uneven { 0.5 + (kind % 3) as f64 * 0.5 } else { 1.0 };
        let own = (1.0 - self.correlation).sqrt() * normal(&format!("own {kind}"));
        self.means[kind] + sd * (self.correlation.sqrt() * normal("shared") + own)
    }

    /// Compares until all is settled or `most` values are spent, by the rule's own allocation or an equal one.
    fn compared(&self, comparison: u64, rule: &Rule, equal: bool, most: usize) -> Ended {
        let mut kinds = vec![Kind { values: Vec::new(), fixed: false }; self.means.len()];
        let mut counts = vec![FIRST; kinds.len()];
        loop {
            for (index, kind) in kinds.iter_mut().enumerate() {
                let from = kind.values.len();
                kind.values
                    .extend((from..counts[index]).map(|member| Some(self.value(comparison, index, member))));
            }
            let standing = rule.standing(&kinds);
            let spent: usize = counts.iter().sum();
            let settled = standing.is_settled();
            if settled || spent >= most {
                return Ended { best: standing.best, settled, spent, standing };
            }
            counts = if equal {
                let more = (round(spent) / kinds.len()).max(1);
                counts.iter().map(|count| count + more).collect()
            } else {
                rule.next(&kinds, &standing, round(spent))
            };
        }
    }
}

fn rule(same_within: f64) -> Rule {
    Rule { measure: Measure::Mean, confidence: 0.95, same_within, ends: [-10.0, 10.0] }
}

/// Of so many comparisons: the share that named the first kind, and mean numbers of values by the rule and by equal allocation.
fn measured(of: &Synthetic, comparisons: u64, rule: &Rule) -> [f64; 3] {
    let (mut right, mut own, mut equal) = (0.0, 0.0, 0.0);
    let share = 1.0 / comparisons as f64;
    for comparison in 0..comparisons {
        let ended = of.compared(comparison, rule, false, 50_000);
        assert!(ended.settled);
        right += share * f64::from(u8::from(ended.best == 0));
        own += share * ended.spent as f64;
        equal += share * of.compared(comparison, rule, true, 50_000).spent as f64;
    }
    [right, own, equal]
}

/// Ten kinds in steps of a quarter of their scatter.
#[test]
#[ignore = "slow: 10 s of processor time"]
fn of_ten_kinds_the_best_is_found_with_a_third_of_the_values_of_equal_allocation() {
    let [right, own, equal] = measured(&Synthetic::spaced(10, 0.25), 1000, &rule(0.2));
    println!("ten kinds: right in {right:.3}, {own:.0} values against {equal:.0}, ratio {:.3}", own / equal);
    assert!(right >= 0.95, "{right}");
    assert!(own / equal <= 1.0 / 3.0, "{own} against {equal}");
}

/// What is published in docs/studies.md: how much is saved depends on how many kinds are far from the best, and on the first values that each
/// of them takes.
#[test]
#[ignore = "slow: half a minute of processor time"]
fn what_is_saved_grows_with_the_number_of_kinds() {
    let mut last = 1.01;
    for kinds in [2, 3, 4, 6, 10] {
        for (step, uneven) in [(0.25, false), (0.5, false), (0.25, true)] {
            let of = Synthetic { uneven, ..Synthetic::spaced(kinds, step) };
            let [right, own, equal] = measured(&of, 200, &rule(0.2));
            let ratio = own / equal;
            println!(
                "{kinds} kinds in steps of {step}, uneven {uneven}: right {right:.3}, {own:.0} against {equal:.0}, {ratio:.3}"
            );
            assert!(right >= 0.95 && ratio <= 1.01, "{right} {ratio}");
            if (step, uneven) == (0.25, false) {
                assert!(ratio < last);
                last = ratio;
            }
        }
    }
    // All others are as far from the best: each needs as many.
    let means = (0..10).map(|k| if k == 0 { 0.0 } else { -0.25 }).collect();
    let far = Synthetic { means, correlation: 0.5, uneven: false };
    let [right, own, equal] = measured(&far, 200, &rule(0.2));
    println!("nine of ten equally far: right {right:.3}, {own:.0} against {equal:.0}, {:.3}", own / equal);
    assert!(right >= 0.95);
}

#[test]
fn equal_kinds_are_called_different_in_no_more_than_five_of_a_hundred() {
    for kinds in [2, 6] {
        let of = Synthetic::spaced(kinds, 0.0);
        let different = (0..1000)
            .filter(|comparison| {
                let ended = of.compared(*comparison, &rule(0.4), false, 4000);
                ended.standing.shown.contains(&Shown::Worse)
            })
            .count();
        println!("{kinds} equal kinds: {different} of 1,000 called different");
        assert!(different <= 50, "{kinds} kinds: {different}");
    }
}

#[test]
fn a_difference_is_settled_as_worse_as_the_same_or_not_at_all() {
    let of = |means: &[f64]| Synthetic { means: means.to_vec(), correlation: 0.8, uneven: false };
    let ended = of(&[0.0, 0.02, -2.0]).compared(3, &rule(0.3), false, 5000);
    assert!(ended.settled && ended.best < 2);
    assert_eq!((ended.standing.shown[1 - ended.best], ended.standing.shown[2]), (Shown::Same, Shown::Worse));
    // The one that is far away got no more than the first values.
    let [near, far] = [1 - ended.best, 2].map(|k| ended.standing.differences[k].unwrap().pairs);
    assert!(far < near / 3, "{near} {far}");
    let stopped = of(&[0.0, 0.02, -2.0]).compared(3, &rule(0.001), false, 200);
    assert!(!stopped.settled && stopped.spent >= 200 && stopped.standing.shown.contains(&Shown::Open));
}

#[test]
fn values_that_are_lost_are_bounded_and_can_keep_a_difference_open() {
    let of = Synthetic::spaced(2, 2.0);
    let kinds = |lost: usize| -> Vec<Kind> {
        let value =
            |kind: usize, member: usize| (kind == 1 || member >= lost).then(|| of.value(9, kind, member));
        (0..2)
            .map(|kind| Kind { values: (0..60).map(|member| value(kind, member)).collect(), fixed: false })
            .collect()
    };
    let rule = Rule { ends: [-4.0, 2.0], ..rule(0.25) };
    let whole = rule.standing(&kinds(0));
    let difference = whole.differences[1].unwrap();
    assert_eq!(
        (whole.shown[1], difference.lost, difference.interval),
        (Shown::Worse, 0, difference.whatever)
    );
    let some = rule.standing(&kinds(6));
    let difference = some.differences[1].unwrap();
    let ([low, high], [least, most]) = (difference.interval.unwrap(), difference.whatever.unwrap());
    assert_eq!((difference.pairs, difference.lost), (54, 6));
    assert!(least < low && most > high && low > 0.0);
    let many = rule.standing(&kinds(40));
    // Were all 40 as weak as can be, the other would be the better one.
    assert_eq!(many.shown[1 - many.best], Shown::Open);
}

#[test]
fn shares_and_quantiles_are_compared_too_and_a_fixed_kind_takes_one_value() {
    let of = Synthetic::spaced(2, 3.0);
    let drawn = |kind: usize| Kind {
        values: (0..200).map(|member| Some(of.value(2, kind, member))).collect(),
        fixed: false,
    };
    for (measure, truth) in [(Measure::ShareBelow(-1.5), 0.866), (Measure::Quantile(0.5), 3.0)] {
        let rule = Rule { measure, ..rule(0.1) };
        let difference = rule.difference(&drawn(0), &drawn(1), 2);
        let [low, high] = difference.interval.expect("200 pairs");
        assert!(low > 0.0 && low < truth && high > truth, "{measure:?}: {difference:?}");
        // Exchanged, the difference is the other way round.
        let back = rule.difference(&drawn(1), &drawn(0), 2);
        assert!((back.value.unwrap() + difference.value.unwrap()).abs() < 1e-12);
        assert!((back.interval.unwrap()[0] + high).abs() < 1e-12);
    }
    let fixed = Kind { values: vec![Some(-0.2)], fixed: true };
    let kinds = [drawn(0), fixed.clone()];
    let rule = Rule { same_within: 0.01, ..rule(0.25) };
    assert_eq!(pairs(&kinds[0], &kinds[1]).len(), 200);
    let standing = rule.standing(&kinds);
    let open = Standing { shown: vec![Shown::Same, Shown::Open], ..standing };
    assert_eq!(rule.next(&kinds, &open, 7), [207, 1]);
    // Two that are fixed are known.
    let other = Kind { values: vec![Some(-0.5)], fixed: true };
    let both = rule.difference(&fixed, &other, 2);
    let [low, high] = both.interval.expect("nothing is drawn");
    assert!(low == high && (low - 0.3).abs() < 1e-12);
    assert_eq!(rule.probability_of_correct_selection(&[fixed, other], 0), Some(1.0));
}

#[test]
fn the_next_values_go_where_they_are_needed() {
    let of = Synthetic { means: vec![0.0, -0.3, -0.5, -8.0], correlation: 0.5, uneven: false };
    let kinds: Vec<Kind> = (0..4)
        .map(|kind| Kind { values: (0..20).map(|m| Some(of.value(4, kind, m))).collect(), fixed: false })
        .collect();
    let rule = rule(0.25);
    let standing = rule.standing(&kinds);
    assert_eq!(standing.best, 0);
    assert_eq!(standing.shown, [Shown::Same, Shown::Open, Shown::Open, Shown::Worse]);
    let next = rule.next(&kinds, &standing, 200);
    assert_eq!(next[3], 20, "what is settled gets no more");
    // As many as the square of scatter over difference says, both as they are seen; the best as many as the most.
    let needed = |kind: usize| {
        let difference = standing.differences[kind].unwrap();
        let [low, high] = difference.interval.unwrap();
        let ratio = (high - low) / difference.value.unwrap();
        ratio * ratio
    };
    let (own, wanted) = (next[1] as f64 / next[2] as f64, needed(1) / needed(2));
    assert!(wanted > 1.2 && (own / wanted - 1.0).abs() < 0.05, "{next:?}: {own} against {wanted}");
    assert_eq!(next[0], next[1]);
    let spent: usize = next.iter().sum();
    assert!((80 + 198..=80 + 200).contains(&spent), "{next:?}");
}
