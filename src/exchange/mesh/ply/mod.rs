//! Reading PLY: a mesh or a cloud of points, as words or as bytes.
//!
//! Not by a crate: ply-rs-bw (4.0.1) asks for memory without end where a head claims many items of no size, and refuses a line for a `nan`
//! among the numbers that nobody asked for. Here memory and time go with the size of the file, whatever its head claims.

mod header;

use crate::exchange::fault::{Fault, WallFaults};
use crate::exchange::mesh::ply::header::{Coding, Element, Header, Number};
use crate::exchange::mesh::{
    AGAIN, MOST_FACES, MOST_FAULTS, MOST_VERTICES, Mesh, SIMPLIFY, enough, is_sliver, quoted, refusal,
};
use crate::math::Vec3;

/// What the list of the corners of a face is called.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];
/// What the body is called in faults, as it has no name.
const BODY: &str = "the mesh";

/// The body in a PLY file. Normals, colours and whatever else it holds are read over, and so are triangles with a corner twice, which hold
/// no area.
///
/// # Errors
/// Everything that is wrong with the file, with lines, or with bytes where it has no lines.
pub(in crate::exchange) fn read_ply(bytes: &[u8]) -> Result<Vec<Mesh>, WallFaults> {
    let mut faults = WallFaults::new("mesh.ply");
    let mut mesh = Mesh::default();
    if let Err(fault) = read(bytes, &mut mesh, &mut faults) {
        faults.push_last(*fault);
    }
    if faults.is_empty() { Ok(vec![mesh]) } else { Err(faults) }
}

/// Reads the file; faults after which the rest can still be read go to `faults`.
fn read(bytes: &[u8], mesh: &mut Mesh, faults: &mut WallFaults) -> Result<(), Box<Fault>> {
    let header = Header::of(bytes)?;
    checked(&header)?;
    mesh.line = usize::from(header.coding == Coding::Words);
    let mut body = Body {
        rest: &bytes[header.size..],
        all: bytes.len(),
        coding: header.coding,
        words: &[],
        line: header.lines,
    };
    let vertices = header.element("vertex").map_or(0, |element| element.count);
    // Items of no size would be read without end.
    for element in header.elements.iter().filter(|element| !element.properties.is_empty()) {
        let roles: Vec<Role> = element.properties.iter().map(|p| Role::of(&element.name, &p.name)).collect();
        for number in 0..element.count {
            let item =
                body.item(element, &roles).map_err(|found| Box::new(body.fault(element, number, found)))?;
            match element.name.as_str() {
                "vertex" => {
                    if !item.at.iter().all(|c| c.is_finite()) {
                        let found = format!("is at ({}, {}, {})", item.at.x, item.at.y, item.at.z);
                        let fault = body.fault(element, number, found);
                        faults.push(Fault {
                            allowed: "finite coordinates".to_owned(),
                            fix: "correct or remove the vertex".to_owned(),
                            ..fault
                        });
                    }
                    mesh.vertices.push(item.at);
                }
                "face" => match outside(&item.corners, vertices) {
                    Some(found) => {
                        let allowed = format!("3 corners or more out of 0 to {}", vertices.saturating_sub(1));
                        faults.push(Fault { allowed, ..body.fault(element, number, found) });
                    }
                    None if is_sliver(&item.corners) => {}
                    None => mesh.faces.push(item.corners),
                },
                _ => {}
            }
            if faults.count() >= MOST_FAULTS {
                return Err(enough());
            }
        }
    }
    body.ended()
}

