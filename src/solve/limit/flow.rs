//! Sliding without dilatancy: a fixed point of associative problems.
//!
//! After Gilbert, Casapulla and Ahmed (2006): each contact's cone is replaced by a cylinder, a fictitious cohesion equal to
//! the shear strength under the normal force of the state found so far, whose associative sliding has no dilatancy:
//!
//! ```text
//! |t_i| <= s_i,  n_i >= -T A_i        s_i = c A_i + n_i tan(phi)
//! ```
//!
//! We depart from the paper in three ways. Of all states that bear as much, a program takes the one nearest to the state so
//! far, or the forces of a statically indeterminate wall would wander for ever. The state so far is an average of states,
//! all of them in equilibrium, so it is too; where the multiplier swings, the newest counts for less. And the search begins
//! at the associative solution.
//!
//! It ends where the state so far obeys Coulomb's law and bears what the cylinders of its own pressures bear: then there is
//! a mechanism without dilatancy that stops it. Such a state obeys Coulomb's law, so its multiplier is not above the
//! associative one; but there are many of them, and which one is found depends on the start. Where the associative
//! solution stands to the end there is nothing to start from, and no search.
//!
//! The same is asked of the dead loads alone: how many times as much could be borne by the shear strength that they cause
//! themselves? A wall for which this is less than 1 slides at rest, even if dilating joints would wedge it in.

use crate::math::{compact, ends, within};
use crate::model::{Level, Outcome};
use crate::solve::limit::analysis::{Analysis, Answer, Applied};
use crate::solve::limit::loads::Wrench;
use crate::solve::limit::program::{Near, Program};
use crate::solve::limit::strength::Strength;
use crate::solve::limit::{FixedPoint, Flow, Limit};

/// Weight of the newest state at first, which is the most; the factors on it where the multiplier swings back and where it
/// does not, and its least.
const RELAXATION: (f64, f64, f64, f64) = (1.0, 0.7, 1.2, 0.1);
/// A change of the multiplier (relative) that is a swing.
const SWING: f64 = 1e-6;
/// What a distance of one block's weight in one normal force costs, in multipliers: little beside what matters of a
/// multiplier, much beside the accuracy of the solver.
const NEARNESS: f64 = 1e-5;
/// Change of the multiplier (relative) at rest.
const SAME_MULTIPLIER: f64 = 1e-5;
/// Excess of a contact's shear over Coulomb's law at rest, over the blocks' mean weight.
const SAME_STRENGTH: f64 = 1e-4;
/// The same excess beside a multiplier that has come to rest: a hundredth of one block's weight in one contact, among forces of which a
/// statically indeterminate wall has many.
const LITTLE_STRENGTH: f64 = 1e-2;
/// Programs that are solved at most, and how many of the last say between which multipliers a search without end goes.
const PATIENCE: (u32, usize) = (400, 20);
/// Shear strength (over the blocks' mean weight) of a contact without pressure: the cylinder needs an inside.
const FLOOR: f64 = 1e-6;
/// So many times the dead loads on the strength that they cause themselves are as good as any; and programs at most.
const PLENTY: (f64, u32) = (100.0, 30);

impl Analysis {
    /// The share of the dead loads, at most 1, that is borne without dilatancy by the strength that they cause; from a state
    /// at rest. Also the iterations spent.
    pub(crate) fn share_without_dilatancy(&self, applied: &Applied, rest: &Answer) -> (f64, u32) {
        let none = vec![Wrench::default(); applied.dead.len()];
        let (mut forces, mut last, mut spent) = (rest.solved.forces.clone(), 0.0, 0);
        for _ in 0..PLENTY.1 {
            let strengths = self.cylinders(&forces);
            let answer =
                self.answer(&self.program(&none, &applied.dead, &applied.axes, &strengths, PLENTY.0));
            spent += answer.solved.iterations;
            let share = answer.solved.multiplier;
            if answer.capped || !answer.accuracy.accepts_state() || share <= 0.0 {
                // What cannot be solved shows nothing: the search under load has the last word.
                return (if answer.capped || !answer.accuracy.accepts_state() { 1.0 } else { 0.0 }, spent);
            }
            if (share - last).abs() <= SAME_MULTIPLIER * share {
                return (if share >= 1.0 - SAME_MULTIPLIER { 1.0 } else { share }, spent);
            }
            last = share;
            forces = answer.solved.forces.iter().map(|f| f.map(|x| x / share)).collect();
        }
        (last.min(1.0), spent)
    }

