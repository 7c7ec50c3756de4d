//! Reading STL: triangles as words, in one or more solids, or as bytes.
//!
//! Not by a crate: stl_io (0.11) reads the first solid only, takes bytes that begin with "solid" for words, rounds words to single precision
//! and names no lines.

use std::collections::HashMap;

use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::mesh::{
    AGAIN, MOST_FACES, MOST_FAULTS, MOST_VERTICES, Mesh, SIMPLIFY, bits, enough, is_sliver, quoted, refusal,
};
use crate::math::Vec3;

/// Bytes before the first triangle: a remark, and how many triangles there are.
const HEAD: usize = 84;
/// Bytes of a triangle: its normal, three corners, and two that mean nothing.
const TRIANGLE: usize = 50;

/// The bodies in an STL file: one per solid with triangles where it is of words, one where it is of bytes. Equal corners are one, in the order
/// in which they are first there; triangles with a corner twice hold no area and are left out.
///
/// # Errors
/// Everything that is wrong with the file, with lines, or with bytes where it has no lines.
pub(in crate::exchange) fn read_stl(bytes: &[u8]) -> Result<Vec<Mesh>, WallFaults> {
    let mut reader =
        Reader { faults: WallFaults::new("mesh.stl"), done: Vec::new(), now: None, vertices: 0, faces: 0 };
    let read = if is_words(bytes) { reader.words(bytes) } else { reader.bytes(bytes) };
    let Reader { mut faults, done, .. } = reader;
    if let Err(fault) = read {
        faults.push_last(*fault);
    } else if faults.is_empty() && done.is_empty() {
        let fix = "export the stones as triangles";
        faults.push(Fault::of("", "it has no triangles", "at least one solid with triangles", fix));
    }
    if faults.is_empty() { Ok(done) } else { Err(faults) }
}

/// Whether a file is of words. Many of bytes begin with "solid" too: those are as long as they say, or hold a zero soon.
fn is_words(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let solid = start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    solid
        && stated(bytes).is_none_or(|(_, size)| size != bytes.len())
        && !bytes[..bytes.len().min(512)].contains(&0)
}

/// How many triangles a file of bytes says that it has, and how long it must be.
fn stated(bytes: &[u8]) -> Option<(usize, usize)> {
    let count = u32::from_le_bytes(*bytes.get(HEAD - 4..)?.first_chunk()?) as usize;
    Some((count, count.checked_mul(TRIANGLE)?.checked_add(HEAD)?))
}

struct Reader {
    faults: WallFaults,
    done: Vec<Mesh>,
    /// The solid that is being read.
    now: Option<Solid>,
    /// Vertices and faces of the whole file.
    vertices: usize,
    faces: usize,
}

/// A solid, and where its corners are already.
#[derive(Default)]
struct Solid {
    mesh: Mesh,
    corners: HashMap<[u64; 3], u32>,
    /// The corners of the triangle that is being read.
    face: Vec<u32>,
}

impl Solid {
    fn corner(&mut self, at: Vec3) {
        let next = self.mesh.vertices.len() as u32;
        let corner = *self.corners.entry(bits(&at)).or_insert(next);
        if corner == next {
            self.mesh.vertices.push(at);
        }
        self.face.push(corner);
    }
}

impl Reader {
    fn bytes(&mut self, bytes: &[u8]) -> Result<(), Box<Fault>> {
        let Some((count, size)) = stated(bytes) else {
            let found = format!("{} bytes that do not begin with \"solid\"", bytes.len());
            return Err(refusal("", found, "an STL file", "export the stones as STL, PLY or OBJ"));
        };
        if size > bytes.len() {
            let found = format!("it says that it has {count} triangles and has {} bytes", bytes.len());
            return Err(refusal("", found, format!("{size} bytes for so many"), AGAIN));
        }
        self.now = Some(Solid::default());
        for (number, triangle) in bytes[HEAD..size].chunks_exact(TRIANGLE).enumerate() {
            let mut numbers = triangle
                .chunks_exact(4)
                .skip(3)
                .map(|own| f64::from(f32::from_le_bytes([own[0], own[1], own[2], own[3]])));
            for _ in 0..3 {
                let at = [(); 3].map(|()| numbers.next().unwrap_or(f64::NAN));
                let place = || format!("triangle {number} (from byte {}) has ", HEAD + TRIANGLE * number);
                self.corner(Vec3::from(at), place, 0)?;
            }
            self.face()?;
        }
        self.end()
    }

    fn words(&mut self, bytes: &[u8]) -> Result<(), Box<Fault>> {
        for (number, line) in (1..).zip(bytes.split(|byte| *byte == b'\n')) {
            self.line(line.trim_ascii(), number).map_err(|fault| Box::new(fault.at(number, 0)))?;
        }
        if self.now.is_none() {
            return Ok(());
        }
        let fix = "export it again, or end it with \"endsolid\" if nothing is missing";
        Err(refusal(&self.name(), "the file ends within it", "\"endsolid\" at the end of each solid", fix))
    }

