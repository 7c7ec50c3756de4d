//! Sliding without dilatancy: a fixed point of associative problems.
//!
//! After Gilbert, Casapulla and Ahmed (2006): each contact's cone is replaced by a cylinder, a fictitious cohesion equal to
//! the shear strength under the normal force of the last solution, whose associative sliding has no dilatancy:
//!
//! ```text
//! |t_i| <= s_i,  n_i >= -T A_i        s_i <- s_i + w (c A_i + n_i tan(phi) - s_i)
//! ```
//!
//! until the multiplier and the strengths come to rest, or the multiplier alone has long been at rest while the forces of a
//! statically indeterminate wall still wander among states with the same multiplier. We depart from the paper in the under-relaxation `w` and in
//! starting from the associative solution. A state at rest obeys Coulomb's law, so its multiplier is not above the
//! associative one; but there are many such states, and which one is found depends on the start. Where the associative
//! solution stands to the end there is nothing to start from, and no search.

use crate::model::{Level, Outcome};
use crate::solve::limit::analysis::{Analysis, Answer, Applied};
use crate::solve::limit::strength::Strength;
use crate::solve::limit::{FixedPoint, Flow, Limit};

/// Weight of the new strength at first; the factor on it whenever the multiplier swings back, and its least.
const RELAXATION: (f64, f64, f64) = (0.5, 0.8, 0.05);
/// A change of the multiplier (relative) that is a swing.
const SWING: f64 = 1e-4;
/// Change of the multiplier (relative) at rest.
const SAME_MULTIPLIER: f64 = 1e-5;
/// Excess of a contact's shear over Coulomb's law at rest, over the blocks' mean weight.
const SAME_STRENGTH: f64 = 1e-4;
/// Change of the multiplier (relative), number of programs in a row, and excess, for the multiplier alone to be at rest.
const CALM: (f64, u32, f64) = (1e-5, 10, 0.05);
/// Programs that are solved at most.
const PATIENCE: u32 = 100;
/// Shear strength (over the blocks' mean weight) of a contact without pressure: the cylinder needs an inside.
const FLOOR: f64 = 1e-6;

impl Analysis {
    /// Looks for a state without dilatancy from the associative solution.
    pub(crate) fn without_dilatancy(
        &self,
        applied: &Applied,
        associative: Answer,
        before: u32,
        cap: f64,
        level: fn(f64) -> Level,
    ) -> Limit {
        let start = self.strengths.iter().zip(&associative.solved.forces);
        let mut strengths: Vec<Strength> =
            start.map(|(own, force)| self.cylinder(own, own, force, 1.0)).collect();
        let (mut answer, mut spent) = (associative, before);
        let mut search = FixedPoint { iterations: 0, converged: false, change: 0.0, excess: f64::INFINITY };
        let (mut calm, mut weight) = (0, RELAXATION.0);
        while !search.converged && search.iterations < PATIENCE {
            let next = self.largest(applied, &strengths, cap);
            spent += answer.solved.iterations;
            let size = next.solved.multiplier.abs().max(1e-3);
            let change = next.solved.multiplier - answer.solved.multiplier;
            if change * search.change < 0.0 && change.abs() > SWING * size {
                weight = (weight * RELAXATION.1).max(RELAXATION.2);
            }
            search = FixedPoint { iterations: search.iterations + 1, change, excess: next.excess, ..search };
            answer = next;
            if !answer.accuracy.accepts_state() {
                break;
            }
            calm = if change.abs() <= CALM.0 * size { calm + 1 } else { 0 };
            let at_rest = change.abs() <= SAME_MULTIPLIER * size && search.excess <= SAME_STRENGTH;
            search.converged = at_rest || (calm >= CALM.1 && search.excess <= CALM.2);
            for ((last, own), force) in strengths.iter_mut().zip(&self.strengths).zip(&answer.solved.forces) {
                *last = self.cylinder(own, last, force, weight);
            }
        }
        let found = answer.solved.multiplier;
        let mut limit = {
            let outcome = ending(&search, &answer, level(found));
            answer.into_limit(outcome, found, Flow::NonAssociative, spent)
        };
        limit.fixed_point = Some(search);
        limit
    }

    /// The cylinder of a contact whose own strength is `own` and whose last one was `last`, after a solution with this
    /// force.
    fn cylinder(&self, own: &Strength, last: &Strength, force: &[f64; 3], weight: f64) -> Strength {
        if own.bonded || !own.shears() {
            return *own;
        }
        let shear = (own.cohesion + own.friction * force[0]).max(FLOOR * self.blocks.unit);
        let cohesion = if weight < 1.0 { last.cohesion + weight * (shear - last.cohesion) } else { shear };
        Strength { friction: 0.0, cohesion, ..*own }
    }
}

/// How the search ended.
fn ending(search: &FixedPoint, answer: &Answer, at: Level) -> Outcome {
    if search.converged {
        Outcome::Collapsed { at }
    } else if answer.is_good() {
        Outcome::NotConverged {
            at,
            unbalanced_ratio: answer.accuracy.residual,
            why: format!(
                "no fixed point without dilatancy in {} programs: the multiplier last changed by {:.1e}",
                search.iterations, search.change
            ),
        }
    } else {
        answer.not_converged(at)
    }
}
