//! How a wall falls without slip, as far as its mechanism shows it.

use crate::math::Vec3;
use crate::render::picture::Stone;
use crate::verb::analyse::state::State;
use crate::verb::wall::condition::Condition;

/// Stones move as one where none leaves the movement of the others by this share of the fastest.
const AS_ONE: f64 = 0.1;

/// A way to fall on which friction does no work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fall {
    /// What moves turns as one rigid body, and no joint slips.
    OverturnsAsOne,
    /// Several bodies turn, and no joint slips.
    TurnsWithoutSlip,
}

impl Fall {
    /// Of a wall that a solver brought down, with the blocks that move; `None` where it is none of these ways.
    pub fn of(state: &State, moving: &[usize]) -> Option<Fall> {
        if !state.falls || moving.is_empty() {
            return None;
        }
        // Joints between stones of one body stay closed.
        let works = || state.conditions.iter().filter(|of| matches!(of, Condition::Hinge | Condition::Slip));
        let slips = works().filter(|of| **of == Condition::Slip).count();
        match (is_one_body(&state.stones, moving), slips, works().count()) {
            (_, _, 0) => None,
            (true, 0, _) => Some(Fall::OverturnsAsOne),
            (false, 0, _) => Some(Fall::TurnsWithoutSlip),
            _ => None,
        }
    }

    /// Why friction does not matter to a wall that falls so.
    pub fn without_friction(self, is_whole: bool) -> String {
        let what = if is_whole { "the wall" } else { "what moves" };
        match self {
            Fall::OverturnsAsOne => format!("{what} overturns as one body"),
            Fall::TurnsWithoutSlip => format!("{what} turns about its joints, and none slips"),
        }
    }
}

/// Whether stones move as parts of one rigid body.
fn is_one_body(stones: &[Stone], moving: &[usize]) -> bool {
    let centroid = |stone: &Stone| stone.shape.mass_properties().centroid;
    let lead = &stones[moving[0]];
    let (origin, own) = (centroid(lead), lead.movement);
    let carried = |point: &Vec3| own.shift + own.turn.cross(&(point - origin));
    let size = |stone: &Stone| 0.5 * stone.shape.diameter();
    let moved = || moving.iter().map(|&id| &stones[id]);
    let fastest = moved()
        .map(|stone| stone.movement.shift.norm() + stone.movement.turn.norm() * size(stone))
        .fold(0.0, f64::max);
    moved().all(|stone| {
        let off = (stone.movement.shift - carried(&centroid(stone))).norm();
        off + (stone.movement.turn - own.turn).norm() * size(stone) < AS_ONE * fastest
    })
}
