//! The problem of a step as a fixed point of convex problems, each solved by Newton's method.
//!
//! For given `s = tan(phi) |u_T|` the velocities minimise a convex function, and impulses are projected onto Coulomb's cone (Acary, Cadoux,
//! Lemaréchal and Malick 2011). In the augmented Lagrangian `r = P(from - rho (u + s n))` its balance is the gradient of
//!
//! ```text
//! 1/2 (v - free) M (v - free) + sum of (|z|^2 - |z - P(z)|^2) / (2 rho),    z = from - rho (u + s n)
//! ```
//!
//! which is convex in `v` whatever `from`, `s` and `rho` are. Newton's method with a search along its direction therefore finds the one minimum, where
//! the method of Alart and Curnier, whose discs of friction move with the pressure, may have several balances or none in reach: walls whose
//! stones are wedged between others. Its matrix is symmetric and positive definite. `from` and `s` are brought up to date together.
//! One point that slides comes closer by `tan^2 / (1 + tan^2)` each time.

use crate::solve::bodies::Body;
use crate::solve::nonsmooth::newton::{Back, Kept, Lagrangian, Solved, Start, Trial};
use crate::solve::nonsmooth::{Friction, Problem, Residual};
use crate::solve::system::System;

/// Weights of the velocity over the inertia at a point: the first, by what it grows from update to update, and the last.
const FIRST: f64 = 1e3;
const GROWS: f64 = 10.0;
const MOST: f64 = 1e6;
/// A start with less left over than this is gone on from with the last weight.
const NEAR: f64 = 1e-5;
/// Newton's iterations between two updates end at this share of the residual before them, or of the tolerance.
const INNER: f64 = 0.03;
/// Changes of `s` are halved where the residual has grown by more than the factor.
const AWAY: f64 = 1.5;
const DAMPED: f64 = 0.5;
/// It ends when so many updates have come no closer.
const IDLE: u32 = 25;
/// Along a direction: the slope that is small enough beside that at its start, by how much a length is shortened, and tries.
const FLAT: f64 = 0.1;
const SHORTEST: f64 = 0.1;
const LONGEST: f64 = 0.9;
const TRIES: u32 = 12;

/// Solves a problem of rigid points from velocities and impulses nearby. What is reached in the end is in [`Solved::residual`]; `None` where a
/// matrix is singular.
pub(super) fn convex(
    problem: &Problem,
    (system, kept): (&mut System, &mut Kept),
    bodies: &[Body],
    start: Start<'_>,
    (tolerance, max_factorisations): (f64, u32),
) -> Option<Solved> {
    // The matrix is left as this method needs it.
    *kept = Kept::default();
    let mut from = start.impulses.to_vec();
    let mut v = start.velocities.to_vec();
    let mut opens: Vec<f64> = problem.points.iter().map(|point| point.opens(&v)).collect();
    let unit = problem.weight * problem.weight / problem.mean_mass;
    let first = Residual::of(problem, Friction::Coulomb, &v, &from).natural_map;
    let mut weight = if first < NEAR { MOST } else { FIRST };
    let (mut damping, mut before) = (1.0f64, first.min(1.0));
    let (mut factorisations, mut idle) = (0, 0);
    let mut best: Option<Solved> = None;
    loop {
        let share = INNER * before.clamp(tolerance, 1.0);
        let enough = 0.5 * unit * share * share;
        let lagrangian = Lagrangian { problem, from: &from, weight, back: Back::ToNearest(&opens) };
        let mut now = lagrangian.at(v);
        while now.energy > enough && factorisations < max_factorisations {
            lagrangian.assemble(system, bodies, &now);
            system.factorise(true)?;
            factorisations += 1;
            let change = system.solve(&now.unbalance);
            let next = along(&lagrangian, &now, &change);
            let is_stuck = next.energy >= now.energy && next.v == now.v;
            now = next;
            if is_stuck {
                break;
            }
        }
        let velocities = problem.velocities(&now.impulses);
        let residual = Residual::of(problem, Friction::Coulomb, &velocities, &now.impulses);
        let reached = best.as_ref().map_or(f64::INFINITY, |best| best.residual.natural_map);
        idle = if residual.natural_map < reached { 0 } else { idle + 1 };
        damping =
            if residual.natural_map < AWAY * before { (damping / DAMPED).min(1.0) } else { damping * DAMPED };
        before = residual.natural_map;
        if residual.natural_map < reached {
            best = Some(Solved { impulses: now.impulses.clone(), residual, factorisations, weight });
        }
        if before <= tolerance || idle >= IDLE || factorisations >= max_factorisations {
            return best.map(|best| Solved { factorisations, ..best });
        }
        for (opens, point) in opens.iter_mut().zip(&problem.points) {
            *opens += damping * (point.opens(&now.v) - *opens);
        }
        (from, v) = (now.impulses, now.v);
        weight = MOST.min(GROWS * weight);
    }
}

/// Goes against a change of the velocities to where the convex function hardly falls any more: its slope there is the unbalance times the
/// direction, and grows with the length.
fn along(lagrangian: &Lagrangian<'_>, now: &Trial, change: &[f64]) -> Trial {
    let slope = |trial: &Trial| -trial.unbalance.iter().zip(change).map(|(a, b)| a * b).sum::<f64>();
    let at = |length: f64| {
        let v = now.v.iter().zip(change).map(|(v, change)| v - length * change).collect();
        lagrangian.at(v)
    };
    let (first, mut length) = (slope(now), 1.0);
    let mut next = at(length);
    for _ in 0..TRIES {
        let here = slope(&next);
        // Where it still falls it has fallen all the way.
        if here <= -FLAT * first {
            break;
        }
        // Where the slope would be zero if it were straight.
        length *= (-first / (here - first)).clamp(SHORTEST, LONGEST);
        next = at(length);
    }
    next
}
