//! What holds a wall: the base under it, and its ends.

use crate::law::Coulomb;
use crate::math::Vec3;
use crate::model::{Block, JointLaws, Support, Tag, Wall};
use crate::protocol::Ends;
use crate::shape::Polyhedron;

/// Thickness of the fixed end blocks (m).
const END_THICKNESS: f64 = 0.1;

/// The stones on their base and between their ends; the stones keep their ids.
pub fn restrain(wall: &Wall, ends: Ends) -> Wall {
    let (low, high) = wall.bounds();
    let mut assembly = wall.clone().with_base();
    match ends {
        Ends::Free => {}
        Ends::OutOfPlane => {
            let near = 1e-6 * (high.x - low.x);
            for block in assembly.blocks.iter_mut().take(wall.blocks.len()) {
                let (from, to) = block.shape.bounds();
                if from.x <= low.x + near || to.x >= high.x - near {
                    block.support = Support::OutOfPlane;
                }
            }
        }
        Ends::FixedEndBlocks | Ends::JointSprings => {
            for (from, to) in [(low.x - END_THICKNESS, low.x), (high.x, high.x + END_THICKNESS)] {
                assembly.blocks.push(Block {
                    shape: Polyhedron::cuboid(
                        Vec3::new(from, low.y - END_THICKNESS, low.z),
                        Vec3::new(to, high.y + END_THICKNESS, high.z + END_THICKNESS),
                    ),
                    density: wall.blocks.first().map_or(0.0, |b| b.density),
                    support: Support::Fixed,
                    tag: Tag::End,
                });
            }
        }
    }
    assembly
}

/// The laws of the wall's joints, and of those with what surrounds it.
pub struct Surroundings<'a> {
    /// Laws of the wall's own joints.
    pub laws: &'a dyn JointLaws,
    /// How the ends are held.
    pub ends: Ends,
    /// Id of the base, the first block that is not the wall's; the ends follow it.
    pub first_added: u32,
}

impl JointLaws for Surroundings<'_> {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        let law = self.laws.of(a, b);
        let at_end = a.max(b) > self.first_added;
        Coulomb { bonded: law.bonded || (at_end && self.ends == Ends::JointSprings), ..law }
    }
}
