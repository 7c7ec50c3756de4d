//! The program as the interior-point method sees it: forces in groups, each with a cone of its own and at most two blocks
//! that feel it, and the strain of a cell.

use crate::model::Support;
use crate::solve::limit::Cone;
use crate::solve::limit::interfaces::{Felt, Rigid};
use crate::solve::limit::loads::Wrench;
use crate::solve::limit::program::Program;

/// Equations of a block. Those of a block that is held out of plane are empty where it is held.
pub(super) const SIX: usize = 6;

/// So many feel a force at most.
pub(super) const ENDS: usize = 3;

/// A wrench in the units of the program.
pub(super) type Six = [f64; SIX];

/// A contact point with three forces or, without shear, with one; or a rope with its pull.
pub(super) struct Group {
    /// Who feels it, among the blocks that move and the strain.
    pub ends: [Option<usize>; ENDS],
    /// What each of its forces does to each.
    pub columns: [[Six; 3]; ENDS],
    /// Whether it has shear, and so a friction cone.
    pub shears: bool,
    pub friction: f64,
    /// Cohesion (N) over the unit of force.
    pub cohesion: f64,
    /// Smallest normal force over the unit of force, where the cone does not say it.
    pub least: Option<f64>,
}

/// All that a program says.
pub(super) struct Groups {
    pub groups: Vec<Group>,
    /// Dead and live loads on the blocks that move.
    pub dead: Vec<Six>,
    pub live: Vec<Six>,
    /// Which equations of each are empty.
    pub held: Vec<[bool; SIX]>,
    /// Index among the blocks that move, for every block.
    pub moving: Vec<Option<usize>>,
}

impl Groups {
    /// Of a program whose every force is bounded by a cone; else `None`.
    pub fn of(program: &Program) -> Option<Groups> {
        let blocks = program.blocks;
        if program.cone != Cone::SecondOrder {
            return None;
        }
        if program.strengths.iter().any(|s| s.bonded) || blocks.ties.iter().any(|rope| rope.two_sided) {
            return None;
        }
        let mut next = 0;
        let moving: Vec<Option<usize>> = blocks
            .rigid
            .iter()
            .map(|block| {
                next += usize::from(block.moves());
                block.moves().then(|| next - 1)
            })
            .collect();
        let points = program.points().zip(program.strengths).map(|((joint, interface, at), strength)| {
            let felt = program.directions(joint).map(|d| blocks.felt(interface, at, d));
            let column = |force: &Felt, end: usize| {
                force[end].as_ref().map_or([0.0; SIX], |(block, wrench)| six(&blocks.rigid[*block], wrench))
            };
            Group {
                ends: std::array::from_fn(|end| felt[0][end].as_ref().and_then(|(block, _)| moving[*block])),
                columns: std::array::from_fn(|end| std::array::from_fn(|k| column(&felt[k], end))),
                shears: strength.shears(),
                friction: strength.friction,
                cohesion: strength.cohesion / blocks.unit,
                least: strength.needs_least().then(|| strength.least / blocks.unit),
            }
        });
        let ropes = blocks.ties.iter().map(|rope| {
            let rigid = &blocks.rigid[rope.block];
            let mut pull = Wrench::default();
            pull.add(rope.at - rigid.centroid, -rope.direction);
            let nothing = [[0.0; SIX]; 3];
            Group {
                ends: [moving[rope.block], None, None],
                columns: [[six(rigid, &pull), [0.0; SIX], [0.0; SIX]], nothing, nothing],
                shears: false,
                friction: 0.0,
                cohesion: 0.0,
                least: Some(0.0),
            }
        });
        let groups = points.chain(ropes).collect();
        let load = |wrenches: &[Wrench]| {
            let all = blocks.rigid.iter().zip(wrenches).filter(|(block, _)| block.moves());
            all.map(|(block, wrench)| six(block, wrench).map(|x| x / blocks.unit)).collect()
        };
        let held = |block: &Rigid| match block.support {
            _ if block.pinned => [true, true, true, false, false, false],
            Support::OutOfPlane => [false, true, false, true, false, true],
            Support::Upright => [false, true, false, true, true, true],
            Support::Free | Support::Fixed | Support::Absent => [false; SIX],
        };
        Some(Groups {
            groups,
            dead: load(program.dead),
            live: load(program.live),
            held: blocks.rigid.iter().filter(|block| block.moves()).map(held).collect(),
            moving,
        })
    }
}

/// A wrench in the order of a block's equations, moments over its radius, without what it does not feel.
fn six(block: &Rigid, wrench: &Wrench) -> Six {
    let (f, m) = (wrench.force, wrench.moment / block.radius);
    match block.support {
        Support::Fixed | Support::Absent => [0.0; SIX],
        Support::Free if block.pinned => [0.0, 0.0, 0.0, m.x, m.y, m.z],
        Support::Free => [f.x, f.y, f.z, m.x, m.y, m.z],
        Support::OutOfPlane => [f.x, 0.0, f.z, 0.0, m.y, 0.0],
        Support::Upright => [f.x, 0.0, f.z, 0.0, 0.0, 0.0],
    }
}
