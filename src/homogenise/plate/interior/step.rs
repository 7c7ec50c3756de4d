//! A step of the method: its direction from what is missed, and how far it goes.

use super::iterate::{Iterate, Residuals, inner};
use super::normal::Normal;
use super::problem::{Problem, Six};

/// Refinements of the normal equations, which lose digits.
const REFINED: usize = 1;
/// Share of the way to where a slack or a flow vanishes that a step goes.
const SHORT: f64 = 0.995;

/// Changes of an iterate.
pub(super) struct Direction {
    pub lambda: f64,
    pub stresses: Vec<Six>,
    pub slacks: Vec<f64>,
    pub velocities: Vec<f64>,
    pub flows: Vec<f64>,
}

/// Right-hand sides: what is missed, and what products of slack and flow are to change by.
pub(super) struct Right<'a> {
    pub rates: &'a [Six],
    pub power: f64,
    pub forces: &'a [f64],
    pub slacks: &'a [f64],
    pub products: &'a [f64],
}

/// Right-hand sides of nothing missed.
pub(super) struct Nothing {
    rates: Vec<Six>,
    forces: Vec<f64>,
    planes: Vec<f64>,
}

impl Nothing {
    pub fn of(problem: &Problem) -> Self {
        Self {
            rates: vec![[0.0; 6]; problem.groups.len()],
            forces: vec![0.0; problem.dead.len()],
            planes: vec![0.0; problem.count],
        }
    }

    pub fn right(&self) -> Right<'_> {
        let Self { rates, forces, planes } = self;
        Right { rates, power: 0.0, forces, slacks: planes, products: planes }
    }
}

impl Right<'_> {
    /// The direction at given slacks and flows, by whose ratios the normal equations were factorised.
    pub fn solve(&self, problem: &Problem, normal: &Normal, slacks: &[f64], flows: &[f64]) -> Direction {
        let forced: Vec<f64> =
            (0..problem.count).map(|k| (self.products[k] - flows[k] * self.slacks[k]) / slacks[k]).collect();
        let mut own = problem.flows(&forced);
        own.as_flattened_mut().iter_mut().zip(self.rates.as_flattened()).for_each(|(o, r)| *o = r - *o);
        let (mut lambda, mut velocities) = (0.0, vec![0.0; problem.dead.len()]);
        let border = inner(&problem.live, &normal.per_lambda);
        let mut stresses = normal.stresses(&own);
        let mut missed = self.forces.to_vec();
        for _ in 0..=REFINED {
            let borne = problem.forces(&stresses);
            for (k, m) in missed.iter_mut().enumerate() {
                *m = self.forces[k] + lambda * problem.live[k] - borne[k];
            }
            let from_forces = normal.solve(&missed);
            let power = self.power - inner(&problem.live, &velocities);
            let more = (power - inner(&problem.live, &from_forces)) / border;
            lambda += more;
            for ((v, f), l) in velocities.iter_mut().zip(&from_forces).zip(&normal.per_lambda) {
                *v += f + more * l;
            }
            let mut rates = problem.rates(&velocities);
            rates.as_flattened_mut().iter_mut().zip(own.as_flattened()).for_each(|(r, o)| *r += o);
            stresses = normal.stresses(&rates);
        }
        let reaches = problem.reaches(&stresses);
        let new_slacks: Vec<f64> = self.slacks.iter().zip(&reaches).map(|(s, r)| s - r).collect();
        let new_flows =
            (0..problem.count).map(|k| (self.products[k] - flows[k] * new_slacks[k]) / slacks[k]).collect();
        Direction { lambda, stresses, slacks: new_slacks, velocities, flows: new_flows }
    }
}

/// The direction at an iterate by a predictor and a corrector (Mehrotra 1992), and the lengths of the step.
pub(super) fn step(
    problem: &Problem,
    normal: &Normal,
    at: &Iterate,
    missed: &Residuals,
) -> (Direction, [f64; 2]) {
    let mut products: Vec<f64> = at.slacks.iter().zip(&at.flows).map(|(s, z)| -s * z).collect();
    let right = |products: &[f64]| {
        let Residuals { rates, power, forces, slacks, .. } = missed;
        Right { rates, power: *power, forces, slacks, products }.solve(problem, normal, &at.slacks, &at.flows)
    };
    let ahead = right(&products);
    let [state, mechanism] = lengths(at, &ahead, 1.0);
    let product =
        |k: usize| (at.slacks[k] + state * ahead.slacks[k]) * (at.flows[k] + mechanism * ahead.flows[k]);
    let reached = (0..problem.count).map(product).sum::<f64>() / problem.count as f64;
    let share = reached / missed.product;
    let aim = share * share * share * missed.product;
    for (k, product) in products.iter_mut().enumerate() {
        *product += aim - ahead.slacks[k] * ahead.flows[k];
    }
    let direction = right(&products);
    let lengths = lengths(at, &direction, SHORT);
    (direction, lengths)
}

/// How far slacks and flows can go, at most all the way.
fn lengths(at: &Iterate, d: &Direction, share: f64) -> [f64; 2] {
    // Largest share of what is left that a whole step takes: without a branch, for the sake of speed.
    let far = |x: &[f64], dx: &[f64]| {
        let taken = x.iter().zip(dx).map(|(x, d)| -d / x);
        let most = taken.fold(0.0, |most: f64, t| if t > most { t } else { most });
        if most > share { share / most } else { 1.0 }
    };
    [far(&at.slacks, &d.slacks), far(&at.flows, &d.flows)]
}
