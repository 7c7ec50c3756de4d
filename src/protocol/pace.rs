//! How fast a wall moves along its load path: the sign of a limit point.

/// A wall that moves so many times faster along its path than at the start has come to its limit point: near a quadratic
/// limit the pace grows as one over the root of the distance, 10 at a hundredth of the way.
const SOFTENED: f64 = 10.0;
/// And over its last, shortened steps so many times faster than over the last full one: a solver that has lost its way
/// stops where nothing grows.
const QUICKENED: f64 = 2.0;

/// A wall that comes to rest so many times further away than its last pace says has leapt to another equilibrium, or near its
/// limit point: an equilibrium far from the last one is no proof that the wall stands.
const LEAPT: f64 = 20.0;

/// How fast the wall moves along its path, from rest to rest.
#[derive(Default)]
pub(super) struct Pace {
    level: f64,
    /// Largest movement of a block per level (m) over the first interval, and over the last.
    first: Option<f64>,
    last: f64,
    /// The same over the last full step.
    full: f64,
}

impl Pace {
    /// Notes how far (m) the wall has moved to a level from the rest before; `step` is a full step.
    pub(super) fn note(&mut self, level: f64, moved: f64, step: f64) {
        if level > self.level {
            self.last = moved / (level - self.level);
            self.first.get_or_insert(self.last);
            // A hundredth for rounding.
            if level - self.level > 0.99 * step {
                self.full = self.last;
            }
            self.level = level;
        }
    }

    /// Whether a wall that has moved so far (m) to a level has leapt there.
    pub(super) fn is_leap(&self, level: f64, moved: f64) -> bool {
        self.first.is_some() && moved > LEAPT * self.last * (level - self.level)
    }

    /// Whether the wall has become so much softer that the path is at its limit point, where its pace grows beyond all
    /// bounds.
    pub(super) fn is_at_limit(&self) -> bool {
        self.first.is_some_and(|first| self.last > SOFTENED * first) && self.last > QUICKENED * self.full
    }
}
