//! Every kind of statement in all three verdicts.

use super::{KN, claim, collected, failed, fixed_arm, population, random_arm};
use crate::ensemble::Quantity;
use crate::model::{Level, Outcome};
use crate::study::ClaimTest;
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::published::{Published, Verdict, judge};

fn judged(test: ClaimTest, arms: &[Vec<Population>]) -> Published {
    judge(&claim(test), &arms.concat())
}

fn ratio(low: f64, high: f64) -> ClaimTest {
    ClaimTest::RatioOfMeans { arm: "a".into(), over: "b".into(), stated: 0.6, low, high }
}

fn cov(low: f64, high: f64) -> ClaimTest {
    ClaimTest::Cov { arm: "a".into(), stated: "0.21 to 0.25".into(), low, high }
}

fn between() -> ClaimTest {
    ClaimTest::Between { arm: "a".into(), of: ["low".into(), "high".into()] }
}

#[test]
fn a_ratio() {
    let arms = [fixed_arm("a", &[0.58, 0.6, 0.62]), fixed_arm("b", &[1.0, 1.0, 1.0])];
    let yes = judged(ratio(0.5, 0.7), &arms);
    assert_eq!(yes.verdict, Verdict::Reproduced);
    assert_eq!(yes.ours, "0.580 to 0.620 (no sampling error)");
    assert_eq!(yes.theirs, "0.600 (accepted: 0.500 to 0.700)");
    assert_eq!(
        (yes.why.as_str(), yes.tolerance.as_str()),
        ("it holds in all of 3 comparisons", "reading error of a figure")
    );

    // One kn is enough against it.
    let no = judged(ratio(0.5, 0.61), &arms);
    assert_eq!(no.verdict, Verdict::NotReproduced);
    assert_eq!(
        no.why,
        "at kn = 1.25e8 Pa/m ours is 0.620, wholly outside 0.500 to 0.610 (against the statement in 1 of 3 comparisons)"
    );

    // 1 of 8 walls with COV 0.107: interval [0.91, 1.09] overlaps 0.5 to 0.95, the value does not lie in it.
    let wide = [random_arm("a", &[1.0]), fixed_arm("b", &[1.0])];
    let open = judged(ratio(0.5, 0.95), &wide);
    assert_eq!(open.verdict, Verdict::CannotJudge);
    assert!(open.why.contains("outside 0.500 to 0.950, but its interval reaches into it"), "{}", open.why);

    let lone = [vec![population("a", false, KN[0], &[0.6])], fixed_arm("b", &[1.0])];
    assert_eq!(
        judged(ratio(0.5, 0.7), &lone).verdict,
        Verdict::CannotJudge,
        "one random wall has no interval"
    );
    assert_eq!(judged(ratio(0.5, 0.7), &arms[..1]).verdict, Verdict::CannotJudge, "an arm is missing");
}

#[test]
fn a_cov() {
    // COV 0.1069, its interval 0.071 to 0.22.
    let arms = [random_arm("a", &[1.0, 2.0, 3.0])];
    assert_eq!(judged(cov(0.1, 0.12), &arms).verdict, Verdict::Reproduced);
    assert_eq!(judged(cov(0.21, 0.25), &arms).verdict, Verdict::CannotJudge);
    assert_eq!(judged(cov(0.23, 0.25), &arms).verdict, Verdict::NotReproduced);
    assert_eq!(judged(cov(0.01, 0.06), &arms).verdict, Verdict::NotReproduced);

    let one = judged(cov(0.0, 1.0), &[fixed_arm("a", &[1.0])]);
    assert_eq!(one.verdict, Verdict::CannotJudge);
    assert_eq!(one.ours, "not defined");
    assert!(one.why.contains("not defined (too few standing walls)"), "{}", one.why);
}

#[test]
fn a_mean_between_two_others() {
    let ends = || [fixed_arm("low", &[1.0, 1.0]), fixed_arm("high", &[3.0, 3.0])];
    let with = |arm: Vec<Population>| [ends().as_slice(), &[arm]].concat();
    assert_eq!(judged(between(), &with(fixed_arm("a", &[2.0, 2.5]))).verdict, Verdict::Reproduced);
    assert_eq!(judged(between(), &with(fixed_arm("a", &[2.0, 3.5]))).verdict, Verdict::NotReproduced);
    assert_eq!(
        judged(between(), &with(fixed_arm("a", &[2.0, 3.0]))).verdict,
        Verdict::NotReproduced,
        "not between"
    );
    // 2.9 -+ 0.28: between them, but the interval reaches above 3.
    assert_eq!(judged(between(), &with(random_arm("a", &[2.0, 2.9]))).verdict, Verdict::CannotJudge);
    assert_eq!(judged(between(), &with(random_arm("a", &[2.0, 2.5]))).verdict, Verdict::Reproduced);
    // 3.1 -+ 0.28: above both, but the interval reaches below 3.
    assert_eq!(judged(between(), &with(random_arm("a", &[2.0, 3.1]))).verdict, Verdict::CannotJudge);
    assert_eq!(judged(between(), &with(random_arm("a", &[2.0, 4.0]))).verdict, Verdict::NotReproduced);
    let lone = vec![population("a", false, KN[0], &[2.0])];
    assert_eq!(judged(between(), &with(lone)).verdict, Verdict::CannotJudge);
}

#[test]
fn a_mean_that_falls_with_kn() {
    let test = || ClaimTest::FallsWithKn;
    let falling = random_arm("random", &[3.0, 2.0, 1.0]);
    assert_eq!(
        judged(test(), &[fixed_arm("a", &[3.0, 2.0, 1.0]), falling.clone()]).verdict,
        Verdict::Reproduced
    );
    let no = judged(test(), &[falling, fixed_arm("a", &[3.0, 2.0, 2.0])]);
    assert_eq!(no.verdict, Verdict::NotReproduced);
    assert!(no.why.starts_with("at kn = 1e8 Pa/m to 1.25e8 Pa/m in arm a ours is 1.00"), "{}", no.why);
    assert!(no.why.ends_with("(against the statement in 1 of 4 comparisons)"), "{}", no.why);
    // Wall by wall the change goes both ways: the mean rises from 1.00 to 1.01 within its error.
    let scatter =
        [population("a", false, KN[0], &[0.9, 1.1, 1.0]), population("a", false, KN[1], &[1.1, 0.9, 1.03])];
    assert_eq!(judged(test(), &[scatter.to_vec()]).verdict, Verdict::CannotJudge);
    assert_eq!(
        judged(test(), &[fixed_arm("a", &[3.0])]).verdict,
        Verdict::CannotJudge,
        "one kn shows no fall"
    );
}

#[test]
fn lost_walls_are_named_and_one_refutation_outweighs_a_gap() {
    let mut arm = fixed_arm("a", &[0.6, 0.9]);
    let fell = failed(0, Outcome::Collapsed { at: Level::Factor(0.5) });
    arm[0] = collected(("a", true), (KN[0], 1), Quantity::TopDisplacement, &[fell]);
    let judged = judged(ratio(0.5, 0.7), &[arm, fixed_arm("b", &[1.0, 1.0])]);
    assert_eq!(judged.verdict, Verdict::NotReproduced);
    assert!(
        judged.why.ends_with("; 1 of 2 analyses of arm a failed and are not in these numbers"),
        "{}",
        judged.why
    );
    assert_eq!(judged.ours, "0.900 (no sampling error; defined in 1 of 2 comparisons)");
}