/// Refuses what a head should not say, before anything is read.
fn checked(header: &Header) -> Result<(), Box<Fault>> {
    let empty = Element { name: String::new(), count: 0, properties: Vec::new() };
    let [vertex, face, strips] =
        ["vertex", "face", "tristrips"].map(|name| header.element(name).unwrap_or(&empty));
    let has = |element: &Element, name: &str, list: bool| {
        element.properties.iter().any(|own| own.name == name && own.count.is_some() == list)
    };
    if strips.count > 0 {
        let fix = "export triangles or polygons, not strips";
        return Err(refusal("", "its faces are strips of triangles (tristrips)", "element face", fix));
    }
    for (element, most) in [(vertex, MOST_VERTICES), (face, MOST_FACES)] {
        if element.count > most {
            let found = format!("it has {} items of the element {}", element.count, element.name);
            return Err(refusal(BODY, found, format!("at most {most}"), SIMPLIFY));
        }
    }
    if vertex.count == 0 || !["x", "y", "z"].iter().all(|name| has(vertex, name, false)) {
        let found = if vertex.count == 0 { "it has no vertices" } else { "its vertices lack x, y or z" };
        let fix = "export the stone as a mesh or a cloud of points";
        return Err(refusal(BODY, found, "an element vertex with x, y and z", fix));
    }
    if face.count > 0 && CORNERS.iter().filter(|name| has(face, name, true)).count() != 1 {
        let allowed = "one list vertex_indices or vertex_index of each face";
        return Err(refusal("", "its faces name no corners", allowed, "export it again as a mesh"));
    }
    Ok(())
}

/// What is wrong with the corners of a face among so many vertices.
fn outside(corners: &[u32], vertices: usize) -> Option<String> {
    match corners.iter().copied().find(|&corner| corner as usize >= vertices) {
        _ if corners.len() < 3 => Some(format!("has {} corners", corners.len())),
        Some(u32::MAX) => Some("names a vertex that is no whole number from 0".to_owned()),
        Some(corner) => Some(format!("names vertex {corner}, which is out of range")),
        None => None,
    }
}

/// What a property is to us.
#[derive(Clone, Copy)]
enum Role {
    Coordinate(usize),
    Corners,
    Other,
}

impl Role {
    fn of(element: &str, property: &str) -> Role {
        match (element, property) {
            ("vertex", "x") => Role::Coordinate(0),
            ("vertex", "y") => Role::Coordinate(1),
            ("vertex", "z") => Role::Coordinate(2),
            ("face", name) if CORNERS.contains(&name) => Role::Corners,
            _ => Role::Other,
        }
    }
}

/// What an item holds that matters here.
#[derive(Default)]
struct Item {
    at: Vec3,
    /// A number that names no vertex is [`u32::MAX`].
    corners: Vec<u32>,
}

/// The numbers of the file.
struct Body<'a> {
    /// What follows.
    rest: &'a [u8],
    /// Bytes of the file.
    all: usize,
    coding: Coding,
    /// What follows in the line of the item.
    words: &'a [u8],
    /// That line, from 1.
    line: usize,
}