    /// Reads a line of words; a fault after which the rest means nothing is an error.
    fn line(&mut self, line: &[u8], number: usize) -> Result<(), Box<Fault>> {
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let (word, rest) = line.split_at(end);
        let odd = |name: &str, allowed: &str| {
            Err(refusal(name, format!("\"{}\"", quoted(line)), allowed, "export it again"))
        };
        let is = |name: &str| word.eq_ignore_ascii_case(name.as_bytes());
        if is("vertex") && self.now.is_some() {
            let words = str::from_utf8(rest).unwrap_or("").split_ascii_whitespace();
            // A fourth word is one too many.
            let mut numbers = words.map(|word| word.parse().ok());
            let [x, y, z, no] = [(); 4].map(|()| numbers.next());
            let (Some(Some(x)), Some(Some(y)), Some(Some(z)), None) = (x, y, z, no) else {
                return odd(&self.name(), "three numbers after vertex, as 0.5");
            };
            self.corner(Vec3::new(x, y, z), String::new, number)
        } else if is("endloop") {
            self.face()
        } else if is("solid") {
            self.end()?;
            let name = Some(quoted(rest)).filter(|name| !name.is_empty());
            let mesh = Mesh { name, line: number, ..Mesh::default() };
            self.now = Some(Solid { mesh, ..Solid::default() });
            Ok(())
        } else if is("endsolid") {
            self.end()
        } else if ["", "facet", "outer", "endfacet"].into_iter().any(is) {
            Ok(())
        } else {
            odd(&self.name(), "solid, facet, outer loop, vertex, endloop, endfacet and endsolid")
        }
    }

    /// What the solid that is being read is called in faults.
    fn name(&self) -> String {
        let name = self.now.as_ref().and_then(|solid| solid.mesh.name.clone());
        match (name, &self.now) {
            (Some(name), _) => format!("solid {name}"),
            (None, Some(solid)) if solid.mesh.line > 0 => format!("solid {}", self.done.len()),
            _ => String::new(),
        }
    }

    /// Takes a corner of a triangle, which is found at a place in words or at a line.
    fn corner(&mut self, at: Vec3, place: impl Fn() -> String, line: usize) -> Result<(), Box<Fault>> {
        if !at.iter().all(|c| c.is_finite()) {
            let found = format!("{}a corner at ({}, {}, {})", place(), at.x, at.y, at.z);
            let fault =
                Fault::of(&self.name(), found, "finite coordinates", "correct or remove the triangle");
            self.faults.push(fault.at(line, 0));
        }
        if let Some(solid) = &mut self.now {
            let before = solid.mesh.vertices.len();
            solid.corner(at);
            self.vertices += solid.mesh.vertices.len() - before;
        }
        if self.faults.count() >= MOST_FAULTS {
            return Err(enough());
        }
        most(self.vertices, "corners", MOST_VERTICES)
    }

    /// Ends a triangle.
    fn face(&mut self) -> Result<(), Box<Fault>> {
        let Some(solid) = &mut self.now else { return Ok(()) };
        let face = std::mem::take(&mut solid.face);
        if face.len() != 3 {
            let found = format!("a loop of {} corners", face.len());
            return Err(refusal(&self.name(), found, "3 corners of each", "export triangles"));
        }
        if !is_sliver(&face) {
            solid.mesh.faces.push(face);
            self.faces += 1;
        }
        most(self.faces, "triangles", MOST_FACES)
    }

    /// Ends the solid that is being read.
    fn end(&mut self) -> Result<(), Box<Fault>> {
        if self.now.as_ref().is_some_and(|solid| !solid.face.is_empty()) {
            return Err(refusal(&self.name(), "it ends within a triangle", "whole triangles", AGAIN));
        }
        let solid = self.now.take().map(|solid| solid.mesh);
        self.done.extend(solid.filter(|mesh| !mesh.faces.is_empty()));
        Ok(())
    }
}

