//! A contact point: where it is, how its impulse follows from its relative velocity.

use crate::law::NormalLaw;
use crate::math::Vec3;
use crate::solve::system::DOF;

/// What a point bears.
#[derive(Clone, Copy, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "all points of a problem have the same variant; a box each would cost more"
)]
pub(super) enum Bearing {
    /// Nothing that is pressed: `r_N >= least` (N s) where `u_N + offset >= 0`.
    Rigid {
        /// Velocity (m/s) by which the point may close, or has to open.
        offset: f64,
    },
    /// A spring.
    Compliant {
        law: NormalLaw,
        /// Shear stiffness (N/m) and shear force (N) at the start of the step, along the two in-plane axes.
        shear_stiffness: f64,
        shear: [f64; 2],
        /// Length of the step (s), gap (m) at its start, area (m^2).
        step: f64,
        gap: f64,
        area: f64,
    },
}

/// A contact point in a step.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Index of its joint, and its own among the joint's points.
    pub joint: usize,
    /// See `joint`.
    pub own: usize,
    /// The body that the impulse acts on, and the one that its reaction acts on.
    pub bodies: [usize; 2],
    /// Directions of the impulse's components, in world coordinates: the normal, in which the reference body pushes the incident one, and two in
    /// the plane.
    pub axes: [Vec3; 3],
    /// From the centroids of the two bodies to the point (m).
    pub arms: [Vec3; 2],
    /// Gap at the start of the step (m).
    pub gap: f64,
    /// tan of the friction angle.
    pub friction: f64,
    /// What cohesion bears (N s).
    pub cohesion: f64,
    /// Least normal impulse (N s): 0, or below where the joint bears tension.
    pub least: f64,
    /// What its relative velocity is half way through the step beyond what it is now, at the same velocities of the bodies (m/s): its arms and axes
    /// turn with them.
    pub(super) turns: [f64; 3],
    pub(super) bearing: Bearing,
    /// Inertia that resists a unit impulse along the normal (kg): one over the diagonal of the Delassus matrix.
    pub inertia: f64,
}

/// How the impulse changes with the relative velocity: `-dr/du`, by row and column (kg).
pub(super) type Slope = [[f64; 3]; 3];

/// What a point does at a relative velocity.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Response {
    pub impulse: [f64; 3],
    pub state: State,
}

/// Whether a point is open, sticks or slides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum State {
    #[default]
    Open,
    Sticks,
    Slides,
}

/// The velocity of one body against another where their arms end, at their velocities.
pub(super) fn apart(arms: &[Vec3; 2], incident: &[f64], reference: &[f64]) -> Vec3 {
    let at = |v: &[f64], arm: &Vec3| {
        Vec3::new(
            v[0] + v[4] * arm.z - v[5] * arm.y,
            v[1] + v[5] * arm.x - v[3] * arm.z,
            v[2] + v[3] * arm.y - v[4] * arm.x,
        )
    };
    at(incident, &arms[0]) - at(reference, &arms[1])
}

impl Point {
    /// The relative velocity of the incident body against the reference body, along the axes, half way through the step, at the velocities of all
    /// bodies.
    pub fn relative_velocity(&self, v: &[f64]) -> [f64; 3] {
        let [i, r] = self.bodies.map(|body| &v[DOF * body..DOF * body + DOF]);
        let u = self.between(i, r);
        std::array::from_fn(|k| u[k] + self.turns[k])
    }

    /// The same where the point is now, at the velocities of its two bodies.
    pub(super) fn between(&self, incident: &[f64], reference: &[f64]) -> [f64; 3] {
        let u = apart(&self.arms, incident, reference);
        self.axes.map(|axis| axis.dot(&u))
    }

    /// By how much De Saxcé's term opens it at the velocities of all bodies (m/s): `tan(phi) |u_T|`.
    pub(super) fn opens(&self, v: &[f64]) -> f64 {
        let u = self.relative_velocity(v);
        self.friction * (u[1] * u[1] + u[2] * u[2]).sqrt()
    }

    /// Velocity (m/s) by which a rigid point may close; `None` of a compliant one.
    pub(super) fn offset(&self) -> Option<f64> {
        match self.bearing {
            Bearing::Rigid { offset } => Some(offset),
            Bearing::Compliant { .. } => None,
        }
    }

    /// What is added to the relative velocity where the point is now before its law is asked: see `turns`, and by what a rigid point may close (m/s).
    pub(super) fn constant(&self) -> [f64; 3] {
        let [n, a, b] = self.turns;
        [n + self.offset().unwrap_or(0.0), a, b]
    }

    /// Largest shear impulse (N s) under a normal one.
    pub(super) fn limit(&self, normal: f64) -> f64 {
        (self.cohesion + self.friction * normal).max(0.0)
    }

    /// Whether it holds whatever acts.
    pub(super) fn is_bonded(&self) -> bool {
        self.least == f64::NEG_INFINITY
    }

