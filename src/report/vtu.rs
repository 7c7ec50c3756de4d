//! VTK's XML unstructured grid with true polyhedra, for ParaView.

use std::fmt::{Display, Write};

use crate::math::Vec3;
use crate::model::{Tag, Wall};

/// VTK's number for a cell made of faces (vtkCellType.h, `VTK_POLYHEDRON`).
const POLYHEDRON: u8 = 42;

/// The wall as an ASCII `.vtu` file: one polyhedral cell per block, in the order of the blocks.
///
/// Cell data: `block` (id), `tag` (0 stone, 1 header, 2 wedge, 3 base, 4 end, 5 another), `density` (kg/m^3), `volume` (m^3) and,
/// if given, `displacement` (m, one vector per block: that of its centroid). Every number is the shortest one that
/// reads back to the same bits.
///
/// The number of displacements must be that of the blocks.
///
/// ```
/// let text = pirca::report::write_vtu(&pirca::generate::canonical::wall_72(), None);
/// assert!(text.contains("NumberOfCells=\"72\""));
/// ```
pub fn write_vtu(wall: &Wall, displacement: Option<&[Vec3]>) -> String {
    let blocks = &wall.blocks;
    let points: usize = blocks.iter().map(|b| b.shape.vertices.len()).sum();
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{}\">\n",
        blocks.len()
    );
    text.push_str("<Points>\n");
    array(&mut text, "Float64", "Points", 3, blocks.iter().flat_map(|b| &b.shape.vertices).map(vector));
    text.push_str("</Points>\n");
    cells(&mut text, wall);
    text.push_str("<CellData>\n");
    array(&mut text, "Int64", "block", 1, 0..blocks.len());
    array(&mut text, "UInt8", "tag", 1, blocks.iter().map(|b| tag_number(&b.tag)));
    array(&mut text, "Float64", "density", 1, blocks.iter().map(|b| b.density));
    array(&mut text, "Float64", "volume", 1, blocks.iter().map(|b| b.shape.volume()));
    if let Some(displacement) = displacement {
        crate::check!(
            displacement.len() == blocks.len(),
            "{} displacements for {} blocks",
            displacement.len(),
            blocks.len()
        );
        array(&mut text, "Float64", "displacement", 3, displacement.iter().map(vector));
    }
    text.push_str("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}

/// Connectivity, and the face stream of every polyhedron: number of faces, then per face its number of points and the
/// points themselves; `faceoffsets` are the ends of the cells in that stream.
fn cells(text: &mut String, wall: &Wall) {
    let (mut first, mut stream) = (0, 0);
    let (mut ends, mut faces, mut face_ends) = (Vec::new(), Vec::new(), Vec::new());
    for block in &wall.blocks {
        let mut line = block.shape.faces.len().to_string();
        stream += 1;
        for face in &block.shape.faces {
            stream += 1 + face.len();
            line += &format!(" {}", face.len());
            for &v in face {
                line += &format!(" {}", first + v as usize);
            }
        }
        first += block.shape.vertices.len();
        ends.push(first);
        faces.push(line);
        face_ends.push(stream);
    }
    text.push_str("<Cells>\n");
    array(text, "Int64", "connectivity", 1, 0..first);
    array(text, "Int64", "offsets", 1, ends);
    array(text, "UInt8", "types", 1, wall.blocks.iter().map(|_| POLYHEDRON));
    array(text, "Int64", "faces", 1, faces);
    array(text, "Int64", "faceoffsets", 1, face_ends);
    text.push_str("</Cells>\n");
}

/// One data array, an entry per line.
fn array<T: Display>(
    text: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    entries: impl IntoIterator<Item = T>,
) {
    let mut line = |arguments: std::fmt::Arguments| {
        writeln!(text, "{arguments}").expect("a string takes every text");
    };
    line(format_args!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
    ));
    for entry in entries {
        line(format_args!("{entry}"));
    }
    line(format_args!("</DataArray>"));
}

