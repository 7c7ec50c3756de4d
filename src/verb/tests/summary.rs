//! Statistics, notes and nulls of the summary; ratios; the table.

use std::collections::BTreeMap;

use super::{
    KN, collected, failed, fixed_arm, population, random_arm, standing, summary_of, three_arms, without,
};
use crate::ensemble::{Quantity, Row};
use crate::model::{Level, Outcome};
use crate::render::number::{significant, with_interval};
use crate::study::{Claim, ClaimTest};
use crate::verb::run::answer::comparison::{Basis, comparisons, ratio};
use crate::verb::run::answer::summary::describe;
use crate::verb::run::answer::table::terminal_table;

/// Relative rounding of a handful of operations and of seven-digit table values.
const TABLE_DIGITS: f64 = 2e-6;

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= TABLE_DIGITS * expected.abs(), "{found} is not {expected}");
}

#[test]
fn four_walls_give_the_numbers_worked_out_by_hand() {
    // 1, 2, 3, 4 mm: mean 2.5, sum of squared deviations 5, sigma sqrt(5/3); t(3) = 3.1824463;
    // chi-square(3) at 2.5 and 97.5 %: 0.21579528 and 9.3484036.
    let entry =
        describe(population("irregular", false, KN[0], &[1e-3, 2e-3, 3e-3, 4e-3]), 1, BTreeMap::new());
    let sigma = (5.0_f64 / 3.0).sqrt() * 1e-3;
    close(entry.mean.unwrap(), 2.5e-3);
    let [low, high] = entry.mean_ci.unwrap();
    close(low, 2.5e-3 - 3.1824463 * sigma / 2.0);
    close(high, 2.5e-3 + 3.1824463 * sigma / 2.0);
    close(entry.sigma.unwrap(), sigma);
    let [low, high] = entry.sigma_ci.unwrap();
    close(low, (5.0_f64 / 9.3484036).sqrt() * 1e-3);
    close(high, (5.0_f64 / 0.21579528).sqrt() * 1e-3);
    close(entry.cov.unwrap(), sigma / 2.5e-3);
    // Linear between order statistics: 1 + 0.15, 2.5, 4 - 0.15; four walls bound no quantile on both sides.
    let quantiles: Vec<f64> = entry.quantiles.iter().map(|quantile| quantile.value.unwrap()).collect();
    for (found, expected) in quantiles.into_iter().zip([1.15e-3, 2.5e-3, 3.85e-3]) {
        close(found, expected);
    }
    assert!(entry.quantiles.iter().all(|quantile| quantile.ci.is_none()));
    assert_eq!((entry.members, entry.in_mean, entry.note), (4, 4, None));
}

#[test]
fn failed_walls_are_counted_and_enter_no_mean() {
    let rows = [
        standing(0, 1e-3),
        // Its last displacement is no answer, should a row ever carry it.
        Row { outcome: Outcome::Collapsed { at: Level::Factor(0.5) }, ..standing(1, 90e-3) },
        standing(2, 3e-3),
        failed(3, Outcome::NonFinite { at: Level::Factor(1.0) }),
        failed(4, Outcome::InvalidGeometry { reason: "beds cross".into() }),
    ];
    let entry = describe(
        collected(("irregular", false), (KN[0], 6), Quantity::TopDisplacement, &rows),
        1,
        BTreeMap::new(),
    );
    close(entry.mean.unwrap(), 2e-3);
    let outcomes = [("collapsed", 1), ("equilibrium", 2), ("invalid_geometry", 1), ("non_finite", 1)];
    assert_eq!(entry.outcomes, outcomes.map(|(name, count)| (name.to_string(), count)).into());
    assert_eq!((entry.members, entry.in_mean), (6, 2));
    assert_eq!(
        entry.note.as_ref().unwrap(),
        "over 2 of 6 walls; not in the numbers: 1 collapsed (wall 1: fell at load factor 0.5), \
         1 invalid geometry (wall 4: beds cross), \
         1 non finite (wall 3: a position or force became non-finite at load factor 1), 1 not computed"
    );
    assert_eq!((entry.missing, entry.computed(), entry.failed()), (1, 5, 3));
}

#[test]
#[should_panic(expected = "has two rows")]
fn a_member_that_appears_twice_is_our_own_fault() {
    let rows = [standing(0, 1e-3), standing(0, 2e-3)];
    collected(("irregular", false), (KN[0], 2), Quantity::TopDisplacement, &rows);
}

#[test]
fn one_wall_and_no_wall_give_null_never_zero_or_nan() {
    let one = population("irregular", false, KN[0], &[1e-3]);
    let json = serde_json::to_value(describe(one, 1, BTreeMap::new())).unwrap();
    assert_eq!(json["mean"], 1e-3);
    for key in
        ["mean_ci", "sigma", "sigma_ci", "sigma_bootstrap_ci", "cov", "cov_ci", "cov_bootstrap_ci", "note"]
    {
        assert!(json[key].is_null(), "{key} is {}", json[key]);
    }
    let rows = [failed(0, Outcome::Collapsed { at: Level::Factor(1.0) })];
    let none = collected(("irregular", false), (KN[0], 1), Quantity::TopDisplacement, &rows);
    let json = serde_json::to_value(describe(none, 1, BTreeMap::new())).unwrap();
    assert!(json["mean"].is_null() && json["quantiles"][1]["value"].is_null());
    assert_eq!(
        json["note"],
        "over 0 of 1 walls; not in the numbers: 1 collapsed (wall 0: fell at load factor 1)"
    );
}

