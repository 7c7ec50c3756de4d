//! A periodic cell: the stones that tile a plate when they are repeated.

use crate::math::Vec3;
use crate::model::Block;

/// Stones that tile a whole plate of masonry, without end along x and z, when they are shifted by all whole combinations of two
/// lattice vectors. Stones at the border are whole, so that they reach beyond the parallelogram of the lattice vectors; what
/// they lack on one side they have on the other.
///
/// The plate spans y = -`thickness` / 2 to `thickness` / 2.
///
/// ```
/// use pirca::math::Vec3;
/// use pirca::model::{Block, Cell, Support, Tag};
/// use pirca::shape::Polyhedron;
/// // The smallest cell of a half bond: one stone of 0.4 x 0.3 x 0.2 m.
/// let shape = Polyhedron::cuboid(Vec3::new(0.0, -0.15, 0.0), Vec3::new(0.4, 0.15, 0.2));
/// let stone = Block::stone(shape, 2400.0);
/// let cell = Cell { blocks: vec![stone], lattice: [[0.4, 0.0], [0.2, 0.2]], thickness: 0.3 };
/// assert!((cell.area() - 0.08).abs() < 1e-15 && (cell.solid_share() - 1.0).abs() < 1e-12);
/// // The stone on top of it to its left.
/// assert_eq!(cell.shift(-1, 1), Vec3::new(-0.2, 0.0, 0.2));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Its stones; a block's id is its index.
    pub blocks: Vec<Block>,
    /// The two lattice vectors, each along x and along z (m): the first lies along x, the second leads one cell upwards.
    pub lattice: [[f64; 2]; 2],
    /// Thickness of the plate (m).
    pub thickness: f64,
}

impl Cell {
    /// Area of the plate that belongs to one cell (m^2).
    pub fn area(&self) -> f64 {
        let [[a, b], [c, d]] = self.lattice;
        (a * d - b * c).abs()
    }

    /// Where the cell `p` cells along the wall and `q` cells up lies (m), seen from this one.
    pub fn shift(&self, p: i32, q: i32) -> Vec3 {
        let [along, up] = self.lattice;
        let (p, q) = (f64::from(p), f64::from(q));
        Vec3::new(p * along[0] + q * up[0], 0.0, p * along[1] + q * up[1])
    }

    /// Share of the plate that is stone: 1 less the open slots in head joints.
    pub fn solid_share(&self) -> f64 {
        self.blocks.iter().map(Block::volume).sum::<f64>() / (self.area() * self.thickness)
    }
}