fn vector(v: &Vec3) -> String {
    format!("{} {} {}", v.x, v.y, v.z)
}

fn tag_number(tag: &Tag) -> u8 {
    match tag {
        Tag::Stone => 0,
        Tag::Header => 1,
        Tag::Wedge => 2,
        Tag::Base => 3,
        Tag::End => 4,
        Tag::Other(_) => 5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Block, Support};
    use crate::shape::{Plane, Polyhedron};

    /// A wedge and a box: cells with different numbers of faces and points.
    fn wall() -> Wall {
        let solid = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(1.0, 1.0, 1.0));
        let (half, _) = solid.cut(&Plane::through(Vec3::zeros(), Vec3::new(1.0, -1.0, 0.0)), 1e-9);
        let block = |shape: Polyhedron, tag: Tag| Block {
            shape,
            density: 2400.0,
            support: Support::Free,
            tag,
            group: None,
        };
        let aside = solid.translated(&Vec3::new(2.0, 0.0, 0.0));
        Wall { blocks: vec![block(half.unwrap(), Tag::Wedge), block(aside, Tag::Stone)] }
    }

    /// The words of a named array.
    fn words(text: &str, name: &str) -> Vec<f64> {
        let start = text.find(&format!("Name=\"{name}\"")).unwrap();
        let body = &text[start + text[start..].find('>').unwrap() + 1..];
        body[..body.find('<').unwrap()].split_whitespace().map(|w| w.parse().unwrap()).collect()
    }

    #[test]
    fn the_face_streams_lead_back_to_the_solids() {
        let wall = wall();
        let text = write_vtu(&wall, None);
        let (points, faces) = (words(&text, "Points"), words(&text, "faces"));
        let (ends, face_ends) = (words(&text, "offsets"), words(&text, "faceoffsets"));
        assert_eq!((points.len(), ends.clone()), (3 * (6 + 8), vec![6.0, 14.0]));
        // A prism: 1 + 2 x (1 + 3) + 3 x (1 + 4) numbers; a box: 1 + 6 x (1 + 4).
        assert_eq!(face_ends, [24.0, 24.0 + 31.0]);
        assert_eq!(faces.len(), 55);
        let mut at = 0;
        for (cell, block) in wall.blocks.iter().enumerate() {
            let first = if cell == 0 { 0 } else { ends[cell - 1] as u32 };
            let corners = points[3 * first as usize..3 * ends[cell] as usize].chunks(3);
            let vertices = corners.map(Vec3::from_column_slice).collect();
            let mut solid = Polyhedron { vertices, faces: vec![] };
            let count = faces[at] as usize;
            at += 1;
            for _ in 0..count {
                let n = faces[at] as usize;
                solid.faces.push(faces[at + 1..=at + n].iter().map(|v| *v as u32 - first).collect());
                at += 1 + n;
            }
            assert_eq!(solid, block.shape);
        }
        assert_eq!(words(&text, "types"), [42.0, 42.0]);
        assert_eq!(words(&text, "tag"), [2.0, 0.0]);
        assert_eq!(words(&text, "volume"), [wall.blocks[0].shape.volume(), wall.blocks[1].shape.volume()]);
        assert!(!text.contains("displacement"));
    }

    #[test]
    fn displacements_are_cell_vectors() {
        let moved = [Vec3::new(0.0, 1e-3, 0.0), Vec3::new(1.0 / 3.0, -2e-300, 0.0)];
        let text = write_vtu(&wall(), Some(&moved));
        assert_eq!(words(&text, "displacement"), [0.0, 1e-3, 0.0, 1.0 / 3.0, -2e-300, 0.0]);
    }

    #[test]
    #[should_panic(expected = "1 displacements for 2 blocks")]
    fn displacements_must_fit_the_blocks() {
        write_vtu(&wall(), Some(&[Vec3::zeros()]));
    }
}
