//! What is recorded of a member: one row, and one row per load step.

use std::collections::BTreeMap;

use crate::math::radians;
use crate::model::{Level, Outcome};
use crate::protocol::{Agreement, FailureMode, ShearMode, Verdict};
use crate::stats::fragility::Outcome as CollapseUnder;
use crate::study::Measure;

/// One member of one arm at one kn: what was drawn, how it ended, what was observed.
///
/// A member that failed is a row too: its outcome says why and the observed values that it does not have are `None`.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
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
    /// Largest out-of-plane displacement at the wall's top under the full load since gravity (m); `None` unless in equilibrium.
    pub top_displacement_m: Option<f64>,
    /// Tilt at which the wall fell: the last one borne (deg); `None` unless it collapsed on a tilting table.
    pub collapse_angle_deg: Option<f64>,
    /// The lowest tilt at which it is known to fall (deg).
    pub fails_at_deg: Option<f64>,
    /// Tilt at which its first stone fell (deg); `None` where none did or nothing tilts.
    #[serde(default)]
    pub first_stone_deg: Option<f64>,
    /// The same for a part of its weight, see [`crate::protocol::EventShares`].
    #[serde(default)]
    pub part_deg: Option<f64>,
    /// The same for most of its weight; `None` as well where the test ended with an earlier event.
    #[serde(default)]
    pub most_deg: Option<f64>,
    /// The largest tilt at which it came to rest (deg); `None` where nothing tilts, and for a wall that never stood.
    pub largest_tilt_deg: Option<f64>,
    /// Limit analysis of the same wall; `None` unless the study asks for it.
    pub limit: Option<LimitAnalysis>,
    /// The mechanism of a collapse; `None` unless one was watched.
    pub mechanism: Option<Mechanism>,
    /// What rigid blocks leave open of its value; `None` where nothing is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub undecided: Option<UndecidedRow>,
    /// What is read off a wall that is sheared; `None` of others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear: Option<ShearRow>,
    /// Number of stones (headers and wedges counted).
    pub stones: u32,
    /// Number of joints at rest.
    pub joints: u32,
    /// Wedge stones.
    pub wedges: u32,
    /// Header stones.
    pub headers: u32,
    /// Fresh starts of the generator.
    pub attempts: u32,
    /// Single redraws of the generator.
    pub redraws: u32,
    /// Slivers merged into a neighbour.
    pub merges: u32,
    /// Mean of the realised dips (deg); `None` where nothing dips.
    pub dip_mean_deg: Option<f64>,
    /// Standard deviation of the realised dips (deg).
    pub dip_sd_deg: Option<f64>,
    /// Standard deviation of the dips as first drawn, before rejection (deg).
    pub first_dip_sd_deg: Option<f64>,
    /// Mean realised stone length (m).
    pub length_mean_m: Option<f64>,
    /// Mean realised stone (course) height (m).
    pub height_mean_m: Option<f64>,
    /// Weight of the stones (N).
    pub weight_n: Option<f64>,
    /// Time steps over all load steps.
    pub solver_steps: u64,
    /// Unbalanced force ratio at the end.
    pub unbalanced_ratio: Option<f64>,
    /// Load steps begun, gravity first.
    pub load_steps: Vec<StepRow>,
}

impl Row {
    /// What came of each record at each intensity, of a wall that is shaken.
    pub fn runs(&self) -> impl Iterator<Item = &ShakenRow> {
        self.load_steps.iter().filter_map(|step| step.shaken.as_ref())
    }
}

impl ShakenRow {
    /// How strong the record was, in a measure.
    pub fn peak(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Pga => self.pga_m_per_s2,
            Measure::Pgv => self.pgv_m_per_s,
        }
    }
}

/// The first mechanism of a collapse; see [`crate::protocol::Failure`].
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Mechanism {
    /// How the moving part moves.
    pub mode: FailureMode,
    /// Number of stones that take part.
    pub moving: u32,
    /// Their share of the weight.
    pub weight_share: f64,
    /// Height of the hinge or the plane of sliding above the wall's foot (m).
    pub hinge_height_m: f64,
    /// Turning over turning and slipping in the joints.
    pub turning_share: f64,
    /// Share of the wall's length that moves by half of the largest movement or more.
    pub length_share: f64,
    /// Middle of the movement along the wall, as a share of its length.
    pub place: f64,
}

/// What joints bear that are merely stiff, where rigid blocks leave the load open; see [`crate::protocol::Undecided`]. The row's value is
/// the upper end.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct UndecidedRow {
    /// The tilt at which it falls with stiff joints (deg); `None` where nothing tilts.
    pub stiff_angle_deg: Option<f64>,
    /// The factor on the load with stiff joints; `None` on a tilting table.
    pub stiff_multiplier: Option<f64>,
    /// The largest push with stiff joints (N), of a wall that is sheared.
    pub stiff_capacity_n: Option<f64>,
    /// The thrust in upright joints that the row's value needs (N).
    pub thrust_needed_n: Option<f64>,
    /// The thrust in upright joints under the weight alone (N).
    pub thrust_at_rest_n: Option<f64>,
    /// Why, in words.
    pub why: String,
}

