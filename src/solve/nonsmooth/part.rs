//! A step or a part of one, and what it comes to.

use crate::solve::nonsmooth::point::Point;
use crate::solve::nonsmooth::{Problem, Residual, Stepped};

/// A step or a part of one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// For how long (s) loads act.
    pub loads: f64,
    /// For how long (s) bodies then move.
    pub moves: f64,
    /// The whole step (s).
    pub step: f64,
}

/// The impulses (N s) of a problem's points, what is left over, and iterations.
pub(super) type Found = (Vec<[f64; 3]>, Residual, u32);

/// What a step or a part of it comes to, before it is taken.
pub(super) struct Solved {
    pub part: Part,
    pub problem: Problem,
    pub impulses: Vec<[f64; 3]>,
    pub v: Vec<f64>,
    pub residual: Residual,
    pub iterations: u32,
}

impl Solved {
    pub fn of(part: Part, problem: Problem, found: Found) -> Solved {
        let (impulses, residual, iterations) = found;
        let v = problem.velocities(&impulses);
        Solved { part, problem, impulses, v, residual, iterations }
    }

    /// What it came to, with how much energy grew by (J) as the bodies took it.
    pub fn told(&self, energy_gain: f64, tolerance: f64) -> Stepped {
        Stepped {
            residual: self.residual,
            iterations: self.iterations,
            is_solved: self.residual.natural_map <= tolerance,
            energy_gain,
            friction_work: friction_work(&self.problem, &self.v, &self.impulses),
            ..Stepped::default()
        }
    }
}

impl Part {
    /// For how long (s) joints bear what they can: in an impact, which lasts no time, as long as in the whole step.
    pub fn bears(&self) -> f64 {
        if self.loads > 0.0 { self.loads } else { self.step }
    }

    /// In what time (s) gaps may close: where bodies do not move, in that of the whole step.
    pub fn closes(&self) -> f64 {
        if self.moves > 0.0 { self.moves } else { self.step }
    }
}

/// What joints take that slide (J).
fn friction_work(problem: &Problem, v: &[f64], impulses: &[[f64; 3]]) -> f64 {
    let of = |(point, impulse): (&Point, &[f64; 3])| {
        let u = point.relative_velocity(v);
        -(u[1] * impulse[1] + u[2] * impulse[2])
    };
    problem.points.iter().zip(impulses).map(of).sum()
}
