//! The problem of a step as a fixed point of cone programs (Acary, Cadoux, Lemaréchal and Malick 2011), each solved by clarabel.
//!
//! For given `s = tan(phi) |u_T|` the velocities minimise a convex function, and the impulses are the dual variables:
//!
//! ```text
//! min 1/2 (v - free) M (v - free) + c . t    such that    u_N + offset + s >= tan(phi) t,    t >= |u_T|
//! ```
//!
//! One point that slides comes closer by `tan^2 / (1 + tan^2)` each time. With `s = 0` once and for all sliding dilates.

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, SecondOrderConeT, ZeroConeT};
use clarabel::solver::{DefaultSolver, IPSolver, SupportedConeT};

use crate::solve::STANDARD_GRAVITY;
use crate::solve::conic::{Entries, settings};
use crate::solve::nonsmooth::point::Point;
use crate::solve::nonsmooth::problem::wrench;
use crate::solve::nonsmooth::{Friction, Problem, Residual};
use crate::solve::system::DOF;

/// Relative accuracy asked of the solver.
const ACCURACY: f64 = 1e-11;
/// A fixed point whose residual grows by more than this factor takes half the step from then on, else twice as much up to a whole one; it ends
/// when so many steps have come no closer.
const AWAY: f64 = 1.5;
const DAMPED: f64 = 0.5;
const IDLE: u32 = 25;

/// Impulses, what is left over, and the cone programs solved. Points must be rigid.
pub(super) fn cone_program(
    problem: &Problem,
    friction: Friction,
    tolerance: f64,
    max_iterations: u32,
) -> (Vec<[f64; 3]>, Residual, u32) {
    let program = Program::of(problem);
    // From the convex problem: a start from what another method failed at leads to other states, or to none.
    let mut s = vec![0.0; problem.points.len()];
    let mut best: Option<(Vec<[f64; 3]>, Residual)> = None;
    let (mut damping, mut before, mut idle) = (1.0f64, f64::INFINITY, 0);
    for iteration in 1..=max_iterations {
        let impulses = program.solve(problem, &s);
        let v = problem.velocities(&impulses);
        let residual = Residual::of(problem, friction, &v, &impulses);
        let improves = best.as_ref().is_none_or(|(_, best)| residual.natural_map < best.natural_map);
        damping =
            if residual.natural_map < AWAY * before { (damping / DAMPED).min(1.0) } else { damping * DAMPED };
        before = residual.natural_map;
        idle = if improves { 0 } else { idle + 1 };
        if improves {
            best = Some((impulses, residual));
        }
        let (_, reached) = best.as_ref().expect("the first one is the best so far");
        if reached.natural_map <= tolerance || friction == Friction::Dilating || idle >= IDLE {
            let (impulses, residual) = best.expect("as above");
            return (impulses, residual, iteration);
        }
        for (s, point) in s.iter_mut().zip(&problem.points) {
            *s += damping * (point.opens(&v) - *s);
        }
    }
    let (impulses, residual) = best.unwrap_or_else(|| {
        let none = vec![[0.0; 3]; problem.points.len()];
        let residual = Residual::of(problem, friction, &problem.free, &none);
        (none, residual)
    });
    (impulses, residual, max_iterations)
}

/// What all cone programs of a step share.
struct Program {
    quadratic: CscMatrix<f64>,
    linear: Vec<f64>,
    constraints: CscMatrix<f64>,
    right: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
    /// First row of each point that can touch: three for one that holds whatever acts, else that of the normal and those of the cone.
    rows: Vec<Option<Rows>>,
    /// Unit of impulses (N s).
    unit: f64,
    velocity: f64,
}

#[derive(Clone, Copy)]
enum Rows {
    Held(usize),
    Touches { normal: usize, cone: usize },
}

