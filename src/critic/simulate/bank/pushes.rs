//! The push of a sheared wall over its drift, in numbers that hang smoothly on what it is made of.
//!
//! At small drifts walls answer in proportion, at large ones they bear hardly more: over the logarithm of the drift the logarithm of
//! the push is a smooth curve that bends once, and a few places tell it for all walls. What stiffens or weakens a wall by a factor adds
//! to it.

use crate::critic::simulate::bank::path::{NUMBERS, Path};
use crate::ensemble::Row;
use crate::math::{Monotone, exp, ln};
use crate::model::{Level, Outcome};
use crate::protocol::first_at;

/// Places at which a curve is given, as shares of the widest drift.
pub const SHARES: [f64; 9] = [0.0125, 0.025, 0.05, 0.09, 0.16, 0.28, 0.5, 0.75, 1.0];
/// Numbers of a curve: how far the wall goes, and a push at every place.
pub const PUSHED: usize = 1 + SHARES.len();
/// A wall that stands at the widest drift is taken to go so many times as far.
const STOOD: f64 = 2.0;
/// No wall falls before this share of the widest drift.
const LEAST: f64 = 1e-3;

impl Path {
    /// The path of a wall that was sheared to a widest drift: the logarithm of the drift at which it fell over the widest one, then of
    /// its push (N) at every place, when it first came there; beyond its fall the last one. `None` where it did not come to rest, or
    /// bore nothing.
    pub fn pushed(row: &Row, widest: f64) -> Option<Path> {
        let reach = match row.outcome {
            Outcome::Equilibrium => STOOD,
            Outcome::Collapsed { at: Level::Drift(drift) } => (drift / widest).max(LEAST),
            _ => return None,
        };
        let last = row.pushes().map(|(drift, _)| drift).fold(0.0, f64::max);
        let mut numbers = [0.0; NUMBERS];
        numbers[0] = ln(reach);
        for (number, share) in numbers[1..PUSHED].iter_mut().zip(SHARES) {
            let push = first_at(row.pushes(), f64::min(100.0 * share * widest, last))?;
            if push <= 0.0 {
                return None;
            }
            *number = ln(push);
        }
        Some(Path { numbers })
    }
}

/// The push of a wall over its drift.
#[derive(Clone, Debug)]
pub struct Pushes {
    /// The drift beyond which it has fallen.
    fall: f64,
    widest: f64,
    /// Over the logarithm of the share of the widest drift.
    curve: Monotone<[f64; SHARES.len()]>,
}

impl Pushes {
    /// Of the wall that has these [adding](Path::adding) numbers.
    pub fn of(adding: &[f64; NUMBERS], widest: f64) -> Pushes {
        let own = std::array::from_fn(|place| adding[1 + place]);
        Pushes { fall: widest * adding[0].max(LEAST), widest, curve: Monotone::through(SHARES.map(ln), own) }
    }

    /// Its push (N) at a drift; `None` where it has fallen.
    pub fn at(&self, drift: f64) -> Option<f64> {
        (drift <= self.fall).then(|| self.last_at(drift))
    }

    /// Its push (N) at a drift; where it has fallen, that at the fall.
    pub fn last_at(&self, drift: f64) -> f64 {
        let share = drift.min(self.fall) / self.widest;
        // Below the first place in proportion.
        let below = (share / SHARES[0]).min(1.0);
        below * exp(self.curve.at(ln(share.max(SHARES[0]))))
    }
}

#[cfg(test)]
mod tests;