    /// Looks for a state without dilatancy from the associative solution.
    pub(crate) fn without_dilatancy(
        &self,
        applied: &Applied,
        associative: Answer,
        before: u32,
        cap: f64,
        level: fn(f64) -> Level,
    ) -> Limit {
        let (mut state, mut spent) = (associative, before);
        let mut search = FixedPoint {
            iterations: 0,
            converged: false,
            change: 0.0,
            excess: f64::INFINITY,
            range: [state.solved.multiplier; 2],
        };
        let (mut weight, mut found) = (RELAXATION.0, Vec::new());
        while !search.converged && search.iterations < PATIENCE.0 {
            let strengths = self.cylinders(&state.solved.forces);
            let normal: Vec<f64> = state.solved.forces.iter().map(|f| f[0]).collect();
            let program = Program {
                near: Some(Near { weight: NEARNESS, normal: &normal }),
                ..self.program(&applied.dead, &applied.live, &applied.axes, &strengths, cap)
            };
            let next = self.answer(&program);
            spent += next.solved.iterations;
            if !next.accuracy.accepts_state() {
                state = next;
                break;
            }
            let size = next.solved.multiplier.abs().max(1e-3);
            let change = next.solved.multiplier - state.solved.multiplier;
            let swings = change * search.change < 0.0 && change.abs() > SWING * size;
            let factor = if swings { RELAXATION.1 } else { RELAXATION.2 };
            weight = (weight * factor).clamp(RELAXATION.3, RELAXATION.0);
            found.push(next.solved.multiplier);
            state = self.between(applied, state, next, weight, cap);
            search = FixedPoint { iterations: search.iterations + 1, change, excess: state.excess, ..search };
            search.converged = change.abs() <= SAME_MULTIPLIER * size && search.excess <= SAME_STRENGTH;
        }
        let last = &found[found.len().saturating_sub(PATIENCE.1)..];
        search.range = last.iter().fold(search.range, |[low, high], &x| {
            if last[0] == x && low == high { [x, x] } else { [low.min(x), high.max(x)] }
        });
        // The forces may wander on where the multiplier does not.
        search.converged |=
            state.accuracy.accepts_state() && is_at_rest(&search) && search.excess <= LITTLE_STRENGTH;
        let multiplier = state.solved.multiplier;
        let outcome = ending(&search, &state, level);
        let at_rest = outcome == Outcome::UnstableAtRest;
        // At rest the associative solution stood: what is below 0 by the search's own accuracy is 0.
        let multiplier = if at_rest { 0.0 } else { multiplier.max(0.0) };
        let mut limit = state.into_limit(outcome, multiplier, Flow::NonAssociative, spent);
        if matches!(limit.outcome, Outcome::NotConverged { .. }) {
            limit.between = Some(search.range.map(|x| x.max(0.0)));
        }
        limit.fixed_point = Some(search);
        limit
    }

    /// The mean of two states, the newer one with its weight and its mechanism.
    fn between(&self, applied: &Applied, older: Answer, newer: Answer, weight: f64, cap: f64) -> Answer {
        let mut solved = newer.solved;
        if weight < 1.0 {
            let mean = |new: &mut f64, old: f64| *new = old + weight * (*new - old);
            mean(&mut solved.multiplier, older.solved.multiplier);
            let old = older.solved.forces.as_flattened();
            solved.forces.as_flattened_mut().iter_mut().zip(old).for_each(|(new, &old)| mean(new, old));
            solved.pulls.iter_mut().zip(&older.solved.pulls).for_each(|(new, &old)| mean(new, old));
        }
        // The cylinders that stopped the mechanism: what it dissipates there is what its multiplier is made of.
        let strengths = self.cylinders(&older.solved.forces);
        self.audited(&self.program(&applied.dead, &applied.live, &applied.axes, &strengths, cap), solved)
    }

    /// The cylinders of all contacts under these forces.
    pub(crate) fn cylinders(&self, forces: &[[f64; 3]]) -> Vec<Strength> {
        let of = |(own, force): (&Strength, &[f64; 3])| {
            if own.bonded || !own.shears() {
                return *own;
            }
            let cohesion = (own.cohesion + own.friction * force[0]).max(FLOOR * self.blocks.unit);
            Strength { friction: 0.0, cohesion, ..*own }
        };
        self.strengths.iter().zip(forces).map(of).collect()
    }
}

/// Whether the last multipliers are the same within the accuracy of the search, so that there is one and no interval.
fn is_at_rest(search: &FixedPoint) -> bool {
    let [low, high] = search.range;
    search.iterations as usize >= PATIENCE.1 && high - low <= SAME_MULTIPLIER * high.abs().max(1e-3)
}

/// How the search ended.
fn ending(search: &FixedPoint, state: &Answer, level: fn(f64) -> Level) -> Outcome {
    let found = state.solved.multiplier;
    let [low, high] = search.range;
    if search.converged && found >= -SAME_MULTIPLIER {
        Outcome::Collapsed { at: level(found.max(0.0)) }
    } else if search.converged || (state.accuracy.accepts_state() && high < -SAME_MULTIPLIER) {
        // It slides on a table that leans back.
        Outcome::UnstableAtRest
    } else if state.accuracy.accepts_state() {
        Outcome::NotConverged {
            at: level(low.max(0.0)),
            unbalanced_ratio: state.accuracy.residual,
            why: format!(
                "no fixed point without dilatancy in {} programs: {}",
                search.iterations,
                match ends([low, high].map(|x| x.max(0.0))) {
                    Some([low, high]) if !is_at_rest(search) =>
                        format!("the last multipliers lie between {low} and {high}"),
                    _ => format!(
                        "the multiplier stays at {}, and a joint's shear exceeds its friction by {} of a block's weight",
                        within(low.max(0.0), SAME_MULTIPLIER * high.abs()),
                        compact(search.excess)
                    ),
                }
            ),
        }
    } else {
        state.not_converged(level(found.max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multipliers_that_are_the_same_leave_no_interval() {
        let search = |range: [f64; 2], iterations: u32| FixedPoint {
            iterations,
            converged: false,
            change: 0.0,
            excess: 1e-3,
            range,
        };
        assert!(is_at_rest(&search([0.293_829_8, 0.293_830_1], 400)));
        assert!(!is_at_rest(&search([0.2938, 0.2939], 400)));
        // Few programs show no rest.
        assert!(!is_at_rest(&search([0.293_83; 2], 3)));
    }
}
