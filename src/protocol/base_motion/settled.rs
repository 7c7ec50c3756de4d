//! Whether a wall was in balance where it was built: how far it goes and turns before it rests.

use crate::solve::bodies::{Bodies, Body};

/// A stone that turns by less (rad) until the wall rests was in balance where it was built: joints that give way, and faces that are off by
/// a millimetre per metre, turn it as far.
const IN_BALANCE: f64 = 1e-3;

/// How far a wall that was not in balance where it was built went until it rested under gravity, before it is shaken: a stone that leans on
/// an edge falls back onto its face.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Settled {
    /// Largest turn of a stone (rad).
    pub rotation_rad: f64,
    /// That stone.
    pub block: usize,
    /// How far its centroid went (m).
    pub displacement_m: f64,
}

impl Settled {
    /// From the bodies of a wall as built and at rest; `None` where it was in balance as built.
    pub(super) fn between(built: &Bodies, at_rest: &Bodies) -> Option<Settled> {
        let turned = built.all.iter().zip(&at_rest.all).enumerate().filter(|(_, (from, _))| from.moves());
        let of = |(block, (from, body)): (usize, (&Body, &Body))| Settled {
            rotation_rad: body.turn_since(from).norm(),
            block,
            displacement_m: (body.position - from.position).norm(),
        };
        let most = turned.map(of).max_by(|a, b| a.rotation_rad.total_cmp(&b.rotation_rad))?;
        (most.rotation_rad > IN_BALANCE).then_some(most)
    }
}
