//! Wavefront OBJ, one object per block.

use std::fmt::Write;

use crate::exchange::read_obj::is_support;
use crate::model::{Block, Support, Tag, Wall};

/// The wall as Wavefront OBJ: one object per block, named by tag and id (`stone_12`), in metres, z up. A fixed block has the word
/// `fixed`, `base` or `end` in its name and no other block has; the parts of a stone are named after the first of them
/// (`stone_12.part1`, `stone_12.part2`). A tag of the owner's own is `stone`.
///
/// Faces are polygons, counter-clockwise seen from outside; their indices count the vertices of the whole file from
/// 1, as the format wants it. OBJ has no density: it stands in a comment above the block. Every number is the
/// shortest one that reads back to the same bits.
///
/// ```
/// let text = pirca::exchange::write_obj(&pirca::generate::canonical::wall_72());
/// assert_eq!(text.lines().filter(|line| line.starts_with("o ")).count(), 72);
/// ```
pub fn write_obj(wall: &Wall) -> String {
    let mut text = String::from("# unit m; x along the wall, y out of plane, z up\n");
    let mut first = 1;
    let (leads, mut parts) = (wall.leads(), vec![0; wall.blocks.len()]);
    for (id, block) in wall.blocks.iter().enumerate() {
        let mut line = |arguments: std::fmt::Arguments| {
            writeln!(text, "{arguments}").expect("a string takes every text");
        };
        line(format_args!("# density {} kg/m^3", block.density));
        match block.group {
            None => line(format_args!("o {}_{id}", object_name(block))),
            Some(_) => {
                let lead = leads[id];
                parts[lead] += 1;
                line(format_args!("o {}_{lead}.part{}", object_name(block), parts[lead]));
            }
        }
        for v in &block.shape.vertices {
            line(format_args!("v {} {} {}", v.x, v.y, v.z));
        }
        for face in &block.shape.faces {
            let indices: Vec<String> = face.iter().map(|v| (first + v).to_string()).collect();
            line(format_args!("f {}", indices.join(" ")));
        }
        first += block.shape.vertices.len() as u32;
    }
    text
}

/// What a block is and whether it is fixed, as the reader of OBJ understands it.
fn object_name(block: &Block) -> String {
    let fixed = block.support == Support::Fixed;
    let name = match &block.tag {
        Tag::Other(_) => "stone",
        known => known.name(),
    };
    match (fixed, is_support(name)) {
        (true, false) => format!("{name}_fixed"),
        (false, true) => "stone".to_owned(),
        _ => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::shape::Polyhedron;

    #[test]
    fn reading_the_objects_back_gives_the_same_solids() {
        let solid = |x: f64| {
            Block::stone(
                Polyhedron::cuboid(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 0.1, 0.2, 1.0 / 3.0)),
                2400.0,
            )
        };
        let wall = Wall { blocks: vec![solid(0.0), solid(0.1 + 0.2)] };
        let (mut vertices, mut solids): (Vec<Vec3>, Vec<(String, Polyhedron)>) = (vec![], vec![]);
        for line in write_obj(&wall).lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[0] {
                "o" => solids.push((words[1].to_owned(), Polyhedron::default())),
                "v" => {
                    let v = Vec3::from_iterator(words[1..].iter().map(|w| w.parse().unwrap()));
                    vertices.push(v);
                    solids.last_mut().unwrap().1.vertices.push(v);
                }
                "f" => {
                    let (_, solid) = solids.last_mut().unwrap();
                    let before = (vertices.len() - solid.vertices.len()) as u32;
                    let face = words[1..].iter().map(|w| w.parse::<u32>().unwrap() - 1 - before).collect();
                    solid.faces.push(face);
                }
                other => assert_eq!(other, "#"),
            }
        }
        assert_eq!(solids.len(), 2);
        assert_eq!(solids[1].0, "stone_1");
        for ((_, read), block) in solids.iter().zip(&wall.blocks) {
            assert_eq!(*read, block.shape);
        }
    }
}
