//! `pirca capacity`: what walls of a kind can be relied on to bear.

use serde_json::json;

use crate::ensemble;
use crate::ensemble::{Quantity, Settings, is_random};
use crate::stats::{CHARACTERISTIC_PROBABILITY, Statistic, Variation};
use crate::study::{MEASURED, MeasuredQuantity, Measurement, Study, Until};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::{output, progress, threads};
use crate::verb::arguments::quoted;
use crate::verb::capacity::answer::{CapacitySummary, capacity_document, capacity_warnings};
use crate::verb::capacity::ask::Capacity;
use crate::verb::capacity::rare;
use crate::verb::capacity::rare::Waiting;
use crate::verb::question::{CAPACITY, Question};
use crate::verb::run::page::{Place, told};
use crate::verb::{demand, locate, question};

/// Answers the question from specimens, or from walls that are evaluated as far as they have not been.
pub(crate) fn capacity(arguments: &Capacity) -> Result<Answer, Failure> {
    let loaded = locate::any_study(&arguments.which)?;
    locate::not_shaken(
        &loaded.study,
        "a wall falls somewhere between two intensities, so what it can be relied on to bear is said by the fragility of its arm: pirca run fits it",
    )?;
    let study = locate::with_ensemble(loaded.study.clone(), &arguments.ensemble)?;
    let known = arguments.known_cov.map_or(Variation::Unknown, Variation::Known);
    let quantity = if arguments.measured { Quantity::CollapseAngle } else { Quantity::of(&study) };
    let question = question::asked(&arguments.question, quantity, &study)?
        .unwrap_or(Question::Quantile(CHARACTERISTIC_PROBABILITY));
    let study = enough(study, question, arguments)?;
    if arguments.known_cov.is_some() && quantity == Quantity::TopDisplacement {
        return Err(Failure::Usage(format!(
            "--known-cov: {} observes a displacement, of which no characteristic value is given; leave it out",
            study.name
        )));
    }
    if arguments.measured {
        let is_angle = |m: &Measurement| m.quantity == MeasuredQuantity::CollapseAngle;
        if !study.measured.iter().any(is_angle) {
            return Err(Failure::Input(format!(
                "{}: no collapse angle in {MEASURED}: nothing to count on",
                study.name
            )));
        }
        let summary = CapacitySummary::measured(&study, question, known);
        let text = capacity_document(&summary).text();
        let answer = Answer::of(text, &summary)?.with_warnings(capacity_warnings(&summary));
        return Ok(demand::judged(answer, arguments.assert, summary.at_most()));
    }
    if !study.arms.iter().any(is_random) {
        return Err(Failure::Input(format!(
            "{}: nothing is drawn in any arm, so every wall is alike and has no probability; give an arm random stones or joints",
            study.name
        )));
    }
    question::needs_independent_walls(&study, "what walls can be relied on to bear")?;
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, CAPACITY));
    let settings = Settings { out: out.clone(), threads: arguments.threads };
    let rows = ensemble::run(&study, &settings, progress::on_stderr(&study).as_ref())?;
    let study = ensemble::come_to(study, &rows);
    let mut summary = CapacitySummary::simulated(&study, &rows, question, known);
    if let (Some(budget), Question::Below(_) | Question::Above(_)) = (arguments.walls, question) {
        let aim = rare::Aim { budget, cov: arguments.cov, method: arguments.method };
        let place = locate::folder(&arguments.which.study)?;
        let batched = arguments.batches.then_some(place.as_path());
        let asked = || rare::ask(&study, &rows, &mut summary, aim, (&out, batched));
        if let Some(waiting) = threads::on(arguments.threads, asked)? {
            return waits(&waiting);
        }
    }
    let place = Place {
        out: &out,
        name: CAPACITY,
        study: (&study, &loaded),
        of: &arguments.which.study,
        threads: arguments.threads,
        report: arguments.report,
    };
    let answer = told(&capacity_document(&summary), &summary, &place)?;
    let answer = answer.with_warnings(capacity_warnings(&summary));
    Ok(demand::judged(answer, arguments.assert, summary.at_most()))
}

/// That the answer waits for walls, and how they are evaluated.
fn waits(waiting: &Waiting) -> Result<Answer, Failure> {
    let Waiting { batch, walls } = waiting;
    let batch = batch.display().to_string();
    let text = format!(
        "{walls} more walls are to be evaluated, as shards of {batch}:\n  pirca shards plan {0} \n\
         then start this command again: it goes on from there\n",
        quoted(&batch)
    );
    Answer::of(text, &json!({"batch": batch, "walls": walls}))
}

/// Most walls of an arm that are added towards a quantile, unless another number is asked for.
const MOST_WALLS: u64 = 1000;

/// The study with walls added until a quantile is known as well as is asked for, and what cannot be asked of a question.
fn enough(study: Study, question: Question, arguments: &Capacity) -> Result<Study, Failure> {
    let Question::Quantile(share) = question else { return Ok(study) };
    let refused = |text: &str| Err(Failure::Usage(text.to_owned()));
    match (arguments.half_width, arguments.walls) {
        _ if arguments.batches => refused(
            "--batches: it is for the walls of a level; name one (--below-deg, --above-m or --below-n)",
        ),
        _ if arguments.method.is_some() => refused(
            "--method: it finds the probability of a level; name one (--below-deg, --above-m or --below-n)",
        ),
        _ if arguments.cov.is_some() => {
            refused("--cov: a quantile has an interval; say how wide with --half-width, or name a level")
        }
        (None, Some(_)) => refused(
            "--walls: further walls are evaluated towards a level (--below-deg, --above-m or --below-n) or a --half-width; name one",
        ),
        (None, None) => Ok(study),
        (Some(below), at_most) => {
            let at_most = at_most.unwrap_or(MOST_WALLS);
            Ok(study.with_until(Until { of: Statistic::Quantile(share), below, at_most }))
        }
    }
}
