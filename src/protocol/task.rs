//! What is asked about one wall, and what comes of it.

use crate::contact;
use crate::math::Vec3;
use crate::model::{JointLaws, Outcome, Support, Tag, Wall};
use crate::protocol::Compliance;
use crate::protocol::changes::Changes;
use crate::protocol::confirm::Confirmation;
use crate::protocol::events::Events;
use crate::protocol::mechanism::{Failure, JointState};
use crate::protocol::path::LoadPath;
use crate::protocol::pressure::Load;
use crate::protocol::shear::Sheared;
use crate::protocol::undecided::Undecided;
use crate::protocol::watch::{Criterion, LoadStep};
use crate::solve::bodies::{Bodies, Body};
use crate::solve::{Assembly, Mount, Tie};

/// A wall with all that surrounds it, its loads, and how far it is to be taken.
pub struct Task<'t> {
    /// The blocks, supports included.
    pub wall: &'t Wall,
    /// Laws of all joints.
    pub laws: &'t dyn JointLaws,
    /// Tolerances of contact detection.
    pub contact: contact::Settings,
    /// Dead loads, on the wall as built; from then on each moves with its block.
    pub loads: Vec<Load>,
    /// Ties of blocks to the surroundings, on the wall as built.
    pub ties: Vec<Tie>,
    /// Springs under the platform.
    pub platform: Option<Platform>,
    /// What changes on the way.
    pub changes: Changes,
    /// The load path.
    pub path: LoadPath,
    /// Thickness (m) of the pile that each block belongs to, see [`pile_thicknesses`](crate::protocol::pile_thicknesses): `criterion` and
    /// `confirmation` are those of the thinnest, thicker ones may move as much further. Empty where all blocks are one wall.
    pub piles: Vec<f64>,
    /// When a wall counts as running away.
    pub criterion: Criterion,
    /// How a suspected collapse is confirmed.
    pub confirmation: Confirmation,
}

/// A platform on springs with what is fixed to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Platform {
    /// The springs.
    pub mount: Mount,
    /// Blocks that go with it: strip and end blocks.
    pub carries: Vec<usize>,
}

impl Platform {
    /// Under the stones of a wall in its surroundings, whose first block that is no stone is the platform; a base of several blocks goes
    /// with its first one.
    pub(super) fn under(stones: &Wall, surroundings: &Wall, springs: Compliance) -> Platform {
        let body = stones.before_base();
        let others = surroundings.blocks.iter().enumerate().skip(body + 1);
        let fixed =
            others.filter(|(_, b)| b.support == Support::Fixed && matches!(b.tag, Tag::Base | Tag::End));
        let Compliance { settlement, rotation } = springs;
        Platform { mount: Mount { body, settlement, rotation }, carries: fixed.map(|(id, _)| id).collect() }
    }
}

/// How the evaluation of one wall went.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// How it ended; a collapse is stated at the last level borne.
    pub outcome: Outcome,
    /// For a collapse after the first level: the last level borne and the lowest one at which the wall falls (SI units).
    pub bracket: Option<[f64; 2]>,
    /// One entry per level at which the wall came to rest, gravity alone first, and one for the level at which it did not.
    pub steps: Vec<LoadStep>,
    /// Displacement of every block's centroid (m) from its position as built, by block id: at the last state at rest, or
    /// where it was left if it never came to rest.
    pub displacements: Vec<Vec3>,
    /// How far every block has turned since it was built: rotation vectors (rad, world axes), in the same state.
    pub turns: Vec<Vec3>,
    /// Number of joints found as built.
    pub joints: usize,
    /// The mechanism of a collapse.
    pub failure: Option<Failure>,
    /// The loads at which parts of the wall fell; none for a run that ends with the first part.
    pub events: Events,
    /// The joints at the last state at rest; empty if there was none.
    pub joint_states: Vec<JointState>,
    /// The joints at rest when all supports had gone down, slips counted from before; empty where none went.
    pub settled_joints: Vec<JointState>,
    /// What is read off a wall that is sheared; `None` of others, and of one that never came to rest.
    pub shear: Option<Sheared>,
    /// What rigid blocks leave open of the load that was found; `None` where stiff joints bear it, too, and of joints that are elastic.
    pub undecided: Option<Undecided>,
}

impl Run {
    /// A run of a wall with so many joints that ended so after these steps, each block displaced and turned by so much. Of all else nothing is known.
    pub(super) fn ended(
        outcome: Outcome,
        steps: Vec<LoadStep>,
        [displacements, turns]: [Vec<Vec3>; 2],
        joints: usize,
    ) -> Run {
        Run {
            outcome,
            bracket: None,
            steps,
            displacements,
            turns,
            joints,
            failure: None,
            events: Events::default(),
            joint_states: Vec::new(),
            settled_joints: Vec::new(),
            shear: None,
            undecided: None,
        }
    }
}

impl<'t> Task<'t> {
    /// The same wall under other loads along another path.
    pub(super) fn under(&self, loads: Vec<Load>, path: LoadPath) -> Task<'t> {
        Task {
            wall: self.wall,
            laws: self.laws,
            contact: self.contact,
            loads,
            ties: self.ties.clone(),
            platform: self.platform.clone(),
            changes: self.changes.clone(),
            path,
            piles: self.piles.clone(),
            criterion: self.criterion,
            confirmation: self.confirmation,
        }
    }

    /// The assembly as built, with its loads.
    pub(crate) fn assembled(&self) -> Assembly<'t> {
        let mut built = Assembly::new(self.wall, self.laws, self.contact);
        for load in &self.loads {
            built.add_load(load.block, load.point, load.force);
        }
        if let Some(platform) = &self.platform {
            built.mount(platform.mount, &platform.carries);
        }
        self.ties.iter().for_each(|tie| built.add_tie(*tie));
        built
    }
}

/// Displacement of every block's centroid (m) between two states of bodies; `carried` says which body each block belongs to.
pub(crate) fn displacements(now: &[Body], built: &[Body], carried: &Bodies) -> Vec<Vec3> {
    (0..now.len()).map(|block| carried.centroid_in(now, block) - carried.centroid_in(built, block)).collect()
}

/// Rotation vector of every block (rad, world axes); arguments as for [`displacements`].
pub(crate) fn turns(now: &[Body], built: &[Body], carried: &Bodies) -> Vec<Vec3> {
    carried.carriers.iter().map(|&carrier| now[carrier].turn_since(&built[carrier])).collect()
}
