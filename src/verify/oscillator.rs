//! A mechanism as an oscillator of one degree of freedom.

use crate::math::STANDARD_GRAVITY;

/// A stone that takes part in a mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving {
    /// Its weight (N).
    pub weight: f64,
    /// How far its centroid begins to move along the load, in any unit that all stones share.
    pub delta: f64,
}

/// The oscillator that a mechanism is taken for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// Participating mass `M*` (kg).
    pub mass: f64,
    /// `e*`: that mass as a share of the mass of all stones that move; 1 where all move alike.
    pub share: f64,
    /// Displacement of the oscillator for each metre that the control point moves.
    pub per_control: f64,
}

impl Oscillator {
    /// Of the stones that move, and how far the control point does; `None` where nothing moves along the load.
    pub fn of(moving: &[Moving], control: f64) -> Option<Oscillator> {
        let sum = |of: fn(&Moving) -> f64| moving.iter().map(of).fold(0.0, |a, x| a + x);
        let weight = sum(|m| m.weight);
        let first = sum(|m| m.weight * m.delta);
        let second = sum(|m| m.weight * m.delta * m.delta);
        let is_one = first > 0.0 && control > 0.0 && second.is_finite();
        is_one.then(|| Oscillator {
            mass: first * first / (STANDARD_GRAVITY * second),
            share: first * first / (weight * second),
            per_control: second / (control * first),
        })
    }

    /// The spectral acceleration (m/s^2) that a multiplier of the weight stands for, by a confidence factor.
    pub fn acceleration(&self, multiplier: f64, confidence: f64) -> f64 {
        multiplier * STANDARD_GRAVITY / (self.share * confidence)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stones_that_move_alike_take_part_whole() {
        let stones = [Moving { weight: 3.0, delta: 0.5 }, Moving { weight: 7.0, delta: 0.5 }];
        let found = Oscillator::of(&stones, 0.5).expect("it moves");
        assert!((found.share - 1.0).abs() < 1e-15, "{found:?}");
        assert!((found.per_control - 1.0).abs() < 1e-15, "{found:?}");
        assert!((found.mass * STANDARD_GRAVITY - 10.0).abs() < 1e-12, "{found:?}");
    }

    /// Two stones, the upper one of which moves three times as far: e* = (1 + 3)^2 / (2 (1 + 9)) = 0.8, d = d_C 10 / (3 4).
    #[test]
    fn stones_that_move_apart_take_part_in_part() {
        let stones = [Moving { weight: 1.0, delta: 1.0 }, Moving { weight: 1.0, delta: 3.0 }];
        let found = Oscillator::of(&stones, 3.0).expect("it moves");
        assert!((found.share - 0.8).abs() < 1e-15, "{found:?}");
        assert!((found.per_control - 10.0 / 12.0).abs() < 1e-15, "{found:?}");
        assert!((found.acceleration(0.2, 1.35) - 0.2 * STANDARD_GRAVITY / (0.8 * 1.35)).abs() < 1e-12);
    }

    #[test]
    fn what_does_not_move_along_the_load_is_no_oscillator() {
        assert_eq!(Oscillator::of(&[Moving { weight: 1.0, delta: 0.0 }], 1.0), None);
        assert_eq!(Oscillator::of(&[], 1.0), None);
    }
}
