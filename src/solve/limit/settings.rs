//! Settings of limit analysis.

/// How the friction cone of a contact is represented.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cone {
    /// The cone itself (second-order cone programming).
    SecondOrder,
    /// The inscribed pyramid with this even number of sides, at least 4, its first edge along the load (linear
    /// programming): on the safe side of the cone by at most `1 - cos(pi / sides)` of the friction.
    Linearised {
        /// Number of sides.
        sides: u32,
    },
}

/// How joints dilate when they slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Flow {
    /// Sliding dilates by the friction angle: the multiplier is an upper bound on any real capacity.
    Associative,
    /// Sliding does not dilate: a fixed point of associative problems, neither a bound nor unique.
    NonAssociative,
}

impl Flow {
    /// Its name in files.
    pub fn name(&self) -> &'static str {
        match self {
            Flow::Associative => "associative",
            Flow::NonAssociative => "non-associative",
        }
    }

    /// What a multiplier found with this flow is, in words.
    pub fn meaning(&self) -> &'static str {
        match self {
            Flow::Associative => "upper bound on the capacity with Coulomb joints",
            Flow::NonAssociative => "state without dilatancy: neither a bound nor unique",
        }
    }
}

/// Settings of limit analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The friction cone (default: the cone itself).
    pub cone: Cone,
    /// The flow rule (default: associative).
    pub flow: Flow,
    /// A wall that bears this multiplier is said to stand to the end (default 10).
    pub largest_multiplier: f64,
    /// A wall that stands at this tilt (rad, below 90 degrees) is said to stand to the end (default 89 degrees).
    pub largest_tilt: f64,
    /// Relative accuracy asked of the solver (default 1e-10): of gap, equilibrium and compatibility.
    pub tolerance: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            cone: Cone::SecondOrder,
            flow: Flow::Associative,
            largest_multiplier: 10.0,
            largest_tilt: crate::math::radians(89.0),
            tolerance: 1e-10,
        }
    }
}
