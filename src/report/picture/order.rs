//! Which block is painted before which: the painter's algorithm on convex blocks.

use std::collections::BTreeSet;

use crate::math::Vec3;
use crate::report::picture::view::View;
use crate::shape::Polyhedron;

/// Cosine to the line of sight below which a plane is seen edge-on, so that neither side of it hides the other.
const EDGE_ON: f64 = 1e-9;

/// The blocks from the furthest to the nearest.
///
/// Of two blocks whose outlines overlap in the picture, the one on the viewer's side of a plane between them comes later;
/// the plane is a face of either, the one that separates them best. Where that leaves a choice, or goes round in a ring, the
/// block whose centroid is further away comes first. Two limits: blocks that only a plane along two crossing edges separates,
/// or that the enlarged movement pushes into each other, may be painted in the wrong order; and a ring of blocks, each before
/// the next, is drawn with one of them wrong.
pub fn back_to_front(shapes: &[Polyhedron], view: &View) -> Vec<usize> {
    let outlines: Vec<[f64; 4]> = shapes.iter().map(|shape| outline(shape, view)).collect();
    let mut hides: Vec<Vec<usize>> = vec![Vec::new(); shapes.len()];
    let mut hidden_by = vec![0; shapes.len()];
    for a in 0..shapes.len() {
        for b in a + 1..shapes.len() {
            if !overlap(&outlines[a], &outlines[b]) {
                continue;
            }
            if let Some(second_is_nearer) = nearer(&shapes[a], &shapes[b], view) {
                let (far, near) = if second_is_nearer { (a, b) } else { (b, a) };
                hides[far].push(near);
                hidden_by[near] += 1;
            }
        }
    }
    let near: Vec<f64> = shapes.iter().map(|s| view.nearness(&s.mass_properties().centroid)).collect();
    let mut left: BTreeSet<usize> = (0..shapes.len()).collect();
    let mut order = Vec::with_capacity(shapes.len());
    while !left.is_empty() {
        // In a ring none is free; the furthest one opens it.
        let furthest = |free: bool| {
            let candidates = left.iter().copied().filter(|&i| !free || hidden_by[i] == 0);
            candidates.min_by(|&a, &b| near[a].total_cmp(&near[b]).then(a.cmp(&b)))
        };
        let Some(next) = furthest(true).or_else(|| furthest(false)) else { break };
        left.remove(&next);
        for &other in &hides[next] {
            hidden_by[other] -= 1;
        }
        order.push(next);
    }
    order
}

/// Whether the second block is on the viewer's side of the plane that separates the two best; `None` where that plane is
/// seen edge-on.
fn nearer(first: &Polyhedron, second: &Polyhedron, view: &View) -> Option<bool> {
    let mut best = (f64::NEG_INFINITY, Vec3::zeros());
    for (own, other, sign) in [(first, second, 1.0), (second, first, -1.0)] {
        for face in 0..own.faces.len() {
            let plane = own.face_plane(face);
            let gap = other.vertices.iter().map(|v| plane.distance(v)).fold(f64::INFINITY, f64::min);
            if gap > best.0 {
                best = (gap, plane.normal * sign);
            }
        }
    }
    let towards = best.1.dot(&view.viewer);
    (towards.abs() > EDGE_ON).then_some(towards > 0.0)
}

/// Left, right, bottom and top of a block in the picture (m).
fn outline(shape: &Polyhedron, view: &View) -> [f64; 4] {
    let start = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    shape
        .vertices
        .iter()
        .map(|v| view.place(v))
        .fold(start, |[l, r, b, t], [x, y]| [l.min(x), r.max(x), b.min(y), t.max(y)])
}

fn overlap(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3]
}
