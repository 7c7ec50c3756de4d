//! `studies/joint-arrangement`: the source paper's section 4.1 and Figure 10.

use std::path::Path;

use pirca::ensemble::{Row, Task, evaluate, plan};
use pirca::model::Outcome;
use pirca::solve::Solver;
use pirca::study::Study;
use pirca::verb::run::{Summary, Verdict, summarise};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/joint-arrangement");

fn study(variant: Option<&str>, members: u64) -> Study {
    Study::load(Path::new(FOLDER), variant).expect("the study is sound").study.with_members(members)
}

fn summary(study: &Study) -> Summary {
    let rows: Vec<Row> = plan(study).into_iter().map(|task| evaluate(study, task)).collect();
    summarise(study, &rows)
}

fn verdict<'a>(summary: &'a Summary, words: &str) -> &'a Verdict {
    let found = summary.published.iter().find(|p| p.claim.contains(words));
    &found.unwrap_or_else(|| panic!("no statement with \"{words}\"")).verdict
}

#[test]
fn the_main_reading_reproduces_the_fall_with_kn_and_none_of_the_ratios() {
    // Six walls an arm are enough: the ratios are far from what is stated, and the fall with kn is the same walls'.
    // That the irregular mean lies outside the other two, by 2 %, takes the study's thirty.
    let summary = summary(&study(None, 6));
    assert_eq!(*verdict(&summary, "falls"), Verdict::Reproduced);
    for words in ["about 40 %", "about 25 % lower", "COV"] {
        assert_eq!(*verdict(&summary, words), Verdict::NotReproduced, "{words}");
    }
    // With equal stones the bond alone changes the displacement by less than a tenth.
    for ratio in summary.comparisons.iter().filter(|c| c.arm == "continuous" && c.over == "discontinuous") {
        let value = ratio.ratio.expect("both walls stand");
        assert!((1.0..1.35).contains(&value), "continuous / discontinuous = {value}");
    }
}

#[test]
fn every_variant_builds_and_stands() {
    let loaded = Study::load(Path::new(FOLDER), None).expect("the study is sound");
    for variant in &loaded.variants {
        let study = study(Some(&variant.name), 2);
        for arm in 0..study.arms.len() as u32 {
            let row = evaluate(&study, Task { arm, point: 0, member: 0 });
            assert_eq!(row.outcome, Outcome::Equilibrium, "variant {}, arm {}", variant.name, row.arm);
            assert!(row.top_displacement_m().is_some_and(|d| d > 0.0));
        }
    }
}

#[test]
fn the_two_solvers_agree_as_stated() {
    // 1.2 % is what the study's README states of every wall. The explicit solver switches gravity on at once and keeps what
    // joints slip meanwhile; that is the difference, so it is of one sign and does not vanish.
    let implicit = study(None, 4);
    assert!(matches!(implicit.solver, Solver::Implicit(_)), "the study's own solver");
    let explicit = study(Some("explicit"), 4);
    for task in plan(&implicit).into_iter().filter(|task| task.point % 5 == 0) {
        let displacement = |study: &Study| evaluate(study, task).top_displacement_m().expect("it stands");
        let difference = displacement(&implicit) / displacement(&explicit) - 1.0;
        println!("arm {}, point {}, member {}: {difference:e}", task.arm, task.point, task.member);
        assert!((-0.012..0.0).contains(&difference), "{difference}");
    }
}

#[test]
fn halving_the_unbalanced_ratio_changes_no_displacement() {
    // Of the explicit solver's by half a per cent, as its rest is approached by waves; of the implicit one's by a
    // millionth, as Newton's last step squares the residual.
    for (variant, ratio, allowed) in [(Some("explicit"), 1e-5, 5e-3), (None, 1e-7, 1e-6)] {
        let coarse = study(variant, 4);
        let mut fine = coarse.clone();
        let own = match &mut fine.solver {
            Solver::Explicit(settings) => &mut settings.unbalanced_ratio,
            Solver::Implicit(settings) => &mut settings.unbalanced_ratio,
            Solver::Nonsmooth(_) | Solver::Limit(_) => panic!("the study has elastic joints"),
        };
        assert_eq!(*own, ratio, "the study's own stop rule");
        *own *= 0.5;
        let mut largest: f64 = 0.0;
        for task in plan(&coarse).into_iter().filter(|task| task.point % 5 == 0) {
            let displacement = |study: &Study| evaluate(study, task).top_displacement_m().expect("it stands");
            largest = largest.max((displacement(&fine) / displacement(&coarse) - 1.0).abs());
        }
        println!("{variant:?}: largest change {largest:e}");
        assert!(largest < allowed, "{variant:?}: {largest}");
    }
}

/// README.md says of this reading that it reproduces all five statements with 300 irregular walls; with 30 the COV's interval is
/// too wide to say so.
#[test]
fn three_departures_together_contradict_no_statement() {
    let summary = summary(&study(Some("mean-size-varies+unequal-courses+cut"), 30));
    let verdicts: Vec<&Verdict> = summary.published.iter().map(|p| &p.verdict).collect();
    use Verdict::{CannotJudge, Reproduced};
    assert_eq!(verdicts, [&Reproduced, &Reproduced, &Reproduced, &CannotJudge, &Reproduced]);
}