impl Body<'_> {
    /// The next item, or what is wrong with it.
    fn item(&mut self, element: &Element, roles: &[Role]) -> Result<Item, String> {
        self.begin();
        let mut item = Item::default();
        for (property, role) in element.properties.iter().zip(roles) {
            let Some(count) = property.count else {
                let number = self.number(property.number)?;
                if let Role::Coordinate(axis) = role {
                    item.at[*axis] = number;
                }
                continue;
            };
            // Each number of a list is a byte at least: what a count claims beyond that is not read.
            let count = self.number(count)?;
            if !(count >= 0.0 && count.fract() == 0.0) {
                return Err(format!("has a list of {count} numbers"));
            }
            for _ in 0..count as u64 {
                let number = self.number(property.number)?;
                if let Role::Corners = role {
                    let whole = number >= 0.0 && number < f64::from(u32::MAX) && number.fract() == 0.0;
                    item.corners.push(if whole { number as u32 } else { u32::MAX });
                }
            }
        }
        match self.words.trim_ascii_start() {
            [] => Ok(item),
            more => Err(format!("goes on with \"{}\" after all its numbers", quoted(more))),
        }
    }

    /// Goes to the line of the next item, over empty ones.
    fn begin(&mut self) {
        while self.coding == Coding::Words && self.words.is_empty() && !self.rest.is_empty() {
            let end = self.rest.iter().position(|byte| *byte == b'\n').unwrap_or(self.rest.len());
            self.words = self.rest[..end].trim_ascii();
            self.rest = self.rest.get(end + 1..).unwrap_or(&[]);
            self.line += 1;
        }
    }

    /// The next number of the item.
    fn number(&mut self, number: Number) -> Result<f64, String> {
        let ended = || "is not complete".to_owned();
        if self.coding != Coding::Words {
            let (bytes, rest) = self.rest.split_at_checked(number.size()).ok_or_else(ended)?;
            self.rest = rest;
            return Ok(decoded(bytes, number, self.coding));
        }
        let words = self.words.trim_ascii_start();
        let end = words.iter().position(u8::is_ascii_whitespace).unwrap_or(words.len());
        let (word, rest) = words.split_at(end);
        self.words = rest;
        match str::from_utf8(word).ok().and_then(|word| word.parse().ok()) {
            Some(number) => Ok(number),
            None if word.is_empty() => Err(ended()),
            None => Err(format!("has \"{}\" for a number", quoted(word))),
        }
    }

    /// A fault of the item that was read last.
    fn fault(&self, element: &Element, number: usize, found: String) -> Fault {
        let name = quoted(element.name.as_bytes());
        let (place, line) = match self.coding {
            Coding::Words => (String::new(), self.line),
            _ => (format!(" (up to byte {})", self.all - self.rest.len()), 0),
        };
        let allowed = format!("{} items of \"{name}\" with the numbers that the head says", element.count);
        Fault::of(BODY, format!("{name} {number}{place} {found}"), allowed, AGAIN).at(line, 0)
    }

    /// Refuses what follows the last item, but for spaces: the counts of the head are wrong.
    fn ended(mut self) -> Result<(), Box<Fault>> {
        self.begin();
        let more = if self.coding == Coding::Words { self.words } else { self.rest };
        if more.iter().all(|byte| *byte == 0 || byte.is_ascii_whitespace()) {
            return Ok(());
        }
        let (found, line) = match self.coding {
            Coding::Words => (format!("\"{}\" follows the last item", quoted(more)), self.line),
            _ => (format!("{} bytes follow the last item", more.len()), 0),
        };
        Err(Box::new(Fault::of(BODY, found, "as many items as its head says", AGAIN).at(line, 0)))
    }
}

