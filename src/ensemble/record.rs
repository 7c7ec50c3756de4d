//! What is recorded of a member: one row, and one row per load step.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::ensemble::built::Built;
use crate::ensemble::design::Task;
use crate::ensemble::field::record;
use crate::ensemble::limit_analysis::LimitAnalysis;
use crate::ensemble::reading::{Reading, StepRow};
use crate::ensemble::undecided::UndecidedRow;
use crate::model::Outcome;
use crate::protocol::{Failure, FailureMode};
use crate::study::Study;

/// One member of one arm at one kn: what was drawn, how it ended, what was observed.
///
/// A member that failed is a row too: its outcome says why and the observed values that it does not have are `None`. The default is a wall
/// of which nothing is known yet.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Index of the arm in the study.
    pub arm_index: u32,
    /// Name of the arm.
    pub arm: String,
    /// Index of the kn point.
    pub point: u32,
    /// Normal stiffness of the joints (Pa/m), as stated.
    pub kn_pa_per_m: f64,
    /// Index of the member within its arm: the same wall at every point.
    pub member: u64,
    /// What was drawn of the wall as a whole in the place of the numbers stated, by the path of its key and in its unit.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub drawn: BTreeMap<String, f64>,
    /// How it ended.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// What its protocol brought to light.
    #[serde(flatten)]
    pub reading: Reading,
    /// Limit analysis of the same wall; `None` unless the study asks for it.
    pub limit: Option<LimitAnalysis>,
    /// The mechanism of a collapse; `None` unless one was watched.
    pub mechanism: Option<Mechanism>,
    /// What rigid blocks leave open of its value; `None` where nothing is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub undecided: Option<UndecidedRow>,
    /// What was built.
    #[serde(flatten)]
    pub built: Built,
    /// Time steps over all load steps.
    pub solver_steps: u64,
    /// Unbalanced force ratio at the end.
    pub unbalanced_ratio: Option<f64>,
    /// Load steps begun, gravity first.
    pub load_steps: Vec<StepRow>,
}

impl Row {
    /// That says which member it is and how it ended, with nothing built and nothing observed.
    pub fn of(study: &Study, task: Task, outcome: Outcome) -> Row {
        let arm = &study.arms[task.arm as usize];
        Row {
            arm_index: task.arm,
            arm: arm.name.clone(),
            point: task.point,
            kn_pa_per_m: arm.kn_points[task.point as usize],
            member: task.member,
            drawn: study.as_drawn(task.arm, task.member).values,
            outcome,
            ..Row::default()
        }
    }

    /// Tilt at which the wall fell: the last one borne (deg); `None` unless it collapsed on a tilting table.
    pub fn collapse_angle_deg(&self) -> Option<f64> {
        self.reading.tilting.collapse_angle_deg
    }

    /// Where its top came to under the full load (m); `None` unless in equilibrium.
    pub fn top_displacement_m(&self) -> Option<f64> {
        self.reading.top_displacement_m
    }
}

record! {
    /// The first mechanism of a collapse; see [`Failure`].
    #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
    Mechanism {
        mode: FailureMode =
            "failure_mode", "", "how the moving part moves as it falls: sliding, rocking, bulging";
        moving: u32 = "moving_stones", "", "number of stones that take part in the mechanism";
        weight_share: f64 = "moving_weight_share", "", "their share of the weight of all stones";
        length_share: f64 = "moving_length_share", "",
            "share of the wall's length that moves by half of the largest movement or more";
        place: f64 = "moving_place", "",
            "middle of the movement along the wall, as a share of its length from x = 0";
        hinge_height_m: f64 =
            "hinge_height_m", "m", "height of the hinge or of the plane of sliding above the wall's foot";
        turning_share: f64 =
            "turning_share", "", "turning over turning and slipping in the moving joints: 1 rocks, 0 slides";
    }
}

impl Mechanism {
    /// Of a collapse that was watched.
    pub(super) fn of(failure: &Failure) -> Mechanism {
        Mechanism {
            mode: failure.mode,
            moving: failure.moving.len() as u32,
            weight_share: failure.weight_share,
            hinge_height_m: failure.hinge_height,
            turning_share: failure.turning_share,
            length_share: failure.length_share,
            place: failure.place,
        }
    }
}
