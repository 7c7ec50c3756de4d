//! The mechanism that is checked: how its stones begin to move along the load, what they weigh, and its name in the field.

use crate::math::Vec3;
use crate::model::{Movement, Support, Wall};
use crate::solve::STANDARD_GRAVITY;
use crate::solve::limit::Limit;
use crate::verb::analyse::state::movements;
use crate::verify::{Moving, Oscillator};

/// A stone takes part when its fastest corner moves by more than this share of the fastest corner of all, as in the answer.
const MOVES: f64 = 0.01;
/// All of the weight moves where less than this share stays.
const WHOLE: f64 = 0.999;
/// A belly: the top moves by less than this share of what moves most.
const BELLY: f64 = 0.5;
/// Stones slide where they turn by less than this share of what they move, corner against centroid.
const SLIDES: f64 = 0.1;
/// The load lies in the plane of the wall where its direction is within this sine of the wall's length.
const IN_PLANE: f64 = 0.5;

/// The mechanism of a wall.
pub(super) struct Mechanism {
    /// The multiplier at which it sets in.
    pub multiplier: f64,
    /// What it is as an oscillator.
    pub oscillator: Oscillator,
    /// The block that moves furthest along the load: its centroid is the control point.
    pub control: usize,
    /// What it is called.
    pub name: &'static str,
    /// Share of the weight that moves.
    pub share: f64,
}

impl Mechanism {
    /// Of a limit analysis under a load towards a side; `None` where nothing moves along it.
    pub fn of(wall: &Wall, found: &Limit, towards: Vec3) -> Option<Mechanism> {
        let motions = movements(wall, found);
        let speed = |id: usize| {
            motions[id].shift.norm() + motions[id].turn.norm() * 0.5 * wall.blocks[id].shape.diameter()
        };
        let free: Vec<usize> =
            (0..wall.blocks.len()).filter(|&id| wall.blocks[id].support != Support::Fixed).collect();
        let fastest = free.iter().map(|&id| speed(id)).fold(0.0, f64::max);
        let moving: Vec<usize> = free.iter().copied().filter(|&id| speed(id) > MOVES * fastest).collect();
        let along = |id: usize| motions[id].shift.dot(&towards);
        let weight = |id: usize| wall.blocks[id].mass() * STANDARD_GRAVITY;
        let control = moving.iter().copied().max_by(|a, b| along(*a).total_cmp(&along(*b)))?;
        let stones: Vec<Moving> =
            moving.iter().map(|&id| Moving { weight: weight(id), delta: along(id) }).collect();
        let sum = |ids: &[usize]| ids.iter().map(|&id| weight(id)).fold(0.0, |a, w| a + w);
        let share = sum(&moving) / sum(&free);
        Some(Mechanism {
            multiplier: found.multiplier,
            oscillator: Oscillator::of(&stones, along(control))?,
            control,
            name: name(wall, &motions, &moving, towards, share),
            share,
        })
    }
}

/// What a mechanism is called.
fn name(wall: &Wall, motions: &[Movement], moving: &[usize], towards: Vec3, share: f64) -> &'static str {
    let (low, high) = wall.bounds();
    let size = high - low;
    let length = if size.x >= size.y { Vec3::x() } else { Vec3::y() };
    let is_whole = share > WHOLE;
    let along = |id: usize| motions[id].shift.dot(&towards);
    let most = moving.iter().map(|&id| along(id)).fold(0.0, f64::max);
    let turned = |id: usize| motions[id].turn.norm() * 0.5 * wall.blocks[id].shape.diameter();
    let turning = moving.iter().map(|&id| turned(id)).fold(0.0, f64::max);
    let top = |id: usize| wall.blocks[id].shape.bounds().1.z;
    let highest = moving.iter().map(|&id| top(id)).fold(f64::NEG_INFINITY, f64::max);
    let at_top = moving
        .iter()
        .filter(|&&id| top(id) > highest - 0.1 * size.z)
        .map(|&id| along(id))
        .fold(0.0, f64::max);
    let is_in_plane = towards.dot(&length).abs() > IN_PLANE;
    match (is_in_plane, turning < SLIDES * most, at_top < BELLY * most) {
        (true, true, _) => "sliding in the plane",
        (true, false, _) => "rocking in the plane",
        (false, true, _) => "sliding out of the plane",
        (false, false, true) => "vertical bending",
        (false, false, false) if is_whole => "simple overturning",
        (false, false, false) => "overturning of a part",
    }
}
