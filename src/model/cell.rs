//! A periodic cell.

use crate::math::Vec3;
use crate::model::Block;

/// Stones that fill a plate of constant thickness when they are repeated along two directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The stones; those at the border reach across it as wholes.
    pub blocks: Vec<Block>,
    /// The two translations (x, z) in m that repeat them.
    pub lattice: [[f64; 2]; 2],
    /// Thickness of the plate (m), from y = -thickness/2 to thickness/2.
    pub thickness: f64,
}

impl Cell {
    /// Area of the cell in the plate's plane (m^2).
    pub fn area(&self) -> f64 {
        let [[ax, az], [bx, bz]] = self.lattice;
        (ax * bz - az * bx).abs()
    }

    /// The translation to the image that lies `p` and `q` periods away (m).
    pub fn shift(&self, p: i32, q: i32) -> Vec3 {
        let along = |k: usize| f64::from(p) * self.lattice[0][k] + f64::from(q) * self.lattice[1][k];
        Vec3::new(along(0), 0.0, along(1))
    }
}

/// A piece of a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    pub inside: Vec<Block>,
    pub around: Vec<Block>,
    pub thickness: f64,
    pub area: f64,
}
