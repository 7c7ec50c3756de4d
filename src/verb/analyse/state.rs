//! What a solver leaves of a wall: where its blocks are, how they fall, what its joints do and carry. The same for all solvers.

use std::collections::BTreeMap;

use crate::contact;
use crate::contact::{Patch, find_patch};
use crate::math::Vec3;
use crate::model::{Block, Movement, Wall};
use crate::protocol::{Closing, JointState, Run};
use crate::render::picture::{Stone, Thrust};
use crate::solve::limit::{BlockMotion, Limit};
use crate::verb::wall::condition::{Condition, Parting, conditions};
use crate::verb::wall::drawn::stones;

/// A block that slips or opens by less than this share of the fastest corner does neither (rounding of the conic solver).
const STILL: f64 = 1e-6;

/// A wall as a solver left it.
pub(crate) struct State {
    /// The blocks; their movement is the mechanism where `falls`, and what they moved to where they rest otherwise.
    pub stones: Vec<Stone>,
    /// Whether there is a mechanism.
    pub falls: bool,
    /// The joints: at the last state at rest; of limit analysis with the forces of the state found, and with the openings and slips
    /// of a mechanism whose fastest corner moves by 1 m.
    pub joints: Vec<JointState>,
    /// The condition of each of them.
    pub conditions: Vec<Condition>,
    /// The forces between blocks of a limit analysis, under the load as it stands at the end.
    pub thrusts: Vec<Thrust>,
}

/// What a solver found of a wall, as it says it.
pub(crate) enum Found {
    /// Limit analysis.
    Limit {
        /// Its result.
        found: Box<Limit>,
        /// Whether what it left is a mechanism.
        falls: bool,
        /// Of its forces: the cosine of a tilt, as the analysis pushes with the tangent and leaves the weight as it is; 1 otherwise.
        scale: f64,
    },
    /// Steps of the load.
    Steps(Box<Run>),
}

impl State {
    /// Of a wall and what was found of it.
    pub fn of(wall: &Wall, settings: &contact::Settings, found: &Found) -> State {
        match found {
            Found::Limit { found, falls, scale } => State::at_limit(wall, settings, found, (*falls, *scale)),
            Found::Steps(run) => State::after(wall, settings, run),
        }
    }

    /// After steps of the load.
    fn after(wall: &Wall, settings: &contact::Settings, run: &Run) -> State {
        let (stones, falls, joints) = (stones(wall, run), run.failure.is_some(), run.joint_states.clone());
        let conditions = conditions((wall, settings), &stones, &joints, falls);
        State { conditions, stones, falls, joints, thrusts: Vec::new() }
    }

    /// Of a limit analysis, with the forces under the load as it stands at the end.
    fn at_limit(
        wall: &Wall,
        settings: &contact::Settings,
        found: &Limit,
        (falls, scale): (bool, f64),
    ) -> State {
        let movements = movements(wall, found);
        let movement = |id: usize| if falls { movements[id] } else { Movement::NONE };
        let stone = |(id, block): (usize, &Block)| Stone {
            shape: block.shape.clone(),
            before: Movement::NONE,
            movement: movement(id),
        };
        let stones: Vec<Stone> = wall.blocks.iter().enumerate().map(stone).collect();
        let joints = found.thrust.iter().filter_map(|thrust| {
            let [a, b] = [thrust.blocks.0 as usize, thrust.blocks.1 as usize];
            let patch = find_patch(&wall.blocks[a].shape, &wall.blocks[b].shape, settings)?;
            Some(joint(&stones, [a, b], &patch, thrust.force * scale))
        });
        let joints: Vec<JointState> = joints.collect();
        let thrusts = found.thrust.iter().filter_map(|own| {
            Some(Thrust { block: own.blocks.0 as usize, at: own.at?, force: own.force * scale })
        });
        let (thrusts, conditions) =
            (thrusts.collect(), conditions((wall, settings), &stones, &joints, falls));
        State { conditions, stones, falls, joints, thrusts }
    }
}

/// How every block moves in the mechanism. The parts of a stone turn about its centroid, not about their own.
pub(crate) fn movements(wall: &Wall, found: &Limit) -> Vec<Movement> {
    let leads = wall.leads();
    let mut stones: BTreeMap<usize, (f64, Vec3)> = BTreeMap::new();
    for (block, lead) in wall.blocks.iter().zip(&leads) {
        let mass = block.mass();
        let stone = stones.entry(*lead).or_insert((0.0, Vec3::zeros()));
        *stone = (stone.0 + mass, stone.1 + block.mass_properties().centroid * mass);
    }
    let of = |((block, lead), motion): ((&Block, &usize), &BlockMotion)| {
        let (mass, moment) = stones[lead];
        let own = block.shape.mass_properties().centroid;
        let off = if mass > 0.0 { own - moment / mass } else { Vec3::zeros() };
        Movement { shift: motion.velocity + motion.spin.cross(&off), turn: motion.spin }
    };
    wall.blocks.iter().zip(&leads).zip(&found.mechanism).map(of).collect()
}

/// A joint of a mechanism: how its blocks part and slip over it, and what the second one gets.
fn joint(stones: &[Stone], blocks: [usize; 2], patch: &Patch, force: Vec3) -> JointState {
    let parting = Parting::of(stones, blocks, patch);
    let (normal, moments) = (patch.plane.normal, patch.polygon.moments());
    let gaps = |st: &[f64; 2]| {
        let corner = patch.frame.lift(*st);
        (corner, Parting::at(stones, blocks, patch, &corner) - parting.least)
    };
    let corners: Vec<(Vec3, f64)> = patch.polygon.vertices.iter().map(gaps).collect();
    let [opening, slip] = [parting.most, parting.slip].map(|x| if x > STILL { x } else { 0.0 });
    let on_incident = if patch.reference_is_second { -force } else { force };
    JointState {
        blocks: blocks.map(|id| id as u32),
        place: patch.frame.lift(moments.centroid()),
        area: moments.area,
        opening,
        slip,
        slipped: if slip > 0.0 { 1.0 } else { 0.0 },
        crushed: 0.0,
        force,
        pressure: on_incident.dot(&normal) / moments.area,
        closing: Closing::of(&corners, STILL),
    }
}
