//! Load paths: from the place on a path to gravity and the factor on the dead loads.

use crate::math::{Vec3, cos, sin};
use crate::model::Level;
use crate::protocol::Direction;
use crate::solve::STANDARD_GRAVITY;

/// What grows along a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growing {
    /// The factor on the dead loads.
    Factor,
    /// The tilt of the platform, whose axes the wall's are: gravity turns towards a side.
    Tilt(Direction),
    /// A body force of so many times the weight.
    Multiplier {
        /// The side that it pushes towards.
        towards: Direction,
        /// So many times the horizontal force acts upwards besides; downwards where below 0.
        vertical: f64,
    },
    /// How far a jack goes along the wall, over its height.
    Drift,
}

/// A load path: a level that grows from 0 to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadPath {
    /// What grows.
    pub growing: Growing,
    /// The level at the end (1 for a factor, rad for a tilt).
    pub end: f64,
    /// Number of full steps to the end; need not be whole, the last step is then shorter.
    pub steps: f64,
    /// The level of collapse is bracketed to this; infinite where a failed step is the end of it.
    pub bracket: f64,
    /// Whether the load is let back to level 0 after every full step, see
    /// [`LoadStep::remainders`](crate::protocol::LoadStep::remainders).
    pub goes_back: bool,
}

impl LoadPath {
    /// The dead loads in `steps` equal steps.
    pub fn factor(steps: u32) -> LoadPath {
        LoadPath {
            growing: Growing::Factor,
            end: 1.0,
            steps: f64::from(steps.max(1)),
            bracket: f64::INFINITY,
            goes_back: false,
        }
    }

    /// A platform that tilts; angles in radians.
    pub fn tilt(towards: Direction, step: f64, end: f64, bracket: f64) -> LoadPath {
        LoadPath { growing: Growing::Tilt(towards), end, steps: end / step, bracket, goes_back: false }
    }

    /// A horizontal force of so many times the weight.
    pub fn multiplier(towards: Direction, step: f64, end: f64, bracket: f64) -> LoadPath {
        let growing = Growing::Multiplier { towards, vertical: 0.0 };
        LoadPath { growing, end, steps: end / step, bracket, goes_back: false }
    }

    /// The same with a vertical share: a multiplier `x` pushes with `x` times the weight sideways and `vertical x` times the
    /// weight upwards, as the two parts of an earthquake do at their worst. Other paths stay as they are.
    pub fn with_vertical(self, vertical: f64) -> LoadPath {
        match self.growing {
            Growing::Multiplier { towards, .. } => {
                LoadPath { growing: Growing::Multiplier { towards, vertical }, ..self }
            }
            Growing::Factor | Growing::Tilt(_) | Growing::Drift => self,
        }
    }

    /// A jack that pushes along the wall; drifts are shares of its height.
    pub fn drift(step: f64, end: f64) -> LoadPath {
        LoadPath { growing: Growing::Drift, end, steps: end / step, bracket: f64::INFINITY, goes_back: false }
    }

    /// The number of the level after so many full steps (a fraction of a step counts as that).
    pub fn after(&self, steps: f64) -> f64 {
        (steps / self.steps * self.end).min(self.end)
    }

    /// The level so many full steps above another one, at most the end.
    pub fn higher(&self, level: f64, steps: u32) -> f64 {
        (level + f64::from(steps) / self.steps * self.end).min(self.end)
    }

    /// A level as a value.
    pub fn level(&self, x: f64) -> Level {
        match self.growing {
            Growing::Factor => Level::Factor(x),
            Growing::Tilt(_) => Level::Tilt(x),
            Growing::Multiplier { .. } => Level::Multiplier(x),
            Growing::Drift => Level::Drift(x),
        }
    }

    /// Gravity (m/s^2) and the factor on the dead loads and on the way of jacks.
    pub fn loads(&self, x: f64) -> (Vec3, f64) {
        let g = STANDARD_GRAVITY;
        match self.growing {
            Growing::Factor | Growing::Drift => (Vec3::new(0.0, 0.0, -g), x),
            Growing::Tilt(towards) => (towards.unit() * (g * sin(x)) - Vec3::z() * (g * cos(x)), 1.0),
            Growing::Multiplier { towards, vertical } => {
                (towards.unit() * (g * x) - Vec3::z() * (g - g * vertical * x), 1.0)
            }
        }
    }

    /// Where the load pushes.
    pub fn direction(&self) -> Direction {
        match self.growing {
            Growing::Factor => Direction::YPlus,
            Growing::Drift => Direction::XPlus,
            Growing::Tilt(towards) | Growing::Multiplier { towards, .. } => towards,
        }
    }
}
