//! A concave solid as convex parts.
//!
//! The box around it is cut by the planes of its faces, each only where a piece of such a face lies inside; what is left are convex cells, each
//! wholly inside or outside. Cells inside that make up a convex solid are put together again. The parts fill the solid exactly.

use crate::exchange::closing::Face;
use crate::exchange::solid::polyhedron;
use crate::math::{Vec3, atan2};
use crate::shape::{Frame, Plane, Polyhedron, convex_union, triangles};

/// Share of a solid's size within which corners lie on a plane: files have single precision, and their faces are plane to no more.
const ROUNDING: f64 = 1e-6;
/// Most cells on the way; a solid that needs more is a scan.
const MOST_CELLS: usize = 2_000;
/// Share of the volume within which the parts fill the solid.
const FILLED: f64 = 1e-5;

/// A piece of a face inside a cell.
#[derive(Clone)]
struct Piece {
    plane: Plane,
    corners: Vec<Vec3>,
}

/// The convex parts of a closed solid whose faces are plane, of a size (m); `None` where there is no such solid, or too many parts.
pub fn convex_parts(vertices: &[Vec3], faces: &[Face], size: f64) -> Option<Vec<Polyhedron>> {
    let whole = polyhedron(vertices, faces);
    let surface = (0..faces.len()).map(|face| pieces(&whole, face)).collect::<Option<Vec<_>>>()?.concat();
    let used: Vec<Vec3> = surface.iter().flat_map(|piece| piece.corners.iter().copied()).collect();
    let (low, high) = Polyhedron { vertices: used, faces: Vec::new() }.bounds();
    let margin = Vec3::repeat(0.01 * size);
    let mut open = vec![(Polyhedron::cuboid(low - margin, high + margin), surface.clone())];
    let (mut inside, mut cells) = (Vec::new(), 0);
    while let Some((cell, pieces)) = open.pop() {
        cells += 1;
        if cells > MOST_CELLS {
            return None;
        }
        let Some(plane) = cutting(&cell, &pieces, size) else {
            let middle = cell.vertices.iter().sum::<Vec3>() / cell.vertices.len() as f64;
            inside.extend(encloses(&surface, &middle).then_some(cell));
            continue;
        };
        let (below, above) = cell.cut(&plane, ROUNDING * size);
        for part in [below, above].into_iter().flatten() {
            let within = pieces.iter().filter_map(|piece| clipped(piece, &part, size)).collect();
            open.push((part, within));
        }
    }
    let parts = put_together(inside);
    let filled: f64 = parts.iter().map(Polyhedron::volume).sum();
    let volume = whole.volume();
    (volume > 0.0 && (filled - volume).abs() <= FILLED * volume).then_some(parts)
}

/// A face as triangles, which a concave face needs as well.
fn pieces(whole: &Polyhedron, face: usize) -> Option<Vec<Piece>> {
    let corners: Vec<Vec3> = whole.face_vertices(face).collect();
    let plane = whole.face_plane(face);
    if !plane.offset.is_finite() {
        return None;
    }
    let frame = Frame::on_plane(corners[0], plane.normal);
    let flat: Vec<[f64; 2]> = corners.iter().map(|corner| frame.project(corner)).collect();
    let piece = |own: [usize; 3]| Piece { plane, corners: own.map(|k| corners[k]).to_vec() };
    Some(triangles(&flat)?.into_iter().map(piece).collect())
}

/// The plane that a cell is to be cut by: that of the largest piece of a face inside it; `None` where none is.
fn cutting(cell: &Polyhedron, pieces: &[Piece], size: f64) -> Option<Plane> {
    let crosses = |plane: &Plane| {
        let beyond = |sign: f64| cell.vertices.iter().any(|v| sign * plane.distance(v) > ROUNDING * size);
        beyond(1.0) && beyond(-1.0)
    };
    let inside = pieces.iter().filter(|piece| crosses(&piece.plane));
    inside.max_by(|a, b| area(&a.corners).total_cmp(&area(&b.corners))).map(|piece| piece.plane)
}

/// The part of a piece inside a cell; `None` where there is none, or a line.
fn clipped(piece: &Piece, cell: &Polyhedron, size: f64) -> Option<Piece> {
    let mut corners = piece.corners.clone();
    for face in 0..cell.faces.len() {
        let plane = cell.face_plane(face);
        let mut kept = Vec::with_capacity(corners.len() + 1);
        for (k, a) in corners.iter().enumerate() {
            let b = &corners[(k + 1) % corners.len()];
            let (da, db) = (plane.distance(a), plane.distance(b));
            if da <= ROUNDING * size {
                kept.push(*a);
            }
            if (da > ROUNDING * size && db < -ROUNDING * size)
                || (da < -ROUNDING * size && db > ROUNDING * size)
            {
                kept.push(a + (b - a) * (da / (da - db)));
            }
        }
        corners = kept;
        if corners.len() < 3 {
            return None;
        }
    }
    (area(&corners) > ROUNDING * size * size).then_some(Piece { plane: piece.plane, corners })
}

