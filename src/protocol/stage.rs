//! A wall of a study with all that its protocol puts around it.

use crate::contact;
use crate::math::cbrt;
use crate::model::{JointLaws, Wall};
use crate::protocol::restraint::{Surroundings, restrain};
use crate::protocol::shear::{beam, jack};
use crate::protocol::task::Platform;
use crate::protocol::{Contacts, Direction, Ends, Protocol, Restraint, ropes};
use crate::shape::Hull;
use crate::solve::Tie;

/// The wall on its base and between its ends, ready for a solver or for limit analysis.
pub struct Stage<'a> {
    /// The blocks; base, strip, ends and the beam on its top have ids behind the stones'.
    pub assembly: Wall,
    /// The laws of all joints.
    pub laws: Surroundings<'a>,
    /// Tolerances of contact detection.
    pub contact: contact::Settings,
    /// Springs under its platform.
    pub platform: Option<Platform>,
    /// The jack that shears it, and ropes at its ends.
    pub ties: Vec<Tie>,
    /// Where the load pushes.
    pub towards: Direction,
}

impl<'a> Stage<'a> {
    /// Around a wall of stones.
    pub fn new(
        wall: &Wall,
        laws: &'a dyn JointLaws,
        protocol: &Protocol,
        restraint: &Restraint,
        contacts: Contacts,
    ) -> Self {
        let towards = match protocol {
            Protocol::Lateral(_) | Protocol::Retaining(_) => Direction::YPlus,
            Protocol::Tilting(tilting) => tilting.towards,
            Protocol::Shear(_) => Direction::XPlus,
            Protocol::BaseMotion(base) => base.towards,
        };
        let mut assembly = restrain(wall, restraint, towards);
        let mut ties = Vec::new();
        if let Protocol::Shear(shear) = protocol {
            let beam = beam(wall, shear);
            ties.push(jack(assembly.blocks.len(), &beam, shear));
            assembly.blocks.push(beam);
        }
        if let Ends::Ropes(rope) = restraint.ends {
            ties.extend(ropes(wall, &rope, towards));
        }
        let platform = restraint.base.compliance.map(|springs| Platform::under(wall, &assembly, springs));
        Stage {
            assembly,
            platform,
            laws: Surroundings::of(wall, laws, restraint),
            contact: contacts.of_wall(wall),
            ties,
            towards,
        }
    }
}

/// The thickness (m) that movements are measured by: of a wall on a platform along x that out of plane; of a wall on a base of its own,
/// which may run any way, the least horizontal width of its stones.
pub fn thickness(wall: &Wall) -> f64 {
    if wall.has_base() {
        let plan = wall.stones().flat_map(|(_, block)| &block.shape.vertices).map(|v| [v.x, v.y]);
        return Hull::of(plan.collect()).width();
    }
    let (low, high) = wall.bounds();
    high.y - low.y
}

/// Edge of the cube with a stone's mean volume (m), the parts of one taken together: the length to which contact tolerances are scaled.
pub fn typical_size(wall: &Wall) -> f64 {
    let leads = wall.leads();
    let (count, volume) = wall
        .stones()
        .fold((0u32, 0.0), |(n, v), (id, block)| (n + u32::from(leads[id] == id), v + block.volume()));
    cbrt(volume / f64::from(count.max(1)))
}
