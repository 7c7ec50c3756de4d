//! What holds a wall: the base under it, and its ends.

use crate::law::Coulomb;
use crate::math::Vec3;
use crate::model::{Block, JointLaws, Support, Tag, Wall};
use crate::protocol::{Direction, Ends, Restraint};
use crate::shape::Polyhedron;

/// Thickness of the fixed end blocks (m).
const END_THICKNESS: f64 = 0.1;

/// Width of the strip at the wall's foot (m).
const STRIP_WIDTH: f64 = 0.03;

/// The stones on their platform, which goes down `towards` a side, with strip and ends as asked for. The stones keep their
/// ids; behind them come the platform, the strip, and the end blocks (x = 0, x = length). A wall with a base of its own stands on
/// that, in the place of the platform.
pub fn restrain(wall: &Wall, restraint: &Restraint, towards: Direction) -> Wall {
    let (low, high) = wall.bounds_of_stones();
    let mut assembly = wall.clone().with_base();
    let density = wall.blocks.first().map_or(0.0, |b| b.density);
    let fixed = |from: Vec3, to: Vec3, tag| Block {
        support: Support::Fixed,
        tag,
        ..Block::stone(Polyhedron::cuboid(from, to), density)
    };
    if let Some(height) = restraint.base.strip_height {
        let (from, to) = strip(wall, height, towards);
        assembly.blocks.push(fixed(from, to, Tag::Base));
    }
    match restraint.ends {
        Ends::Free | Ends::Ropes(_) => {}
        Ends::OutOfPlane => {
            let near = 1e-6 * (high.x - low.x);
            for block in assembly.blocks.iter_mut().take(wall.before_base()) {
                let (from, to) = block.shape.bounds();
                let at_an_end = from.x <= low.x + near || to.x >= high.x - near;
                if at_an_end && block.support != Support::Absent {
                    block.support = Support::OutOfPlane;
                }
            }
        }
        Ends::FixedEndBlocks | Ends::JointSprings => {
            for (from, to) in [(low.x - END_THICKNESS, low.x), (high.x, high.x + END_THICKNESS)] {
                assembly.blocks.push(fixed(
                    Vec3::new(from, low.y - END_THICKNESS, low.z),
                    Vec3::new(to, high.y + END_THICKNESS, high.z + END_THICKNESS),
                    Tag::End,
                ));
            }
        }
    }
    assembly
}

/// Lowest and highest corner of the strip at the wall's foot on the side that goes down most, as long as the wall. The foot is where
/// the corners of stones within a millionth of the wall's height of its lowest point are.
fn strip(wall: &Wall, height: f64, towards: Direction) -> (Vec3, Vec3) {
    let (low, high) = wall.bounds_of_stones();
    let highest = low.z + 1e-6 * (high.z - low.z);
    let unit = towards.nearest_axis().unit();
    let corners = wall.stones().flat_map(|(_, b)| &b.shape.vertices).filter(|v| v.z <= highest);
    let foot = corners.map(|v| v.dot(&unit)).fold(f64::NEG_INFINITY, f64::max);
    // The wall's box, cut down to what lies beyond the foot.
    let (near, far) = (unit * foot, unit * (foot + STRIP_WIDTH));
    let beyond = |k: usize, wall: f64, at: f64| if unit[k] == 0.0 { wall } else { at };
    let from = Vec3::new(beyond(0, low.x, near.x.min(far.x)), beyond(1, low.y, near.y.min(far.y)), low.z);
    let to =
        Vec3::new(beyond(0, high.x, near.x.max(far.x)), beyond(1, high.y, near.y.max(far.y)), low.z + height);
    (from, to)
}

/// The laws of the wall's joints, and of those with what surrounds it.
pub struct Surroundings<'a> {
    /// Laws of the wall's own joints.
    laws: &'a dyn JointLaws,
    restraint: Restraint,
    /// Id of the platform, the first block that is no stone.
    platform: u32,
    /// Id of the first end block.
    first_end: u32,
}

impl<'a> Surroundings<'a> {
    /// For what [`restrain`] adds to a wall.
    pub fn of(wall: &Wall, laws: &'a dyn JointLaws, restraint: &Restraint) -> Self {
        let grounded = wall.blocks.len() + usize::from(!wall.has_base());
        let strips = usize::from(restraint.base.strip_height.is_some());
        let (platform, first_end) = (wall.before_base() as u32, (grounded + strips) as u32);
        Surroundings { laws, restraint: *restraint, platform, first_end }
    }
}

impl JointLaws for Surroundings<'_> {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        let law = self.laws.of(a, b);
        let other = a.max(b);
        if other >= self.first_end {
            return Coulomb { bonded: law.bonded || self.restraint.ends == Ends::JointSprings, ..law };
        }
        match self.restraint.base.tan_phi {
            Some(tan_phi) if other >= self.platform => Coulomb { tan_phi, ..law },
            _ => law,
        }
    }
}
