//! What walls are asked, how it is answered, and the numbers on the command line.

use clap::Args;
use serde::Serialize;

use crate::ensemble::{Quantity, RANDOMISATIONS};
use crate::study::{Angle, Demand, Design, Study};
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::demand;

/// What is asked of walls: one question, or none.
#[derive(Args, Debug)]
#[group(multiple = false)]
#[command(next_help_heading = "Question")]
pub(crate) struct Asked {
    /// Which share of walls lie below the value sought.
    #[arg(long, value_name = "P", value_parser = probability, allow_negative_numbers = true)]
    pub quantile: Option<f64>,
    /// How probable is it that a wall does not bear this, or moves further: a tilt (8.5deg), a share of its weight (0.15g), a force (12kN), a multiple
    /// of the full load (1.2), a displacement (4mm)?
    #[arg(long, value_name = "VALUE", value_parser = demand::demand, allow_negative_numbers = true)]
    pub demand: Option<Demand>,
    /// How probable is a collapse before this tilt (deg)?
    #[arg(long, value_name = "DEG", value_parser = level, allow_negative_numbers = true)]
    pub below_deg: Option<f64>,
    /// How probable is a displacement beyond this (m)?
    #[arg(long, value_name = "M", value_parser = level, allow_negative_numbers = true)]
    pub above_m: Option<f64>,
    /// How probable is a shear capacity below this (N)?
    #[arg(long, value_name = "N", value_parser = level, allow_negative_numbers = true)]
    pub below_n: Option<f64>,
}

/// The question that is asked, which must be of what is observed; `None` where none is.
pub(crate) fn asked(asked: &Asked, quantity: Quantity, study: &Study) -> Result<Option<Question>, Failure> {
    let levels = [
        ("--below-deg", asked.below_deg, Quantity::CollapseAngle, Question::Below as fn(f64) -> Question),
        ("--above-m", asked.above_m, Quantity::TopDisplacement, Question::Above),
        ("--below-n", asked.below_n, Quantity::ShearCapacity, Question::Below),
    ];
    for (option, level, of, question) in levels {
        let Some(level) = level else { continue };
        if of != quantity {
            let own = levels.iter().find(|(.., of, _)| *of == quantity);
            let fix =
                own.map_or("ask for a --quantile".to_owned(), |(option, ..)| format!("ask with {option}"));
            return Err(Failure::Usage(format!(
                "{option}: {} observes {}; {fix}",
                study.name,
                quantity.words()
            )));
        }
        let doubt = Some(level).filter(|_| of == Quantity::CollapseAngle);
        if let Some(doubt) = doubt.and_then(|level| Angle::Tilt.doubt(level)) {
            output::warning(&format!("{option}: {doubt}"));
        }
        return Ok(Some(question(level)));
    }
    if let Some(demand) = &asked.demand {
        let level = demand::level(demand, quantity, study)?;
        return Ok(Some(match quantity {
            Quantity::TopDisplacement => Question::Above(level),
            _ => Question::Below(level),
        }));
    }
    Ok(asked.quantile.map(Question::Quantile))
}

/// That a study draws its walls independently, as what is asked of them needs.
pub(crate) fn needs_independent_walls(study: &Study, what: &str) -> Result<(), Failure> {
    if study.randomisations() < 2 {
        return Ok(());
    }
    Err(Failure::Input(format!(
        "{}: {what} rests on walls that are drawn independently; set study.design = \"plain\" for it",
        study.name
    )))
}

/// A probability between 0 and 1.
pub(crate) fn probability(text: &str) -> Result<f64, String> {
    number(text, "a number above 0 and below 1", |p| p > 0.0 && p < 1.0)
}

/// A share above 0 and below 1 that an error is of what it is the error of.
pub(crate) fn relative(text: &str) -> Result<f64, String> {
    number(text, "a number above 0 and below 1 (0.1 is 10 %)", |x| x > 0.0 && x < 1.0)
}

/// A level above 0.
pub(crate) fn level(text: &str) -> Result<f64, String> {
    number(text, "a number above 0", |x| x > 0.0 && x.is_finite())
}

/// Minutes of work above 0.
pub(crate) fn minutes(text: &str) -> Result<f64, String> {
    number(text, "a number of minutes above 0", |x| x > 0.0 && x.is_finite())
}

/// A confidence of a half or more.
pub(crate) fn confidence(text: &str) -> Result<f64, String> {
    number(text, "a number from 0.5, below 1 (0.95 is 95 %)", |p| (0.5..1.0).contains(&p))
}

/// A coefficient of variation above 0 and up to 1.
pub(crate) fn variation(text: &str) -> Result<f64, String> {
    number(text, "a number above 0, up to 1 (0.1 is 10 %)", |v| v > 0.0 && v <= 1.0)
}

/// Specimens of which a scatter can be told.
pub(crate) fn specimens(text: &str) -> Result<usize, String> {
    let allowed =
        || "allowed is a whole number from 2 to 10000: one specimen alone shows no scatter".to_owned();
    text.parse().ok().filter(|n| (2..=10_000).contains(n)).ok_or_else(allowed)
}

fn number(text: &str, allowed: &str, is_allowed: impl Fn(f64) -> bool) -> Result<f64, String> {
    text.parse().ok().filter(|x| is_allowed(*x)).ok_or_else(|| format!("allowed is {allowed}"))
}

/// What is asked of the capacity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Question {
    /// How probable it is that a wall's value lies below a level (in the unit of the quantity).
    Below(f64),
    /// How probable it is that a wall's value lies above a level.
    Above(f64),
    /// Below which value a share of all walls lie.
    Quantile(f64),
}

/// An answer, by its name in files; none where the walls do not tell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// Of a value on the worse side of a level.
    Probability(Option<f64>),
    /// The value that a share of all walls lie below, in the unit of the quantity.
    Quantile(Option<f64>),
}

impl Answer {
    /// The answer to a question.
    pub(crate) fn to(question: Question, value: Option<f64>) -> Answer {
        match question {
            Question::Below(_) | Question::Above(_) => Answer::Probability(value),
            Question::Quantile(_) => Answer::Quantile(value),
        }
    }

    /// Its value.
    pub fn value(self) -> Option<f64> {
        let (Answer::Probability(value) | Answer::Quantile(value)) = self;
        value
    }
}

/// What the folder of the results of `capacity` is named by.
pub(crate) const CAPACITY: &str = "capacity";

/// Most base points.
const MOST: u64 = RANDOMISATIONS * Design::MOST_POINTS;

/// A number of base points.
pub(crate) fn points(text: &str) -> Result<u64, String> {
    let allowed = |n: &u64| n.is_multiple_of(RANDOMISATIONS) && (2 * RANDOMISATIONS..=MOST).contains(n);
    text.parse().ok().filter(allowed).ok_or_else(|| {
        format!("allowed is a multiple of {RANDOMISATIONS} from {} to {MOST}", 2 * RANDOMISATIONS)
    })
}