fn area(corners: &[Vec3]) -> f64 {
    let around = corners[1..].windows(2).map(|pair| (pair[0] - corners[0]).cross(&(pair[1] - corners[0])));
    0.5 * around.sum::<Vec3>().norm()
}

/// Whether a surface of triangles runs round a point that is not on it: by the solid angles that they fill (Van Oosterom and Strackee 1983).
fn encloses(surface: &[Piece], point: &Vec3) -> bool {
    let angle = |piece: &Piece| {
        let [a, b, c] = [0, 1, 2].map(|k| piece.corners[k] - point);
        let [la, lb, lc] = [a, b, c].map(|side| side.norm());
        let below = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
        2.0 * atan2(a.dot(&b.cross(&c)), below)
    };
    surface.iter().map(angle).sum::<f64>() > 2.0 * std::f64::consts::PI
}

/// Cells put together as long as two of them make up a convex solid.
fn put_together(mut cells: Vec<Polyhedron>) -> Vec<Polyhedron> {
    cells.sort_by(|a, b| b.volume().total_cmp(&a.volume()));
    let mut at = 0;
    while at < cells.len() {
        let joined = (at + 1..cells.len()).find_map(|k| Some((k, convex_union(&[&cells[at], &cells[k]])?)));
        match joined {
            Some((k, whole)) => {
                cells[at] = whole;
                cells.remove(k);
                // What it could not be put together with before, it may be now.
                at = 0;
            }
            None => at += 1,
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A prism of 0.2 m along y over an outline in x and z, which runs counter-clockwise seen from the front (against y).
    fn prism(outline: &[[f64; 2]]) -> (Vec<Vec3>, Vec<Face>) {
        let n = outline.len() as u32;
        let at = |y: f64| outline.iter().map(move |[x, z]| Vec3::new(*x, y, *z));
        let vertices: Vec<Vec3> = at(0.0).chain(at(0.2)).collect();
        let mut corners: Vec<Vec<u32>> = vec![(0..n).collect(), (n..2 * n).rev().collect()];
        corners.extend((0..n).map(|k| {
            let next = (k + 1) % n;
            vec![k, k + n, next + n, next]
        }));
        (
            vertices,
            corners.into_iter().enumerate().map(|(number, corners)| Face { number, corners }).collect(),
        )
    }

    fn parts(outline: &[[f64; 2]]) -> Vec<Polyhedron> {
        let (vertices, faces) = prism(outline);
        let parts = convex_parts(&vertices, &faces, 3.0).expect("parts");
        parts.iter().for_each(|part| part.validate(1e-7).unwrap());
        parts
    }

    #[test]
    fn an_l_is_two_parts_and_a_frame_three() {
        let l = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        let two = parts(&l);
        assert_eq!(two.len(), 2);
        assert!((two.iter().map(Polyhedron::volume).sum::<f64>() - 0.6).abs() < 1e-12);
        let frame =
            [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.5, 2.0], [2.5, 0.5], [0.5, 0.5], [0.5, 2.0], [0.0, 2.0]];
        assert_eq!(parts(&frame).len(), 3);
    }

    #[test]
    fn a_convex_solid_is_one_part_with_its_own_corners() {
        let one = parts(&[[0.0, 0.0], [1.0, 0.0], [1.3, 0.7], [0.2, 1.0]]);
        assert_eq!((one.len(), one[0].vertices.len(), one[0].faces.len()), (1, 8, 6));
        assert!(one[0].vertices.iter().any(|v| (v - Vec3::new(1.3, 0.2, 0.7)).norm() < 1e-12));
    }

    #[test]
    fn a_pyramid_with_a_dent_is_filled() {
        // A square pyramid, and the same turned into it from below by half its height.
        let p = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
        let vertices = vec![
            p(0.0, 0.0, 0.0),
            p(1.0, 0.0, 0.0),
            p(1.0, 1.0, 0.0),
            p(0.0, 1.0, 0.0),
            p(0.5, 0.5, 1.0),
            p(0.5, 0.5, 0.5),
        ];
        let corners: [[u32; 3]; 8] =
            [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
        let faces: Vec<Face> =
            corners.iter().enumerate().map(|(number, own)| Face { number, corners: own.to_vec() }).collect();
        let parts = convex_parts(&vertices, &faces, 1.7).expect("parts");
        assert!((parts.iter().map(Polyhedron::volume).sum::<f64>() - 1.0 / 6.0).abs() < 1e-9);
        assert!(parts.len() <= 4, "{}", parts.len());
    }

    #[test]
    fn a_surface_that_is_inside_out_has_no_parts() {
        let (vertices, mut faces) = prism(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        faces.iter_mut().for_each(|face| face.corners.reverse());
        assert!(convex_parts(&vertices, &faces, 1.0).is_none());
    }
}
