//! The trapezoidal pressure on the back of a wall, as dead loads at the centres of pressure of its stones' faces.

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::faces::{Face, faces_against};
use crate::protocol::observe::extent;
use crate::protocol::{Direction, Lateral};
use crate::solve::limit::{PointLoad, When};

/// A force (N) at a point (m) of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// The block.
    pub block: usize,
    /// Where it acts, on the block as built.
    pub point: Vec3,
    /// The force.
    pub force: Vec3,
}

impl Load {
    /// The same for limit analysis, there from the start or growing with the multiplier.
    pub fn when(&self, when: When) -> PointLoad {
        PointLoad { block: self.block, point: self.point, force: self.force, when }
    }
}

/// The pressure on every face that looks backwards (-y) with no stone behind its middle, towards +y.
///
/// The pressure varies linearly with height and acts per vertical projection of the face; its resultant on a face and
/// its point of action come from the exact integrals over the face.
pub fn back_loads(wall: &Wall, lateral: &Lateral) -> Vec<Load> {
    trapezoid(wall, Direction::YPlus, lateral.mean_pressure, lateral.base_over_top)
}

/// The same towards any direction: its mean over the height of the stones (Pa), and the pressure at the base over that at the top.
pub fn trapezoid(wall: &Wall, towards: Direction, mean: f64, base_over_top: f64) -> Vec<Load> {
    let towards = towards.unit();
    let (low, high) = extent(wall);
    let at_top = 2.0 * mean / (base_over_top + 1.0);
    let slope = at_top * (1.0 - base_over_top) / (high.z - low.z);
    let at_base = at_top * base_over_top;
    let on_face = |face: &Face| {
        let (total, point) = face.pressed(at_base + slope * (face.frame.origin.z - low.z), slope)?;
        let projected = -face.frame.normal.dot(&towards);
        Some(Load { block: face.block, point, force: towards * (total * projected) })
    };
    faces_against(wall, towards).iter().filter_map(on_face).collect()
}
