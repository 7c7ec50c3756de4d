//! Ropes across the downhill face of a wall, as ties of the stones that they cross.

use crate::math::Vec3;
use crate::model::{Tag, Wall};
use crate::protocol::faces::is_covered;
use crate::protocol::{Direction, Rope};
use crate::shape::Polyhedron;
use crate::solve::Tie;

/// The ties of a wall of stones: at each end, every stone whose face the rope crosses. Ropes hold out of plane; on a
/// platform that goes down along the wall they are on its front.
pub fn ropes(wall: &Wall, rope: &Rope, towards: Direction) -> Vec<Tie> {
    let direction = if towards.is_backwards() { -Vec3::y() } else { Vec3::y() };
    let (low, high) = wall.bounds_of_stones();
    let mut ties = Vec::new();
    for x in [low.x + rope.from_end, high.x - rope.from_end] {
        for (body, stone) in wall.stones().filter(|(_, stone)| stone.tag != Tag::Wedge) {
            let Some(point) = crossing(&stone.shape, x, direction) else { continue };
            if !is_covered(wall, body, point, direction) {
                ties.push(Tie {
                    body,
                    point,
                    direction,
                    stiffness: rope.stiffness,
                    pretension: rope.pretension,
                    slack: rope.slack,
                    two_sided: rope.two_sided,
                    travel: 0.0,
                });
            }
        }
    }
    ties
}

/// Where the plane at `x` cuts the face of a stone that looks most squarely along a direction: the middle of the cut.
fn crossing(stone: &Polyhedron, x: f64, direction: Vec3) -> Option<Vec3> {
    let (face, _) = (0..stone.faces.len())
        .map(|face| (face, stone.face_plane(face).normal.dot(&direction)))
        .fold((0, f64::NEG_INFINITY), |best, next| if next.1 > best.1 { next } else { best });
    let corners: Vec<Vec3> = stone.face_vertices(face).collect();
    let cuts = corners.iter().enumerate().filter_map(|(k, from)| {
        let to = &corners[(k + 1) % corners.len()];
        let (a, b) = (from.x - x, to.x - x);
        // A corner on the plane belongs to the side beyond, so that the cut has two ends or none.
        ((a < 0.0) != (b < 0.0)).then(|| from + (to - from) * (a / (a - b)))
    });
    let ends: Vec<Vec3> = cuts.collect();
    (ends.len() == 2).then(|| (ends[0] + ends[1]) * 0.5)
}