/// A number out of as many bytes as it has.
fn decoded(bytes: &[u8], number: Number, coding: Coding) -> f64 {
    let mut own = [0; 8];
    own[..bytes.len()].copy_from_slice(bytes);
    if coding == Coding::Big {
        own[..bytes.len()].reverse();
    }
    let [a, b, c, d, ..] = own;
    match number {
        Number::I8 => f64::from(a as i8),
        Number::U8 => f64::from(a),
        Number::I16 => f64::from(i16::from_le_bytes([a, b])),
        Number::U16 => f64::from(u16::from_le_bytes([a, b])),
        Number::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
        Number::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
        Number::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        Number::F64 => f64::from_le_bytes(own),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::mesh::twisted::twisted;

    /// A tetrahedron with a colour per vertex and an edge, as a head and as what follows it.
    const HEAD: &str = "element vertex 4\nproperty float x\nproperty double y\nproperty short z\nproperty uchar red\nelement face 4\nproperty list uchar int vertex_indices\nelement edge 1\nproperty ushort a\nend_header\n";
    const WORDS: &str =
        "0 0 0 255\n0.1 0 0 255\n\n0 0.1 0 1\n 0 0 1 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n7\n";

    fn words() -> Vec<u8> {
        format!("ply\nformat ascii 1.0\n{HEAD}{WORDS}").into_bytes()
    }

    fn bytes(big: bool) -> Vec<u8> {
        let end = if big { "big" } else { "little" };
        let mut all = format!("ply\nformat binary_{end}_endian 1.0\n{HEAD}").into_bytes();
        let mut put = |bytes: &[u8]| {
            let own = bytes.iter().copied();
            if big { all.extend(own.rev()) } else { all.extend(own) }
        };
        for (x, y, z) in [(0.0_f32, 0.0_f64, 0_i16), (0.1, 0.0, 0), (0.0, 0.1, 0), (0.0, 0.0, 1)] {
            put(&x.to_le_bytes());
            put(&y.to_le_bytes());
            put(&z.to_le_bytes());
            put(&[9]);
        }
        for face in [[0_i32, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
            put(&[3]);
            face.iter().for_each(|corner| put(&corner.to_le_bytes()));
        }
        put(&7_u16.to_le_bytes());
        all
    }

    #[test]
    fn words_and_bytes_of_either_order_give_the_same_body() {
        let [read] = &read_ply(&words()).expect("it reads")[..] else { panic!("one body") };
        assert_eq!((read.vertices.len(), read.faces.len(), read.line), (4, 4, 1));
        assert_eq!(read.vertices[3], Vec3::new(0.0, 0.0, 1.0));
        assert_eq!(read.vertices[1].x, 0.1, "words keep every digit");
        for big in [false, true] {
            let [own] = &read_ply(&bytes(big)).expect("it reads")[..] else { panic!("one body") };
            assert_eq!((&own.faces, own.line), (&read.faces, 0));
            assert_eq!(own.vertices[1].x, f64::from(0.1_f32));
            assert_eq!(own.vertices[2..], read.vertices[2..]);
        }
    }

    #[test]
    fn a_cloud_of_points_has_no_faces() {
        let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float y\nproperty float x\nproperty float nx\nproperty int z\nend_header\n2. .5 nan 3";
        let read = read_ply(text.as_bytes()).expect("it reads");
        assert_eq!((&read[0].vertices[..], read[0].faces.len()), (&[Vec3::new(0.5, 2.0, 3.0)][..], 0));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line_or_byte() {
        let text = String::from_utf8(words()).expect("text");
        for (old, new, found, line) in [
            ("0.1 0 0 255", "nan 0 0 255", "vertex 1 is at (NaN, 0, 0)", 14),
            ("0.1 0 0 255", "0 1e400 0 255", "vertex 1 is at (0, inf, 0)", 14),
            ("0.1 0 0 255", "0,1 0 0 255", "vertex 1 has \"0,1\" for a number", 14),
            ("0.1 0 0 255", "0 0 255", "vertex 1 is not complete", 14),
            ("3 0 2 1", "3 0 2 4", "face 0 names vertex 4", 18),
            ("3 0 2 1", "3 0 2 -1", "face 0 names a vertex that is no whole number", 18),
            ("3 0 2 1", "4 0 2 1", "face 0 is not complete", 18),
            ("3 0 2 1", "2 0 2 1", "face 0 goes on with \"1\"", 18),
            ("3 0 2 1", "2 0 2", "face 0 has 2 corners", 18),
            ("3 0 2 1", "-1", "a list of -1 numbers", 18),
            ("edge 1", "edge 2", "edge 1 is not complete", 22),
            ("edge 1", "edge 0", "\"7\" follows the last item", 22),
            ("vertex 4", "vertex 1000000000000", "it has 1000000000000 items", 0),
            ("element face 4", "element tristrips 4", "strips", 0),
            ("vertex_indices", "corners", "its faces name no corners", 0),
            ("double y", "double v", "lack x, y or z", 0),
        ] {
            let faults = read_ply(text.replace(old, new).as_bytes()).expect_err(new);
            let first = &faults.faults[0];
            assert!(first.found.contains(found) && first.line == line, "{new}: {first:?}");
        }
        let mut cut = bytes(false);
        cut.truncate(cut.len() - 4);
        let faults = read_ply(&cut).expect_err("cut");
        assert!(faults.to_string().contains(&format!("face 3 (up to byte {}", cut.len() - 2)), "{faults}");
    }

    #[test]
    fn items_of_no_size_and_lists_without_end_take_no_time() {
        let head = "ply\nformat binary_little_endian 1.0\nelement nothing 1000000000000\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int vertex_index\nend_header\n";
        let mut bytes = head.as_bytes().to_vec();
        bytes.extend([0; 12]);
        bytes.extend([0xff; 8]);
        assert!(read_ply(&bytes).is_err());
    }

    #[test]
    fn nothing_that_is_twisted_breaks_it() {
        for whole in [words(), bytes(false), bytes(true)] {
            twisted(&whole, |bytes| {
                if let Ok(meshes) = read_ply(bytes) {
                    let mesh = &meshes[0];
                    assert!(mesh.vertices.iter().flatten().all(|c| c.is_finite()));
                    assert!(mesh.faces.iter().flatten().all(|&c| (c as usize) < mesh.vertices.len()));
                }
            });
        }
    }
}
