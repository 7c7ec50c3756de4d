//! Where the method is, and by how much it misses the conditions of an optimum.

use super::normal::Normal;
use super::problem::{Problem, Six};
use super::step::{Direction, Nothing, Right};

/// Multiplier, stresses and slacks of the planes; velocities and multipliers of the planes.
#[derive(Clone)]
pub(super) struct Iterate {
    pub lambda: f64,
    pub stresses: Vec<Six>,
    pub slacks: Vec<f64>,
    pub velocities: Vec<f64>,
    pub flows: Vec<f64>,
}

/// What an iterate misses.
pub(super) struct Residuals {
    /// Rates beyond those of the planes' flow, by group.
    pub rates: Vec<Six>,
    /// Power of the live load, from one.
    pub power: f64,
    /// Loads beyond what the stresses bear, by velocity.
    pub forces: Vec<f64>,
    /// Distance to the planes beyond the slacks.
    pub slacks: Vec<f64>,
    /// Multiplier of the velocities, if they were a mechanism.
    pub kinematic: f64,
    /// Mean product of slack and flow.
    pub product: f64,
}

impl Iterate {
    /// A start: the stresses of least slack and the velocities of least flow, moved so that no slack or flow is below zero.
    pub fn start(problem: &Problem, normal: &mut Normal) -> Option<Self> {
        if !normal.factorise(problem, &vec![1.0; problem.count]) {
            return None;
        }
        let zero = Self {
            lambda: 0.0,
            stresses: vec![[0.0; 6]; problem.groups.len()],
            slacks: vec![0.0; problem.count],
            velocities: vec![0.0; problem.dead.len()],
            flows: vec![0.0; problem.count],
        };
        let missed = zero.residuals(problem);
        let nothing = Nothing::of(problem);
        let ones = vec![1.0; problem.count];
        let primal = Right { forces: &missed.forces, slacks: &missed.slacks, ..nothing.right() };
        let state = primal.solve(problem, normal, &ones, &ones);
        let dual = Right { power: missed.power, ..nothing.right() };
        let mechanism = dual.solve(problem, normal, &ones, &ones);
        let mut start = Self {
            lambda: state.lambda,
            stresses: state.stresses,
            slacks: state.slacks,
            velocities: mechanism.velocities,
            flows: mechanism.flows,
        };
        lift(&mut start.slacks);
        lift(&mut start.flows);
        Some(start)
    }

    pub fn residuals(&self, problem: &Problem) -> Residuals {
        let mut rates = problem.rates(&self.velocities);
        let flows = problem.flows(&self.flows);
        rates.as_flattened_mut().iter_mut().zip(flows.as_flattened()).for_each(|(r, f)| *r -= f);
        let borne = problem.forces(&self.stresses);
        let loads = problem.dead.iter().zip(&problem.live).map(|(d, l)| d + self.lambda * l);
        let reaches = problem.reaches(&self.stresses);
        let gaps = problem.bounds().zip(&reaches).zip(&self.slacks).map(|((b, r), s)| b - r - s);
        let products = self.slacks.iter().zip(&self.flows).map(|(s, z)| s * z);
        let costs = problem.bounds().zip(&self.flows).map(|(b, z)| b * z);
        Residuals {
            rates,
            power: 1.0 - inner(&problem.live, &self.velocities),
            forces: loads.zip(&borne).map(|(l, b)| l - b).collect(),
            slacks: gaps.collect(),
            kinematic: costs.sum::<f64>() - inner(&problem.dead, &self.velocities),
            product: products.sum::<f64>() / problem.count as f64,
        }
    }

    /// What a rate of flow costs in slack, for every plane.
    pub fn weights(&self) -> Vec<f64> {
        self.flows.iter().zip(&self.slacks).map(|(z, s)| z / s).collect()
    }

    /// Takes steps of these lengths: stresses, and velocities.
    pub fn go(&mut self, d: &Direction, [state, mechanism]: [f64; 2]) {
        self.lambda += state * d.lambda;
        add(self.stresses.as_flattened_mut(), d.stresses.as_flattened(), state);
        add(&mut self.slacks, &d.slacks, state);
        add(&mut self.velocities, &d.velocities, mechanism);
        add(&mut self.flows, &d.flows, mechanism);
    }
}

impl Residuals {
    /// The largest of all, each relative to the size of what it is of; NaN if one of them is.
    pub fn merit(&self, problem: &Problem, at: &Iterate) -> f64 {
        let stress = largest(at.stresses.as_flattened()).max(1.0);
        let flow = largest(&at.flows).max(1.0);
        let state = largest(&self.forces).max(largest(&self.slacks)) / stress;
        let mechanism = largest(self.rates.as_flattened()) / flow;
        // A multiplier of zero has no size: a hundredth of what a live load of one unit of force takes.
        let small = 0.01 / problem.live.iter().map(|l| l.abs()).sum::<f64>();
        let gap = (self.kinematic - at.lambda) / at.lambda.abs().max(self.kinematic.abs()).max(small);
        largest(&[state, mechanism, self.power, gap])
    }
}

fn largest(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |most: f64, x| if x.is_nan() || most.is_nan() { f64::NAN } else { most.max(x.abs()) })
}

pub(super) fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn add(to: &mut [f64], what: &[f64], length: f64) {
    to.iter_mut().zip(what).for_each(|(t, w)| *t += length * w);
}

/// Raises all by the same until the least of them is well above zero.
fn lift(all: &mut [f64]) {
    let least = all.iter().fold(f64::INFINITY, |least: f64, x| least.min(*x));
    let mean = all.iter().map(|x| x.abs()).sum::<f64>() / all.len() as f64;
    let by = (-1.5 * least).max(0.0) + mean.max(1e-3);
    all.iter_mut().for_each(|x| *x += by);
}
