//! `pirca plan-tests`: how many real specimens tell what, and by which reading.

use crate::ensemble;
use crate::ensemble::{Settings, is_random};
use crate::stats::Aim;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::{output, progress};
use crate::verb::plan_tests::answer::{Asked, TestPlan, test_plan_document, test_plan_warnings};
use crate::verb::plan_tests::ask::PlanTests;
use crate::verb::run::page::{Place, told};
use crate::verb::{arms, locate, question};

/// What the folder of the results is named by.
const PLAN_TESTS: &str = "plan-tests";

/// Simulates the walls of a study and plans tests of real ones by them.
pub(crate) fn plan_tests(arguments: &PlanTests) -> Result<Answer, Failure> {
    let loaded = locate::study(&arguments.which)?;
    let study = locate::with_ensemble(loaded.study.clone(), &arguments.ensemble)?;
    if arguments.cov.is_none() && !study.arms.iter().any(is_random) {
        return Err(Failure::Input(format!(
            "{}: nothing is drawn in any arm, so simulated walls show no scatter; state that of real ones with --cov, or give an arm random stones or joints",
            study.name
        )));
    }
    question::needs_independent_walls(&study, "a plan of tests")?;
    study.arms.iter().try_for_each(|arm| arms::has_point(arm, arguments.point))?;
    let asked = Asked {
        specimens: arguments.specimens,
        known_cov: arguments.cov,
        error_deg: arguments.error_deg,
        error_m: arguments.error_m,
        aim: Aim { confidence: arguments.confidence, power: arguments.power },
        loss: arguments.loss,
        point: arguments.point,
    };
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, PLAN_TESTS));
    let settings = Settings { out: out.clone(), threads: arguments.threads };
    let rows = ensemble::run(&study, &settings, progress::on_stderr(&study).as_ref())?;
    let study = ensemble::come_to(study, &rows);
    let plan = TestPlan::of(&study, &rows, asked);
    let place = Place {
        out: &out,
        name: PLAN_TESTS,
        study: (&study, &loaded),
        of: &arguments.which.study,
        threads: arguments.threads,
        report: arguments.report,
    };
    let answer = told(&test_plan_document(&plan), &plan, &place)?;
    Ok(answer.with_warnings(test_plan_warnings(&plan)))
}
