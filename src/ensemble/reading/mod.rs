//! What a protocol brings to light of a wall. Each protocol has a file: what it records of walls and of their load steps, how that is read
//! off a run, in which columns it stands, and the quantity that it is about.

pub(super) mod base_motion;
pub(super) mod lateral;
pub(super) mod retaining;
pub(super) mod shear;
mod sought;
pub(super) mod tilting;

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Block, Column, Members, Steps, of_record};
use crate::ensemble::field::record;
use crate::ensemble::reading::base_motion::ShakenRow;
use crate::ensemble::reading::lateral::TopStep;
use crate::ensemble::reading::retaining::{RetainedRow, RetainedStep};
use crate::ensemble::reading::shear::{ShearRow, ShearStep};
use crate::ensemble::reading::tilting::{TiltingRow, tilt};
use crate::ensemble::record::Row;
use crate::ensemble::undecided;
use crate::model::Level;
use crate::protocol::{LoadStep, Run};
use crate::study::Mechanisms;

record! {
    /// What is read of a wall; by default nothing. Of a wall that is shaken each run is a load step.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
    Reading {
        top_displacement_m: Option<f64> = "top_displacement_m", "m",
            "largest displacement at the wall's top along the load, at its end, since gravity alone; of walls in equilibrium";
        /// What is read on a tilting table.
        #[serde(flatten)]
        tilting: TiltingRow;
        /// What is read off a wall that holds back fill or water; `None` of others.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        retained: Option<RetainedRow>;
        /// What is read off a wall that is sheared; `None` of others.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        shear: Option<ShearRow>;
    }
}

record! {
    /// One load step of a member; by default with nothing observed.
    #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
    StepRow {
        load_factor: Option<f64> = "load_factor", "", "share of the full load; none on a tilting table";
        tilt_deg: Option<f64> = "tilt_deg", "deg", "tilt of the platform";
        /// What a jack does along the wall.
        #[serde(flatten)]
        jack: ShearStep;
        /// How high fill or water stands behind the wall.
        #[serde(flatten)]
        behind: RetainedStep;
        /// How far the top has moved.
        #[serde(flatten)]
        top: TopStep;
        /// Unbalanced force ratio reached; `None` when it is not finite.
        unbalanced_ratio: Option<f64>;
        /// Time steps taken.
        solver_steps: u64;
        /// What came of a record at an intensity; `None` unless the wall is shaken.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        shaken: Option<ShakenRow>;
    }
}

impl Reading {
    /// Off a run along a load path, by a gauge that may be off.
    pub(super) fn of(run: &Run, gauge: &Mechanisms) -> Reading {
        Reading {
            top_displacement_m: lateral::top_displacement(run, gauge),
            tilting: TiltingRow::of(run),
            retained: RetainedRow::of(run),
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
            behind: RetainedStep::of(step),
            top: TopStep::of(number, step, gauge),
            unbalanced_ratio: finite(step.unbalanced_ratio),
            solver_steps: step.solver_steps,
            shaken: None,
        }
    }
}

/// The columns that tables have only where some wall fills them, in their order.
pub(super) static BLOCKS: [Block; 6] = [
    retaining::HELD,
    retaining::RAISED,
    shear::SHEARED,
    shear::PUSHED,
    undecided::UNDECIDED,
    base_motion::SHAKEN,
];

/// The columns that every table of members has.
pub(super) fn members() -> Vec<Column<Members>> {
    let tilting = of_record(|row: &Row| &row.reading.tilting);
    of_record(|row: &Row| &row.reading).into_iter().chain(tilting).collect()
}

/// The columns that every table of load steps has.
pub(super) fn steps() -> Vec<Column<Steps>> {
    let top = of_record(|step: &StepRow| &step.top);
    of_record(|step: &StepRow| step).into_iter().chain(top).collect()
}

/// A value that a table can hold: NaN and infinity are "not observed".
pub(super) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