fn most(count: usize, what: &str, allowed: usize) -> Result<(), Box<Fault>> {
    if count <= allowed {
        return Ok(());
    }
    Err(refusal("", format!("more than {allowed} {what}"), format!("at most {allowed}"), SIMPLIFY))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::mesh::twisted::twisted;

    const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [-0.0, 0.0, 0.1]];
    const FACES: [[usize; 3]; 5] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3], [1, 2, 2]];

    /// A tetrahedron and a triangle without area, in words.
    fn solid(name: &str) -> String {
        let corner = |c: usize| format!("    vertex {} {} {}\n", CORNERS[c][0], CORNERS[c][1], CORNERS[c][2]);
        let facet = |face: &[usize; 3]| {
            let corners = face.map(corner).concat();
            format!("facet normal 0 0 0\n  outer loop\n{corners}  endloop\nendfacet\n")
        };
        format!("solid {name}\n{}endsolid {name}\n", FACES.iter().map(facet).collect::<String>())
    }

    fn bytes(head: &str) -> Vec<u8> {
        let mut all = format!("{head:80}").into_bytes();
        all.extend(5_u32.to_le_bytes());
        for face in FACES {
            all.extend([0; 12]);
            face.iter().flat_map(|&c| CORNERS[c]).for_each(|number| all.extend(number.to_le_bytes()));
            all.extend([0; 2]);
        }
        all
    }

    #[test]
    fn each_solid_of_words_is_a_body_with_its_corners_once() {
        let text = format!("{}{}{}", solid("a b"), "solid empty\nendsolid\n", solid(""));
        let read = read_stl(text.replace('\n', "\r\n").as_bytes()).expect("it reads");
        assert_eq!(read.iter().map(|mesh| mesh.name.as_deref()).collect::<Vec<_>>(), [Some("a b"), None]);
        assert_eq!(read.iter().map(|mesh| mesh.line).collect::<Vec<_>>(), [1, 40]);
        for mesh in read {
            assert_eq!(mesh.faces, [[0, 1, 2], [0, 2, 3], [2, 1, 3], [1, 0, 3]]);
            assert_eq!((mesh.vertices.len(), mesh.vertices[1].y), (4, 0.1));
        }
    }

    #[test]
    fn bytes_are_read_whatever_they_begin_with() {
        for head in ["made by a scanner", "solid of words? No"] {
            let read = read_stl(&bytes(head)).expect("it reads");
            assert_eq!((read.len(), read[0].line, &read[0].name), (1, 0, &None));
            assert_eq!((read[0].vertices.len(), read[0].faces.len()), (4, 4));
            assert_eq!(read[0].vertices[1].y, f64::from(0.1_f32));
            let cut = &bytes(head)[..200];
            let faults = read_stl(cut).expect_err("cut").to_string();
            assert!(faults.contains("5 triangles and has 200 bytes; allowed is 334"), "{faults}");
        }
    }

    #[test]
    fn what_is_wrong_is_named_with_its_solid_and_its_line_or_byte() {
        let text = solid("a");
        for (old, new, found, line) in [
            ("vertex 0.1 0 0", "vertex nan 0 0", "a corner at (NaN, 0, 0)", 6),
            ("vertex 0.1 0 0", "vertex 1e400 0 0", "a corner at (inf, 0, 0)", 6),
            ("vertex 0.1 0 0", "vertex 0,1 0 0", "\"vertex 0,1 0 0\"", 6),
            ("vertex 0.1 0 0", "vertex 0 0", "\"vertex 0 0\"", 6),
            ("vertex 0.1 0 0", "", "a loop of 2 corners", 7),
            ("  endloop", "", "a loop of 6 corners", 14),
            ("endsolid", "end", "\"end a\"", 37),
            ("endsolid a", "", "ends within it", 0),
        ] {
            let faults = read_stl(text.replacen(old, new, 1).as_bytes()).expect_err(new);
            let first = &faults.faults[0];
            assert!(first.found.contains(found) && first.line == line, "{new}: {first:?}");
            assert_eq!(first.block, "solid a", "{new}");
        }
        for (text, found) in [
            ("", "0 bytes"),
            ("solid a\nendsolid\n", "no triangles"),
            ("solid a\nvertex 0 0 0\nendsolid", "within a triangle"),
            ("solid a\nendsolid\nvertex 0 0 0", "\"vertex 0 0 0\""),
        ] {
            let faults = read_stl(text.as_bytes()).expect_err(text);
            assert!(faults.faults[0].found.contains(found), "{text}: {faults}");
        }
        let mut bad = bytes("");
        bad[HEAD + TRIANGLE + 12..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
        let faults = read_stl(&bad).expect_err("not finite").to_string();
        assert!(faults.contains("triangle 1 (from byte 134) has a corner at (inf, 0, 0)"), "{faults}");
    }

    #[test]
    fn nothing_that_is_twisted_breaks_it() {
        for whole in [solid("a").into_bytes(), bytes("b"), bytes("solid c")] {
            twisted(&whole, |bytes| {
                for mesh in read_stl(bytes).unwrap_or_default() {
                    assert!(mesh.vertices.iter().flatten().all(|c| c.is_finite()));
                    assert!(mesh.faces.iter().flatten().all(|&c| (c as usize) < mesh.vertices.len()));
                }
            });
        }
    }
}
