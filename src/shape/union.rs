//! Solids from planes, and parts that make up a convex solid.

use crate::math::Vec3;
use crate::shape::{Plane, Polyhedron};

/// Share of the size within which corners lie on a plane, and of the volume within which parts fill a solid: rounding alone.
const ROUNDING: f64 = 1e-9;

impl Polyhedron {
    /// What lies behind all planes, within a box of `size` (m) around some points; corners that a plane passes within
    /// `tolerance` (m) are not cut. `None` where nothing is left.
    pub fn behind(planes: &[Plane], around: &[Vec3], size: f64, tolerance: f64) -> Option<Polyhedron> {
        let (low, high) = Polyhedron { vertices: around.to_vec(), faces: Vec::new() }.bounds();
        let margin = Vec3::repeat(size);
        let start = Some(Polyhedron::cuboid(low - margin, high + margin));
        planes.iter().fold(start, |rest, plane| rest?.cut(plane, tolerance).0)
    }
}

/// The convex solid that several convex solids make up without a gap and without sharing a place; `None` where they do not.
///
/// Its faces lie in the planes of those faces of the parts that have all parts behind them.
pub fn convex_union(parts: &[&Polyhedron]) -> Option<Polyhedron> {
    let corners: Vec<Vec3> = parts.iter().flat_map(|part| part.vertices.iter().copied()).collect();
    let (low, high) = Polyhedron { vertices: corners.clone(), faces: Vec::new() }.bounds();
    let size = (high - low).norm();
    let outer = |plane: &Plane| corners.iter().all(|corner| plane.distance(corner) <= ROUNDING * size);
    let planes: Vec<Plane> = parts
        .iter()
        .flat_map(|part| (0..part.faces.len()).map(|face| part.face_plane(face)))
        .filter(outer)
        .collect();
    let solid = Polyhedron::behind(&planes, &corners, size, ROUNDING * size)?;
    let filled: f64 = parts.iter().map(|part| part.volume()).sum();
    ((solid.volume() - filled).abs() <= ROUNDING * filled).then_some(solid)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_a_cut_make_up_the_solid_again() {
        let whole = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(0.4, 0.3, 0.2));
        for normal in [Vec3::x(), Vec3::new(0.3, -0.2, 1.0), Vec3::new(1.0, 1.0, 1.0)] {
            let (below, above) = whole.cut(&Plane::through(Vec3::new(0.2, 0.1, 0.1), normal), 1e-9);
            let again = convex_union(&[&below.unwrap(), &above.unwrap()]).unwrap();
            assert_eq!((again.vertices.len(), again.faces.len()), (8, 6));
            again.validate(1e-14).unwrap();
            // Each corner is where it was but for rounding.
            for corner in &whole.vertices {
                assert!(again.vertices.iter().any(|v| (v - corner).norm() < 1e-14), "{corner}");
            }
        }
    }

    #[test]
    fn parts_of_a_concave_solid_and_parts_that_overlap_or_gape_make_up_none() {
        let part = |x: f64, length: f64, height: f64| {
            Polyhedron::cuboid(Vec3::new(x, 0.0, 0.0), Vec3::new(x + length, 0.2, height))
        };
        let first = part(0.0, 0.3, 0.2);
        assert!(convex_union(&[&first, &part(0.3, 0.3, 0.2)]).is_some());
        for other in [part(0.3, 0.3, 0.4), part(0.2, 0.3, 0.2), part(0.31, 0.3, 0.2)] {
            assert_eq!(convex_union(&[&first, &other]), None);
        }
    }
}
