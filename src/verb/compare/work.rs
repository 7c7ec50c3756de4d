//! `pirca compare`: which arm of a study is the best, and how sure that is.

use crate::ensemble::{Compared, Contest, Hopeless, Quantity, Row, Settings, is_random};
use crate::stats::selection::{FIRST, Measure};
use crate::study::Study;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::compare::answer::{SelectionSummary, selection_document, selection_running};
use crate::verb::compare::ask::{Compare, SameWithin};
use crate::verb::question::Question;
use crate::verb::run::page::{Place, told};
use crate::verb::{arms, locate, question};

/// What the folder of the results is named by.
const COMPARE: &str = "compare";

/// Evaluates walls until the best arm is known, and says what they show.
pub(crate) fn compare(arguments: &Compare) -> Result<Answer, Failure> {
    let loaded = locate::study(&arguments.which)?;
    let study = match arguments.seed {
        Some(seed) => loaded.study.clone().with_seed(seed),
        None => loaded.study.clone(),
    };
    question::needs_independent_walls(&study, "a comparison of arms")?;
    let quantity = Quantity::of(&study);
    let question = question::asked(&arguments.question, quantity, &study)?;
    let contest = Contest {
        study: &study,
        arms: compared(&study, arguments)?,
        point: arguments.point,
        measure: measure(question, quantity),
        confidence: arguments.confidence,
        same_within: same_within(&arguments.same_within, question, quantity, &study)?,
        budget: arguments.walls as usize,
    };
    let least: usize =
        contest.arms.iter().map(|arm| if is_random(arm_of(&study, *arm)) { FIRST } else { 1 }).sum();
    if contest.budget < least {
        return Err(Failure::Usage(format!(
            "--walls {}: {FIRST} walls of each random arm are evaluated before the first look, {least} in all; allow these or more",
            contest.budget
        )));
    }
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, COMPARE));
    let settings = Settings { out: out.clone(), threads: arguments.threads };
    let tell =
        |look: &Compared| output::note(&format!("{}: {}", study.name, selection_running(&contest, look)));
    let (rows, look) = contest.run(&settings, &tell)?;
    if let Some(why) = contest.hopeless(&look) {
        return Err(hopeless(&contest, &rows, &look, why));
    }
    let summary = SelectionSummary::of(&contest, question, &rows, &look);
    let counted = evaluated(&study, &rows);
    let place = Place {
        out: &out,
        name: COMPARE,
        study: (&counted, &loaded),
        of: &arguments.which.study,
        threads: arguments.threads,
        report: arguments.report,
    };
    told(&selection_document(&summary), &summary, &place)
}

/// The study with the arms that were compared, each with the walls that were evaluated of it.
fn evaluated(study: &Study, rows: &[Row]) -> Study {
    let mut counted = study.clone();
    for (arm, index) in counted.arms.iter_mut().zip(0u32..) {
        arm.members = rows.iter().filter(|row| row.arm_index == index).count() as u64;
    }
    counted.arms.retain(|arm| arm.members > 0);
    counted
}

fn arm_of(study: &Study, index: u32) -> &crate::study::Arm {
    &study.arms[index as usize]
}

/// The arms that are asked for, by their places in the study: two or more, one of them random, all with this kn point.
fn compared(study: &Study, arguments: &Compare) -> Result<Vec<u32>, Failure> {
    let chosen = arms::named(study, &arguments.arms)?;
    if let [only] = chosen[..] {
        let found =
            format!("one arm, `{}`, cannot be compared: two or more are needed", arm_of(study, only).name);
        return Err(match arguments.arms.is_empty() {
            true => Failure::Input(format!("{}: {found}; add an [[arm]] to study.toml", study.name)),
            false => Failure::Usage(format!("--arms: {found}; the study has {}", arms::names(study))),
        });
    }
    if !chosen.iter().any(|arm| is_random(arm_of(study, *arm))) {
        return Err(Failure::Input(format!(
            "{}: nothing is drawn in any arm that is compared, so every wall of an arm is alike and `run` shows which is better; give an arm random stones or joints",
            study.name
        )));
    }
    chosen.iter().try_for_each(|arm| arms::has_point(arm_of(study, *arm), arguments.point))?;
    Ok(chosen)
}

/// The question as a measure of strength, of which larger is better.
fn measure(question: Option<Question>, quantity: Quantity) -> Measure {
    match question {
        None => Measure::Mean,
        Some(Question::Below(level) | Question::Above(level)) => {
            Measure::ShareBelow(quantity.strength(level))
        }
        // The upper end of a displacement is the weak one.
        Some(Question::Quantile(share)) if quantity == Quantity::TopDisplacement => {
            Measure::Quantile(1.0 - share)
        }
        Some(Question::Quantile(share)) => Measure::Quantile(share),
    }
}

/// Which differences do not matter, in the unit of what is compared.
fn same_within(
    asked: &SameWithin,
    question: Option<Question>,
    quantity: Quantity,
    study: &Study,
) -> Result<f64, Failure> {
    let is_share = matches!(question, Some(Question::Below(_) | Question::Above(_)));
    let options = [
        ("--same-within-deg", asked.same_within_deg, Some(Quantity::CollapseAngle), 0.25),
        ("--same-within-m", asked.same_within_m, Some(Quantity::TopDisplacement), 1e-4),
        ("--same-within-n", asked.same_within_n, Some(Quantity::ShearCapacity), 1000.0),
        ("--same-within-share", asked.same_within_share, None, 0.05),
    ];
    let wanted = if is_share { None } else { Some(quantity) };
    let own = options.iter().find(|(.., of, _)| *of == wanted).copied().unwrap_or(options[0]);
    if let Some((option, ..)) = options.iter().find(|(_, value, of, _)| value.is_some() && *of != wanted) {
        let compared =
            if is_share { "probabilities".to_owned() } else { quantity.name().replace('_', " ") + "s" };
        return Err(Failure::Usage(format!(
            "{option}: of {} {compared} are compared; say it with {}",
            study.name, own.0
        )));
    }
    Ok(own.1.unwrap_or(own.3))
}

/// What keeps walls from being compared, how it was found, and what to do.
fn hopeless(contest: &Contest<'_>, rows: &[Row], look: &Compared, why: Hopeless) -> Failure {
    let quantity = Quantity::of(contest.study);
    match why {
        Hopeless::NoValue(place) => {
            let index = contest.arms[place];
            let name = &arm_of(contest.study, index).name;
            let reason = rows.iter().find(|row| row.arm_index == index).map_or_else(String::new, |row| {
                format!(" (the first: {} {})", row.outcome.name().replace('_', " "), row.outcome.reason())
            });
            Failure::Run(format!(
                "none of the {} walls of arm `{name}` brought a value{reason}; allowed are arms of which some do: leave it out with --arms, or change its walls or its load",
                look.kinds[place].values.len()
            ))
        }
        Hopeless::OneSide(ends) => {
            let [a, b] = ends.map(|strength| quantity.shown(quantity.strength(strength)));
            let ends = [a.min(b), a.max(b)].map(|end| format!("{end:.4}"));
            Failure::Usage(format!(
                "the level: all {} walls lie on one side of it, at {} to {} {}; name a level between them, or ask `pirca capacity --walls` for rarer ones",
                look.walls,
                ends[0],
                ends[1],
                quantity.shown_unit()
            ))
        }
    }
}
