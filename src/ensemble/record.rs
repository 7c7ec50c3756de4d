//! What is recorded of a member: one row, and one row per load step.

use crate::model::Outcome;

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
    /// Normal stiffness of the joints (Pa/m).
    pub kn_pa_per_m: f64,
    /// Index of the member within its arm: the same wall at every point.
    pub member: u64,
    /// How it ended.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Largest out-of-plane displacement at the wall's top under the full load since gravity (m); `None` unless in equilibrium.
    pub top_displacement_m: Option<f64>,
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

/// One load step of a member.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct StepRow {
    /// Load factor: 0 under gravity alone, 1 at the full load.
    pub load_factor: f64,
    /// Largest out-of-plane displacement at the top since the end of gravity (m); `None` when it is not finite.
    pub top_displacement_m: Option<f64>,
    /// Unbalanced force ratio reached; `None` when it is not finite.
    pub unbalanced_ratio: Option<f64>,
    /// Time steps taken.
    pub solver_steps: u64,
}
