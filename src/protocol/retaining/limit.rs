//! How high the fill or the water may rise behind rigid blocks.
//!
//! The forces of a height grow with its square and their levers with the height itself, so that the height is no load factor. But at each height limit
//! analysis has one: so many times the pressure of that height the wall bears. It falls where that is 1. The height is bracketed between one where it
//! is above and one where it is below, by false position (Illinois method, Dowell and Jarratt 1971) safeguarded by bisection, on the cube root: the moment of fill goes with the
//! third power of its height.

use crate::math::{Vec3, cbrt};
use crate::model::{Level, Outcome};
use crate::protocol::retaining::behind::Behind;
use crate::protocol::retaining::settings::Lifts;
use crate::solve::limit::{Analysis, Limit, Loads, When};

/// Heights that are looked at most between two lifts.
const PATIENCE: u32 = 60;
/// A wall that bears less than this share of a pressure bears none of it.
const NONE: f64 = 1e-6;

/// How high it may rise.
#[derive(Clone, Debug, PartialEq)]
pub struct Highest {
    /// What was found at the height that is told: the mechanism and the forces. Its outcome has that height as its level: the largest that was seen to be
    /// borne. Its multiplier is how many times the pressure of the height the wall bears; infinite where no factor brings it down.
    pub limit: Limit,
    /// The height (m) above the foot of the back: of a wall that stands that of its top, of one that does not even stand at rest 0.
    pub height: f64,
    /// The highest that was borne and the lowest that was not (m), of a wall that falls.
    pub bracket: Option<[f64; 2]>,
}

/// A look at one height.
struct Tried {
    height: f64,
    limit: Limit,
    /// How far (share) the height lies below that of the fall, about; below 0 where the wall falls.
    margin: f64,
}

/// The height at which a wall falls, or its top.
pub fn highest(analysis: &Analysis, behind: &Behind, lifts: Lifts) -> Highest {
    let at_rest = analysis.multiplier(&loads(behind, 0.0));
    if matches!(at_rest.outcome, Outcome::UnstableAtRest | Outcome::NotConverged { .. }) {
        return ended(at_rest, 0.0);
    }
    let mut spent = at_rest.iterations;
    let mut look = |height: f64| {
        let tried = tried(analysis, behind, height);
        spent += tried.limit.iterations;
        tried
    };
    let (mut low, mut stands) = ((0.0, 1.0), None);
    let mut falls = None;
    for height in lifts.heights(behind.height) {
        let lift = look(height);
        if matches!(lift.limit.outcome, Outcome::NotConverged { .. }) {
            return ended(lift.limit, height);
        }
        if lift.margin < 0.0 {
            falls = Some(lift);
            break;
        }
        low = (height, lift.margin);
        stands = Some(lift);
    }
    let Some(mut falls) = falls else {
        // There is at least one lift.
        let limit = stands.map_or(at_rest, |lift| lift.limit);
        let limit = Limit { outcome: Outcome::Equilibrium, iterations: spent, ..limit };
        return Highest { limit, height: behind.height, bracket: None };
    };
    let close = lifts.bracket * behind.height;
    let (mut high, mut kept_high) = (falls.margin, 0);
    for trial in 0..PATIENCE {
        if falls.height - low.0 <= close {
            break;
        }
        let width = falls.height - low.0;
        // A little beyond where the margin should vanish, on the side that is still far, so that the bracket closes from both.
        let guess = low.0 + width * low.1 / (low.1 - high);
        let between = if kept_high > 0 { guess + 0.4 * close } else { guess - 0.4 * close };
        let usable = between > low.0 && between < falls.height && trial % 4 != 3;
        let lift = look(if usable { between } else { 0.5 * (low.0 + falls.height) });
        if matches!(lift.limit.outcome, Outcome::NotConverged { .. }) {
            return ended(lift.limit, lift.height);
        }
        if lift.margin < 0.0 {
            (high, kept_high) = (lift.margin, 0);
            falls = lift;
        } else {
            low = (lift.height, lift.margin);
            kept_high += 1;
            if kept_high > 1 {
                high *= 0.5;
            }
        }
    }
    let outcome = Outcome::Collapsed { at: Level::Height(low.0) };
    let bracket = Some([low.0, falls.height]);
    Highest { limit: Limit { outcome, iterations: spent, ..falls.limit }, height: low.0, bracket }
}

fn tried(analysis: &Analysis, behind: &Behind, height: f64) -> Tried {
    // It stands under its weight, as was asked before.
    let limit = analysis.multiplier_beside(&analysis.applied(&loads(behind, height)), 0);
    let multiplier = if limit.outcome == Outcome::Unbounded { f64::INFINITY } else { limit.multiplier };
    Tried { height, margin: 1.0 - cbrt(1.0 / multiplier.max(NONE)), limit: Limit { multiplier, ..limit } }
}

fn loads(behind: &Behind, height: f64) -> Loads {
    Loads {
        points: behind.loads(height).iter().map(|load| load.when(When::Live)).collect(),
        live: Vec3::zeros(),
        ..Loads::weight()
    }
}

/// What was found before there was a height to tell, at the level of a height.
fn ended(limit: Limit, height: f64) -> Highest {
    let outcome = match limit.outcome {
        Outcome::NotConverged { unbalanced_ratio, why, .. } => {
            Outcome::NotConverged { at: Level::Height(height), unbalanced_ratio, why }
        }
        other => other,
    };
    Highest { limit: Limit { outcome, ..limit }, height, bracket: None }
}
