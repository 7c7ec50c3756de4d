//! What rigid blocks leave open of a member's value.

use serde::{Deserialize, Serialize};

use crate::ensemble::columns::{Block, of_optional};
use crate::ensemble::design::Task;
use crate::ensemble::field::record;
use crate::ensemble::reading::tilting::tilt;
use crate::ensemble::record::Row;
use crate::math::{degrees, radians};
use crate::model::{Level, Outcome};
use crate::protocol::{self, Protocol};
use crate::study::Study;

record! {
    /// What joints bear that are merely stiff, where rigid blocks leave the load open; see [`protocol::Undecided`]. The row's value is
    /// the upper end.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    UndecidedRow {
        stiff_angle_deg: Option<f64> = "stiff_angle_deg", "deg",
            "tilt at which it falls with stiff joints, where rigid blocks leave the value open";
        stiff_multiplier: Option<f64> = "stiff_multiplier", "", "factor on the load with stiff joints, the same";
        stiff_capacity_n: Option<f64> =
            "stiff_capacity_n", "N", "the largest push with stiff joints, the same";
        thrust_needed_n: Option<f64> =
            "thrust_needed_n", "N", "thrust in upright joints that the value needs";
        thrust_at_rest_n: Option<f64> =
            "thrust_at_rest_n", "N", "thrust in upright joints under the weight alone";
        why: String = "left_open", "", "why rigid blocks leave the value open";
    }
}

impl Row {
    /// The row with what stiff joints bear in the place of its value, where rigid blocks leave that open.
    pub fn with_stiff_joints(&self) -> Row {
        let mut row = self.clone();
        let Some(open) = &self.undecided else { return row };
        if let Some(angle) = open.stiff_angle_deg {
            row.reading.tilting.collapse_angle_deg = Some(angle);
            row.outcome = Outcome::Collapsed { at: Level::Tilt(radians(angle)) };
        }
        if let (Some(height), Some(retained)) = (open.stiff_multiplier, &mut row.reading.retained) {
            retained.fell_at_m = Some(height);
            row.outcome = Outcome::Collapsed { at: Level::Height(height) };
        }
        if let (Some(capacity), Some(shear)) = (open.stiff_capacity_n, &mut row.reading.shear) {
            shear.capacity_n = Some(capacity);
        }
        row
    }
}

/// What rigid blocks leave open of a wall's value, in its unit.
pub(super) fn undecided(study: &Study, task: Task, run: &protocol::Run) -> Option<UndecidedRow> {
    let open = run.undecided.as_ref()?;
    let vertical = match study.as_drawn(task.arm, task.member).protocol {
        Protocol::Shear(shear) => Some(shear.vertical_load),
        _ => None,
    };
    let tilts = run.steps.first().is_some_and(|step| tilt(step.level).is_some());
    Some(UndecidedRow {
        stiff_angle_deg: tilts.then(|| degrees(open.lower)),
        stiff_multiplier: (!tilts).then_some(open.lower),
        stiff_capacity_n: vertical.map(|load| open.lower * load),
        thrust_needed_n: open.needed,
        thrust_at_rest_n: open.at_rest,
        why: open.reason(),
    })
}

/// Columns of what stiff joints bear.
pub(super) const UNDECIDED: Block = Block {
    name: "undecided",
    fills: |row| row.undecided.is_some(),
    members: || of_optional(|row: &Row| row.undecided.as_ref()),
    steps: Vec::new,
};
