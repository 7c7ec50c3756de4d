//! What still overlaps when joints are planes: a corner or an edge that reaches into another stone.

use crate::mend::ROUNDING;
use crate::mend::stone::sound;
use crate::model::{Support, Wall};
use crate::shape::{Plane, Polyhedron, overlap_depth};

/// Cuts one of every two blocks that overlap by at most `within` (m) at the face of the other that it passes least. Gives the pairs that overlap
/// still, with the depth (m).
pub fn cut_overlaps(
    wall: &Wall,
    shapes: &mut [Polyhedron],
    pairs: &[(u32, u32)],
    within: f64,
) -> Vec<((usize, usize), f64)> {
    let leads = wall.leads();
    let is_fixed = |block: usize| wall.blocks[block].support == Support::Fixed;
    let mut left = Vec::new();
    for &(a, b) in pairs {
        let (a, b) = (a as usize, b as usize);
        if leads[a] == leads[b] || (is_fixed(a) && is_fixed(b)) {
            continue;
        }
        let rounding = ROUNDING * shapes[a].diameter().min(shapes[b].diameter());
        let Some(depth) = overlap_depth(&shapes[a], &shapes[b], rounding) else { continue };
        // The face that needs the thinnest slice of the other block, which must be one that may be cut.
        let ways = [(a, b), (b, a)].into_iter().filter(|(_, cut)| !is_fixed(*cut));
        let faces = ways.flat_map(|(by, cut)| (0..shapes[by].faces.len()).map(move |face| (by, cut, face)));
        let slices = faces.map(|(by, cut, face)| {
            let plane = shapes[by].face_plane(face);
            (slice(&shapes[cut], &plane), cut, plane)
        });
        let thinnest = slices.fold(None::<(f64, usize, Plane)>, |best, next| match best {
            Some(best) if best.0 <= next.0 => Some(best),
            _ => Some(next),
        });
        let done = thinnest.filter(|(thick, ..)| *thick <= within).and_then(|(_, cut, plane)| {
            let outside = shapes[cut].cut(&plane, rounding).1?;
            Some((cut, sound(outside, &shapes[cut])?))
        });
        match done {
            Some((cut, shape)) => shapes[cut] = shape,
            None => left.push(((a, b), depth)),
        }
    }
    left
}

/// How much (m) of a shape lies behind a plane.
fn slice(shape: &Polyhedron, plane: &Plane) -> f64 {
    shape.vertices.iter().map(|v| -plane.distance(v)).fold(f64::NEG_INFINITY, f64::max)
}
