//! Walls that hold back fill or water: how high it may rise.

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Block, of_optional, of_record};
use crate::ensemble::field::record;
use crate::ensemble::quantity::{Observed, value};
use crate::ensemble::reading::StepRow;
use crate::ensemble::record::Row;
use crate::model::{Level, Outcome};
use crate::protocol::{LoadStep, Run};

record! {
    /// What is read off a wall that holds back fill or water. Heights are above the foot of its back.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
    RetainedRow {
        fell_at_m: Option<f64> = "retained_height_m", "m",
            "the highest fill or water behind the wall that it bore, of a wall that fell";
        not_borne_m: Option<f64> = "not_borne_height_m", "m", "the lowest one that it did not bear";
        held_m: Option<f64> = "held_height_m", "m",
            "the highest one at which it is known to stand; of a wall that stands that of the top of its back";
    }
}

record! {
    /// How high fill or water stands at a load step; nothing where there is none.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
    RetainedStep {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        height_m: Option<f64> = "height_behind_m", "m", "height of the fill or water behind the wall";
    }
}

impl RetainedRow {
    /// Off a run; `None` where nothing rises.
    pub(super) fn of(run: &Run) -> Option<RetainedRow> {
        let last = height(run.steps.last()?.level)?;
        let fell_at_m = match run.outcome {
            Outcome::Collapsed { at } => height(at),
            _ => None,
        };
        let stands = run.outcome == Outcome::Equilibrium;
        Some(RetainedRow {
            fell_at_m,
            not_borne_m: run.bracket.map(|[_, at]| at),
            held_m: fell_at_m.or_else(|| stands.then_some(last)),
        })
    }
}

impl RetainedStep {
    /// Of a load step.
    pub(super) fn of(step: &LoadStep) -> RetainedStep {
        RetainedStep { height_m: height(step.level) }
    }
}

/// A height (m), if the level is one.
fn height(level: Level) -> Option<f64> {
    if let Level::Height(height) = level { Some(height) } else { None }
}

/// What a wall says of [`Quantity::RetainedHeight`](crate::ensemble::Quantity::RetainedHeight).
pub fn fell(row: &Row) -> Observed {
    let Some(retained) = row.reading.retained else { return Observed::Nothing };
    match row.outcome {
        Outcome::Collapsed { .. } => value(retained.fell_at_m),
        Outcome::Equilibrium => retained.held_m.map_or(Observed::Nothing, Observed::Above),
        _ => Observed::Nothing,
    }
}

/// Columns of what is read off the whole rise.
pub(super) const HELD: Block = Block {
    name: "held",
    fills: |row| row.reading.retained.is_some(),
    members: || of_optional(|row: &Row| row.reading.retained.as_ref()),
    steps: Vec::new,
};

/// Columns of the rise itself.
pub(super) const RAISED: Block = Block {
    name: "raised",
    fills: |row| row.load_steps.iter().any(|step| step.behind.height_m.is_some()),
    members: Vec::new,
    steps: || of_record(|step: &StepRow| &step.behind),
};
