//! Normal laws: compressive stress of a joint as a function of its closure.

/// The normal law of a joint. Closure `u` (m) is positive where the faces overlap.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "law", rename_all = "snake_case")]
pub enum NormalLaw {
    /// `sigma = kn u` (source paper Eq. 2), the law of 3DEC's and YADE's joints.
    Linear {
        /// Normal stiffness per joint area (Pa/m).
        kn: f64,
    },
}

impl NormalLaw {
    /// Compressive stress (Pa) at closure `u` (m); the extension of the law to negative `u` is its tension branch.
    pub fn stress(&self, u: f64) -> f64 {
        match self {
            NormalLaw::Linear { kn } => kn * u,
        }
    }

    /// Slope of the law (Pa/m) at closure `u` (m).
    pub fn stiffness(&self, _u: f64) -> f64 {
        match self {
            NormalLaw::Linear { kn } => *kn,
        }
    }

    /// The largest slope that the law can show (Pa/m), for the critical time step.
    pub fn largest_stiffness(&self) -> f64 {
        match self {
            NormalLaw::Linear { kn } => *kn,
        }
    }

    /// Stored energy per area (J/m^2) at closure `u` (m).
    pub fn energy(&self, u: f64) -> f64 {
        match self {
            NormalLaw::Linear { kn } => 0.5 * kn * u * u,
        }
    }
}
