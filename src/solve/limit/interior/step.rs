//! A step of the method: the scaling where it is, the direction, and how far it goes.

use crate::solve::limit::interior::cone::{Second, Triple, product, quotient};
use crate::solve::limit::interior::groups::{Group, Groups, SIX, Six};
use crate::solve::limit::interior::iterate::{Iterate, Residuals};
use crate::solve::limit::interior::normal::Normal;
use crate::solve::limit::interior::{Goal, SHORT};

/// Refinements of a solution of the normal equations, and the miss of equilibrium (relative to what is asked) that needs none.
const REFINED: (u32, f64) = (3, 1e-13);

/// Changes of an iterate.
#[derive(Clone, Default)]
pub(super) struct Direction {
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

/// Right-hand sides, with the sign of residuals; `q` are those of the cones once the slacks are eliminated.
#[derive(Clone)]
pub(super) struct Right {
    pub x: Vec<Triple>,
    pub x_lambda: f64,
    pub y: Vec<Six>,
    pub q: Vec<Triple>,
    pub q_least: Vec<f64>,
    pub q_cap: f64,
}

impl Right {
    pub fn zero(groups: usize, blocks: usize) -> Right {
        Right {
            x: vec![[0.0; 3]; groups],
            x_lambda: 0.0,
            y: vec![[0.0; SIX]; blocks],
            q: vec![[0.0; 3]; groups],
            q_least: vec![0.0; groups],
            q_cap: 0.0,
        }
    }
}

/// The scaling of all cones at an iterate.
pub(super) struct Scaling {
    cones: Vec<Second>,
    /// `W` and `lambda` of the half-lines.
    least: Vec<[f64; 2]>,
    cap: [f64; 2],
    /// What a group's normal force has in `M` beside the friction cone.
    stiff: Vec<f64>,
    /// `M^-1` by group.
    pub inverses: Vec<[Triple; 3]>,
}

impl Group {
    /// Slack of a force in the friction cone.
    pub fn slack(&self, f: Triple) -> Triple {
        [self.cohesion + self.friction * f[0], f[1], f[2]]
    }

    /// `M^-1` of the group, where `stiff` is what its normal force has beside the cone.
    fn inverse(&self, cone: &Second, stiff: f64) -> [Triple; 3] {
        if !self.shears {
            return [[1.0 / stiff, 0.0, 0.0], [0.0; 3], [0.0; 3]];
        }
        if self.friction == 0.0 {
            let [[a, b], [c, d]] = cone.sliding();
            return [[1.0 / stiff, 0.0, 0.0], [0.0, a, b], [0.0, c, d]];
        }
        let mut inverse = cone.squared();
        inverse[0] = inverse[0].map(|x| x / self.friction);
        inverse.iter_mut().for_each(|row| row[0] /= self.friction);
        if stiff > 0.0 {
            let first = inverse[0];
            let share = stiff / (1.0 + stiff * first[0]);
            for (row, of) in inverse.iter_mut().zip(first) {
                (0..3).for_each(|k| row[k] -= share * of * first[k]);
            }
        }
        inverse
    }
}

/// `W` and `lambda` of a half-line.
fn half_line(s: f64, z: f64) -> Option<[f64; 2]> {
    (s > 0.0 && z > 0.0).then(|| [(s / z).sqrt(), (s * z).sqrt()])
}

impl Scaling {
    /// That does nothing.
    pub fn unit(groups: &Groups) -> Scaling {
        let n = groups.groups.len();
        let stiff: Vec<f64> =
            groups.groups.iter().map(|g| if g.least.is_some() { 1.0 } else { 0.0 }).collect();
        let inverse = |(g, stiff): (&Group, &f64)| g.inverse(&Second::UNIT, *stiff);
        Scaling {
            cones: vec![Second::UNIT; n],
            least: vec![[1.0, 1.0]; n],
            cap: [1.0, 1.0],
            inverses: groups.groups.iter().zip(&stiff).map(inverse).collect(),
            stiff,
        }
    }

    /// At an iterate; `None` when it has left a cone.
    pub fn of(groups: &Groups, goal: &Goal, at: &Iterate) -> Option<Scaling> {
        let mut scaling = Scaling::unit(groups);
        scaling.cap = half_line(at.s_cap, at.z_cap)?;
        for (k, group) in groups.groups.iter().enumerate() {
            let mut stiff = if k < goal.near.len() { goal.weight } else { 0.0 };
            if group.least.is_some() {
                scaling.least[k] = half_line(at.s_least[k], at.z_least[k])?;
                stiff += 1.0 / (scaling.least[k][0] * scaling.least[k][0]);
            }
            if group.shears {
                scaling.cones[k] = Second::of(at.s[k], at.z[k])?;
            }
            scaling.stiff[k] = stiff;
            scaling.inverses[k] = group.inverse(&scaling.cones[k], stiff);
        }
        Some(scaling)
    }

