//! Walls on a tilting table: the tilts at which they fall.

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Column, Members, Step, Steps, real};
use crate::ensemble::quantity::{Observed, Quantity, value};
use crate::ensemble::record::Row;
use crate::math::degrees;
use crate::model::{Level, Outcome};
use crate::protocol::{Observes, Run, Tilting};

/// What is read of a wall on a tilting table; nothing where nothing tilts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TiltingRow {
    /// Tilt at which the wall fell: the last one borne (deg); `None` unless it collapsed.
    pub collapse_angle_deg: Option<f64>,
    /// The lowest tilt at which it is known to fall (deg).
    pub fails_at_deg: Option<f64>,
    /// Tilt at which its first stone fell (deg); `None` where none did.
    #[serde(default)]
    pub first_stone_deg: Option<f64>,
    /// The same for a part of its weight, see [`crate::protocol::EventShares`].
    #[serde(default)]
    pub part_deg: Option<f64>,
    /// The same for most of its weight; `None` as well where the test ended with an earlier event.
    #[serde(default)]
    pub most_deg: Option<f64>,
    /// The largest tilt at which it came to rest (deg); `None` for a wall that never stood.
    pub largest_tilt_deg: Option<f64>,
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

/// Of the table of members.
pub(super) fn members() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        real(
            "collapse_angle_deg",
            "deg",
            "the largest tilt that it bore before the event that is its capacity",
            |r: R| r.reading.tilting.collapse_angle_deg,
        ),
        real("fails_at_deg", "deg", "the lowest tilt at which it is known to fall", |r: R| {
            r.reading.tilting.fails_at_deg
        }),
        real("first_stone_deg", "deg", "tilt at which its first stone fell", |r: R| {
            r.reading.tilting.first_stone_deg
        }),
        real("part_deg", "deg", "tilt at which part_share of its weight had fallen", |r: R| {
            r.reading.tilting.part_deg
        }),
        real("most_deg", "deg", "tilt at which most_share of its weight had fallen", |r: R| {
            r.reading.tilting.most_deg
        }),
        real("largest_tilt_deg", "deg", "the largest tilt at which it came to rest", |r: R| {
            r.reading.tilting.largest_tilt_deg
        }),
    ]
}

/// How far along the load path.
pub(super) fn tilt_column() -> Column<Steps> {
    real("tilt_deg", "deg", "tilt of the platform", |s: Step<'_>| s.step.tilt_deg)
}
