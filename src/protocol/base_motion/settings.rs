//! How a wall is shaken, and when a stone has fallen.

use crate::motion::Motion;
use crate::protocol::{Direction, EventShares};
use crate::solve::explicit::{self, Rayleigh};
use crate::solve::{Solver, nonsmooth};

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
    /// A stone has fallen when its centroid has moved by so many thicknesses of the wall; default 0.75.
    pub fallen_moved: f64,
    /// Or when it has gone down by so many of its own heights; default 0.5.
    pub fallen_down: f64,
    /// Which shares of the weight are looked at. The test ends when most has fallen.
    pub shares: EventShares,
    /// The solver.
    pub solver: InTime,
}

impl Shaking {
    /// With the defaults, by a solver.
    pub fn new(motion: Motion, solver: InTime) -> Shaking {
        Shaking {
            motion,
            after: 5.0,
            fallen_moved: 0.75,
            fallen_down: 0.5,
            shares: EventShares::default(),
            solver,
        }
    }
}

/// What all motions that a wall of a study meets have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseMotion {
    /// Where the y axis of a record points in plan, or its only component; default y+, out of plane.
    pub towards: Direction,
    /// See [`Shaking::after`].
    pub after: f64,
    /// See [`Shaking::fallen_moved`].
    pub fallen_moved: f64,
    /// See [`Shaking::fallen_down`].
    pub fallen_down: f64,
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
    pub fn shaking(&self, motion: Motion, solver: InTime) -> Shaking {
        let BaseMotion { after, fallen_moved, fallen_down, shares, .. } = *self;
        Shaking { motion, after, fallen_moved, fallen_down, shares, solver }
    }
}