    /// Forces, multiplier and velocities of a direction; refined, as normal equations lose digits.
    pub fn solve(&self, groups: &Groups, normal: &Normal, right: &Right) -> Option<Direction> {
        let stiff = 1.0 / (self.cap[0] * self.cap[0]);
        let u_lambda = -right.x_lambda - stiff * right.q_cap;
        let full = normal.solve(&groups.live);
        let border = stiff + power(&groups.live, &full);
        let mut found = Direction {
            f: (0..groups.groups.len()).map(|k| self.alone(k, &groups.groups[k], right)).collect(),
            y: vec![[0.0; SIX]; right.y.len()],
            ..Direction::default()
        };
        let asked = right.y.iter().flatten().fold(1e-300, |most: f64, x| most.max(x.abs()));
        for round in 0..=REFINED.0 {
            // What is still missing of equilibrium.
            let mut missing = right.y.clone();
            for (sum, live) in missing.iter_mut().zip(&groups.live) {
                sum.iter_mut().zip(live).for_each(|(sum, live)| *sum += found.lambda * live);
            }
            groups.groups.iter().zip(&found.f).for_each(|(group, f)| group.act(*f, &mut missing));
            let worst = missing.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
            if !worst.is_finite() {
                return None;
            }
            if round > 0 && worst <= REFINED.1 * asked {
                break;
            }
            let mut y = normal.solve(&missing);
            let met = stiff * found.lambda + power(&groups.live, &found.y);
            let lambda = (u_lambda - met - power(&groups.live, &y)) / border;
            for (y, full) in y.iter_mut().zip(&full) {
                y.iter_mut().zip(full).for_each(|(y, full)| *y += lambda * full);
            }
            found.lambda += lambda;
            for ((f, group), inverse) in found.f.iter_mut().zip(&groups.groups).zip(&self.inverses) {
                let force = times(inverse, group.feel(&y));
                (0..3).for_each(|i| f[i] -= force[i]);
            }
            found.y.as_flattened_mut().iter_mut().zip(y.as_flattened()).for_each(|(sum, y)| *sum += y);
        }
        Some(found)
    }

    /// The force of a group that no block moves: `M^-1 u`, written so that what is large in `u` never appears.
    fn alone(&self, k: usize, group: &Group, right: &Right) -> Triple {
        let (x, q, stiff) = (right.x[k], right.q[k], self.stiff[k]);
        let least = if group.least.is_some() {
            right.q_least[k] / (self.least[k][0] * self.least[k][0])
        } else {
            0.0
        };
        if group.shears && group.friction > 0.0 {
            let normal = q[0] / group.friction;
            let rest = times(&self.inverses[k], [least - stiff * normal - x[0], -x[1], -x[2]]);
            return [normal + rest[0], q[1] + rest[1], q[2] + rest[2]];
        }
        let mut force = times(&self.inverses[k], [least - x[0], -x[1], -x[2]]);
        if group.shears {
            let w = self.cones[k].w;
            let bend = 2.0 * w[0] * q[0] / (2.0 * w[0] * w[0] - 1.0);
            (1..3).for_each(|i| force[i] += q[i] - bend * w[i]);
        }
        force
    }

    /// Multipliers that belong to a direction. `W^-2 (G dx + q)` loses all digits where a contact slides, at the rim of its
    /// cone; the flow rule gives them without loss. What it leaves open where the normal force has no cone or two is had
    /// from the rest.
    pub fn multipliers(
        &self,
        groups: &Groups,
        goal: &Goal,
        d: &Direction,
        right: &Right,
    ) -> (Vec<Triple>, Vec<f64>, f64) {
        let n = groups.groups.len();
        let (mut z, mut z_least) = (vec![[0.0; 3]; n], vec![0.0; n]);
        for (k, group) in groups.groups.iter().enumerate() {
            let (mu, q, felt) = (group.friction, right.q[k], group.feel(&d.y));
            let flow: Triple = std::array::from_fn(|i| right.x[k][i] + felt[i]);
            let weight = if k < goal.near.len() { goal.weight } else { 0.0 };
            let normal = flow[0] + weight * d.f[k][0];
            if !group.shears {
                z_least[k] = normal;
                continue;
            }
            let (first, rest) = self.cones[k].first_by_rest();
            let known = first * q[0] + rest[0] * flow[1] + rest[1] * flow[2];
            let z0 = if mu == 0.0 {
                z_least[k] = normal;
                known
            } else {
                if group.least.is_some() {
                    let (line, cone) = (1.0 / (self.least[k][0] * self.least[k][0]), mu * mu * first);
                    let pressed = right.q_least[k] * (cone + weight) - mu * known + flow[0];
                    z_least[k] = line * pressed / (cone + line + weight);
                }
                (normal - z_least[k]) / mu
            };
            z[k] = [z0, flow[1], flow[2]];
        }
        (z, z_least, -right.x_lambda - power(&groups.live, &d.y))
    }

