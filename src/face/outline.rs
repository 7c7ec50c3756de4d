//! What a drawing or a picture shows of a wall's face: closed outlines.

use crate::shape::{Polygon, distance, moments, sides};

/// What an outline surrounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Part {
    /// A stone.
    #[default]
    Stone,
    /// A stone that goes through the wall: a header.
    Header,
    /// What the wall stands on, and what does not move.
    Ground,
    /// A hole in the wall: a door, a window. Nothing is there.
    Opening,
}

/// A closed line in the face of a wall: x to the right, z upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its name for messages: `stone 7`, `stone 12 (K3)`.
    pub name: String,
    /// Line of the file where it begins, from 1; 0 where lines do not matter.
    pub line: usize,
    /// What it surrounds.
    pub part: Part,
    /// Its corners in order, in the file's unit; the first one is not repeated at the end.
    pub points: Vec<[f64; 2]>,
}

impl Outline {
    /// Its length (in the unit of its points).
    pub fn perimeter(&self) -> f64 {
        sides(&self.points).map(|[from, to]| distance(from, to)).sum()
    }

    /// Its area, whichever way it runs (square of the unit of its points).
    pub fn area(&self) -> f64 {
        moments(&self.points).area.abs()
    }

    /// The convex polygon around it.
    pub fn hull(&self) -> Polygon {
        Polygon::around(self.points.clone())
    }
}
