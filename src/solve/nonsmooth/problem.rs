//! The contact problem of a step: masses, free velocities and contact points.

use nalgebra::Matrix6;

use crate::math::{Mat3, Vec3};
use crate::solve::bodies::Body;
use crate::solve::nonsmooth::point::Point;
use crate::solve::system::{DOF, held};

/// By row and column, of the six components of a body's velocity.
pub(super) type Matrix = [[f64; DOF]; DOF];

/// A body in a step: how it resists a change of its velocity.
#[derive(Clone, Copy, Debug)]
pub struct Inertia {
    /// Mass and moments of inertia (kg, kg m^2, world axes about the centroid), with the springs that hold it times the square of the step:
    /// they act at the end of the step.
    pub matrix: Matrix,
    /// Its inverse; zero in what the body cannot do.
    pub inverse: Matrix,
    /// Its own moments of inertia (kg m^2, world axes): without the springs, which store no angular momentum.
    pub moments: Mat3,
    /// Which of the six components of its velocity are zero whatever acts.
    pub held: &'static [usize],
}

impl Inertia {
    /// Of a body with an attitude, and springs times the square of the step.
    pub(super) fn of(body: &Body, rotation: &Mat3, springs: &Matrix) -> Inertia {
        let moments =
            rotation * Mat3::from_diagonal(&(body.inertia * body.inertia_scale)) * rotation.transpose();
        let mut matrix = *springs;
        for k in 0..3 {
            matrix[k][k] += body.mass * body.inertia_scale;
            (0..3).for_each(|l| matrix[3 + k][3 + l] += moments[(k, l)]);
        }
        let held = held(body);
        for &k in held {
            let own = matrix[k][k];
            (0..DOF).for_each(|l| (matrix[k][l], matrix[l][k]) = (0.0, 0.0));
            matrix[k][k] = own;
        }
        let regular = Matrix6::from_fn(|row, column| matrix[row][column]);
        let inverse = regular.try_inverse().unwrap_or_else(Matrix6::zeros);
        let mut inverse: Matrix =
            std::array::from_fn(|row| std::array::from_fn(|column| inverse[(row, column)]));
        held.iter().for_each(|&k| inverse[k] = [0.0; DOF]);
        Inertia { matrix, inverse, moments, held }
    }

    /// The velocity (m/s, rad/s) that an impulse (N s, N m s) gives it.
    pub(super) fn velocity(&self, impulse: &[f64]) -> [f64; DOF] {
        self.inverse.map(|row| row.iter().zip(impulse).map(|(a, x)| a * x).sum())
    }

    /// The impulse that gives it a velocity.
    pub(super) fn impulse(&self, v: &[f64]) -> [f64; DOF] {
        self.matrix.map(|row| row.iter().zip(v).map(|(a, x)| a * x).sum())
    }
}

/// The contact problem of a step: find velocities `v` and impulses `r` with `M (v - free) = H r` and the law of each point between.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The bodies, by block id.
    pub inertias: Vec<Inertia>,
    /// Their velocities (m/s, rad/s, world axes, six each) without contact.
    pub free: Vec<f64>,
    /// The contact points.
    pub points: Vec<Point>,
    /// Length of the step (s).
    pub step: f64,
    /// The impulse of the weights of all bodies that move, under standard gravity (N s).
    pub weight: f64,
    /// Largest speed of a body (m/s), above 0: what rounding is a share of.
    pub fastest: f64,
    /// Mean mass of the bodies that move (kg).
    pub mean_mass: f64,
}

impl Problem {
    /// The impulses (N s, N m s) that are missing at velocities: `M (v - free) - H r`.
    pub(super) fn unbalance(&self, v: &[f64], impulses: &[[f64; 3]]) -> Vec<f64> {
        let mut sums = vec![0.0; v.len()];
        for (b, inertia) in self.inertias.iter().enumerate() {
            let range = DOF * b..DOF * b + DOF;
            let change: [f64; DOF] = std::array::from_fn(|k| v[DOF * b + k] - self.free[DOF * b + k]);
            sums[range].copy_from_slice(&inertia.impulse(&change));
        }
        for (point, impulse) in self.points.iter().zip(impulses) {
            if *impulse != [0.0; 3] {
                point.add_impulse(impulse, -1.0, &mut sums);
            }
        }
        for (b, inertia) in self.inertias.iter().enumerate() {
            inertia.held.iter().for_each(|k| sums[DOF * b + k] = 0.0);
        }
        sums
    }

