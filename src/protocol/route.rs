//! Which level is tried next: up by full steps, back and halved after a failure until the bracket is reached.

use crate::protocol::path::LoadPath;

/// The way along a load path, in full steps; halves and their halves are exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Route {
    path: LoadPath,
    /// Last level borne.
    low: f64,
    /// Lowest level known to fail, until it proves to be borne after all.
    high: Option<f64>,
    /// Length of the next step when nothing is known to fail.
    step: f64,
}

impl Route {
    /// From level 0.
    pub fn new(path: LoadPath) -> Route {
        Route { path, low: 0.0, high: None, step: 1.0 }
    }

    /// The next level to try; `None` at the end of the path.
    pub fn next(&self) -> Option<f64> {
        match self.high {
            None if self.path.after(self.low) >= self.path.end => None,
            None => Some(self.low + self.step),
            Some(high) if self.is_bracketed(high) => Some(high),
            Some(high) => Some(0.5 * (self.low + high)),
        }
    }

    /// A level has been borne. One that had failed from further below is tried again from nearer by, and may be.
    pub fn borne(&mut self, at: f64) {
        match self.high {
            Some(high) if at < high => {}
            Some(_) => {
                self.high = None;
                self.step = at - self.low;
            }
            None => self.step = (2.0 * self.step).min(1.0),
        }
        self.low = at;
    }

    /// A level has failed. Whether that is the end: the bracket around the capacity is as narrow as asked for.
    pub fn failed(&mut self, at: f64) -> bool {
        self.high = Some(at);
        self.is_bracketed(at)
    }

    fn is_bracketed(&self, high: f64) -> bool {
        // One part in 10^9 for the rounding of steps that are a whole number of brackets.
        self.path.after(high) - self.path.after(self.low) <= self.path.bracket * (1.0 + 1e-9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::Direction;

    /// Walks the route of a wall that bears levels up to `capacity`; gives the levels tried, and the end if it fell.
    fn walked(path: LoadPath, capacity: f64) -> (Vec<f64>, Option<f64>) {
        let (mut route, mut tried) = (Route::new(path), vec![0.0]);
        while let Some(place) = route.next() {
            let level = path.after(place);
            tried.push(level);
            if level <= capacity {
                route.borne(place);
            } else if route.failed(place) {
                return (tried, Some(level));
            }
        }
        (tried, None)
    }

    #[test]
    fn the_step_is_halved_from_the_last_level_borne() {
        // Binary fractions: every level is exact.
        let path = LoadPath::multiplier(Direction::YPlus, 0.5, 4.0, 0.125);
        let (tried, fell) = walked(path, 1.3);
        assert_eq!(tried, [0.0, 0.5, 1.0, 1.5, 1.25, 1.375]);
        assert_eq!(fell, Some(1.375));
        // The level that had failed from further below is tried again from nearer by before it ends the climb.
        let (tried, fell) = walked(path, 1.4);
        assert_eq!(tried, [0.0, 0.5, 1.0, 1.5, 1.25, 1.375, 1.5]);
        assert_eq!(fell, Some(1.5));
        assert_eq!(walked(path, 5.0).1, None);
        // A service load is not refined, and its last step ends at the full load.
        assert_eq!(walked(LoadPath::factor(3), 0.5), (vec![0.0, 1.0 / 3.0, 2.0 / 3.0], Some(2.0 / 3.0)));
        assert_eq!(walked(LoadPath::factor(3), 2.0).0, [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]);
    }

    #[test]
    fn a_level_that_is_borne_after_all_lengthens_the_steps_again() {
        let path = LoadPath::multiplier(Direction::YPlus, 1.0, 8.0, 0.25);
        let mut route = Route::new(path);
        route.borne(1.0);
        assert!(!route.failed(2.0) && !route.failed(1.5));
        assert_eq!(route.next(), Some(1.25));
        route.borne(1.25);
        assert_eq!(route.next(), Some(1.5));
        route.borne(1.5);
        // From there on by a quarter, a half, and full steps.
        let mut levels = Vec::new();
        while let Some(place) = route.next() {
            levels.push(place);
            route.borne(place);
        }
        assert_eq!(levels[..4], [1.75, 2.25, 3.25, 4.25]);
        assert_eq!(levels.last().map(|last| path.after(*last)), Some(8.0));
    }
}
