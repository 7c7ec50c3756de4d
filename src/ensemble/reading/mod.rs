//! What a protocol brings to light of a wall. Each protocol has a file: what it records of walls and of their load steps, how that is read
//! off a run, in which columns it stands, and the quantity that it is about.

pub(super) mod base_motion;
pub(super) mod lateral;
pub(super) mod shear;
pub(super) mod tilting;

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Block, Column, Members, Steps};
use crate::ensemble::reading::base_motion::ShakenRow;
use crate::ensemble::reading::lateral::TopStep;
use crate::ensemble::reading::shear::{ShearRow, ShearStep};
use crate::ensemble::reading::tilting::{TiltingRow, tilt};
use crate::ensemble::undecided;
use crate::model::Level;
use crate::protocol::{LoadStep, Run};
use crate::study::Mechanisms;

/// What is read of a wall; by default nothing. Of a wall that is shaken each run is a load step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// Largest out-of-plane displacement at the wall's top under the full load since gravity (m); `None` unless in equilibrium.
    pub top_displacement_m: Option<f64>,
    /// What is read on a tilting table.
    #[serde(flatten)]
    pub tilting: TiltingRow,
    /// What is read off a wall that is sheared; `None` of others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear: Option<ShearRow>,
}

/// One load step of a member; by default with nothing observed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepRow {
    /// Load factor: 0 under gravity alone, 1 at the full load; `None` on a tilting table.
    pub load_factor: Option<f64>,
    /// Tilt of the platform (deg); `None` unless on a tilting table.
    pub tilt_deg: Option<f64>,
    /// What a jack does along the wall.
    #[serde(flatten)]
    pub jack: ShearStep,
    /// How far the top has moved.
    #[serde(flatten)]
    pub top: TopStep,
    /// Unbalanced force ratio reached; `None` when it is not finite.
    pub unbalanced_ratio: Option<f64>,
    /// Time steps taken.
    pub solver_steps: u64,
    /// What came of a record at an intensity; `None` unless the wall is shaken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shaken: Option<ShakenRow>,
}

impl Reading {
    /// Off a run along a load path, by a gauge that may be off.
    pub(super) fn of(run: &Run, gauge: &Mechanisms) -> Reading {
        Reading {
            top_displacement_m: lateral::top_displacement(run, gauge),
            tilting: TiltingRow::of(run),
            shear: run.shear.as_ref().map(ShearRow::of),
        }
    }
}

impl StepRow {
    /// Off a load step of this number.
    pub(super) fn of(number: usize, step: &LoadStep, gauge: &Mechanisms) -> StepRow {
        StepRow {
            load_factor: matches!(step.level, Level::Factor(_)).then(|| step.level.value()),
            tilt_deg: tilt(step.level),
            jack: ShearStep::of(step),
            top: TopStep::of(number, step, gauge),
            unbalanced_ratio: finite(step.unbalanced_ratio),
            solver_steps: step.solver_steps,
            shaken: None,
        }
    }
}

/// The columns that tables have only where some wall fills them, in their order.
pub(super) static BLOCKS: [Block; 4] =
    [shear::SHEARED, shear::PUSHED, undecided::UNDECIDED, base_motion::SHAKEN];

/// The columns that every table of members has.
pub(super) fn members() -> Vec<Column<Members>> {
    lateral::members().into_iter().chain(tilting::members()).collect()
}

/// The columns that every table of load steps has.
pub(super) fn steps() -> Vec<Column<Steps>> {
    [lateral::load_factor(), tilting::tilt_column()].into_iter().chain(lateral::top()).collect()
}

/// A value that a table can hold: NaN and infinity are "not observed".
pub(super) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