#[test]
fn the_interval_of_a_ratio_rests_on_what_is_random() {
    let (two, four) = (&fixed_arm("two", &[2e-3])[0], &fixed_arm("four", &[4e-3])[0]);
    let exact = ratio(two, four);
    assert_eq!((exact.value, exact.interval, exact.basis), (Some(0.5), Some([0.5, 0.5]), Basis::Exact));

    // Mean 4 with sigma 0.4 sqrt(8/7) of eight walls, t(7) = 2.3646243: half width 0.3574976, over 2.
    let random = &random_arm("random", &[4e-3])[0];
    let half = ratio(random, two);
    assert_eq!(half.basis, Basis::OneArmFixed);
    let [low, high] = half.interval.unwrap();
    close(low, (4.0 - 0.3574976) / 2.0);
    close(high, (4.0 + 0.3574976) / 2.0);

    // Wall by wall one half: no scatter of the ratio is left, although both arms scatter.
    let paired = ratio(&random_arm("a", &[1e-3])[0], &random_arm("b", &[2e-3])[0]);
    assert_eq!((paired.basis, paired.walls), (Basis::Paired, 8));
    for end in paired.interval.unwrap() {
        close(end, 0.5);
    }

    let other_size = population("c", false, KN[0], &[1e-3, 2e-3, 3e-3]);
    assert_eq!(ratio(random, &other_size).basis, Basis::Independent);
    let lone = population("d", false, KN[0], &[1e-3]);
    assert_eq!(ratio(&lone, two).interval, None, "one random wall says nothing about its scatter");
    assert_eq!(ratio(random, &lone).interval, None, "nor below the line");
}

#[test]
fn pairs_are_compared_over_the_walls_that_stand_in_both_arms() {
    let (a, b) = (without(&random_arm("a", &[1e-3])[0], 0), random_arm("b", &[2e-3]).remove(0));
    let ratio = ratio(&a, &b);
    assert_eq!((ratio.basis, ratio.walls), (Basis::Paired, 7));
    close(ratio.value.unwrap(), 0.5);
}

#[test]
fn a_pair_is_given_in_the_direction_of_the_statement() {
    let test =
        ClaimTest::RatioOfMeans { arm: "b".into(), over: "a".into(), stated: 2.0, low: 1.0, high: 3.0 };
    let claims = [Claim { claim: String::new(), source: String::new(), test, why: String::new() }];
    let all = [fixed_arm("a", &[1e-3]), fixed_arm("b", &[2e-3]), fixed_arm("c", &[4e-3])].concat();
    let found: Vec<_> =
        comparisons(&all, &claims).into_iter().map(|c| (c.arm + " / " + &c.over, c.ratio.unwrap())).collect();
    assert_eq!(found, [("b / a".into(), 2.0), ("a / c".into(), 0.25), ("b / c".into(), 0.5)]);
}

#[test]
fn the_table_fits_and_says_what_failed() {
    let stated =
        ClaimTest::Cov { arm: "irregular".into(), stated: "0.21 to 0.25".into(), low: 0.19, high: 0.27 };
    let long = "a name that is far too long for a column of the table";
    let mut all = three_arms();
    all.extend(random_arm(long, &[0.25e-3, 0.2e-3, 0.15e-3]));
    let text = terminal_table(&summary_of(&all, &[super::claim(stated)]));
    for line in text.lines() {
        assert!(line.chars().count() <= 110, "{} columns: {line}", line.chars().count());
    }
    let conclusion: Vec<&str> = text.lines().take_while(|line| !line.is_empty()).collect();
    assert!(conclusion.len() <= 5, "{text}");
    let said = conclusion.join(" ");
    for part in [
        "hand-made, variant two-wythes: 18 walls in 54 evaluations, 1 failed (not in the means).",
        "Published statements: 0 reproduced, 0 not reproduced, 1 cannot be judged.",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let row = text.lines().find(|line| line.starts_with("irregular") && line.contains("1e8")).unwrap();
    let cells: Vec<&str> = row.split_whitespace().take(4).collect();
    assert_eq!(cells, ["irregular", "1e8", "8", "1"]);
    assert!(
        text.contains(
            "! irregular at kn 1e8 Pa/m: over 7 of 8 walls; not in the numbers: 1 collapsed (wall 3:"
        ),
        "{text}"
    );
    assert!(
        text.contains("NOT REPRODUCED: as stated") || text.contains("CANNOT BE JUDGED: as stated"),
        "{text}"
    );
}

#[test]
fn numbers_keep_their_significant_digits() {
    let cases = [
        (0.123456, "0.123"),
        (9.996, "10.0"),
        (1234.5, "1234"),
        (0.0, "0.00"),
        (1.5e-7, "1.50e-7"),
        (-0.25, "-0.250"),
    ];
    for (x, expected) in cases {
        assert_eq!(significant(x, 3), expected);
    }
    assert_eq!(with_interval(Some(1.0), None, 3), "1.00 [-]");
    assert_eq!(with_interval(None, None, 3), "-");
}
