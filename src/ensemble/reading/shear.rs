//! Walls that a jack pushes along themselves: their capacity and stiffness, and the push over the drift.

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Block, of_optional, of_record};
use crate::ensemble::field::record;
use crate::ensemble::quantity::{Observed, value};
use crate::ensemble::reading::{StepRow, finite};
use crate::ensemble::record::Row;
use crate::model::{Level, Outcome};
use crate::protocol::{LoadStep, ShearMode, Sheared};

record! {
    /// What is read off a sheared wall; see [`Sheared`]. `None` where limit analysis has no such value.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
    ShearRow {
        capacity_n: Option<f64> = "capacity_n", "N", "the largest push that the wall bore";
        drift_at_capacity_percent: Option<f64> =
            "drift_at_capacity_percent", "%", "the drift at which it was reached";
        plateau_n: Option<f64> = "plateau_n", "N",
            "push at which a wall of the same stiffness that gives way at once does as much work";
        stiffness_n_per_m: Option<f64> =
            "stiffness_n_per_m", "N/m", "secant of push over displacement at a third of the plateau";
        mode: Option<ShearMode> =
            "shear_mode", "", "how the wall gives way in its plane: rocking, sliding, toe";
        opening_m: Option<f64> = "opening_m", "m", "widest opening of a joint at the end";
    }
}

record! {
    /// What a jack does at a load step; nothing where there is none.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
    ShearStep {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        drift_percent: Option<f64> =
            "drift_percent", "%", "displacement of the beam on the wall over the height of the jack";
        #[serde(default, skip_serializing_if = "Option::is_none")]
        force_n: Option<f64> = "force_n", "N", "force of the jack along the wall";
    }
}

impl ShearRow {
    /// Of a run.
    pub(super) fn of(shear: &Sheared) -> ShearRow {
        ShearRow {
            capacity_n: finite(shear.capacity),
            drift_at_capacity_percent: shear.mode.and_then(|_| finite(100.0 * shear.drift_at_capacity)),
            plateau_n: shear.plateau.and_then(finite),
            stiffness_n_per_m: shear.stiffness.and_then(finite),
            mode: shear.mode,
            opening_m: shear.opening.and_then(finite),
        }
    }
}

impl ShearStep {
    /// Of a load step.
    pub(super) fn of(step: &LoadStep) -> ShearStep {
        let drift = if let Level::Drift(drift) = step.level { finite(100.0 * drift) } else { None };
        ShearStep { drift_percent: drift, force_n: step.push.and_then(finite) }
    }
}

impl Row {
    /// The push of a wall that is sheared, step by step: drift (%) and force (N).
    pub fn pushes(&self) -> impl Iterator<Item = (f64, f64)> {
        self.load_steps.iter().filter_map(|step| step.jack.drift_percent.zip(step.jack.force_n))
    }
}

/// What a wall says of [`Quantity::ShearCapacity`](crate::ensemble::Quantity::ShearCapacity).
pub fn capacity(row: &Row) -> Observed {
    match row.outcome {
        Outcome::Collapsed { .. } | Outcome::Equilibrium => {
            value(row.reading.shear.and_then(|shear| shear.capacity_n))
        }
        _ => Observed::Nothing,
    }
}

/// Columns of what is read off the whole push.
pub(super) const SHEARED: Block = Block {
    name: "sheared",
    fills: |row| row.reading.shear.is_some(),
    members: || of_optional(|row: &Row| row.reading.shear.as_ref()),
    steps: Vec::new,
};

/// Columns of the push itself.
pub(super) const PUSHED: Block = Block {
    name: "pushed",
    fills: |row| row.load_steps.iter().any(|step| step.jack.force_n.is_some()),
    members: Vec::new,
    steps: || of_record(|step: &StepRow| &step.jack),
};
