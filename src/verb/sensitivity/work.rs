//! `pirca sensitivity`: where does the scatter of walls come from?

use std::collections::BTreeMap;

use crate::ensemble::{Ledger, RANDOMISATIONS, SensitivityWalls, base_points, sensitivity_table, sources};
use crate::study::{Arm, Study};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::{output, threads};
use crate::verb::run::page::{Place, told};
use crate::verb::sensitivity::answer::{
    SensitivitySummary, running, sensitivity_document, sensitivity_warnings,
};
use crate::verb::sensitivity::ask::Sensitivity;
use crate::verb::{arms, locate, share};

/// What the folder of the results is named by.
const SENSITIVITY: &str = "sensitivity";

/// Evaluates what has not been, and says where the scatter comes from.
pub(crate) fn sensitivity(arguments: &Sensitivity) -> Result<Answer, Failure> {
    threads::on(arguments.threads, || answered(arguments))
}

fn answered(arguments: &Sensitivity) -> Result<Answer, Failure> {
    let loaded = locate::study(&arguments.which)?;
    let mut study = loaded.study.clone();
    if let Some(seed) = arguments.seed {
        study = study.with_seed(seed);
    }
    let index = arms::arm_index(&study, arguments.arm.as_deref())?;
    let kn = arms::kn(&study.arms[index], arguments.point)?;
    let study = of_points(study, index, arguments.points);
    let sources = sources(&study.arms[0]);
    if sources.is_empty() {
        return Err(Failure::Input(format!(
            "{}: nothing is drawn in arm {}, so its walls do not scatter; draw something in [uncertain], or name another --arm",
            study.name, study.arms[0].name
        )));
    }
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, SENSITIVITY));
    output::folder(&out)?;
    let ledger = Ledger::of_study(&out, SENSITIVITY, &study.hash, arguments.shard)?;
    let walls = SensitivityWalls {
        study: &study,
        arm: 0,
        point: arguments.point,
        sources: &sources,
        ledger: &ledger,
    };
    if let Some(share) = arguments.shard {
        walls.evaluate_shard(arguments.points, &share::progress(&study.name, "walls"))?;
        return share::answer(share, &out);
    }
    let mut tenths = 0;
    let evaluated = walls.evaluated(arguments.points, &mut |done| {
        let now = 10 * done.len() as u64 / arguments.points;
        if now > tenths {
            tenths = now;
            let answer = running(&sources, &base_points(done), RANDOMISATIONS);
            output::note(&format!("{}: {}/{} points, {answer}", study.name, done.len(), arguments.points));
        }
    })?;
    let summary = SensitivitySummary::of(&study, kn, &sources, &evaluated, RANDOMISATIONS);
    let table = sensitivity_table(&sources, &evaluated, RANDOMISATIONS)?;
    let place = Place {
        out: &out,
        name: SENSITIVITY,
        study: (&study, &loaded),
        of: &arguments.which.study,
        threads: arguments.threads,
        report: arguments.report,
    };
    let answer = told(&sensitivity_document(&summary, table), &summary, &place)?;
    Ok(answer.with_warnings(sensitivity_warnings(&summary)))
}

/// The study of one arm alone, whose members are the base points.
fn of_points(study: Study, index: usize, points: u64) -> Study {
    let arm = Arm { members: points, ..study.arms[index].clone() };
    let mut decided_by = BTreeMap::from([(SENSITIVITY.to_owned(), arm.name.clone())]);
    if study.depends_on_members() {
        decided_by.insert(format!("{SENSITIVITY}.points"), points.to_string());
    }
    let name = study.name.clone();
    study.of_arms(name, vec![arm], decided_by)
}
