//! Separating axes of two convex polyhedra: the direction along which they are furthest apart, or overlap least.

use crate::math::Vec3;
use crate::shape::Polyhedron;

/// Where two polyhedra come nearest, as the separating axis of largest signed distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axis {
    /// A face of the first polyhedron.
    FaceOfFirst(usize),
    /// A face of the second polyhedron.
    FaceOfSecond(usize),
    /// An edge of each, as vertex index pairs.
    Edges([u32; 2], [u32; 2]),
}

/// The axis of largest separation and that separation (m; negative = overlap depth).
///
/// An edge pair wins only when it separates by more than `preference` (m) beyond the best face: resting faces are
/// never mistaken for crossing edges by rounding. Ties between faces go to the first polyhedron in the same way.
/// `None` when the separation exceeds `reach` (m).
pub fn deepest_axis(a: &Polyhedron, b: &Polyhedron, reach: f64, preference: f64) -> Option<(Axis, f64)> {
    let (face_a, mut best) = best_face(a, b, reach)?;
    let mut axis = Axis::FaceOfFirst(face_a);
    let (face_b, depth_b) = best_face(b, a, reach)?;
    if depth_b > best + preference {
        best = depth_b;
        axis = Axis::FaceOfSecond(face_b);
    }
    let face_depth = best;
    let (edges_a, edges_b) = (edges(a), edges(b));
    let (centre_a, centre_b) = (mean(a), mean(b));
    for &(ea, da) in &edges_a {
        for &(eb, db) in &edges_b {
            let cross = da.cross(&db);
            // Nearly parallel edges span no plane; a face axis covers them.
            if cross.norm_squared() < 1e-6 * da.norm_squared() * db.norm_squared() {
                continue;
            }
            let mut normal = cross.normalize();
            if normal.dot(&(centre_b - centre_a)) < 0.0 {
                normal = -normal;
            }
            let p = a.vertices[ea[0] as usize];
            let q = b.vertices[eb[0] as usize];
            // Only edges that support their solid along the axis can be the nearest features.
            let depth = normal.dot(&(q - p));
            if depth <= best.max(face_depth + preference)
                || support(a, &normal) > normal.dot(&p) + preference
                || -support(b, &-normal) < normal.dot(&q) - preference
            {
                continue;
            }
            best = depth;
            axis = Axis::Edges(ea, eb);
        }
    }
    (best <= reach).then_some((axis, best))
}

/// The face of `a` whose plane `b` stays furthest outside of; `None` as soon as one separates by more than `reach`.
fn best_face(a: &Polyhedron, b: &Polyhedron, reach: f64) -> Option<(usize, f64)> {
    let mut best = (0, f64::NEG_INFINITY);
    for face in 0..a.faces.len() {
        let plane = a.face_plane(face);
        let depth = b.vertices.iter().map(|v| plane.distance(v)).fold(f64::INFINITY, f64::min);
        if depth > reach {
            return None;
        }
        if depth > best.1 {
            best = (face, depth);
        }
    }
    Some(best)
}

/// Largest coordinate of a polyhedron along a direction.
fn support(solid: &Polyhedron, direction: &Vec3) -> f64 {
    solid.vertices.iter().map(|v| v.dot(direction)).fold(f64::NEG_INFINITY, f64::max)
}

fn mean(solid: &Polyhedron) -> Vec3 {
    solid.vertices.iter().sum::<Vec3>() / solid.vertices.len() as f64
}

/// Every edge once, with its direction.
fn edges(solid: &Polyhedron) -> Vec<([u32; 2], Vec3)> {
    let mut out = Vec::new();
    for f in &solid.faces {
        for (i, &from) in f.iter().enumerate() {
            let to = f[(i + 1) % f.len()];
            if from < to {
                out.push(([from, to], solid.vertices[to as usize] - solid.vertices[from as usize]));
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Mat3, cos, radians, sin};
    use approx::assert_relative_eq;

    fn cube() -> Polyhedron {
        Polyhedron::cuboid(Vec3::repeat(-0.5), Vec3::repeat(0.5))
    }

    fn turned(axis: usize, degrees: f64) -> Mat3 {
        let (c, s) = (cos(radians(degrees)), sin(radians(degrees)));
        match axis {
            0 => Mat3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
            1 => Mat3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c),
            _ => Mat3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
        }
    }

    #[test]
    fn stacked_cubes_meet_at_faces() {
        let upper = cube().translated(&Vec3::new(0.3, 0.0, 0.999));
        let (axis, depth) = deepest_axis(&cube(), &upper, 0.01, 1e-6).unwrap();
        assert_eq!(axis, Axis::FaceOfFirst(1));
        assert_relative_eq!(depth, -0.001, epsilon = 1e-12);
    }

    #[test]
    fn crossed_ridges_meet_at_edges() {
        // Two cubes on their edges, one above the other, the ridges crossed at a right angle: half diagonals apart.
        let diagonal = 0.5f64.sqrt();
        let lower = cube().moved(&turned(0, 45.0), &Vec3::zeros());
        let upper = cube().moved(&turned(1, 45.0), &Vec3::new(0.0, 0.0, 2.0 * diagonal - 0.001));
        let (axis, depth) = deepest_axis(&lower, &upper, 0.01, 1e-6).unwrap();
        assert!(matches!(axis, Axis::Edges(..)), "{axis:?}");
        assert_relative_eq!(depth, -0.001, epsilon = 1e-9);
    }

    #[test]
    fn far_solids_have_no_axis() {
        assert!(deepest_axis(&cube(), &cube().translated(&Vec3::new(1.2, 0.0, 0.0)), 0.1, 1e-6).is_none());
        // Apart by edges only: boxes overlap, faces overlap, the ridges do not.
        let lower = cube().moved(&turned(0, 45.0), &Vec3::zeros());
        let upper = cube().moved(&turned(1, 45.0), &Vec3::new(0.0, 0.0, 2.0 * 0.5f64.sqrt() + 0.01));
        assert!(deepest_axis(&lower, &upper, 0.005, 1e-6).is_none());
    }
}
