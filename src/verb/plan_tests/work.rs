//! `pirca plan-tests`: how many real specimens tell what, and by which reading.

use crate::ensemble;
use crate::ensemble::{Settings, is_random};
use crate::stats::Aim;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::{output, progress};
use crate::verb::plan_tests::answer::{Asked, TestPlan, test_plan_text, test_plan_warnings, write_test_plan};
use crate::verb::plan_tests::ask::PlanTests;
use crate::verb::{arms, locate, question};

/// What the folder of the results is named by.
const PLAN_TESTS: &str = "plan-tests";

/// Simulates the walls of a study and plans tests of real ones by them.
pub(crate) fn plan_tests(arguments: &PlanTests) -> Result<Answer, Failure> {
    let study = locate::with_ensemble(locate::study(&arguments.which)?.study, &arguments.ensemble)?;
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
    write_test_plan(&plan, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
    let text = format!("{}\nwritten to {}\n", test_plan_text(&plan).trim_end(), out.display());
    Ok(Answer::of(text, &plan)?.in_place(&out).with_warnings(test_plan_warnings(&plan)))
}