impl Row {
    /// The row with what stiff joints bear in the place of its value, where rigid blocks leave that open.
    pub fn with_stiff_joints(&self) -> Row {
        let mut row = self.clone();
        let Some(own) = &self.undecided else { return row };
        if let Some(angle) = own.stiff_angle_deg {
            row.collapse_angle_deg = Some(angle);
            row.outcome = Outcome::Collapsed { at: Level::Tilt(radians(angle)) };
        }
        if let (Some(capacity), Some(shear)) = (own.stiff_capacity_n, &mut row.shear) {
            shear.capacity_n = Some(capacity);
        }
        row
    }
}

/// What is read off a sheared wall; see [`crate::protocol::Sheared`]. `None` where limit analysis has no such value.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
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

/// What limit analysis says of a member, and how that goes with the solver's answer; see [`crate::protocol::Bounds`].
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct LimitAnalysis {
    /// Tilt of collapse with associative flow, an upper bound (deg); `None` unless on a tilting table and found.
    pub angle_deg: Option<f64>,
    /// The same without dilatancy, neither a bound nor unique (deg).
    pub non_associative_angle_deg: Option<f64>,
    /// Factor on the protocol's load at collapse with associative flow, in shear the push over the vertical load; `None` on a
    /// tilting table or if not found.
    pub multiplier: Option<f64>,
    /// The same without dilatancy.
    pub non_associative_multiplier: Option<f64>,
    /// How it goes with the solver's answer.
    pub agreement: Agreement,
    /// The solver's capacity over the associative bound; `None` unless both were found.
    pub ratio: Option<f64>,
}

/// One load step of a member; by default with nothing observed.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct StepRow {
    /// Load factor: 0 under gravity alone, 1 at the full load; `None` on a tilting table.
    pub load_factor: Option<f64>,
    /// Tilt of the platform (deg); `None` unless on a tilting table.
    pub tilt_deg: Option<f64>,
    /// Displacement of the beam over the height of the jack (%); `None` unless the wall is sheared.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drift_percent: Option<f64>,
    /// Force (N) of the jack along x+; `None` unless the wall is sheared.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Largest displacement at the top in the direction of the load since the end of gravity (m); `None` when it is not finite.
    pub top_displacement_m: Option<f64>,
    /// Displacement of the left point of the top along +y since the end of gravity (m); `None` when it is not finite.
    pub left_m: Option<f64>,
    /// The same at the centre (m).
    pub centre_m: Option<f64>,
    /// The same at the right end (m).
    pub right_m: Option<f64>,
    /// What is left of `left_m` when the platform goes back to the level from here (m); `None` unless the study asks for it and the
    /// wall comes to rest on the way.
    pub left_remainder_m: Option<f64>,
    /// The same at the centre (m).
    pub centre_remainder_m: Option<f64>,
    /// The same at the right end (m).
    pub right_remainder_m: Option<f64>,
    /// Unbalanced force ratio reached; `None` when it is not finite.
    pub unbalanced_ratio: Option<f64>,
    /// Time steps taken.
    pub solver_steps: u64,
    /// What came of a record at an intensity; `None` unless the wall is shaken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shaken: Option<ShakenRow>,
}

/// A wall under a record at an intensity; see [`crate::protocol::Shaken`]. Displacements are against the base, since rest.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ShakenRow {
    /// Index of the record in the study.
    pub record: u32,
    /// Index of the intensity.
    pub stripe: u32,
    /// Peak ground acceleration (m/s^2).
    pub pga_m_per_s2: f64,
    /// Peak ground velocity (m/s).
    pub pgv_m_per_s: f64,
    /// Whether what counts as the wall's collapse came about; `None` where the run and its twin do not tell.
    pub collapse: Option<CollapseUnder>,
    /// How the wall came through.
    pub verdict: Verdict,
    /// How it came through from the start that differs by next to nothing; the same where there was none.
    pub twin: Verdict,
    /// When the first stone fell (s from the beginning of the record).
    pub first_stone_s: Option<f64>,
    /// When `part_share` of the weight had fallen (s).
    pub part_s: Option<f64>,
    /// When `most_share` of it had fallen (s); the run ends there.
    pub most_s: Option<f64>,
    /// Stones that fell.
    pub fallen: u32,
    /// Largest displacement of a stone that had not fallen (m).
    pub displacement_m: f64,
    /// Largest rotation of one (rad).
    pub rotation_rad: f64,
    /// Widest opening of a joint (m).
    pub uplift_m: f64,
    /// Largest slip in a joint (m).
    pub slip_m: f64,
    /// Largest displacement left at the end (m).
    pub residual_m: Option<f64>,
    /// Largest rotation left at the end (rad).
    pub residual_rad: Option<f64>,
    /// Time followed (s).
    pub time_s: f64,
    /// Steps that were not solved to the tolerance.
    pub unsolved_steps: u64,
}
