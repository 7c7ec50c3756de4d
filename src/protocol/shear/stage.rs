//! The beam on the wall's top, and the jack that pushes it.

use crate::math::Vec3;
use crate::model::{Block, Support, Tag, Wall};
use crate::protocol::shear::{Head, Shear};
use crate::shape::Polyhedron;
use crate::solve::{STANDARD_GRAVITY, Tie};

/// A push as large as the vertical load shortens the jack by this share of its height: little beside a drift, and enough for the
/// jack to give way to a wall that is stiffer.
const SHORTENED: f64 = 1e-4;

/// The beam on a wall of stones: as long and as thick as the wall, its middle at the height of the jack, guided out of plane.
pub fn beam(wall: &Wall, shear: &Shear) -> Block {
    let (low, high) = wall.bounds_of_stones();
    let above = shear.force_height - (high.z - low.z);
    crate::check!(above > 0.0, "the jack must push above the wall");
    let top = Vec3::new(high.x, high.y, high.z + 2.0 * above);
    let shape = Polyhedron::cuboid(Vec3::new(low.x, low.y, high.z), top);
    let density = shear.vertical_load / (STANDARD_GRAVITY * shape.volume());
    let support = match shear.head {
        Head::Turns => Support::OutOfPlane,
        Head::Level => Support::Upright,
    };
    Block { support, tag: Tag::End, ..Block::stone(shape, density) }
}

/// The jack at the middle of a beam; its load factor is a drift.
pub fn jack(body: usize, beam: &Block, shear: &Shear) -> Tie {
    Tie {
        body,
        point: beam.shape.mass_properties().centroid,
        direction: Vec3::x(),
        stiffness: shear.vertical_load / (SHORTENED * shear.force_height),
        pretension: 0.0,
        slack: 0.0,
        two_sided: true,
        travel: shear.force_height,
    }
}
