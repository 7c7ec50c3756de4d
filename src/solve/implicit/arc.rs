//! Newton's method along the path of equilibria, with the level of the load among the unknowns; see [`super::follow`].

use crate::math::Vec3;
use crate::solve::implicit::newton::{GOOD_CONTRACTION, Newton, POOR_CONTRACTION, dot, norm};
use crate::solve::system::{DOF, held};

/// Iterations of a step along the path of equilibria.
const MOST_ARC_ITERATIONS: u32 = 10;
/// The same where joints close softly: contacts found anew throw such a wall further off its balance.
const MOST_SOFT_ITERATIONS: u32 = 20;
/// A residual that grows so many times in an iteration is lost.
const LOST: f64 = 30.0;
/// What counts as no displacement at all (m): far below the rounding of a position.
const NOWHERE: f64 = 1e-17;
/// Change of the level (rad, or a factor) over which the growth of the loads is taken.
const LEVEL_STEP: f64 = 1e-4;

/// A state reached along the path of equilibria.
pub(super) struct Arc {
    /// The level of the load.
    pub level: f64,
    /// Unbalanced force ratio.
    pub ratio: f64,
    /// Direction in which the path goes on, of unit length.
    pub along: Vec<f64>,
    /// Growth of the level per length that way.
    pub slope: f64,
    /// Whether the state is stable.
    pub stable: bool,
    /// Length of the step that led here.
    pub length: f64,
    /// Iterations that it took.
    pub iterations: u32,
}

/// A state that has been reached, before the path is looked at from there.
pub(super) struct Reached {
    /// The level of the load.
    pub level: f64,
    /// Unbalanced force ratio.
    pub ratio: f64,
    /// Direction in which it was reached, of unit length; empty where it did not move.
    pub along: Vec<f64>,
    /// Length of the step that led here.
    pub length: f64,
    /// Iterations that it took.
    pub iterations: u32,
}