    /// The impulse nearest to a trial one that the point bears: in the cone of friction and cohesion, and not less than the least. Where the
    /// projection onto the cone is below the least, it lies on the disc there.
    pub(super) fn nearest(&self, trial: &[f64; 3]) -> [f64; 3] {
        if self.is_bonded() {
            return *trial;
        }
        let [n, a, b] = *trial;
        let (mu, size) = (self.friction, (a * a + b * b).sqrt());
        let clipped = |normal: f64, limit: f64| {
            let factor = if size > limit { limit / size } else { 1.0 };
            [normal, a * factor, b * factor]
        };
        // The slope of the cone takes off `x` of the shear, and adds `mu x` to the normal part.
        let x = ((size - self.cohesion - mu * n) / (1.0 + mu * mu)).max(0.0);
        let normal = n + mu * x;
        if mu > 0.0 && normal >= self.least && self.cohesion + mu * normal >= 0.0 {
            return clipped(normal, self.cohesion + mu * normal);
        }
        let normal = n.max(self.least);
        if mu == 0.0 {
            return clipped(normal, self.cohesion);
        }
        clipped(self.least, self.limit(self.least))
    }

    /// Adds the impulse (times `factor`) to the sums over the bodies.
    pub(super) fn add_impulse(&self, impulse: &[f64; 3], factor: f64, sums: &mut [f64]) {
        let world =
            (self.axes[0] * impulse[0] + self.axes[1] * impulse[1] + self.axes[2] * impulse[2]) * factor;
        for ((body, arm), sign) in self.bodies.iter().zip(&self.arms).zip([1.0, -1.0]) {
            let (force, moment) = (world * sign, arm.cross(&world) * sign);
            let own = &mut sums[DOF * body..DOF * body + DOF];
            for k in 0..3 {
                own[k] += force[k];
                own[3 + k] += moment[k];
            }
        }
    }

    /// What the point would bear at a relative velocity if it neither opened nor slid: normal part, shear, and their slopes (kg). By the
    /// augmented Lagrangian of Alart and Curnier: `from` is the impulse of the last iterate and `rho` (kg) the weight with which the
    /// velocity counts; a compliant point needs neither.
    fn trial(&self, u: &[f64; 3], from: &[f64; 3], rho: f64) -> (f64, [f64; 2], [f64; 2]) {
        match &self.bearing {
            Bearing::Rigid { offset } => {
                let normal = from[0] - rho * (u[0] + offset);
                (normal, [from[1] - rho * u[1], from[2] - rho * u[2]], [rho; 2])
            }
            Bearing::Compliant { law, shear_stiffness, shear, step, gap, area } => {
                let closure = -(gap + step * u[0]);
                let sheared = |k: usize| step * (shear[k] - shear_stiffness * step * u[k + 1]);
                let slopes = [step * step * area * law.stiffness(closure), step * step * shear_stiffness];
                (step * area * law.stress(closure), [sheared(0), sheared(1)], slopes)
            }
        }
    }

    /// The impulse at a relative velocity: the trial, brought back to what the point bears.
    pub(super) fn response(&self, u: &[f64; 3], from: &[f64; 3], rho: f64) -> Response {
        let (trial, shear, _) = self.trial(u, from, rho);
        let normal = trial.max(self.least);
        let (factor, state) = self.slides_back(normal, shear);
        let state = if trial <= self.least { State::Open } else { state };
        Response { impulse: [normal, shear[0] * factor, shear[1] * factor], state }
    }

    /// By what a trial shear is multiplied under a normal impulse.
    fn slides_back(&self, normal: f64, [a, b]: [f64; 2]) -> (f64, State) {
        let limit = self.limit(normal);
        let size = (a * a + b * b).sqrt();
        if size <= limit { (1.0, State::Sticks) } else { (limit / size, State::Slides) }
    }

    /// The slope of [`response`](Point::response): unsymmetric where it slides, as friction grows with the normal impulse.
    pub(super) fn slope(&self, u: &[f64; 3], from: &[f64; 3], rho: f64) -> Slope {
        let (trial, shear, [kn, ks]) = self.trial(u, from, rho);
        let (normal, kn) = if trial > self.least { (trial, kn) } else { (self.least, 0.0) };
        let (factor, state) = self.slides_back(normal, shear);
        if state == State::Sticks {
            return if kn > 0.0 {
                [[kn, 0.0, 0.0], [0.0, ks, 0.0], [0.0, 0.0, ks]]
            } else {
                Slope::default()
            };
        }
        let size = (shear[0] * shear[0] + shear[1] * shear[1]).sqrt();
        let (x, y, share) = (shear[0] / size, shear[1] / size, ks * factor);
        let grows = if factor > 0.0 { self.friction * kn } else { 0.0 };
        [
            [kn, 0.0, 0.0],
            [grows * x, share * (1.0 - x * x), -share * x * y],
            [grows * y, -share * x * y, share * (1.0 - y * y)],
        ]
    }
}
