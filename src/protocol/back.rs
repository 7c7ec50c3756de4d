//! The way back: what becomes of a wall whose load goes back to level 0.

use crate::protocol::path::LoadPath;
use crate::solve::{Equilibrate, Status};

/// A step back to level 0 is halved down to this share of a full one.
const SHORTEST: f64 = 0.125;

/// The wall at level 0, to which the load has gone back from a state at rest: in full steps or, where no equilibrium is found,
/// shorter ones; `None` where that does not help. Adds the solver's steps to `spent`.
pub(super) fn back_to_0<'a, S: Equilibrate<'a>>(
    from: &S,
    level: f64,
    path: &LoadPath,
    spent: &mut u64,
) -> Option<S> {
    let full_step = path.higher(0.0, 1);
    let (mut state, mut at, mut step) = (from.clone(), level, full_step);
    while at > 0.0 {
        let lower = (at - step).max(0.0);
        let mut next = state.clone();
        let (gravity, factor) = path.loads(lower);
        next.set_loads(gravity, factor);
        // It may have come far, and goes back as far.
        let settled = next.settle(&mut |_| false);
        *spent += settled.steps;
        if settled.status == Status::Equilibrium {
            (state, at) = (next, lower);
            step = (2.0 * step).min(full_step);
        } else if step <= SHORTEST * full_step {
            return None;
        } else {
            step *= 0.5;
        }
    }
    Some(state)
}