impl Newton<'_, '_> {
    /// Goes a length along a direction from a state at rest at `level`, the level of the load being as unknown as the
    /// positions, to an unbalanced force ratio; without a direction it stays where it is. `None` where it does not converge.
    pub fn along(
        &mut self,
        loads: &dyn Fn(f64) -> (Vec3, f64),
        mut level: f64,
        along: &[f64],
        length: f64,
        unbalanced_ratio: f64,
    ) -> Option<Reached> {
        let tolerance = unbalanced_ratio.max(self.rounding());
        let mut moved = vec![0.0; DOF * self.assembly.bodies.all.len()];
        let (mut gone, mut before, mut fresh) = (0.0, f64::INFINITY, self.system.is_factorised());
        let mut iterations = 0;
        let most = match self.assembly.joints.close_softly() {
            true => MOST_SOFT_ITERATIONS,
            false => MOST_ARC_ITERATIONS,
        };
        if !fresh && !along.is_empty() {
            // Where nothing has moved yet every joint sticks: the matrix of one that slides is made where the step leads.
            let step: Vec<f64> = along.iter().map(|x| x * length).collect();
            let share = self.allowed(&step);
            let start = self.assembly.bodies.all.clone();
            self.place(&start, &step, share);
            moved = step.iter().map(|x| share * x).collect();
            gone = share * length;
        }
        let ratio = loop {
            (self.assembly.gravity, self.assembly.load_factor) = loads(level);
            let residual = self.residual();
            let ratio = self.assembly.unbalanced_ratio();
            let there = along.is_empty() || (length - gone).abs() <= 1e-6 * length + NOWHERE;
            if there && ratio < tolerance {
                break ratio;
            }
            let now = norm(&residual, &self.assembly.bodies.all);
            // The first step leaves the balance that it starts from; a later one that leaves it further does not come back.
            let lost = iterations > 1 && now > LOST * before;
            if iterations == most || along.is_empty() || !now.is_finite() || lost {
                return None;
            }
            if !fresh || now > GOOD_CONTRACTION * before {
                self.factorise()?;
            }
            fresh = true;
            let loading = self.per_level(loads, level);
            let (a, b) = (self.system.solve(&residual), self.system.solve(&loading));
            let growth = (length - gone - self.product(along, &a)) / self.product(along, &b);
            let step: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a + growth * b).collect();
            if !step.iter().all(|x| x.is_finite()) {
                return None;
            }
            // Between two sides of a corner of the law, where sub-contacts stick and slip in turn, it goes half of the way.
            let turns = iterations > 1 && now > POOR_CONTRACTION * before;
            let share = self.allowed(&step) * if turns { 0.5 } else { 1.0 };
            let start = self.assembly.bodies.all.clone();
            self.place(&start, &step, share);
            moved.iter_mut().zip(&step).for_each(|(m, s)| *m += share * s);
            gone += share * self.product(along, &step);
            level += share * growth;
            before = now;
            self.effort.steps += 1;
            iterations += 1;
        };
        let size = self.product(&moved, &moved).sqrt();
        let along = match length > 0.0 {
            true => moved.iter().map(|x| x / size).collect(),
            false => along.to_vec(),
        };
        Some(Reached { level, ratio, along, length, iterations })
    }

    /// How the path goes on from a state that has been reached; where no direction is known, the way of the growing load.
    pub fn onward(&mut self, loads: &dyn Fn(f64) -> (Vec3, f64), reached: Reached) -> Option<Arc> {
        self.factorise()?;
        let loading = self.per_level(loads, reached.level);
        let onward = self.system.solve(&loading);
        let mut along = reached.along;
        if along.is_empty() {
            let size = self.product(&onward, &onward).sqrt();
            along = onward.iter().map(|x| x / size).collect();
        }
        let slope = 1.0 / self.product(&along, &onward);
        let stable = self.system.is_stable();
        let Reached { level, ratio, length, iterations, .. } = reached;
        slope.is_finite().then_some(Arc { level, ratio, along, slope, stable, length, iterations })
    }

    /// Growth of the loads per level.
    fn per_level(&mut self, loads: &dyn Fn(f64) -> (Vec3, f64), level: f64) -> Vec<f64> {
        let mut at = |level: f64| -> Vec<f64> {
            (self.assembly.gravity, self.assembly.load_factor) = loads(level);
            self.assembly.apply_loads();
            let bodies = &self.assembly.bodies.all;
            bodies
                .iter()
                .flat_map(|b| [b.force.x, b.force.y, b.force.z, b.torque.x, b.torque.y, b.torque.z])
                .collect()
        };
        // A central difference over smooth loads of order one.
        let (low, high) = (at(level - LEVEL_STEP), at(level + LEVEL_STEP));
        (self.assembly.gravity, self.assembly.load_factor) = loads(level);
        let mut growth: Vec<f64> = high.iter().zip(&low).map(|(h, l)| (h - l) / (2.0 * LEVEL_STEP)).collect();
        for (index, body) in self.assembly.bodies.all.iter().enumerate() {
            held(body).iter().for_each(|unknown| growth[DOF * index + unknown] = 0.0);
        }
        growth
    }

    /// Product of two motions, weighted by the share of the mass that moves, so that a motion's product with itself is its mean
    /// square displacement; turns count at the radius of gyration.
    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        let bodies = &self.assembly.bodies.all;
        let (mut sum, mut mass) = (0.0, 0.0);
        for ((a, b), body) in
            a.chunks_exact(DOF).zip(b.chunks_exact(DOF)).zip(bodies).filter(|(_, b)| b.moves())
        {
            let gyration = body.gyration();
            sum += body.mass * (dot(&a[..3], &b[..3]) + gyration * gyration * dot(&a[3..], &b[3..]));
            mass += body.mass;
        }
        if mass > 0.0 { sum / mass } else { 0.0 }
    }
}
