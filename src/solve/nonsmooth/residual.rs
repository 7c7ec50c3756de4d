//! How well velocities and impulses solve the problem of a step.

use crate::solve::nonsmooth::{Friction, Problem};

/// A sticking point bears less than this share of what it could.
const BELOW_THE_CONE: f64 = 1.0 - 1e-6;

/// What is left over in a step, without a dimension and in those of the problem.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Residual {
    /// Largest natural map of a point, an impulse over that of all weights in the step: by how much an impulse changes when it is projected
    /// again after a step against its relative velocity.
    pub natural_map: f64,
    /// Largest depth (m) to which rigid joints close in the step beyond touching.
    pub penetration_m: f64,
    /// Largest shear force (N) beyond what friction and cohesion bear.
    pub cone_violation_n: f64,
    /// Largest velocity (m/s) in the plane of a rigid joint that sticks.
    pub sliding_m_per_s: f64,
}

impl Residual {
    /// Of velocities (six for each body) and impulses (three for each point). Coulomb's friction opens a point that slides by
    /// `tan(phi) |u_T|` before it is projected (De Saxcé and Feng 1998).
    pub fn of(problem: &Problem, friction: Friction, v: &[f64], impulses: &[[f64; 3]]) -> Residual {
        let mut worst = Residual::default();
        for (point, impulse) in problem.points.iter().zip(impulses) {
            let u = point.relative_velocity(v);
            let slides = (u[1] * u[1] + u[2] * u[2]).sqrt();
            let shear = (impulse[1] * impulse[1] + impulse[2] * impulse[2]).sqrt();
            let limit = point.limit(impulse[0]);
            let projected = match point.offset() {
                Some(offset) => {
                    let opens = if friction == Friction::Coulomb { point.friction * slides } else { 0.0 };
                    let against = [u[0] + offset + opens, u[1], u[2]];
                    worst.penetration_m = worst.penetration_m.max(-(u[0] + offset) * problem.step);
                    if impulse[0] > point.least && shear < BELOW_THE_CONE * limit {
                        worst.sliding_m_per_s = worst.sliding_m_per_s.max(slides);
                    }
                    point.nearest(&std::array::from_fn(|k| impulse[k] - point.inertia * against[k]))
                }
                None => point.response(&u, impulse, point.inertia).impulse,
            };
            let apart = |k: usize| (impulse[k] - projected[k]) * (impulse[k] - projected[k]);
            worst.natural_map = worst.natural_map.max((apart(0) + apart(1) + apart(2)).sqrt());
            if !point.is_bonded() {
                worst.cone_violation_n = worst.cone_violation_n.max((shear - limit) / problem.step);
            }
        }
        worst.natural_map /= problem.weight;
        worst
    }
}
