//! Which block is painted before which: the painter's algorithm on convex blocks.

use std::collections::BTreeSet;

use crate::math::Vec3;
use crate::render::picture::view::View;
use crate::shape::Polyhedron;

/// Outlines that overlap by less than this share of the wall's height do not hide each other.
pub const GRAZES: f64 = 5e-3;
/// Cosine to the line of sight below which a plane is seen edge-on, so that neither side of it hides the other.
const EDGE_ON: f64 = 1e-9;

/// The blocks from the furthest to the nearest.
///
/// Of two blocks whose outlines overlap in the picture by more than `depth` (m), the one on the viewer's side of a plane between them comes later;
/// the plane is a face of either, the one that separates them best. Where that leaves a choice, or goes round in a ring, the
/// block whose centroid is further away comes first. Two limits: blocks that only a plane along two crossing edges separates,
/// or that the enlarged movement pushes into each other, may be painted in the wrong order; and a ring of blocks, each before
/// the next, is drawn with one of them wrong.
pub fn back_to_front(shapes: &[Polyhedron], view: &View, depth: f64) -> Vec<usize> {
    let outlines: Vec<Outline> = shapes.iter().map(|shape| Outline::of(shape, view)).collect();
    let mut hides: Vec<Vec<usize>> = vec![Vec::new(); shapes.len()];
    let mut hidden_by = vec![0; shapes.len()];
    for a in 0..shapes.len() {
        for b in a + 1..shapes.len() {
            if !outlines[a].overlaps(&outlines[b], depth) {
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

/// The corners of a block in the picture (m), and the directions across its edges there.
struct Outline {
    corners: Vec<[f64; 2]>,
    across: Vec<[f64; 2]>,
}

impl Outline {
    fn of(shape: &Polyhedron, view: &View) -> Outline {
        let corners: Vec<[f64; 2]> = shape.vertices.iter().map(|v| view.place(v)).collect();
        let edges = shape.faces.iter().flat_map(|face| face.iter().zip(face.iter().cycle().skip(1)));
        // Each edge belongs to two faces; one of them is enough.
        let across = edges.filter(|(a, b)| a < b).filter_map(|(&a, &b)| {
            let ([x0, y0], [x1, y1]) = (corners[a as usize], corners[b as usize]);
            let length = ((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)).sqrt();
            (length > 0.0).then(|| [(y0 - y1) / length, (x1 - x0) / length])
        });
        Outline { across: across.collect(), corners }
    }

    /// From where to where it reaches along a direction.
    fn reach(&self, along: &[f64; 2]) -> [f64; 2] {
        let at = self.corners.iter().map(|c| c[0] * along[0] + c[1] * along[1]);
        at.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    }

    /// Whether two outlines overlap by more than a depth (m); both are convex, so a direction across an edge of either tells.
    fn overlaps(&self, other: &Outline, depth: f64) -> bool {
        self.across.iter().chain(&other.across).all(|along| {
            let ([a0, a1], [b0, b1]) = (self.reach(along), other.reach(along));
            (a1 - b0).min(b1 - a0) > depth
        })
    }
}
