//! How a computation ended, as a value.

/// How the evaluation of a wall ended. Four different things are never one: it stands, it fell, the solver did not
/// get there, and the numbers went bad; and a wall that could not be built is none of these.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "outcome", rename_all = "snake_case")]
pub enum Outcome {
    /// The unbalanced force ratio fell below its limit at every load step.
    Equilibrium,
    /// The wall moved past the collapse criterion.
    Collapsed {
        /// Load factor of the step in which it happened (1 = full load; 0 = under its own weight).
        load_factor: f64,
    },
    /// The step budget ran out with the wall neither at rest nor past the collapse criterion.
    NotConverged {
        /// Load factor of the step in which it happened.
        load_factor: f64,
        /// Unbalanced force ratio reached.
        unbalanced_ratio: f64,
    },
    /// A position or force became NaN or infinite.
    NonFinite {
        /// Load factor of the step in which it happened.
        load_factor: f64,
    },
    /// The generator could not build a valid wall within its attempts.
    InvalidGeometry {
        /// Why, in words.
        reason: String,
    },
}

impl Outcome {
    /// The name used in tables, JSON and Parquet.
    pub fn name(&self) -> &'static str {
        match self {
            Outcome::Equilibrium => "equilibrium",
            Outcome::Collapsed { .. } => "collapsed",
            Outcome::NotConverged { .. } => "not_converged",
            Outcome::NonFinite { .. } => "non_finite",
            Outcome::InvalidGeometry { .. } => "invalid_geometry",
        }
    }

    /// The reason in words, empty for an equilibrium.
    pub fn reason(&self) -> String {
        match self {
            Outcome::Equilibrium => String::new(),
            Outcome::Collapsed { load_factor } => {
                format!("moved past the collapse criterion at load factor {load_factor}")
            }
            Outcome::NotConverged { load_factor, unbalanced_ratio } => {
                format!(
                    "unbalanced force ratio {unbalanced_ratio:.1e} when the steps ran out at load factor {load_factor}"
                )
            }
            Outcome::NonFinite { load_factor } => {
                format!("a position or force became non-finite at load factor {load_factor}")
            }
            Outcome::InvalidGeometry { reason } => reason.clone(),
        }
    }
}