    /// The direction whose products of slack and multiplier change by `products`.
    fn direction(
        &self,
        groups: &Groups,
        goal: &Goal,
        normal: &Normal,
        residuals: &Residuals,
        products: &(Vec<Triple>, Vec<f64>, f64),
    ) -> Option<Direction> {
        let n = groups.groups.len();
        let mut right = Right {
            x: residuals.x.clone(),
            x_lambda: residuals.x_lambda,
            y: residuals.y.clone(),
            q: vec![[0.0; 3]; n],
            q_least: vec![0.0; n],
            q_cap: residuals.s_cap + self.cap[0] * products.2 / self.cap[1],
        };
        for (k, group) in groups.groups.iter().enumerate() {
            if group.shears {
                let cone = &self.cones[k];
                let asked = cone.scale(quotient(products.0[k], cone.lambda));
                right.q[k] = std::array::from_fn(|i| residuals.s[k][i] + asked[i]);
            }
            let [w, lambda] = self.least[k];
            right.q_least[k] = residuals.s_least[k] + w * products.1[k] / lambda;
        }
        let mut d = self.solve(groups, normal, &right)?;
        (d.z, d.z_least, d.z_cap) = self.multipliers(groups, goal, &d, &right);
        d.s = vec![[0.0; 3]; n];
        d.s_least = vec![0.0; n];
        for (k, group) in groups.groups.iter().enumerate() {
            let (f, r) = (d.f[k], residuals.s[k]);
            d.s[k] = [group.friction * f[0] - r[0], f[1] - r[1], f[2] - r[2]];
            d.s_least[k] = f[0] - residuals.s_least[k];
        }
        d.s_cap = -residuals.s_cap - d.lambda;
        Some(d)
    }

    /// A direction's slacks and multipliers in the scaled space, group by group.
    fn scaled(&self, k: usize, d: &Direction) -> (Triple, Triple) {
        (self.cones[k].unscale(d.s[k]), self.cones[k].scale(d.z[k]))
    }

    /// The largest step that stays in all cones.
    fn largest_step(&self, groups: &Groups, d: &Direction) -> f64 {
        let half = |[w, lambda]: [f64; 2], s: f64, z: f64| {
            let (s, z) = (s / (w * lambda), z * w / lambda);
            1.0 / (-s).max(-z).max(f64::MIN_POSITIVE)
        };
        let mut step = half(self.cap, d.s_cap, d.z_cap);
        for (k, group) in groups.groups.iter().enumerate() {
            if group.shears {
                let (s, z) = self.scaled(k, d);
                step = step.min(self.cones[k].largest_step(s)).min(self.cones[k].largest_step(z));
            }
            if group.least.is_some() {
                step = step.min(half(self.least[k], d.s_least[k], d.z_least[k]));
            }
        }
        step
    }

    /// What the products of slack and multiplier are to change by: to `centre`, past what the predictor does to them.
    fn products(
        &self,
        groups: &Groups,
        centre: f64,
        predictor: Option<&Direction>,
    ) -> (Vec<Triple>, Vec<f64>, f64) {
        let half = |[w, lambda]: [f64; 2], d: Option<(f64, f64)>| {
            centre - lambda * lambda - d.map_or(0.0, |(s, z)| (s / w) * (z * w))
        };
        let n = groups.groups.len();
        let (mut cones, mut least) = (vec![[0.0; 3]; n], vec![0.0; n]);
        for (k, group) in groups.groups.iter().enumerate() {
            if group.shears {
                let lambda = self.cones[k].lambda;
                let own = product(lambda, lambda);
                let past = predictor.map_or([0.0; 3], |d| {
                    let (s, z) = self.scaled(k, d);
                    product(s, z)
                });
                cones[k] = std::array::from_fn(|i| if i == 0 { centre } else { 0.0 } - own[i] - past[i]);
            }
            if group.least.is_some() {
                least[k] = half(self.least[k], predictor.map(|d| (d.s_least[k], d.z_least[k])));
            }
        }
        (cones, least, half(self.cap, predictor.map(|d| (d.s_cap, d.z_cap))))
    }
}

/// Predictor and corrector: the direction, and how far to go along it.
pub(super) fn directions(
    groups: &Groups,
    goal: &Goal,
    normal: &Normal,
    scaling: &Scaling,
    at: &Iterate,
    residuals: &Residuals,
) -> Option<(Direction, f64)> {
    let predictor =
        scaling.direction(groups, goal, normal, residuals, &scaling.products(groups, 0.0, None))?;
    let reach = scaling.largest_step(groups, &predictor).min(1.0);
    let left = 1.0 - reach;
    let centre = left * left * left * residuals.gap / at.degree(groups);
    let products = scaling.products(groups, centre, Some(&predictor));
    let direction = scaling.direction(groups, goal, normal, residuals, &products)?;
    let length = (SHORT * scaling.largest_step(groups, &direction)).min(1.0);
    length.is_finite().then_some((direction, length))
}

/// A symmetric matrix times a vector.
fn times(matrix: &[Triple; 3], by: Triple) -> Triple {
    matrix.map(|row| row[0] * by[0] + row[1] * by[1] + row[2] * by[2])
}

/// Power of loads on velocities.
fn power(loads: &[Six], velocities: &[Six]) -> f64 {
    loads.iter().flatten().zip(velocities.iter().flatten()).map(|(l, v)| l * v).sum()
}
