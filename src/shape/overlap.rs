//! Whether two convex polyhedra overlap, by separating axes.

use crate::math::Vec3;
use crate::shape::Polyhedron;

/// Sine below which two edge directions count as parallel: their cross product is no axis.
const PARALLEL: f64 = 1e-9;

/// How deep two convex polyhedra overlap: the shortest way (m) that one would have to be moved to be clear of the
/// other. `None` when it is not more than `tolerance` (m): they are apart, or they touch.
///
/// Exact for convex solids: two of them are apart if and only if one of the face normals, or the cross product of
/// an edge of one with an edge of the other, separates them (Gottschalk, Lin and Manocha 1996, for boxes; the same
/// holds for all convex polyhedra).
///
/// ```
/// use pirca::{math::Vec3, shape::{Polyhedron, overlap_depth}};
/// let a = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(1.0, 1.0, 1.0));
/// assert_eq!(overlap_depth(&a, &a.translated(&Vec3::x()), 1e-9), None);
/// let depth = overlap_depth(&a, &a.translated(&Vec3::new(0.75, 0.5, 0.0)), 1e-9);
/// assert_eq!(depth, Some(0.25));
/// ```
pub fn overlap_depth(a: &Polyhedron, b: &Polyhedron, tolerance: f64) -> Option<f64> {
    let mut least = f64::INFINITY;
    let mut separates = |axis: &Vec3| {
        least = least.min(depth_along(a, b, axis));
        least <= tolerance
    };
    for solid in [a, b] {
        for face in 0..solid.faces.len() {
            if separates(&solid.face_plane(face).normal) {
                return None;
            }
        }
    }
    let (of_a, of_b) = (edge_directions(a), edge_directions(b));
    for p in &of_a {
        for q in &of_b {
            let axis = p.cross(q);
            let sine = axis.norm();
            if sine > PARALLEL && separates(&(axis / sine)) {
                return None;
            }
        }
    }
    Some(least)
}

/// How far the shadows of two solids on a unit axis overlap, negative when they are apart (m).
fn depth_along(a: &Polyhedron, b: &Polyhedron, axis: &Vec3) -> f64 {
    let shadow = |solid: &Polyhedron| {
        solid.vertices.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            let d = axis.dot(v);
            (low.min(d), high.max(d))
        })
    };
    let (p, q) = (shadow(a), shadow(b));
    (p.1 - q.0).min(q.1 - p.0)
}

/// The unit directions of the edges, parallel ones once.
fn edge_directions(solid: &Polyhedron) -> Vec<Vec3> {
    let mut directions: Vec<Vec3> = Vec::new();
    for face in &solid.faces {
        for (i, &from) in face.iter().enumerate() {
            let to = face[(i + 1) % face.len()];
            // Each edge belongs to two faces, which run it in opposite ways.
            if from < to {
                let d = (solid.vertices[to as usize] - solid.vertices[from as usize]).normalize();
                if directions.iter().all(|other| other.cross(&d).norm() > PARALLEL) {
                    directions.push(d);
                }
            }
        }
    }
    directions
}
