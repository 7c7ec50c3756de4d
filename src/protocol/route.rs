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
