//! Separating axes of two convex polyhedra: the direction along which they are furthest apart, or overlap least.

use crate::math::Vec3;
use crate::shape::Polyhedron;

/// A face that separates two polyhedra best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceAxis {
    /// Whether the face belongs to the second polyhedron.
    pub of_second: bool,
    /// The face.
    pub face: usize,
    /// Separation along its normal (m; negative = overlap depth).
    pub depth: f64,
}

/// Two edges whose common normal separates two polyhedra.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeAxis {
    /// Edge of the first polyhedron, as vertex indices.
    pub first: [u32; 2],
    /// Edge of the second polyhedron.
    pub second: [u32; 2],
    /// Their common unit normal, pointing from the first polyhedron to the second.
    pub normal: Vec3,
    /// Separation along it (m; negative = overlap depth).
    pub depth: f64,
}

/// The face, of either polyhedron, with the largest separation; a face of the second one must be better by more than
/// `preference` (m). `None` when some face separates them by more than `reach` (m).
pub fn best_face_axis(a: &Polyhedron, b: &Polyhedron, reach: f64, preference: f64) -> Option<FaceAxis> {
    let (face_a, depth_a) = best_face(a, b, reach)?;
    let (face_b, depth_b) = best_face(b, a, reach)?;
    Some(if depth_b > depth_a + preference {
        FaceAxis { of_second: true, face: face_b, depth: depth_b }
    } else {
        FaceAxis { of_second: false, face: face_a, depth: depth_a }
    })
}

/// The pair of edges with the largest separation, if it is larger than `beyond` (m).
pub fn best_edge_axis(a: &Polyhedron, b: &Polyhedron, beyond: f64) -> Option<EdgeAxis> {
    let (edges_a, edges_b) = (edges(a), edges(b));
    let between = mean(b) - mean(a);
    let mut best: Option<EdgeAxis> = None;
    for &(first, da) in &edges_a {
        for &(second, db) in &edges_b {
            let cross = da.cross(&db);
            // Nearly parallel edges span no plane; a face axis covers them.
            if cross.norm_squared() < 1e-6 * da.norm_squared() * db.norm_squared() {
                continue;
            }
            let mut normal = cross.normalize();
            if normal.dot(&between) < 0.0 {
                normal = -normal;
            }
            let (p, q) = (a.vertices[first[0] as usize], b.vertices[second[0] as usize]);
            let depth = normal.dot(&(q - p));
            // Only edges that support their solids are its outermost parts; the tolerance is for rounding alone.
            let rounding = 1e-12 * (da.norm() + db.norm());
            if depth > best.map_or(beyond, |x| x.depth)
                && support(a, &normal) <= normal.dot(&p) + rounding
                && support(b, &-normal) <= -normal.dot(&q) + rounding
            {
                best = Some(EdgeAxis { first, second, normal, depth });
            }
        }
    }
    best
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
        let axis = best_face_axis(&cube(), &upper, 0.01, 1e-6).unwrap();
        assert!(!axis.of_second && axis.face == 1, "{axis:?}");
        assert_relative_eq!(axis.depth, -0.001, epsilon = 1e-12);
    }

    #[test]
    fn crossed_ridges_meet_at_edges() {
        // Two cubes on their edges, one above the other, the ridges crossed at a right angle: half diagonals apart.
        let diagonal = 0.5f64.sqrt();
        let lower = cube().moved(&turned(0, 45.0), &Vec3::zeros());
        let upper = cube().moved(&turned(1, 45.0), &Vec3::new(0.0, 0.0, 2.0 * diagonal - 0.001));
        let face = best_face_axis(&lower, &upper, 0.01, 1e-6).unwrap();
        let axis = best_edge_axis(&lower, &upper, face.depth).unwrap();
        assert_relative_eq!(axis.depth, -0.001, epsilon = 1e-9);
        // Nothing beyond that.
        assert!(best_edge_axis(&lower, &upper, -0.0009).is_none());
    }

    #[test]
    fn far_solids_have_no_axis() {
        assert!(best_face_axis(&cube(), &cube().translated(&Vec3::new(1.2, 0.0, 0.0)), 0.1, 1e-6).is_none());
        // Apart by edges only: boxes overlap, faces overlap, the ridges do not.
        let lower = cube().moved(&turned(0, 45.0), &Vec3::zeros());
        let upper = cube().moved(&turned(1, 45.0), &Vec3::new(0.0, 0.0, 2.0 * 0.5f64.sqrt() + 0.01));
        let face = best_face_axis(&lower, &upper, 0.005, 1e-6).unwrap();
        assert_relative_eq!(best_edge_axis(&lower, &upper, face.depth).unwrap().depth, 0.01, epsilon = 1e-9);
    }
}
