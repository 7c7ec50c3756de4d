//! Walls on a tilting table: the tilts at which they fall.

use serde::{Deserialize, Serialize};

use crate::ensemble::field::record;
use crate::ensemble::quantity::{Observed, Quantity, value};
use crate::ensemble::record::Row;
use crate::math::degrees;
use crate::model::{Level, Outcome};
use crate::protocol::{Observes, Run, Tilting};

record! {
    /// What is read of a wall on a tilting table; nothing where nothing tilts. A part and most of its weight
    /// are shares as in [`crate::protocol::EventShares`].
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
    TiltingRow {
        collapse_angle_deg: Option<f64> =
            "collapse_angle_deg", "deg", "the largest tilt that it bore before the event that is its capacity";
        fails_at_deg: Option<f64> = "fails_at_deg", "deg", "the lowest tilt at which it is known to fall";
        #[serde(default)]
        first_stone_deg: Option<f64> = "first_stone_deg", "deg", "tilt at which its first stone fell";
        #[serde(default)]
        part_deg: Option<f64> = "part_deg", "deg", "tilt at which part_share of its weight had fallen";
        #[serde(default)]
        most_deg: Option<f64> = "most_deg", "deg", "tilt at which most_share of its weight had fallen";
        largest_tilt_deg: Option<f64> = "largest_tilt_deg", "deg", "the largest tilt at which it came to rest";
    }
}

impl TiltingRow {
    /// Off a run.
    pub(super) fn of(run: &Run) -> TiltingRow {
        let last = run.steps.last().and_then(|step| tilt(step.level));
        TiltingRow {
            collapse_angle_deg: match run.outcome {
                Outcome::Collapsed { at } => tilt(at),
                _ => None,
            },
            fails_at_deg: run.bracket.filter(|_| last.is_some()).map(|[_, at]| degrees(at)),
            first_stone_deg: run.events.first_stone.and_then(tilt),
            part_deg: run.events.part.and_then(tilt),
            most_deg: run.events.most.and_then(tilt),
            largest_tilt_deg: match run.outcome {
                Outcome::Equilibrium => last,
                _ => run.steps.iter().rev().nth(1).and_then(|step| tilt(step.level)),
            },
        }
    }
}

/// A tilt (deg), if the level is one.
pub fn tilt(level: Level) -> Option<f64> {
    if let Level::Tilt(tilt) = level { Some(degrees(tilt)) } else { None }
}

/// The quantity of a study.
pub fn quantity(tilting: &Tilting) -> Quantity {
    match tilting.observes {
        Observes::CollapseAngle => Quantity::CollapseAngle,
        Observes::Displacement => Quantity::TopDisplacement,
    }
}

/// What a wall says of [`Quantity::CollapseAngle`].
pub fn fell(row: &Row) -> Observed {
    match row.outcome {
        Outcome::Collapsed { .. } => value(row.collapse_angle_deg()),
        Outcome::Equilibrium => {
            row.reading.tilting.largest_tilt_deg.map_or(Observed::Nothing, Observed::Above)
        }
        _ => Observed::Nothing,
    }
}
