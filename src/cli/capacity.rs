//! `pirca capacity`: what walls of a kind may be counted on to bear.

use crate::cli::arguments::Capacity;
use crate::cli::failure::Failure;
use crate::cli::{locate, output, progress, question, rare, threads};
use crate::ensemble::{self, Quantity, Settings, is_random};
use crate::report::{CapacitySummary, Question, capacity_text, write_capacity};
use crate::stats::{CHARACTERISTIC_PROBABILITY, Variation};
use crate::study::{MEASURED, MeasuredQuantity, Measurement};

/// What the folder of the results is named by.
const CAPACITY: &str = "capacity";

/// Answers the question from specimens, or from walls that are evaluated as far as they have not been.
pub(crate) fn capacity(arguments: &Capacity) -> Result<(), Failure> {
    let study = locate::with_ensemble(locate::study(&arguments.which)?.study, &arguments.ensemble)?;
    let known = arguments.known_cov.map_or(Variation::Unknown, Variation::Known);
    let quantity = if arguments.measured { Quantity::CollapseAngle } else { Quantity::of(&study.protocol) };
    let question = question::asked(&arguments.question, quantity, &study)?
        .unwrap_or(Question::Quantile(CHARACTERISTIC_PROBABILITY));
    if let (Some(_), Question::Quantile(_)) = (arguments.walls, question) {
        let text = "--walls: further walls are evaluated towards a level; name one (--below-deg, --above-m or --below-n)";
        return Err(Failure::Usage(text.to_owned()));
    }
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
        return match arguments.which.json {
            true => output::print_json(&summary),
            false => output::print(&capacity_text(&summary)),
        };
    }
    if !study.arms.iter().any(is_random) {
        return Err(Failure::Input(format!(
            "{}: nothing is drawn in any arm, so every wall is alike and has no probability; give an arm random stones or joints",
            study.name
        )));
    }
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, CAPACITY));
    let settings = Settings { out: out.clone(), threads: arguments.threads };
    let rows = ensemble::run(&study, &settings, progress::on_stderr(&study).as_ref())?;
    let mut summary = CapacitySummary::simulated(&study, &rows, question, known);
    if let Some(budget) = arguments.walls {
        threads::on(arguments.threads, || rare::ask(&study, &mut summary, budget, &out))?;
    }
    write_capacity(&summary, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
    if arguments.which.json {
        return output::print_json(&summary);
    }
    output::print(&format!("{}\nwritten to {}\n", capacity_text(&summary), out.display()))
}
