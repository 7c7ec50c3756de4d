//! Walls that a jack pushes along themselves: their capacity and stiffness, and the push over the drift.

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Block, Column, Members, Step, Steps, real, text};
use crate::ensemble::quantity::{Observed, value};
use crate::ensemble::reading::finite;
use crate::ensemble::record::Row;
use crate::model::{Level, Outcome};
use crate::protocol::{LoadStep, ShearMode, Sheared};

/// What is read off a sheared wall; see [`Sheared`]. `None` where limit analysis has no such value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShearRow {
    /// The largest push (N).
    pub capacity_n: Option<f64>,
    /// The drift at which it was reached (%).
    pub drift_at_capacity_percent: Option<f64>,
    /// The plateau (N).
    pub plateau_n: Option<f64>,
    /// The secant at a third of the plateau (N/m).
    pub stiffness_n_per_m: Option<f64>,
    /// How the wall gives way.
    pub mode: Option<ShearMode>,
    /// Widest opening of a joint at the end (m).
    pub opening_m: Option<f64>,
}

/// What a jack does at a load step; nothing where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShearStep {
    /// Displacement of the beam over the height of the jack (%).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drift_percent: Option<f64>,
    /// Force (N) of the jack along x+.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
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
pub(super) const SHEARED: Block =
    Block { name: "sheared", fills: |row| row.reading.shear.is_some(), members, steps: Vec::new };

/// Columns of the push itself.
pub(super) const PUSHED: Block = Block {
    name: "pushed",
    fills: |row| row.load_steps.iter().any(|step| step.jack.force_n.is_some()),
    members: Vec::new,
    steps,
};

fn members() -> Vec<Column<Members>> {
    type R<'r> = &'r Row;
    vec![
        real("capacity_n", "N", "the largest push that the wall bore", |r: R| {
            r.reading.shear.and_then(|s| s.capacity_n)
        }),
        real("drift_at_capacity_percent", "%", "the drift at which it was reached", |r: R| {
            r.reading.shear.and_then(|s| s.drift_at_capacity_percent)
        }),
        real(
            "plateau_n",
            "N",
            "push at which a wall of the same stiffness that gives way at once does as much work",
            |r: R| r.reading.shear.and_then(|s| s.plateau_n),
        ),
        real(
            "stiffness_n_per_m",
            "N/m",
            "secant of push over displacement at a third of the plateau",
            |r: R| r.reading.shear.and_then(|s| s.stiffness_n_per_m),
        ),
        text("shear_mode", "how the wall gives way in its plane: rocking, sliding, toe", |r: R| {
            r.reading.shear.and_then(|s| s.mode).map(|mode| mode.name().to_owned())
        }),
        real("opening_m", "m", "widest opening of a joint at the end", |r: R| {
            r.reading.shear.and_then(|s| s.opening_m)
        }),
    ]
}

fn steps() -> Vec<Column<Steps>> {
    type S<'r> = Step<'r>;
    vec![
        real(
            "drift_percent",
            "%",
            "displacement of the beam on the wall over the height of the jack",
            |s: S| s.step.jack.drift_percent,
        ),
        real("force_n", "N", "force of the jack along the wall", |s: S| s.step.jack.force_n),
    ]
}
