//! The contact problem of a step as matrices, in the form in which collections of such problems keep it (Acary et al. 2014, FCLib):
//! `M v = H r + f`, `u = H^T v + w`, and at each point `-(u + mu |u_T| n)` in the normal cone of Coulomb's cone at `r`.

use crate::solve::nonsmooth::point::Point;
use crate::solve::nonsmooth::problem::wrench;
use crate::solve::nonsmooth::{Problem, Residual, Simulation};
use crate::solve::system::DOF;

/// A sparse matrix: value by row and column, each place once.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Triplets {
    /// Rows.
    pub rows: usize,
    /// Columns.
    pub columns: usize,
    /// Row, column, value.
    pub entries: Vec<(usize, usize, f64)>,
}

/// A contact problem of rigid dry joints over the velocities of all bodies that move, six each: linear (m/s), then angular (rad/s), along
/// the world's axes. Points have three components each: along the normal, in which `u` opens and `r` presses, and two in the plane.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct GlobalProblem {
    /// The bodies, by block id.
    pub bodies: Vec<usize>,
    /// Block ids of the two bodies of each point: the one that the impulse acts on, and the one that its reaction acts on.
    pub pairs: Vec<[usize; 2]>,
    /// Masses and moments of inertia (kg, kg m^2).
    pub mass: Triplets,
    /// From impulses at points to those on bodies (1, m).
    pub h: Triplets,
    /// `M v` without contact (N s, N m s).
    pub f: Vec<f64>,
    /// Added to the relative velocities (m/s): the gap over the step along the normal, and by how much points turn in half a step.
    pub w: Vec<f64>,
    /// tan of the friction angle, by point.
    pub mu: Vec<f64>,
    /// Gap at the start of the step (m), by point.
    pub gap: Vec<f64>,
    /// Length of the step (s).
    pub step: f64,
}

/// Velocities and impulses that solve the problem of a step.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Solution {
    /// Of the bodies (m/s, rad/s).
    pub v: Vec<f64>,
    /// Relative velocities with what `w` adds to them (m/s).
    pub u: Vec<f64>,
    /// Impulses (N s).
    pub r: Vec<f64>,
    /// What is left over.
    pub residual: Residual,
}

impl Simulation<'_> {
    /// The problem of a step of the settings' length from here, with its solution; the step is not taken. What a body cannot do has no
    /// entries in `H`. `None` where joints are not rigid, bear tension or have cohesion, which the form does not know.
    pub fn global_problem(&mut self) -> Option<(GlobalProblem, Solution)> {
        let problem = self.problem(self.time_step());
        let is_dry = |point: &Point| {
            point.offset().is_some_and(f64::is_finite) && point.cohesion == 0.0 && point.least == 0.0
        };
        if !problem.points.iter().all(is_dry) {
            return None;
        }
        let (impulses, residual, _) = self.solve(&problem);
        let global = GlobalProblem::of(&problem);
        let all = problem.velocities(&impulses);
        let v = global.bodies.iter().flat_map(|body| all[DOF * body..DOF * body + DOF].to_vec()).collect();
        let relative = |point: &Point| {
            let [n, a, b] = point.relative_velocity(&all);
            [n + point.offset().unwrap_or(0.0), a, b]
        };
        let u = problem.points.iter().flat_map(relative).collect();
        let r = impulses.into_iter().flatten().collect();
        Some((global, Solution { v, u, r, residual }))
    }
}

impl GlobalProblem {
    fn of(problem: &Problem) -> GlobalProblem {
        let moves = |body: &usize| problem.inertias[*body].held.len() < DOF;
        let bodies: Vec<usize> = (0..problem.inertias.len()).filter(moves).collect();
        let n = DOF * bodies.len();
        let (mut mass, mut f) = (Vec::new(), Vec::with_capacity(n));
        for (at, &body) in bodies.iter().enumerate() {
            let inertia = &problem.inertias[body];
            for (row, values) in inertia.matrix.iter().enumerate() {
                let own = values.iter().enumerate().filter(|(_, value)| **value != 0.0);
                mass.extend(own.map(|(column, value)| (DOF * at + row, DOF * at + column, *value)));
            }
            f.extend(inertia.impulse(&problem.free[DOF * body..DOF * body + DOF]));
        }
        let row_of = |body: usize| bodies.binary_search(&body).ok().map(|at| DOF * at);
        let mut h = Vec::new();
        for (at, point) in problem.points.iter().enumerate() {
            for ((body, arm), sign) in point.bodies.iter().zip(&point.arms).zip([1.0, -1.0]) {
                let Some(row) = row_of(*body) else { continue };
                for (k, axis) in point.axes.iter().enumerate() {
                    for (dof, value) in wrench(arm, axis).iter().enumerate() {
                        if *value != 0.0 && !problem.inertias[*body].held.contains(&dof) {
                            h.push((row + dof, 3 * at + k, sign * value));
                        }
                    }
                }
            }
        }
        let columns = 3 * problem.points.len();
        GlobalProblem {
            pairs: problem.points.iter().map(|point| point.bodies).collect(),
            mass: Triplets { rows: n, columns: n, entries: mass },
            h: Triplets { rows: n, columns, entries: h },
            f,
            w: problem.points.iter().flat_map(Point::constant).collect(),
            mu: problem.points.iter().map(|point| point.friction).collect(),
            gap: problem.points.iter().map(|point| point.gap).collect(),
            step: problem.step,
            bodies,
        }
    }
}
