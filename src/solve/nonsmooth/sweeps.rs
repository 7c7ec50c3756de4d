//! Non-linear Gauss-Seidel, the field's method (Jourdan, Alart and Jean 1998): contacts one after the other, each solved exactly while the
//! others stay, forwards and backwards in a fixed order.

use nalgebra::Matrix3;

use crate::math::Vec3;
use crate::solve::nonsmooth::point::Point;
use crate::solve::nonsmooth::problem::wrench;
use crate::solve::nonsmooth::{Friction, Problem, Residual};
use crate::solve::system::DOF;

/// Sweeps for each iteration that the other methods may take.
const SWEEPS: u32 = 1000;
/// Sweeps between two looks at the residual.
const BETWEEN: u32 = 10;
/// Halvings of the bracket of a local solution.
const HALVINGS: u32 = 200;

/// Impulses, what is left over, and sweeps.
pub(super) fn sweeps(
    problem: &Problem,
    start: &[[f64; 3]],
    tolerance: f64,
    max_iterations: u32,
) -> (Vec<[f64; 3]>, Residual, u32) {
    let mut impulses = start.to_vec();
    let mut v = problem.velocities(&impulses);
    let locals: Vec<Local> = problem.points.iter().map(|point| Local::of(problem, point)).collect();
    let mut residual = Residual::of(problem, Friction::Coulomb, &v, &impulses);
    let most = max_iterations.saturating_mul(SWEEPS);
    let mut swept = 0;
    while swept < most && residual.natural_map > tolerance {
        for k in 0..BETWEEN {
            sweep(problem, &locals, (&mut v, &mut impulses), k % 2 == 0);
        }
        swept += BETWEEN;
        v = problem.velocities(&impulses);
        residual = Residual::of(problem, Friction::Coulomb, &v, &impulses);
    }
    (impulses, residual, swept)
}

/// Every contact once, forwards or backwards.
fn sweep(problem: &Problem, locals: &[Local], (v, impulses): (&mut [f64], &mut [[f64; 3]]), forwards: bool) {
    for k in 0..problem.points.len() {
        let at = if forwards { k } else { problem.points.len() - 1 - k };
        let (point, local) = (&problem.points[at], &locals[at]);
        let u = Vec3::from(point.relative_velocity(v));
        let from = Vec3::from(impulses[at]);
        let now = local.solve(point, &(u - local.delassus * from));
        let change: [f64; 3] = (now - from).into();
        if change != [0.0; 3] {
            local.add(point, &change, v);
            impulses[at] = now.into();
        }
    }
}

/// What a point's impulse does to its own velocity, and to those of its bodies.
struct Local {
    delassus: Matrix3<f64>,
    /// Velocities of the two bodies for a unit impulse along each axis.
    given: [[[f64; DOF]; 3]; 2],
}

impl Local {
    fn of(problem: &Problem, point: &Point) -> Local {
        let given = std::array::from_fn(|side| {
            std::array::from_fn(|k| {
                let sign = if side == 0 { 1.0 } else { -1.0 };
                let impulse = wrench(&point.arms[side], &point.axes[k]).map(|x| x * sign);
                problem.inertias[point.bodies[side]].velocity(&impulse)
            })
        });
        let mut delassus = Matrix3::zeros();
        for column in 0..3 {
            let u = point.between(&given[0][column], &given[1][column]);
            (0..3).for_each(|row| delassus[(row, column)] = u[row]);
            // A direction in which neither body can move bears nothing.
            if delassus[(column, column)] == 0.0 {
                delassus[(column, column)] = 1.0 / point.inertia;
            }
        }
        Local { delassus, given }
    }

    /// Adds what a change of the impulse does to the velocities.
    fn add(&self, point: &Point, change: &[f64; 3], v: &mut [f64]) {
        for (body, given) in point.bodies.iter().zip(&self.given) {
            let own = &mut v[DOF * body..DOF * body + DOF];
            for (given, change) in given.iter().zip(change) {
                own.iter_mut().zip(given).for_each(|(v, given)| *v += given * change);
            }
        }
    }

    /// The impulse of a point whose relative velocity without it is `free`: none, or one that sticks, or one that slides.
    fn solve(&self, point: &Point, free: &Vec3) -> Vec3 {
        let Some(offset) = point.offset() else { return self.compliant(point, free) };
        let q = Vec3::new(free.x + offset, free.y, free.z);
        // Open.
        let least = Vec3::new(point.least, 0.0, 0.0);
        if point.least.is_finite() && point.cohesion == 0.0 && (q + self.delassus * least).x >= 0.0 {
            return least;
        }
        let sticks = self.delassus.try_inverse().map_or_else(Vec3::zeros, |inverse| -(inverse * q));
        let shear = |r: &Vec3| (r.y * r.y + r.z * r.z).sqrt();
        if sticks.x >= point.least && shear(&sticks) <= point.cohesion + point.friction * sticks.x {
            return sticks;
        }
        self.slides(point, &q)
    }

