//! The stones of a mesh: a file may hold several, which hang together by nothing.

use std::collections::HashMap;

use crate::exchange::closing::edges;
use crate::exchange::mesh::{Mesh, bits};

/// The parts of a mesh that share no corner, in the order of their first faces, as `name part 1` and so on; the mesh itself where it is one
/// part, or has no faces. Vertices that belong to no face are dropped. Every corner of a face must be the number of a vertex.
///
/// Corners are shared by their number. At an open edge they are also shared by their place: programs that shade each face by itself write the
/// corners once per face. Stones that are closed stay apart where they touch.
pub(in crate::exchange) fn pieces(mesh: Mesh) -> Vec<Mesh> {
    if mesh.faces.is_empty() {
        return vec![mesh];
    }
    let mut sets = Sets { above: (0..mesh.vertices.len() as u32).collect() };
    for face in &mesh.faces {
        face.windows(2).for_each(|pair| sets.join(pair[0], pair[1]));
    }
    let first = mesh.faces.iter().flatten().next().map(|&corner| sets.of(corner));
    if mesh.faces.iter().flatten().any(|&corner| Some(sets.of(corner)) != first) {
        let mut there: HashMap<[u64; 3], u32> = HashMap::new();
        for corner in open_corners(&mesh.faces) {
            let other = *there.entry(bits(&mesh.vertices[corner as usize])).or_insert(corner);
            sets.join(corner, other);
        }
    }
    divided(mesh, &mut sets)
}

/// Corners of edges that only one face has.
fn open_corners(faces: &[Vec<u32>]) -> Vec<u32> {
    let sorted = |(a, b): (u32, u32)| (a.min(b), a.max(b));
    let mut all: Vec<(u32, u32)> = faces.iter().flat_map(|face| edges(face).map(sorted)).collect();
    all.sort_unstable();
    let open = all.chunk_by(|a, b| a == b).filter(|same| same.len() == 1);
    open.flat_map(|same| [same[0].0, same[0].1]).collect()
}

/// A mesh for each set of corners that has faces.
fn divided(mesh: Mesh, sets: &mut Sets) -> Vec<Mesh> {
    const NONE: u32 = u32::MAX;
    let Mesh { name, is_support, line, vertices, faces } = mesh;
    // By the number of a vertex: the part of its set, and its own number there.
    let (mut part, mut own) = (vec![NONE; vertices.len()], vec![NONE; vertices.len()]);
    let mut parts: Vec<Mesh> = Vec::new();
    for &corner in faces.iter().flatten() {
        own[corner as usize] = 0;
        let set = sets.of(corner) as usize;
        if part[set] == NONE {
            part[set] = parts.len() as u32;
            parts.push(Mesh { name: name.clone(), is_support, line, ..Mesh::default() });
        }
    }
    for (number, at) in vertices.into_iter().enumerate() {
        if own[number] == NONE {
            continue;
        }
        let vertices = &mut parts[part[sets.of(number as u32) as usize] as usize].vertices;
        own[number] = vertices.len() as u32;
        vertices.push(at);
    }
    for mut face in faces {
        let Some(&corner) = face.first() else { continue };
        let of = part[sets.of(corner) as usize];
        face.iter_mut().for_each(|corner| *corner = own[*corner as usize]);
        parts[of as usize].faces.push(face);
    }
    if parts.len() > 1 {
        for (number, part) in (1..).zip(&mut parts) {
            part.name = Some(match &name {
                Some(name) => format!("{name} part {number}"),
                None => format!("part {number}"),
            });
        }
    }
    parts
}

/// Sets of corners that hang together.
struct Sets {
    /// A corner of the same set that stands nearer to the one by which the set is known.
    above: Vec<u32>,
}

impl Sets {
    /// The corner by which its set is known.
    fn of(&mut self, mut corner: u32) -> u32 {
        while self.above[corner as usize] != corner {
            let above = self.above[corner as usize];
            self.above[corner as usize] = self.above[above as usize];
            corner = above;
        }
        corner
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.of(a), self.of(b));
        self.above[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    /// Corners of a tetrahedron that begins at x; its faces go by the numbers of four corners.
    fn corners(x: f64) -> [Vec3; 4] {
        let at = Vec3::new(x, 0.0, 0.0);
        [at, at + Vec3::x(), at + Vec3::y(), at + Vec3::z()]
    }

    fn faces([a, b, c, d]: [u32; 4]) -> [Vec<u32>; 4] {
        [vec![a, c, b], vec![a, b, d], vec![b, c, d], vec![c, a, d]]
    }

    fn mesh(vertices: Vec<Vec3>, faces: Vec<Vec<u32>>) -> Mesh {
        Mesh { name: Some("a".to_owned()), line: 3, vertices, faces, ..Mesh::default() }
    }

    #[test]
    fn stones_that_touch_are_parts_and_what_no_face_uses_is_dropped() {
        let vertices = [&[Vec3::zeros()], &corners(0.0)[..], &corners(1.0)].concat();
        let mut all = [faces([1, 2, 3, 4]), faces([5, 6, 7, 8])].concat();
        all.swap(0, 4);
        let parts = pieces(mesh(vertices, all));
        assert_eq!(
            parts.iter().map(|p| p.name.as_deref()).collect::<Vec<_>>(),
            [Some("a part 1"), Some("a part 2")]
        );
        assert_eq!((&parts[0].vertices[..], parts[0].line), (&corners(1.0)[..], 3));
        assert_eq!(parts[0].faces[0], [0, 2, 1]);
        assert_eq!((&parts[1].vertices[..], parts[1].faces.len()), (&corners(0.0)[..], 4));
    }

    #[test]
    fn corners_written_once_per_face_are_shared() {
        let own = faces([0, 1, 2, 3]);
        let vertices = own.iter().flatten().map(|&corner| corners(0.0)[corner as usize]).collect();
        let apart = (0..4).map(|face| (3 * face..3 * face + 3).collect()).collect();
        let parts = pieces(mesh(vertices, apart));
        assert_eq!((parts.len(), parts[0].vertices.len(), parts[0].name.as_deref()), (1, 12, Some("a")));
    }

    #[test]
    fn points_stay_as_they_are() {
        let points = mesh(corners(0.0).to_vec(), Vec::new());
        assert_eq!(pieces(points.clone()), [points]);
    }
}
