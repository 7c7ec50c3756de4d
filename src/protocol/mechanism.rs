//! How a wall fails, read off its motion while it runs away; and the state of its joints before.

use crate::math::Vec3;
use crate::model::Wall;
use crate::protocol::observe::{extent, movable, top_points};
use crate::protocol::task::{displacements, turns};
use crate::protocol::{Closing, Direction};
use crate::solve::Assembly;
use crate::solve::bodies::{Bodies, Body};

/// A block takes part in the mechanism when one of its corners moves by this share of the largest movement of a corner.
const MOVES: f64 = 0.05;
/// A belly: the top moves less than this share of the largest movement along the load.
const BELLY: f64 = 0.5;

/// How the moving part moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FailureMode {
    /// Its joints slip more than they turn.
    Sliding,
    /// Its joints turn more than they slip.
    Rocking,
    /// Several blocks below the top move out further than the top does: a belly.
    Bulging,
}

impl FailureMode {
    /// The name used in tables.
    pub fn name(&self) -> &'static str {
        match self {
            FailureMode::Sliding => "sliding",
            FailureMode::Rocking => "rocking",
            FailureMode::Bulging => "bulging",
        }
    }
}

/// The first mechanism of a collapse.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// How the moving part moves.
    pub mode: FailureMode,
    /// The blocks that take part, ascending.
    pub moving: Vec<u32>,
    /// Their share of the weight of all stones that can move.
    pub weight_share: f64,
    /// Height (m) of the lowest point of the moving part above the lowest point of the wall, as built: the hinge or the
    /// plane of sliding.
    pub hinge_height: f64,
    /// Turning over turning and slipping, summed over the joints of the moving part: 1 = pure rocking, 0 = pure sliding.
    pub turning_share: f64,
    /// Share of the wall's length over which a stone moves by half of the largest movement or more: near 1 for a wall that
    /// moves as one all along.
    pub length_share: f64,
    /// Where along the wall it moves, as a share of its length from x = 0: the mean, weighted by the movement.
    pub place: f64,
    /// How far each block's centroid went (m) while it was watched, by block id: the mechanism, in no particular scale.
    pub motion: Vec<Vec3>,
    /// How far each block turned meanwhile: rotation vectors (rad, world axes), by block id.
    pub turns: Vec<Vec3>,
}

/// A joint at the last state at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointState {
    /// Its blocks, lower id first.
    pub blocks: [u32; 2],
    /// Where its middle is (m).
    pub place: Vec3,
    /// Its area (m^2).
    pub area: f64,
    /// Largest gap over the joint (m); 0 where it is closed throughout.
    pub opening: f64,
    /// Size of the relative displacement of the two blocks along the joint, at its middle, since the wall came to rest
    /// under gravity (m); elastic shear is in it.
    pub slip: f64,
    /// Share of its sub-contacts that have slipped at any time.
    pub slipped: f64,
    /// Share of its area that is crushed.
    pub crushed: f64,
    /// Force (N, world axes) on the second of its blocks.
    pub force: Vec3,
    /// The part of that force across the joint over its area (Pa): positive where the blocks press on each other.
    pub pressure: f64,
    /// What is left of its contact.
    pub closing: Closing,
}

/// The mechanism from two moments of the runaway.
pub fn failure(
    wall: &Wall,
    assembly: &Assembly<'_>,
    before: &[Body],
    after: &Bodies,
    towards: Direction,
) -> Failure {
    let furthest_corner = |id: usize| {
        let body = after.carriers[id];
        let (from, to) = (&before[body], &after.all[body]);
        let corners = after.shapes[id].vertices.iter();
        corners
            .map(|v| (to.position + to.rotation * v - from.position - from.rotation * v).norm())
            .fold(0.0, f64::max)
    };
    // The parts of a stone move as far as the one of them that moves furthest.
    let mut reach = vec![0.0; before.len()];
    for (id, _) in movable(wall) {
        let body = after.carriers[id];
        reach[body] = f64::max(reach[body], furthest_corner(id));
    }
    let largest = reach.iter().fold(0.0, |a: f64, r| a.max(*r));
    let moves = |id: usize| reach[after.carriers[id]] > MOVES * largest;
    let moving: Vec<u32> =
        movable(wall).map(|(id, _)| id).filter(|&id| moves(id)).map(|id| id as u32).collect();
    let motion = displacements(&after.all, before, after);
    // The body of a stone's first part has the mass of all.
    let mass = |id: usize| if after.carriers[id] == id { before[id].mass } else { 0.0 };
    let weight = |ids: &mut dyn Iterator<Item = usize>| ids.map(mass).fold(0.0, |a, m| a + m);
    let all = weight(&mut movable(wall).map(|(id, _)| id));
    let turning_share = turning_share(assembly, before, &after.all, &moving);
    let [length_share, place] = along_the_wall(wall, &motion);
    Failure {
        length_share,
        place,
        mode: mode(wall, assembly, &moving, &motion, turning_share, towards),
        weight_share: weight(&mut moving.iter().map(|&id| id as usize)) / all,
        hinge_height: moving
            .iter()
            .map(|&id| wall.blocks[id as usize].shape.bounds().0.z)
            .fold(f64::INFINITY, f64::min)
            - extent(wall).0.z,
        turning_share,
        turns: turns(&after.all, before, after),
        moving,
        motion,
    }
}

