//! How a computation ended, as a value.

use std::fmt;

use crate::math::degrees;

/// How far along its load path a wall was.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// Share of the full load; 0 = under its own weight.
    Factor(f64),
    /// Tilt of the table (rad).
    Tilt(f64),
    /// Horizontal load over weight, the multiplier of limit analysis.
    Multiplier(f64),
    /// Horizontal displacement of a beam on the wall's top over its height, along the wall.
    Drift(f64),
    /// Share of the way that supports go down before the load grows.
    Settlement(f64),
    /// Peak ground acceleration (m/s^2).
    Acceleration(f64),
    /// Peak ground velocity (m/s).
    Velocity(f64),
    /// Time since the ground began to move (s).
    Time(f64),
    /// Height of fill or water above the foot of the back that holds it (m).
    Height(f64),
}

impl Level {
    /// The number alone, in SI units.
    pub fn value(&self) -> f64 {
        match *self {
            Level::Factor(x)
            | Level::Tilt(x)
            | Level::Multiplier(x)
            | Level::Drift(x)
            | Level::Settlement(x)
            | Level::Acceleration(x)
            | Level::Velocity(x)
            | Level::Time(x)
            | Level::Height(x) => x,
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Level::Factor(x) => write!(f, "load factor {}", shown(*x)),
            Level::Tilt(x) => write!(f, "a tilt of {:.4} deg", degrees(*x)),
            Level::Multiplier(x) => write!(f, "a load multiplier of {x:.6}"),
            Level::Drift(x) => write!(f, "a drift of {:.4} %", 100.0 * x),
            Level::Settlement(x) => write!(f, "{:.2} % of the settlement of its supports", 100.0 * x),
            Level::Acceleration(x) => write!(f, "a peak ground acceleration of {} m/s2", shown(*x)),
            Level::Velocity(x) => write!(f, "a peak ground velocity of {} m/s", shown(*x)),
            Level::Time(x) => write!(f, "{x:.2} s"),
            Level::Height(x) => write!(f, "a height of {x:.4} m behind it"),
        }
    }
}

/// To a millionth: no last bits of a sum of steps.
fn shown(x: f64) -> f64 {
    (1e6 * x).round() / 1e6
}

/// How the evaluation of a wall ended. Different things are never one: it stands to the end, it fell, it never stood,
/// nothing can bring it down, the solver did not get there, the numbers went bad; and a wall that could not be built
/// is none of these.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "outcome", rename_all = "snake_case")]
pub enum Outcome {
    /// At rest at every load step, to the end of the load path.
    #[default]
    Equilibrium,
    /// The wall fell, and this is the load at which it did.
    Collapsed {
        /// The last load it is known to have borne, or for limit analysis the load it can bear.
        at: Level,
    },
    /// The wall does not even stand under its own weight.
    UnstableAtRest,
    /// No load of this kind, however large, brings the wall down (limit analysis).
    Unbounded,
    /// The solver found neither a rest state nor a collapse.
    NotConverged {
        /// The load at which it happened.
        at: Level,
        /// Unbalanced force ratio reached. Its name in files is not that of a row, which an outcome is part of.
        #[serde(rename = "unbalanced_ratio_there")]
        unbalanced_ratio: f64,
        /// Where and why, in words.
        why: String,
    },
    /// A position or force became NaN or infinite.
    NonFinite {
        /// The load at which it happened.
        at: Level,
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
            Outcome::UnstableAtRest => "unstable_at_rest",
            Outcome::Unbounded => "unbounded",
            Outcome::NotConverged { .. } => "not_converged",
            Outcome::NonFinite { .. } => "non_finite",
            Outcome::InvalidGeometry { .. } => "invalid_geometry",
        }
    }

    /// The reason in words, empty for an equilibrium.
    pub fn reason(&self) -> String {
        match self {
            Outcome::Equilibrium => String::new(),
            Outcome::Collapsed { at } => format!("fell at {at}"),
            Outcome::UnstableAtRest => "does not stand under its own weight".to_string(),
            Outcome::Unbounded => "no load of this kind brings it down".to_string(),
            Outcome::NotConverged { at, unbalanced_ratio, why } => {
                format!("unbalanced force ratio {unbalanced_ratio:.1e} at {at}: {why}")
            }
            Outcome::NonFinite { at } => format!("a position or force became non-finite at {at}"),
            Outcome::InvalidGeometry { reason } => reason.clone(),
        }
    }
}
