//! How a wall is shaken.

use crate::math::{Vec3, cos, sin};
use crate::motion::Motion;
use crate::protocol::{Direction, EventShares};
use crate::solve::explicit::{self, Rayleigh};
use crate::solve::{STANDARD_GRAVITY, Solver, nonsmooth};

/// A solver that follows motion in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InTime {
    /// Central differences with elastic joints and Rayleigh damping. Local damping and scaled inertia of the settings serve the way to rest
    /// alone.
    Explicit(explicit::Settings, Rayleigh),
    /// Contact dynamics; joints take energy by impact and friction.
    Nonsmooth(nonsmooth::Settings),
}

/// A test on a shaking table.
#[derive(Clone, Debug)]
pub struct Shaking {
    /// Motion of the base. Axes: x along the wall, y out of plane, z up.
    pub motion: Motion,
    /// How long (s) the wall is followed after the motion has ended, if it does not come to rest before; default 5.
    pub after: f64,
    /// Which shares of the weight are looked at. The test ends when most has fallen for good.
    pub shares: EventShares,
}

impl Shaking {
    /// With the defaults.
    pub fn new(motion: Motion) -> Shaking {
        Shaking { motion, after: 5.0, shares: EventShares::default() }
    }
}

/// A ground that leans: a plane that goes down towards a side, and the wall with it. Records stay level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lean {
    /// The side that is lower.
    pub towards: Direction,
    /// By how much (rad).
    pub angle: f64,
}

impl Lean {
    /// A level ground.
    pub const NONE: Lean = Lean { towards: Direction::YPlus, angle: 0.0 };

    /// A vector in the axes of the wall, whose z is normal to the ground, of one in axes of which z is the vertical and the others are level.
    pub fn seen(&self, level: &Vec3) -> Vec3 {
        let (towards, (s, c)) = (self.towards.unit(), (sin(self.angle), cos(self.angle)));
        let forward = level.dot(&towards);
        level
            + towards * ((c - 1.0) * forward - s * level.z)
            + Vec3::z() * (s * forward + (c - 1.0) * level.z)
    }

    /// Gravity (m/s^2) in the axes of the wall.
    pub fn gravity(&self) -> Vec3 {
        self.seen(&(-Vec3::z() * STANDARD_GRAVITY))
    }
}

/// What all motions that a wall of a study meets have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseMotion {
    /// Where the y axis of a record points in plan, or its only component; default y+, out of plane.
    pub towards: Direction,
    /// See [`Shaking::after`].
    pub after: f64,
    /// Which shares of the weight are looked at, and the fall of which of them is a collapse.
    pub shares: EventShares,
    /// Damping, where the solver is the explicit one.
    pub rayleigh: Rayleigh,
    /// Whether each run is done once more from a start that differs by next to nothing, see [`shake_twice`](crate::protocol::shake_twice).
    pub twice: bool,
}

impl BaseMotion {
    /// The solver of a study in time; `None` of those that know none.
    pub fn in_time(&self, solver: &Solver) -> Option<InTime> {
        match solver {
            Solver::Explicit(settings) => Some(InTime::Explicit(*settings, self.rayleigh)),
            Solver::Nonsmooth(settings) => Some(InTime::Nonsmooth(*settings)),
            Solver::Implicit(_) | Solver::Limit(_) => None,
        }
    }

    /// One of the motions.
    pub fn shaking(&self, motion: Motion) -> Shaking {
        Shaking { motion, after: self.after, shares: self.shares }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::radians;

    #[test]
    fn a_lean_turns_gravity_and_what_is_level() {
        let lean = Lean { towards: Direction::XPlus, angle: radians(30.0) };
        let gravity = lean.gravity() / STANDARD_GRAVITY;
        assert!((gravity - Vec3::new(0.5, 0.0, -0.75_f64.sqrt())).norm() < 1e-15, "{gravity}");
        // What is level stays across gravity, and what is level and across the lean stays as it is.
        let forward = lean.seen(&Vec3::x());
        assert!((forward - Vec3::new(0.75_f64.sqrt(), 0.0, 0.5)).norm() < 1e-15, "{forward}");
        assert!(forward.dot(&gravity).abs() < 1e-15);
        assert_eq!((lean.seen(&Vec3::y()), Lean::NONE.seen(&Vec3::x())), (Vec3::y(), Vec3::x()));
    }
}
