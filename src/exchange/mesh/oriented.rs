//! Faces of a mesh turned the same way round: programs that draw them do not care, volumes do.

use std::collections::HashMap;

use crate::exchange::closing::edges;
use crate::exchange::mesh::{Mesh, bits};
use crate::math::Vec3;

/// Turns faces until each edge of two faces runs once to and once fro, and the mesh holds a positive volume, piece by piece.
pub fn orient(mesh: &mut Mesh) {
    let corner = corners(&mesh.vertices);
    let mut beside: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
    for (face, corners) in mesh.faces.iter().enumerate() {
        for (a, b) in placed(corners, &corner) {
            beside.entry((a.min(b), a.max(b))).or_default().push(face);
        }
    }
    let mut turned: Vec<Option<bool>> = vec![None; mesh.faces.len()];
    for first in 0..mesh.faces.len() {
        if turned[first].is_some() {
            continue;
        }
        turned[first] = Some(false);
        let mut piece = vec![first];
        let mut next = 0;
        while next < piece.len() {
            let face = piece[next];
            next += 1;
            for (a, b) in placed(&mesh.faces[face], &corner) {
                let &[one, two] = &beside[&(a.min(b), a.max(b))][..] else { continue };
                let other = if one == face { two } else { one };
                if other != face && turned[other].is_none() {
                    // Both run along the edge the same way where one of them is turned and the other is not.
                    let same = placed(&mesh.faces[other], &corner).any(|edge| edge == (a, b));
                    turned[other] = Some(turned[face] == Some(!same));
                    piece.push(other);
                }
            }
        }
        let volume: f64 = piece
            .iter()
            .map(|face| {
                let share = share(&mesh.vertices, &mesh.faces[*face]);
                if turned[*face] == Some(true) { -share } else { share }
            })
            .sum();
        if volume < 0.0 {
            piece.iter().for_each(|face| turned[*face] = turned[*face].map(|own| !own));
        }
    }
    for (face, turned) in mesh.faces.iter_mut().zip(turned) {
        if turned == Some(true) {
            face.reverse();
        }
    }
}

/// Corners by their places, as a program may write one for each face.
fn corners(vertices: &[Vec3]) -> Vec<u32> {
    let mut first = HashMap::new();
    (0..).zip(vertices).map(|(number, at)| *first.entry(bits(at)).or_insert(number)).collect()
}

/// The edges of a face by the places of their ends, in its own way round.
fn placed<'f>(face: &'f [u32], corner: &'f [u32]) -> impl Iterator<Item = (u32, u32)> + 'f {
    edges(face).map(|(a, b)| (corner[a as usize], corner[b as usize]))
}

/// Six times the volume between a face and the first corner of the mesh.
fn share(vertices: &[Vec3], face: &[u32]) -> f64 {
    let at = |k: usize| vertices[face[k] as usize] - vertices[0];
    (1..face.len().saturating_sub(1)).map(|k| at(0).dot(&at(k).cross(&at(k + 1)))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Polyhedron;

    #[test]
    fn faces_that_look_anywhere_look_outwards() {
        let cuboid = Polyhedron::cuboid(Vec3::new(1.0, 2.0, 3.0), Vec3::new(2.0, 3.0, 4.0));
        for turned in 0..64_u32 {
            let mut faces = cuboid.faces.clone();
            faces
                .iter_mut()
                .enumerate()
                .filter(|(k, _)| turned >> k & 1 == 1)
                .for_each(|(_, own)| own.reverse());
            let mut mesh = Mesh { vertices: cuboid.vertices.clone(), faces, ..Mesh::default() };
            orient(&mut mesh);
            let now = Polyhedron { vertices: mesh.vertices, faces: mesh.faces };
            assert!((now.volume() - 1.0).abs() < 1e-12, "{turned:b}");
        }
    }
}
