//! Where the method is: forces, slacks, velocities and multipliers, and by how much they miss the conditions of an optimum.

use crate::solve::limit::interior::Goal;
use crate::solve::limit::interior::cone::{Triple, depth, dot};
use crate::solve::limit::interior::groups::{Group, Groups, SIX, Six};
use crate::solve::limit::interior::normal::Normal;
use crate::solve::limit::interior::step::{Direction, Right, Scaling};

/// A point of the method. `s` and `z` are slack and multiplier of the friction cones, `s_least` and `z_least` those of
/// `n >= least`, `s_cap` and `z_cap` those of the cap.
#[derive(Clone, Default)]
pub(super) struct Iterate {
    pub lambda: f64,
    pub f: Vec<Triple>,
    pub y: Vec<Six>,
    pub s: Vec<Triple>,
    pub z: Vec<Triple>,
    pub s_least: Vec<f64>,
    pub z_least: Vec<f64>,
    pub s_cap: f64,
    pub z_cap: f64,
}

/// What an iterate misses.
pub(super) struct Residuals {
    /// Flow rule, by group.
    pub x: Vec<Triple>,
    /// Flow rule of the multiplier.
    pub x_lambda: f64,
    /// Equilibrium.
    pub y: Vec<Six>,
    /// Slacks.
    pub s: Vec<Triple>,
    pub s_least: Vec<f64>,
    pub s_cap: f64,
    /// Sum of the products of slacks and multipliers.
    pub gap: f64,
    /// Size of the loads, and of the multiplier.
    scale: f64,
    multiplier: f64,
}

impl Residuals {
    /// The largest of all, each relative to the size of what it is of.
    pub fn merit(&self) -> f64 {
        let x = self.x.iter().flatten().fold(self.x_lambda.abs(), largest);
        let gap = self.gap / self.multiplier.abs().max(1.0);
        [self.state(), x, gap].iter().fold(0.0, largest)
    }

    /// The largest of those of the forces alone.
    pub fn state(&self) -> f64 {
        let y = self.y.iter().flatten().fold(0.0, largest);
        self.s.iter().flatten().chain(&self.s_least).fold(y.max(self.s_cap.abs()), largest) / self.scale
    }
}

/// The larger size; NaN if one of them is.
fn largest(largest: f64, x: &f64) -> f64 {
    if x.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(x.abs()) }
}

impl Iterate {
    /// A start: the state of least slack and the mechanism of least multipliers, moved into the cones.
    pub fn start(groups: &Groups, goal: &Goal, normal: &mut Normal) -> Option<Iterate> {
        let (n, blocks) = (groups.groups.len(), groups.dead.len());
        let scaling = Scaling::unit(groups);
        if !normal.factorise(groups, &scaling.inverses) {
            return None;
        }
        let zero = Right::zero(n, blocks);
        let mut start = Iterate { f: vec![[0.0; 3]; n], y: vec![[0.0; SIX]; blocks], ..Iterate::default() };
        let mut forces = Right { y: groups.dead.clone(), q_cap: -goal.cap, ..zero.clone() };
        for ((group, q), least) in groups.groups.iter().zip(&mut forces.q).zip(&mut forces.q_least) {
            *q = [-group.cohesion, 0.0, 0.0];
            *least = group.least.unwrap_or(0.0);
        }
        let primal = scaling.solve(groups, normal, &forces)?;
        (start.lambda, start.f) = (primal.lambda, primal.f);
        start.s = groups.groups.iter().zip(&start.f).map(|(g, f)| g.slack(*f)).collect();
        let above = |(g, f): (&Group, &Triple)| f[0] - g.least.unwrap_or(0.0);
        start.s_least = groups.groups.iter().zip(&start.f).map(above).collect();
        start.s_cap = goal.cap - start.lambda;
        let mut costs = Right { x_lambda: -1.0, ..zero };
        for (k, x) in costs.x.iter_mut().enumerate() {
            x[0] = goal.slope(k, 0.0);
        }
        let dual = scaling.solve(groups, normal, &costs)?;
        start.y = dual.y.clone();
        (start.z, start.z_least, start.z_cap) = scaling.multipliers(groups, goal, &dual, &costs);
        into_the_cones(groups, &mut start.s, &mut start.s_least, &mut start.s_cap);
        into_the_cones(groups, &mut start.z, &mut start.z_least, &mut start.z_cap);
        Some(start)
    }