impl Program {
    fn of(problem: &Problem) -> Program {
        // What falls freely over the step, or the fastest of all.
        let fastest = problem.free.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let velocity = fastest.max(STANDARD_GRAVITY * problem.step);
        let unit = problem.mean_mass * velocity;
        let mut width = 0;
        // The column of each component of each velocity.
        let columns: Vec<Option<usize>> = (0..problem.free.len())
            .map(|k| {
                let is_free = !problem.inertias[k / DOF].held.contains(&(k % DOF));
                width += usize::from(is_free);
                is_free.then(|| width - 1)
            })
            .collect();
        let velocities = width;
        let touches = |point: &Point| point.offset().is_some_and(f64::is_finite);
        let slides: Vec<usize> =
            problem.points.iter().map(|point| usize::from(touches(point) && !point.is_bonded())).collect();
        let width = velocities + slides.iter().sum::<usize>();
        let (mut quadratic, mut linear) = (Entries::default(), vec![0.0; width]);
        // What tension always bears acts as a load.
        let pulls: Vec<[f64; 3]> = problem
            .points
            .iter()
            .map(|point| if point.least.is_finite() { [point.least, 0.0, 0.0] } else { [0.0; 3] })
            .collect();
        let free = problem.velocities(&pulls);
        for (b, inertia) in problem.inertias.iter().enumerate() {
            let impulse = inertia.impulse(&free[DOF * b..DOF * b + DOF]);
            for (row, impulse) in impulse.iter().enumerate() {
                let Some(own) = columns[DOF * b + row] else { continue };
                linear[own] = -impulse / unit;
                for column in row..DOF {
                    if let Some(other) = columns[DOF * b + column] {
                        quadratic.add(own, other, inertia.matrix[row][column] / problem.mean_mass);
                    }
                }
            }
        }
        let (mut matrix, mut right, mut cones) = (Entries::default(), Vec::new(), Vec::new());
        let add = |matrix: &mut Entries, row: usize, point: &Point, axis: usize, factor: f64| {
            for (side, sign) in [(0, factor), (1, -factor)] {
                let entries = wrench(&point.arms[side], &point.axes[axis]);
                for (k, entry) in entries.into_iter().enumerate() {
                    if let Some(column) = columns[DOF * point.bodies[side] + k] {
                        matrix.add(row, column, entry * sign);
                    }
                }
            }
        };
        let mut rows = vec![None; problem.points.len()];
        for (at, point) in problem.points.iter().enumerate().filter(|(_, point)| point.is_bonded()) {
            rows[at] = Some(Rows::Held(right.len()));
            for axis in 0..3 {
                add(&mut matrix, right.len(), point, axis, -1.0);
                right.push(point.turns[axis] / velocity);
            }
        }
        cones.push(ZeroConeT(right.len()));
        let sliding = || problem.points.iter().enumerate().filter(|(at, _)| slides[*at] == 1);
        let held = right.len();
        for (k, (at, point)) in sliding().enumerate() {
            rows[at] = Some(Rows::Touches { normal: right.len(), cone: 0 });
            add(&mut matrix, right.len(), point, 0, -1.0);
            matrix.add(right.len(), velocities + k, point.friction);
            right.push(point.constant()[0] / velocity);
            linear[velocities + k] = point.limit(point.least) / unit;
        }
        cones.push(NonnegativeConeT(right.len() - held));
        for (k, (at, point)) in sliding().enumerate() {
            if let Some(Rows::Touches { cone, .. }) = &mut rows[at] {
                *cone = right.len();
            }
            matrix.add(right.len(), velocities + k, -1.0);
            right.push(0.0);
            for axis in 1..3 {
                add(&mut matrix, right.len(), point, axis, -1.0);
                right.push(point.turns[axis] / velocity);
            }
            cones.push(SecondOrderConeT(3));
        }
        let (quadratic, constraints) = (quadratic.matrix(width, width), matrix.matrix(right.len(), width));
        Program { quadratic, linear, constraints, right, cones, rows, unit, velocity }
    }

    /// The impulses for given `s` (m/s) of every point.
    fn solve(&self, problem: &Problem, s: &[f64]) -> Vec<[f64; 3]> {
        let mut right = self.right.clone();
        for (rows, s) in self.rows.iter().zip(s) {
            if let Some(Rows::Touches { normal, .. }) = rows {
                right[*normal] += s / self.velocity;
            }
        }
        let mut solver = DefaultSolver::new(
            &self.quadratic,
            &self.linear,
            &self.constraints,
            &right,
            &self.cones,
            settings(ACCURACY),
        )
        .expect("the program's dimensions agree");
        solver.solve();
        let z = &solver.solution.z;
        let of = |(rows, point): (&Option<Rows>, &Point)| match rows {
            None => [point.least, 0.0, 0.0],
            Some(Rows::Held(at)) => std::array::from_fn(|k| z[at + k] * self.unit),
            Some(Rows::Touches { normal, cone }) => {
                [point.least + z[*normal] * self.unit, z[cone + 1] * self.unit, z[cone + 2] * self.unit]
            }
        };
        self.rows.iter().zip(&problem.points).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::solve::nonsmooth::problem::fixture::column;

    #[test]
    fn the_fixed_point_of_one_point_that_slides_comes_closer_as_theory_says() {
        // u_(j+1) = (v0 - mu g h + mu^2 u_j) / (1 + mu^2) with v0 the velocity without friction.
        for (mu, ratio) in [(0.5, 0.2), (0.8, 0.390_244), (1.2, 0.590_164)] {
            let problem = column(1, mu, Vec3::new(20.0, 0.0, -9.81));
            let limit = (20.0 - mu * 9.81) * problem.step;
            let program = Program::of(&problem);
            let mut s = vec![0.0];
            let mut before: Option<f64> = None;
            for _ in 0..4 {
                let v = problem.velocities(&program.solve(&problem, &s));
                let apart = v[0] - limit;
                if let Some(before) = before {
                    // clarabel's own accuracy, 1e-11, over what is left, 3 % of the velocity.
                    assert!((apart / before - ratio).abs() < 1e-5, "{mu}: {}", apart / before);
                }
                before = Some(apart);
                s = vec![problem.points[0].opens(&v)];
            }
        }
    }
}
