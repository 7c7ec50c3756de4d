//! The blocks of a wall as true polyhedra.

use crate::math::Vec3;
use crate::model::{Block, Movement, ReplayState, Support, Tag, Wall};
use crate::render::vtk::xml::{array, field, grid, vector};

/// VTK's number for a cell made of faces (vtkCellType.h, `VTK_POLYHEDRON`).
const POLYHEDRON: u8 = 42;

/// The wall as an ASCII `.vtu` file: one polyhedral cell per block, in the order of the blocks, where it was built.
///
/// Cell data: `block` (id), `tag` (0 stone, 1 header, 2 wedge, 3 base, 4 end, 5 another), `held` (1 of a block that is fixed, else 0),
/// `density` (kg/m^3) and `volume` (m^3). With how every block `moved` since it was built there are `displacement`s (m) of two kinds: as
/// point data those of its corners, with its turn in them, and as cell data that of its centroid. Every number is the shortest one that
/// reads back to the same bits.
///
/// The number of movements must be that of the blocks.
///
/// ```
/// let text = pirca::render::write_vtu(&pirca::generate::canonical::wall_72(), None);
/// assert!(text.contains("NumberOfCells=\"72\""));
/// ```
pub fn write_vtu(wall: &Wall, moved: Option<&[Movement]>) -> String {
    written(wall, moved, &[], |_| {})
}

/// The wall in a state of its replay: [`write_vtu`] with one more array of cell data, `there` (0 of a block that fell out before, else
/// 1), and with the field data of the state.
pub(crate) fn in_state(wall: &Wall, state: &ReplayState) -> String {
    let there = |id: usize| u8::from(state.gone.binary_search(&(id as u32)).is_err());
    written(wall, Some(&state.poses), &field(state), |text| {
        array(text, "UInt8", "there", 1, (0..wall.blocks.len()).map(there));
    })
}

fn written(
    wall: &Wall,
    moved: Option<&[Movement]>,
    field: &[(&str, f64)],
    more: impl FnOnce(&mut String),
) -> String {
    let blocks = &wall.blocks;
    if let Some(moved) = moved {
        crate::check!(moved.len() == blocks.len(), "{} movements for {} blocks", moved.len(), blocks.len());
    }
    let points = blocks.iter().map(|b| b.shape.vertices.len()).sum();
    grid([points, blocks.len()], field, |text| {
        text.push_str("<Points>\n");
        array(text, "Float64", "Points", 3, blocks.iter().flat_map(|b| &b.shape.vertices).map(vector));
        text.push_str("</Points>\n");
        cells(text, wall);
        if let Some(moved) = moved {
            text.push_str("<PointData Vectors=\"displacement\">\n");
            let corners = blocks.iter().zip(moved).flat_map(|(block, movement)| displaced(block, movement));
            array(text, "Float64", "displacement", 3, corners.map(|v| vector(&v)));
            text.push_str("</PointData>\n");
        }
        text.push_str("<CellData>\n");
        array(text, "Int64", "block", 1, 0..blocks.len());
        array(text, "UInt8", "tag", 1, blocks.iter().map(|b| tag_number(&b.tag)));
        array(text, "UInt8", "held", 1, blocks.iter().map(|b| u8::from(b.support == Support::Fixed)));
        array(text, "Float64", "density", 1, blocks.iter().map(|b| b.density));
        array(text, "Float64", "volume", 1, blocks.iter().map(|b| b.volume()));
        if let Some(moved) = moved {
            array(text, "Float64", "displacement", 3, moved.iter().map(|movement| vector(&movement.shift)));
        }
        more(text);
        text.push_str("</CellData>\n");
    })
}

/// How the corners of a block are displaced (m).
fn displaced(block: &Block, movement: &Movement) -> Vec<Vec3> {
    movement.displacing(block.shape.mass_properties().centroid, &block.shape.vertices)
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
    use crate::shape::{Plane, Polyhedron};
    use std::f64::consts::FRAC_PI_2;

    /// A wedge and a box: cells with different numbers of faces and points.
    fn wall() -> Wall {
        let solid = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(1.0, 1.0, 1.0));
        let (half, _) = solid.cut(&Plane::through(Vec3::zeros(), Vec3::new(1.0, -1.0, 0.0)), 1e-9);
        let block = |shape: Polyhedron, tag: Tag| Block { tag, ..Block::stone(shape, 2400.0) };
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
        // Readers such as meshio take one component that is named for a matrix of one column.
        let moved = write_vtu(&wall, Some(&[Movement::NONE, Movement::NONE]));
        assert!(!moved.contains("NumberOfComponents=\"1\""), "{moved}");
    }

    #[test]
    fn corners_are_displaced_by_the_shift_and_the_turn_of_their_block() {
        let turned = Movement { shift: Vec3::new(0.0, 0.0, 1.0 / 3.0), turn: Vec3::z() * FRAC_PI_2 };
        let text = write_vtu(&wall(), Some(&[Movement::NONE, turned]));
        let (points, all) = (words(&text, "Points"), words(&text, "displacement"));
        assert!(text.find("<PointData") < text.find("<CellData"));
        assert!(all[..18].iter().all(|x| *x == 0.0));
        // The cube about its own centre, (2.5, 0.5, 0.5), by a quarter turn: x to y.
        for (from, by) in points.chunks(3).zip(all.chunks(3)).skip(6) {
            let (x, y) = (from[0] - 2.5, from[1] - 0.5);
            let wanted = [-y - x, x - y, 1.0 / 3.0];
            assert!(by.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{from:?}: {by:?} {wanted:?}");
        }
        let cells = &text[text.find("<CellData").unwrap()..];
        assert_eq!(words(cells, "displacement")[3..], [0.0, 0.0, 1.0 / 3.0]);
    }

    #[test]
    #[should_panic(expected = "1 movements for 2 blocks")]
    fn movements_must_fit_the_blocks() {
        write_vtu(&wall(), Some(&[Movement::NONE]));
    }
}