    /// What it misses.
    pub fn residuals(&self, groups: &Groups, goal: &Goal) -> Residuals {
        let mut y = groups.dead.clone();
        for (sum, live) in y.iter_mut().zip(&groups.live) {
            sum.iter_mut().zip(live).for_each(|(sum, live)| *sum += self.lambda * live);
        }
        let n = groups.groups.len();
        let (mut x, mut s, mut s_least) = (vec![[0.0; 3]; n], vec![[0.0; 3]; n], vec![0.0; n]);
        let mut gap = self.s_cap * self.z_cap;
        let mut scale: f64 = 1.0;
        for (k, group) in groups.groups.iter().enumerate() {
            group.act(self.f[k], &mut y);
            let felt = group.feel(&self.y);
            x[k][0] = felt[0] + goal.slope(k, self.f[k][0]);
            if group.shears {
                x[k] =
                    [x[k][0] - group.friction * self.z[k][0], felt[1] - self.z[k][1], felt[2] - self.z[k][2]];
                let slack = group.slack(self.f[k]);
                s[k] = std::array::from_fn(|i| self.s[k][i] - slack[i]);
                gap += dot(self.s[k], self.z[k]);
            }
            if let Some(least) = group.least {
                x[k][0] -= self.z_least[k];
                s_least[k] = self.s_least[k] - self.f[k][0] + least;
                gap += self.s_least[k] * self.z_least[k];
            }
            scale = scale.max(self.f[k][0].abs());
        }
        let power =
            groups.live.iter().flatten().zip(self.y.iter().flatten()).map(|(l, v)| l * v).sum::<f64>();
        Residuals {
            x,
            x_lambda: power - 1.0 + self.z_cap,
            y,
            s,
            s_least,
            s_cap: self.lambda + self.s_cap - goal.cap,
            gap,
            scale,
            multiplier: self.lambda,
        }
    }

    /// Takes a share of the state alone.
    pub fn shrink(&mut self, share: f64) {
        self.lambda *= share;
        self.f.as_flattened_mut().iter_mut().for_each(|f| *f *= share);
    }

    /// Number of cones.
    pub fn degree(&self, groups: &Groups) -> f64 {
        let of = |g: &Group| usize::from(g.shears) + usize::from(g.least.is_some());
        1.0 + groups.groups.iter().map(of).sum::<usize>() as f64
    }

    /// Takes a step.
    pub fn go(&mut self, d: &Direction, length: f64) {
        fn add<const N: usize>(to: &mut [[f64; N]], what: &[[f64; N]], length: f64) {
            to.as_flattened_mut().iter_mut().zip(what.as_flattened()).for_each(|(t, w)| *t += length * w);
        }
        self.lambda += length * d.lambda;
        add(&mut self.f, &d.f, length);
        add(&mut self.y, &d.y, length);
        add(&mut self.s, &d.s, length);
        add(&mut self.z, &d.z, length);
        self.s_least.iter_mut().zip(&d.s_least).for_each(|(t, w)| *t += length * w);
        self.z_least.iter_mut().zip(&d.z_least).for_each(|(t, w)| *t += length * w);
        self.s_cap += length * d.s_cap;
        self.z_cap += length * d.z_cap;
    }
}

/// Moves all by the same along the cones' axes until they are inside, if they are not.
fn into_the_cones(groups: &Groups, cones: &mut [Triple], least: &mut [f64], cap: &mut f64) {
    let mut outside = -*cap;
    for (k, group) in groups.groups.iter().enumerate() {
        if group.shears {
            outside = outside.max(-depth(cones[k]));
        }
        if group.least.is_some() {
            outside = outside.max(-least[k]);
        }
    }
    // Near the rim is as bad as outside.
    if outside > -1e-6 {
        let by = 1.0 + outside;
        cones.iter_mut().for_each(|u| u[0] += by);
        least.iter_mut().for_each(|u| *u += by);
        *cap += by;
    }
}
