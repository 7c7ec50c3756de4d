//! `pirca influence`: where does the scatter of walls come from?

use std::collections::BTreeMap;

use crate::cli::answer::Answer;
use crate::cli::arguments::Influence;
use crate::cli::failure::Failure;
use crate::cli::{locate, one_wall, output, report as page, threads};
use crate::ensemble::{InfluenceWalls, Kept, RANDOMISATIONS, base_points, influence_table, sources};
use crate::report::{
    InfluenceSummary, influence_page, influence_text, influence_warnings, running, write_influence,
};
use crate::study::{Arm, Design, Study};

/// What the folder of the results is named by.
const INFLUENCE: &str = "influence";
/// Most base points.
const MOST: u64 = RANDOMISATIONS * Design::MOST_POINTS;

/// Evaluates what has not been, and says where the scatter comes from.
pub(crate) fn influence(arguments: &Influence) -> Result<Answer, Failure> {
    threads::on(arguments.threads, || answered(arguments))
}

fn answered(arguments: &Influence) -> Result<Answer, Failure> {
    let loaded = locate::study(&arguments.which)?;
    let mut study = loaded.study.clone();
    if let Some(seed) = arguments.seed {
        study = study.with_seed(seed);
    }
    let index = one_wall::arm_index(&study, arguments.arm.as_deref())?;
    let kn = one_wall::kn(&study.arms[index], arguments.point)?;
    let study = of_points(study, index, arguments.points);
    let sources = sources(&study.arms[0]);
    if sources.is_empty() {
        return Err(Failure::Input(format!(
            "{}: nothing is drawn in arm {}, so its walls do not scatter; draw something in [uncertain], or name another --arm",
            study.name, study.arms[0].name
        )));
    }
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, INFLUENCE));
    output::folder(&out)?;
    let kept = Kept::open(&out, &study.hash)?;
    let walls =
        InfluenceWalls { study: &study, arm: 0, point: arguments.point, sources: &sources, kept: &kept };
    let mut tenths = 0;
    let evaluated = walls.evaluated(arguments.points, &mut |done| {
        let now = 10 * done.len() as u64 / arguments.points;
        if now > tenths {
            tenths = now;
            let answer = running(&sources, &base_points(done), RANDOMISATIONS);
            output::note(&format!("{}: {}/{} points, {answer}", study.name, done.len(), arguments.points));
        }
    })?;
    let summary = InfluenceSummary::of(&study, kn, &sources, &evaluated, RANDOMISATIONS);
    let table = influence_table(&sources, &evaluated, RANDOMISATIONS)?;
    write_influence(&summary, &table, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
    page::beside(&out, (arguments.report, &arguments.which, arguments.threads), |origin| {
        influence_page(&summary, (&study, &loaded), origin)
    })?;
    let text = format!("{}\nwritten to {}\n", influence_text(&summary), out.display());
    Ok(Answer::of(text, &summary)?.in_place(&out).with_warnings(influence_warnings(&summary)))
}

/// The study of one arm alone, whose members are the base points.
fn of_points(study: Study, index: usize, points: u64) -> Study {
    let arm = Arm { members: points, ..study.arms[index].clone() };
    let mut decided_by = BTreeMap::from([(INFLUENCE.to_owned(), arm.name.clone())]);
    if study.depends_on_members() {
        decided_by.insert(format!("{INFLUENCE}.points"), points.to_string());
    }
    let name = study.name.clone();
    study.of_arms(name, vec![arm], decided_by)
}

/// A number of base points.
pub(crate) fn points(text: &str) -> Result<u64, String> {
    let allowed = |n: &u64| n.is_multiple_of(RANDOMISATIONS) && (2 * RANDOMISATIONS..=MOST).contains(n);
    text.parse().ok().filter(allowed).ok_or_else(|| {
        format!("allowed is a multiple of {RANDOMISATIONS} from {} to {MOST}", 2 * RANDOMISATIONS)
    })
}
