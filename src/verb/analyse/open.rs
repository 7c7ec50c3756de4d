//! What rigid blocks leave open of an answer, and how it is told.

use serde_json::{Value, json};

use crate::law::Coulomb;
use crate::math::{degrees, tan};
use crate::model::{Outcome, Wall};
use crate::protocol::{Highest, Lower, Undecided, left_open_at, undecided};
use crate::solve::limit::{Analysis, Settings};
use crate::study::Fit;
use crate::terminal::doing::doing;
use crate::verb::analyse::ask::{Analyse, Growing};
use crate::verb::analyse::held::{behind, counted};
use crate::verb::analyse::solve::task;
use crate::verb::analyse::state::Found;

/// What a limit analysis leaves open; contact dynamics says it of itself.
pub(crate) fn left_open(
    arguments: &Analyse,
    wall: &Wall,
    law: &Coulomb,
    fit: &Fit,
    found: &Found,
) -> Option<Undecided> {
    let Found::Limit { found, .. } = found else { return None };
    let bears = match found.outcome {
        Outcome::Collapsed { at } => Some(at.value()),
        Outcome::Equilibrium | Outcome::Unbounded => None,
        _ => return None,
    };
    let analysis = Analysis::new(wall, law, fit.contact, Settings::default());
    let task = task(arguments, (wall, &[]), law, fit);
    if let Some(Ok(behind)) = behind(arguments, wall) {
        let height = if let Some(height) = bears { height } else { behind.height };
        let found = Highest { limit: (**found).clone(), height, bracket: None };
        return doing("asking stiff joints for the thrust", |_| {
            left_open_at(&task, &analysis, &behind, &found)
        });
    }
    doing("asking stiff joints for the thrust", |_| undecided(&task, &analysis, bears, bears))
}

/// Loads in the unit of the answer and as multipliers.
struct Ends {
    unit: [Option<f64>; 2],
    multipliers: [Option<f64>; 2],
}

fn ends(asked: &Analyse, open: &Undecided) -> Ends {
    let levels = [Some(open.lower), open.upper];
    let multiplier = |level: f64| if asked.growing() == Growing::Tilt { tan(level) } else { level };
    Ends {
        unit: levels.map(|level| level.map(|level| in_unit(asked, level))),
        multipliers: levels.map(|level| level.map(multiplier)),
    }
}

/// What the wall bears at least and at most, in the unit of the answer.
pub(crate) fn levels(asked: &Analyse, open: &Undecided) -> [Option<f64>; 2] {
    ends(asked, open).unit
}

/// A load in the unit of the answer: degrees of tilt, or a multiplier.
fn in_unit(asked: &Analyse, level: f64) -> f64 {
    if asked.growing() == Growing::Tilt { degrees(level) } else { level }
}

/// The unit of the answer in the JSON object.
pub(crate) fn unit(asked: &Analyse) -> &'static str {
    match asked.growing() {
        Growing::Tilt => "deg",
        Growing::Height => "m",
        Growing::Lateral | Growing::Factor => "1",
    }
}

/// The same in words.
pub(crate) fn unit_in_words(asked: &Analyse) -> &'static str {
    match asked.growing() {
        Growing::Tilt => "deg",
        Growing::Lateral => "of its weight",
        Growing::Height => "m",
        Growing::Factor => "times the load",
    }
}

/// The range in the headline: what the wall does between the two.
pub(crate) fn headline(asked: &Analyse, open: &Undecided) -> String {
    let to = asked.direction;
    let Ends { unit: [low, high], multipliers } = ends(asked, open);
    let low = low.unwrap_or_default();
    let multipliers = multiplier_range(multipliers);
    match (asked.growing(), high) {
        (Growing::Tilt, Some(high)) => format!(
            "collapses at a tilt between {low:.2} and {high:.2} deg towards {to} (collapse multiplier {multipliers})"
        ),
        (Growing::Height, Some(high)) => {
            format!(
                "collapses between {low:.3} and {high:.3} m of {}, which pushes it towards {to}",
                asked.load.name()
            )
        }
        (Growing::Height, None) => format!(
            "collapses at {low:.3} m of {}, which pushes it towards {to}, or stands with it to the top of its back",
            asked.load.name()
        ),
        (Growing::Factor, Some(high)) => {
            format!("collapses between {low:.4} and {high:.4} times {} towards {to}", counted(asked))
        }
        (Growing::Factor, None) => {
            format!("collapses at {low:.4} times {} towards {to}, or at no more of it", counted(asked))
        }
        (Growing::Tilt, None) => {
            format!("collapses at a tilt of {low:.2} deg towards {to}, or stands to the largest tilt")
        }
        (Growing::Lateral, Some(high)) => {
            format!(
                "collapses between {low:.4} and {high:.4} of its weight towards {to} (collapse multiplier)"
            )
        }
        (Growing::Lateral, None) => {
            format!(
                "collapses at {low:.4} of its weight towards {to}, or stands to the largest horizontal load"
            )
        }
    }
}

/// The collapse multiplier as a range.
fn multiplier_range([low, high]: [Option<f64>; 2]) -> String {
    let low = low.unwrap_or_default();
    high.map_or_else(|| format!("{low:.4} or more"), |high| format!("{low:.4} to {high:.4}"))
}

/// The same in the JSON object.
pub(crate) fn object(asked: &Analyse, open: &Undecided) -> Value {
    let Ends { unit: [lower, upper], multipliers: [lower_multiplier, upper_multiplier] } = ends(asked, open);
    json!({
        "lower": lower,
        "upper": upper,
        "unit": unit(asked),
        "lower_multiplier": lower_multiplier,
        "upper_multiplier": upper_multiplier,
        "lower_by": match open.by {
            Lower::StiffJoints => "stiff_joints",
            Lower::StiffJointsAtLeast(_) => "stiff_joints_at_least",
            Lower::SmoothSides(_) => "smooth_sides",
        },
        "without_dilatancy": open.without_dilatancy.map(|level| in_unit(asked, level)),
        "thrust_needed_n": open.needed,
        "thrust_at_rest_n": open.at_rest,
        "reason": open.reason(),
    })
}
