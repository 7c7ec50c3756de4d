//! What walls must bear, as it is asked for, and what its answer says to a program that waits for the exit code.

use clap::Args;
use serde_json::{Value, json};

use crate::ensemble::{Failing, Quantity};
use crate::study::{Demand, Study};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::locate;

/// Share of walls that may fail where another is not asked for.
pub(crate) const MAY_FAIL: &str = "0.05";
/// The exit code of an answer that does not show what was to be shown.
const NOT_SHOWN: u8 = 4;

/// What walls must bear, and whether the exit code says so.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Demand")]
pub(crate) struct DemandOptions {
    /// What a wall must bear: a tilt (8.5deg), a share of its weight (0.15g), a force (12kN), a multiple of the full load (1.2); or how far it may
    /// move (4mm). The answer says whether it does, by how much, and which share of walls fails.
    #[arg(long, value_name = "VALUE", value_parser = demand, allow_negative_numbers = true)]
    pub demand: Option<Demand>,
    /// Exit with 4 unless the demand is met: a single wall bears it, and of many walls, or over ranges, no more than SHARE fail, with a confidence
    /// of 95 %. 59 walls of which none fails show 0.05.
    #[arg(long, value_name = "SHARE", value_parser = share, num_args = 0..=1, default_missing_value = MAY_FAIL, require_equals = true, requires = "demand")]
    pub assert: Option<f64>,
}

impl DemandOptions {
    /// The demand as it was stated; empty where there is none.
    pub fn stated(&self) -> String {
        self.demand.as_ref().map_or_else(String::new, |own| own.stated.clone())
    }

    /// The study with what its walls must bear, which must be of what it observes.
    pub fn of(&self, study: Study) -> Result<Study, Failure> {
        let Some(demand) = self.demand.clone() else { return Ok(study) };
        locate::not_shaken(
            &study,
            "how many walls fall under a record grows with its intensity: the fragility of each arm says it; leave --demand out",
        )?;
        level(&demand, Quantity::of(&study), &study)?;
        Ok(Study { demand: Some(demand), ..study })
    }

    /// The answer, whose exit code says whether no more walls fail than may; `at_most` is the share that they show not to be exceeded.
    pub fn judged(&self, answer: Answer, at_most: f64) -> Answer {
        judged(answer, self.assert, at_most)
    }
}

/// The answer, whose exit code says whether the share that may fail is shown not to be exceeded.
pub(crate) fn judged(answer: Answer, may_fail: Option<f64>, at_most: f64) -> Answer {
    match may_fail {
        Some(may_fail) if at_most > may_fail => answer.with_code(NOT_SHOWN),
        _ => answer,
    }
}

/// How many walls fail, of how many, in the JSON object of an answer.
pub(crate) fn of_walls(failing: &Failing) -> Value {
    json!({
        "fail": failing.fail,
        "unknown": failing.unknown,
        "walls": failing.walls,
        "share": failing.share(),
        "share_ci": failing.interval(),
    })
}

/// How many of them are not known, as the end of a sentence; nothing where all are.
pub(crate) fn and_unknown(failing: &Failing) -> String {
    match failing.unknown {
        0 => String::new(),
        some => format!(", and of {some} it is not known"),
    }
}

/// A demand in the unit of what a study observes.
pub(crate) fn level(demand: &Demand, quantity: Quantity, study: &Study) -> Result<f64, Failure> {
    quantity.level(demand).map_err(|allowed| {
        let found = format!("--demand {}: {} observes {}", demand.stated, study.name, quantity.words());
        Failure::Usage(format!("{found}; allowed is {allowed}"))
    })
}

/// A demand.
pub(crate) fn demand(text: &str) -> Result<Demand, String> {
    text.parse()
}

pub(crate) fn share(text: &str) -> Result<f64, String> {
    let share = text.parse().ok().filter(|x: &f64| (0.0..1.0).contains(x));
    share.ok_or_else(|| "allowed is a number from 0, below 1 (0.05 is 5 %)".to_owned())
}
