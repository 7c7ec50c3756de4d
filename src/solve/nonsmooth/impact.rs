//! Steps divided at an impact.
//!
//! Velocities are those of the middles of steps. Loads that speed a stone up before an impact may slow it down after it, as gravity does a stone
//! that rocks: where an impact is taken anywhere in a step, they act the wrong way for part of it, and the impact takes off too much, in
//! proportion to the step. A step of length `h` in which something hits after `s` is divided:
//!
//! ```text
//! loads for what is owed and s/2, old contacts; bodies move for s      velocities of the middle of s
//! loads for s/2, old contacts                                          velocities just before the impact
//! no loads, all contacts                                               just after it
//! loads for (h - s)/2, all contacts; bodies move for h - s             the step that comes is owed (h - s)/2
//! ```
//!
//! So that walls in which something hits in every step take little longer, one step in [`APART`] is divided on average, once, at its first impact;
//! and none of which a part is not solved. Walls that come to rest under a load take steps that are not divided.

use crate::solve::bodies::Body;
use crate::solve::nonsmooth::part::{Part, Solved};
use crate::solve::nonsmooth::point::{Bearing, Point};
use crate::solve::nonsmooth::{Normal, Simulation, StepSolver, Stepped};

/// A point hits where it closes faster than what gravity gives in this share of a step. What is slower has come to rest, as far as steps tell.
const HARD: f64 = 1e-2;
/// Points that hit within this share of the step hit at once, and parts of a step are not shorter.
const LEAST: f64 = 1e-2;
/// One step in so many is divided on average, and so many in a row.
const APART: u32 = 16;
const IN_A_ROW: u32 = 4;

/// How many steps may be divided.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowance(u32);

impl Allowance {
    pub fn full() -> Allowance {
        Allowance(IN_A_ROW * APART)
    }

    /// After a step.
    pub fn grow(&mut self) {
        self.0 = (self.0 + 1).min(IN_A_ROW * APART);
    }
}

impl Simulation<'_> {
    /// Takes a step, of which the solution as a whole is given, in parts; `None`, and nothing taken, where it is not to be divided.
    pub(super) fn divided(&mut self, whole: &Solved) -> Option<Stepped> {
        if self.settings.normal != Normal::Gap || self.allowance.0 < APART {
            return None;
        }
        let before: Vec<f64> = self.assembly.bodies.all.iter().flat_map(Body::twist).collect();
        let least = HARD * self.assembly.gravity.norm() * whole.part.step;
        let points = whole.problem.points.iter().zip(&whole.impulses).enumerate();
        let hitting: Vec<usize> = points
            .filter(|(_, (point, impulse))| hits(point, impulse, &before, least))
            .map(|(k, _)| k)
            .collect();
        if hitting.is_empty() {
            return None;
        }
        self.allowance.0 -= APART;
        let bodies = self.assembly.bodies.all.clone();
        let divided = self.divided_at(whole, &before, &hitting);
        if divided.is_none() {
            self.assembly.bodies.all = bodies;
        }
        divided
    }

    /// The same where these points hit, at velocities before. `None`, with bodies on their way, where one of the parts is not solved.
    fn divided_at(&mut self, whole: &Solved, before: &[f64], hitting: &[usize]) -> Option<Stepped> {
        let step = whole.part.step;
        // Where nothing is in their way, when do they touch?
        let missed = self.part(whole.part, hitting, f64::INFINITY)?;
        let times: Vec<f64> = hitting.iter().map(|&k| closes_after(&missed, before, k)).collect();
        let first = times.iter().copied().fold(f64::INFINITY, f64::min);
        if first > step {
            return None;
        }
        let is_struck = |(_, time): &(&usize, &f64)| **time <= first + LEAST * step;
        let struck: Vec<usize> = hitting.iter().zip(&times).filter(is_struck).map(|(k, _)| *k).collect();
        let at = if first < LEAST * step { 0.0 } else { first.min((1.0 - LEAST) * step) };
        let (owed, left) = (whole.part.loads - 0.5 * step, step - at);
        let mut parts = vec![(owed + 0.5 * at, at, hitting, f64::INFINITY)];
        if at > 0.0 {
            parts.push((0.5 * at, 0.0, hitting, f64::INFINITY));
        }
        parts.push((0.0, 0.0, &struck, 0.0));
        parts.push((0.5 * left, left, &[], 0.0));
        let mut sum = Stepped {
            is_solved: true,
            iterations: whole.iterations + missed.iterations,
            ..Stepped::default()
        };
        let mut taken = Vec::new();
        for (loads, moves, points, closing) in parts {
            let part = self.part(Part { loads, moves, step }, points, closing)?;
            let energy_gain = self.advance(&part);
            sum.add(&part.told(energy_gain, self.settings.tolerance));
            taken.push(part);
        }
        taken.iter().for_each(|part| self.remember(part));
        self.owed = Some(0.5 * left);
        sum.speed = self.assembly.bodies.fastest();
        Some(sum)
    }

    /// Solves a part of a step, in which some points may close at another speed (m/s) than their gaps say. `None` where Newton's method, if it is in
    /// use, does not: what the others take would be too long.
    fn part(&mut self, part: Part, points: &[usize], closing: f64) -> Option<Solved> {
        let mut problem = self.posed(part);
        points.iter().for_each(|&k| problem.points[k].bearing = Bearing::Rigid { offset: closing });
        let found = match self.settings.solver {
            StepSolver::Newton => self.by_newton(&problem)?,
            StepSolver::ConeProgram | StepSolver::Sweeps => self.solve(&problem),
        };
        let is_solved = found.1.natural_map <= self.settings.tolerance;
        is_solved.then(|| Solved::of(part, problem, found))
    }
}

/// Whether a point bears that closed faster than at a speed (m/s).
fn hits(point: &Point, impulse: &[f64; 3], before: &[f64], least: f64) -> bool {
    point.least == 0.0 && impulse[0] > 0.0 && point.relative_velocity(before)[0] < -least
}

/// After what time (s) a point touches that is not in the way, under loads that act as long as bodies have moved.
fn closes_after(missed: &Solved, before: &[f64], k: usize) -> f64 {
    let (point, part) = (&missed.problem.points[k], &missed.part);
    let gap = point.gap.max(0.0);
    let [from, to] = [before, &missed.v].map(|v| point.relative_velocity(v)[0]);
    let acceleration = (to - from) / part.loads;
    let now = from + acceleration * (part.loads - 0.5 * part.step);
    // gap + now t + acceleration t^2 / 2 = 0
    let root = (now * now - 2.0 * acceleration * gap).sqrt();
    let time = 2.0 * gap / (root - now);
    if time >= 0.0 { time } else { f64::INFINITY }
}

impl Stepped {
    /// Adds a part of a step.
    fn add(&mut self, part: &Stepped) {
        if part.residual.natural_map >= self.residual.natural_map {
            self.residual = part.residual;
        }
        self.iterations += part.iterations;
        self.is_solved &= part.is_solved;
        self.energy_gain += part.energy_gain;
        self.friction_work += part.friction_work;
    }
}
