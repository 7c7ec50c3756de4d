//! The protocols and their settings, as a study states them.

/// How the ends of the wall (x = 0 and x = length) are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ends {
    /// Free.
    Free,
    /// Fixed end blocks against which the wall stands with ordinary joints (no tension, Coulomb friction).
    FixedEndBlocks,
    /// The end stones cannot move out of plane.
    OutOfPlane,
    /// Joint springs (kn, ks) to fixed end blocks, which neither open nor slip.
    JointSprings,
}

/// Gravity, then a trapezoidal pressure on the back face (-y) towards +y, in equal steps.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Lateral {
    /// Mean horizontal pressure over the height (Pa of vertical projection).
    pub mean_pressure: f64,
    /// Pressure at the base over pressure at the top; 2 gives 4/3 and 2/3 of the mean.
    pub base_over_top: f64,
    /// Number of equal load steps after gravity, at least 1.
    pub steps: u32,
    /// The wall counts as collapsed when its top has moved out of plane by this share of its base thickness.
    pub collapse_share: f64,
}

/// What is done to each wall of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Protocol {
    /// Service load on the back face: the source paper's section 4.1.
    Lateral(Lateral),
}