    /// Slides: `r_T = -l u_T`, with the `l >= 0` at which it lies on the cone. For each `l` the normal impulse follows from `u_N = 0`.
    fn slides(&self, point: &Point, q: &Vec3) -> Vec3 {
        let w = &self.delassus;
        // (W_TT + l) r_T = -(q_T + W_TN r_N), W_NN r_N + W_NT r_T = -q_N, r_N >= least: two equations for the shear at each l.
        let at = |l: f64| {
            let full = Matrix3::new(
                w[(0, 0)],
                w[(0, 1)],
                w[(0, 2)],
                w[(1, 0)],
                w[(1, 1)] + l,
                w[(1, 2)],
                w[(2, 0)],
                w[(2, 1)],
                w[(2, 2)] + l,
            );
            let r = full.try_inverse().map_or_else(Vec3::zeros, |inverse| -(inverse * q));
            if r.x >= point.least {
                return r;
            }
            let n = point.least;
            let (a, b, c, d) = (w[(1, 1)] + l, w[(1, 2)], w[(2, 1)], w[(2, 2)] + l);
            let (x, y) = (q.y + w[(1, 0)] * n, q.z + w[(2, 0)] * n);
            let det = a * d - b * c;
            Vec3::new(n, -(d * x - b * y) / det, -(a * y - c * x) / det)
        };
        let beyond = |r: &Vec3| (r.y * r.y + r.z * r.z).sqrt() - point.limit(r.x);
        let unit = w.trace();
        let (mut low, mut high) = (0.0, 1e-3 * unit);
        for _ in 0..HALVINGS {
            if beyond(&at(high)) <= 0.0 {
                break;
            }
            (low, high) = (high, 4.0 * high);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if beyond(&at(middle)) > 0.0 { low = middle } else { high = middle }
        }
        let r = at(high);
        let (limit, size) = (point.limit(r.x), (r.y * r.y + r.z * r.z).sqrt());
        let factor = if size > limit { limit / size } else { 1.0 };
        Vec3::new(r.x, r.y * factor, r.z * factor)
    }

    /// A compliant point: Newton's method on its own velocity, of which its impulse is a function.
    fn compliant(&self, point: &Point, free: &Vec3) -> Vec3 {
        let mut u = *free;
        for _ in 0..HALVINGS {
            let own: [f64; 3] = u.into();
            let response = point.response(&own, &[0.0; 3], 0.0);
            let left = u - free - self.delassus * Vec3::from(response.impulse);
            if left.norm() <= 1e-15 * (1.0 + free.norm()) {
                break;
            }
            let slope = point.slope(&own, &[0.0; 3], 0.0);
            let tangent = Matrix3::identity() + self.delassus * Matrix3::from_fn(|r, c| slope[r][c]);
            let Some(inverse) = tangent.try_inverse() else { break };
            u -= inverse * left;
        }
        let own: [f64; 3] = u.into();
        Vec3::from(point.response(&own, &[0.0; 3], 0.0).impulse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::cos;
    use crate::solve::nonsmooth::problem::fixture::column;

    #[test]
    fn one_sweep_up_a_column_takes_off_what_theory_says() {
        // Normal contacts alone, forwards: the error of the slowest mode is multiplied by cos^2(pi / 2N).
        for n in [4, 9, 20] {
            let problem = column(n, 0.0, Vec3::new(0.0, 0.0, -9.81));
            let locals: Vec<Local> = problem.points.iter().map(|point| Local::of(&problem, point)).collect();
            let mut impulses = vec![[0.0; 3]; n];
            let mut v = problem.velocities(&impulses);
            // The exact impulses bear all that lies above.
            let left = |impulses: &[[f64; 3]]| {
                let mass = 1.0 / problem.inertias[0].inverse[2][2];
                (0..n)
                    .map(|k| (impulses[k][0] - mass * 9.81 * problem.step * (n - k) as f64).abs())
                    .sum::<f64>()
            };
            let mut ratio = 0.0;
            for _ in 0..20 * n {
                let before = left(&impulses);
                sweep(&problem, &locals, (&mut v, &mut impulses), true);
                ratio = left(&impulses) / before;
            }
            let c = cos(std::f64::consts::FRAC_PI_2 / n as f64);
            // After 20 N sweeps the other modes are gone; rounding is 1e-16 over what is left, 1e-4 of the start at the most.
            assert!((ratio - c * c).abs() < 1e-6, "{n}: {ratio} {}", c * c);
        }
    }
}