/// Strips into which the wall's length is divided to see where it moves.
const STRIPS: usize = 60;

/// Share of the length that moves by half of the largest movement or more, and the middle of the movement along the length.
/// In each strip of the length the stone that moves most speaks.
fn along_the_wall(wall: &Wall, motion: &[Vec3]) -> [f64; 2] {
    let (low, high) = extent(wall);
    let length = high.x - low.x;
    let share = |strip: usize| (strip as f64 + 0.5) / STRIPS as f64;
    let moves: Vec<f64> = (0..STRIPS)
        .map(|strip| {
            let x = low.x + share(strip) * length;
            let across = movable(wall).filter(|(_, block)| {
                let (from, to) = block.shape.bounds();
                from.x <= x && x <= to.x
            });
            across.map(|(id, _)| motion[id].norm()).fold(0.0, f64::max)
        })
        .collect();
    let largest = moves.iter().copied().fold(0.0, f64::max);
    let total = moves.iter().fold(0.0, |sum, m| sum + m);
    let wide = moves.iter().filter(|m| **m >= 0.5 * largest).count() as f64 / STRIPS as f64;
    let middle = moves.iter().enumerate().fold(0.0, |sum, (strip, m)| sum + share(strip) * m);
    [wide, if total > 0.0 { middle / total } else { 0.5 }]
}

fn mode(
    wall: &Wall,
    assembly: &Assembly<'_>,
    moving: &[u32],
    motion: &[Vec3],
    turning_share: f64,
    towards: Direction,
) -> FailureMode {
    let along = |id: usize| motion[id].dot(&towards.unit());
    let top = top_points(wall, &assembly.bodies).iter().map(|p| along(p.block)).fold(0.0, f64::max);
    let anywhere = moving.iter().map(|&id| along(id as usize)).fold(0.0, f64::max);
    if moving.len() > 1 && top < BELLY * anywhere {
        FailureMode::Bulging
    } else if turning_share > 0.5 {
        FailureMode::Rocking
    } else {
        FailureMode::Sliding
    }
}

/// Turning (relative rotation times the joint's half extents) over turning and slipping (relative displacement along the
/// joint at its middle), summed over the joints that a moving block has.
fn turning_share(assembly: &Assembly<'_>, before: &[Body], after: &[Body], moving: &[u32]) -> f64 {
    let (mut turning, mut slipping) = (0.0, 0.0);
    for joint in &assembly.joints.all {
        let (a, b) = (joint.incident, joint.reference);
        if !moving.contains(&a) && !moving.contains(&b) {
            continue;
        }
        let (place, normal) = joint.place(before);
        let [(s, _), (t, _)] = joint.levers(before);
        let moved = |id: u32| carried(&before[id as usize], &after[id as usize], place) - place;
        let relative = moved(a) - moved(b);
        slipping += (relative - normal * relative.dot(&normal)).norm();
        let turned = |id: u32, lever: Vec3| {
            let (from, to) = (&before[id as usize], &after[id as usize]);
            to.rotation * from.rotation.tr_mul(&lever)
        };
        let opened = |lever: Vec3| (turned(a, lever) - turned(b, lever)).norm();
        turning += opened(s).max(opened(t));
    }
    if turning + slipping > 0.0 { turning / (turning + slipping) } else { 0.0 }
}

/// Where a point of a body is after the body has moved.
fn carried(from: &Body, to: &Body, point: Vec3) -> Vec3 {
    to.position + to.rotation * from.rotation.tr_mul(&(point - from.position))
}

/// The joints as they are now; slip is counted from the bodies `at_rest` under gravity alone.
pub fn joint_states(assembly: &Assembly<'_>, at_rest: &[Body]) -> Vec<JointState> {
    let now = &assembly.bodies.all;
    assembly
        .joints
        .all
        .iter()
        .map(|joint| {
            let ((lower, upper), a, b) = (joint.pair(), joint.incident, joint.reference);
            let (place, normal) = joint.place(now);
            // Back to where the joint's middle was on either block.
            let came = |id: u32| place - carried(&now[id as usize], &at_rest[id as usize], place);
            let relative = came(a) - came(b);
            let carried = joint.carried(now);
            let origin = assembly.bodies.origin;
            let corners: Vec<(Vec3, f64)> =
                joint.corners(now).into_iter().map(|(at, gap)| (at + origin, gap)).collect();
            let second = assembly.bodies.carriers[upper as usize] as u32 == a;
            JointState {
                blocks: [lower, upper],
                place: place + origin,
                area: joint.area(),
                opening: joint.largest_gap(now).max(0.0),
                slip: (relative - normal * relative.dot(&normal)).norm(),
                slipped: joint.slipped_share(),
                crushed: joint.crushed_share(now),
                force: if second { carried } else { -carried },
                pressure: carried.dot(&normal) / joint.area(),
                closing: Closing::of(&corners, 0.0),
            }
        })
        .collect()
}