    /// The velocities that impulses lead to: `free + M^-1 H r`.
    pub fn velocities(&self, impulses: &[[f64; 3]]) -> Vec<f64> {
        let mut sums = vec![0.0; self.free.len()];
        for (point, impulse) in self.points.iter().zip(impulses) {
            point.add_impulse(impulse, 1.0, &mut sums);
        }
        let mut v = self.free.clone();
        for (b, inertia) in self.inertias.iter().enumerate() {
            let change = inertia.velocity(&sums[DOF * b..DOF * b + DOF]);
            (0..DOF).for_each(|k| v[DOF * b + k] += change[k]);
        }
        v
    }

    /// Half of `x M^-1 x` of impulses: an energy (J).
    pub(super) fn energy(&self, impulses: &[f64]) -> f64 {
        let own = |(b, inertia): (usize, &Inertia)| {
            let range = DOF * b..DOF * b + DOF;
            let velocity = inertia.velocity(&impulses[range.clone()]);
            impulses[range].iter().zip(velocity).map(|(x, v)| x * v).sum::<f64>()
        };
        0.5 * self.inertias.iter().enumerate().map(own).sum::<f64>()
    }
}

/// Force and moment about a centroid of a unit force along a direction, whose arm is given.
pub(super) fn wrench(arm: &Vec3, direction: &Vec3) -> [f64; DOF] {
    let moment = arm.cross(direction);
    [direction.x, direction.y, direction.z, moment.x, moment.y, moment.z]
}

/// Mass of all bodies that move, and their mean (kg).
pub(super) fn masses(bodies: &[Body]) -> (f64, f64) {
    let moving: Vec<f64> = bodies.iter().filter(|body| body.moves()).map(|body| body.mass).collect();
    let mass: f64 = moving.iter().sum();
    (mass, mass / moving.len().max(1) as f64)
}

/// One over the velocity along a direction that a unit impulse gives there (kg).
pub(super) fn inertia_along(inertias: [&Inertia; 2], arms: &[Vec3; 2], direction: &Vec3) -> f64 {
    let given = |inertia: &Inertia, arm: &Vec3| {
        let impulse = wrench(arm, direction);
        impulse.iter().zip(inertia.velocity(&impulse)).map(|(x, v)| x * v).sum::<f64>()
    };
    1.0 / (given(inertias[0], &arms[0]) + given(inertias[1], &arms[1]))
}

#[cfg(test)]
pub(super) mod fixture {
    use super::*;
    use crate::model::{Block, Support, Wall};
    use crate::shape::Polyhedron;
    use crate::solve::bodies::Bodies;
    use crate::solve::nonsmooth::point::Bearing;

    /// A column of `n` blocks on the ground that move without turning, one contact point in the middle of each bed, in a step of 1 ms from rest
    /// under an acceleration.
    pub fn column(n: usize, friction: f64, acceleration: Vec3) -> Problem {
        let block = |k: usize| {
            let bottom = 0.2 * k as f64;
            let shape = Polyhedron::cuboid(Vec3::new(-0.2, -0.1, bottom), Vec3::new(0.2, 0.1, bottom + 0.2));
            let support = if k == 0 { Support::Fixed } else { Support::Upright };
            Block { support, ..Block::stone(shape, 2400.0) }
        };
        // The ground comes last.
        let blocks = (1..=n).chain([0]).map(block).collect();
        let bodies = Bodies::from_wall(&Wall { blocks });
        let none = [[0.0; DOF]; DOF];
        let inertias: Vec<Inertia> =
            bodies.all.iter().map(|body| Inertia::of(body, &body.rotation, &none)).collect();
        let (step, mass) = (1e-3, bodies.all[0].mass);
        let mut free = vec![0.0; DOF * (n + 1)];
        for k in 0..n {
            free[DOF * k] = acceleration.x * step;
            free[DOF * k + 2] = acceleration.z * step;
        }
        let point = |k: usize| {
            let own = [k, if k == 0 { n } else { k - 1 }];
            let arms = [Vec3::new(0.0, 0.0, -0.1), Vec3::new(0.0, 0.0, 0.1)];
            Point {
                joint: k,
                own: 0,
                bodies: own,
                axes: [Vec3::z(), Vec3::x(), Vec3::y()],
                arms,
                gap: 0.0,
                friction,
                cohesion: 0.0,
                least: 0.0,
                turns: [0.0; 3],
                bearing: Bearing::Rigid { offset: 0.0 },
                inertia: inertia_along(own.map(|body| &inertias[body]), &arms, &Vec3::z()),
            }
        };
        let points = (0..n).map(point).collect();
        let weight = n as f64 * mass * 9.81 * step;
        Problem { inertias, free, points, step, weight, fastest: 1e-9, mean_mass: mass }
    }
}
