//! The horizontal direction in which a wall bears least: even steps all around, then ever shorter ones about the lowest.

use rayon::prelude::*;

use crate::math::degrees;
use crate::model::{Level, Outcome};
use crate::protocol::Direction;

/// Directions that are tried first, evenly around.
const TRIED: usize = 24;
/// So many of those that bear less than both of their neighbours are looked at more closely, the lowest first.
const CLOSELY: usize = 3;
/// Steps (deg) are halved down to this.
const FINEST_DEG: f64 = 0.25;

/// What a wall bears in a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tried {
    /// From x+, counter-clockwise seen from above (deg).
    pub direction_deg: f64,
    /// Collapse angle (deg) or multiplier: 0 where it does not stand at rest; `None` where it does not fall or nothing was found.
    pub bears: Option<f64>,
}

/// All directions that were tried, ascending; `solve` says how a wall ends in one.
pub(crate) fn tried(solve: &(dyn Fn(Direction) -> Outcome + Sync)) -> Vec<Tried> {
    let try_all = |angles: Vec<f64>| -> Vec<Tried> {
        angles
            .into_par_iter()
            .map(|deg| Tried { direction_deg: deg, bears: bears(&solve(Direction::at(deg))) })
            .collect()
    };
    let step = 360.0 / TRIED as f64;
    let mut all = try_all((0..TRIED).map(|k| step * k as f64).collect());
    let value = |at: usize| all[at % TRIED].bears.unwrap_or(f64::INFINITY);
    let is_low = |at: &usize| value(*at) <= value(at + 1) && value(*at) <= value(at + TRIED - 1);
    let mut low: Vec<Tried> =
        (0..TRIED).filter(is_low).map(|at| all[at]).filter(|of| of.bears.is_some()).collect();
    low.sort_by(|a, b| key(a).total_cmp(&key(b)));
    for mut best in low.into_iter().take(CLOSELY) {
        let mut step = 0.5 * step;
        while step >= FINEST_DEG {
            let beside = try_all(vec![best.direction_deg - step, best.direction_deg + step]);
            all.extend(&beside);
            best = beside.into_iter().fold(best, |best, of| if key(&of) < key(&best) { of } else { best });
            step *= 0.5;
        }
    }
    all.iter_mut().for_each(|of| of.direction_deg = of.direction_deg.rem_euclid(360.0));
    all.sort_by(|a, b| a.direction_deg.total_cmp(&b.direction_deg));
    all.dedup_by(|a, b| a.direction_deg == b.direction_deg);
    all
}

/// The direction that bears least; `None` where it falls in none.
pub(crate) fn weakest(all: &[Tried]) -> Option<Tried> {
    let falls = all.iter().filter(|of| of.bears.is_some());
    falls.copied().reduce(|best, of| if key(&of) < key(&best) { of } else { best })
}

fn key(of: &Tried) -> f64 {
    of.bears.unwrap_or(f64::INFINITY)
}

/// The load at collapse (deg or multiplier): 0 where it does not stand at rest; `None` where it does not fall or nothing was found.
pub(crate) fn bears(outcome: &Outcome) -> Option<f64> {
    match outcome {
        Outcome::Collapsed { at: Level::Tilt(angle) } => Some(degrees(*angle)),
        // It falls before any load grows.
        Outcome::Collapsed { at: Level::Settlement(_) } => Some(0.0),
        Outcome::Collapsed { at } => Some(at.value()),
        Outcome::UnstableAtRest => Some(0.0),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::radians;

    /// A wall on a square: what it bears in a direction goes as the distance to an edge, and is least across the nearer ones.
    #[test]
    fn the_lowest_of_several_directions_is_found_within_a_quarter_of_a_degree() {
        let bears = |direction: Direction| {
            let off = |weakest: f64| (direction.angle_deg() - weakest + 540.0).rem_euclid(360.0) - 180.0;
            let at = [(37.3, 20.0), (221.6, 19.5)].map(|(deg, least)| least + 1e-3 * off(deg) * off(deg));
            Outcome::Collapsed { at: Level::Tilt(radians(at[0].min(at[1]))) }
        };
        let all = tried(&bears);
        let found = weakest(&all).unwrap();
        assert!((found.direction_deg - 221.6).abs() <= FINEST_DEG, "{found:?}");
        assert!((found.bears.unwrap() - 19.5).abs() < 1e-3);
        assert!(all.windows(2).all(|pair| pair[0].direction_deg < pair[1].direction_deg));
    }

    #[test]
    fn a_wall_that_falls_nowhere_has_no_weakest_direction_and_one_that_does_not_stand_bears_nothing() {
        assert_eq!(weakest(&tried(&|_| Outcome::Equilibrium)), None);
        for outcome in [Outcome::UnstableAtRest, Outcome::Collapsed { at: Level::Settlement(0.7) }] {
            let found = weakest(&tried(&|_| outcome.clone())).unwrap();
            assert_eq!(found.bears, Some(0.0));
        }
    }
}
