//! Does a wall stand by its weight, or only by forces that no weight causes?
//!
//! Limit analysis lets joints press as hard as it helps. A bar between two vertical walls, on nothing, stands in it: clamped
//! by a pressure that balances itself (a self-stress), its friction carries it. Nothing says that such a pressure is there;
//! of stones that were laid one on another without force it is not.
//!
//! So pressures are let go. Of all states at rest the one with the least sum of pressures is taken; each contact's shear is
//! then limited to what that pressure bears, and the pressures are made as small as they can be again. Pressure that the
//! weight causes stays, whatever the shear does, and soon nothing changes. Pressure that only served to raise the friction
//! goes, the friction with it, and what it held falls.

use crate::solve::limit::analysis::{Analysis, Answer, Applied};
use crate::solve::limit::loads::Wrench;
use crate::solve::limit::program::Program;
use crate::solve::limit::strength::Strength;
use crate::solve::limit::{BlockMotion, Loads};

/// What the sum of all pressures costs at most, in shares of the load: little, as the load comes first.
const COST: f64 = 1e-3;
/// A wall that bears this share of its weight bears it: well above what the cost leaves undone, well below a block of a
/// thousand, as what falls takes all of the load's share with it.
const BORNE: f64 = 0.99;
/// Shear is limited to a little more than the last pressure bears, so that a state that stays is not on the rim of what is
/// possible.
const AMPLE: f64 = 1.0 + 1e-4;
/// A fall of the sum of pressures by less than this share of a block's weight, and this share of itself, is none.
const SAME: (f64, f64) = (0.01, 1e-5);
/// Rounds at least and at most. A clamp is gone in one round and what it held falls in the next, however little of the sum of a
/// great wall it was.
const ROUNDS: (u32, u32) = (3, 12);

impl Analysis {
    /// How the blocks move that stand under the dead loads only by forces which these do not cause; `None` where the wall stands
    /// without such forces, or does not stand.
    pub fn self_stressed(&self, loads: &Loads) -> Option<Vec<BlockMotion>> {
        let applied = self.applied(loads);
        let rest = self.at_rest(&applied);
        if !rest.capped || !rest.is_good() || self.stands_by_pressure_alone(&applied) {
            return None;
        }
        let pressure = self.cost_of_pressure(&rest);
        let mut state = self.least_pressure(&applied, &self.strengths, pressure);
        for round in 1..=ROUNDS.1 {
            let mut strengths = self.cylinders(&state.solved.forces);
            strengths.iter_mut().for_each(|s| s.cohesion *= AMPLE);
            let next = self.least_pressure(&applied, &strengths, pressure);
            if !next.accuracy.accepts_state() {
                return None;
            }
            if next.solved.multiplier < BORNE {
                return Some(next.mechanism);
            }
            let (before, after) = (sum_of_pressures(&state), sum_of_pressures(&next));
            if round >= ROUNDS.0 && after >= before - SAME.0 * self.blocks.unit - SAME.1 * before {
                return None;
            }
            state = next;
        }
        None
    }

    /// Whether there is a state at rest without any shear: friction then holds nothing.
    fn stands_by_pressure_alone(&self, applied: &Applied) -> bool {
        let smooth = |own: &Strength| {
            if own.bonded { *own } else { Strength { friction: 0.0, cohesion: 0.0, ..*own } }
        };
        let strengths: Vec<Strength> = self.strengths.iter().map(smooth).collect();
        let none = vec![Wrench::default(); applied.dead.len()];
        let program = self.program(&none, &applied.dead, &applied.axes, &strengths, 1.0);
        let answer = self.answer(&Program { enough: true, ..program });
        answer.capped && answer.accuracy.accepts_state()
    }

    /// What a normal force of one unit costs beside a state: little in all.
    pub(super) fn cost_of_pressure(&self, state: &Answer) -> f64 {
        COST * self.blocks.unit / sum_of_pressures(state).max(self.blocks.unit)
    }

    /// As much of the dead loads as can be borne, with as little pressure as that needs.
    pub(super) fn least_pressure(&self, applied: &Applied, strengths: &[Strength], pressure: f64) -> Answer {
        let none = vec![Wrench::default(); applied.dead.len()];
        let program = self.program(&none, &applied.dead, &applied.axes, strengths, 1.0);
        self.answer(&Program { pressure, ..program })
    }
}

/// The sum of all normal forces (N).
fn sum_of_pressures(answer: &Answer) -> f64 {
    answer.solved.forces.iter().map(|f| f[0].max(0.0)).sum()
}
