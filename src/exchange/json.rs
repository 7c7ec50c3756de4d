//! The wall exchange format `wall.json`.

use serde::Serialize;

use crate::math::Vec3;
use crate::model::{Support, Wall};

/// One block as the file states it.
#[derive(Serialize)]
struct Entry<'a> {
    id: usize,
    vertices: &'a [Vec3],
    faces: &'a [Vec<u32>],
    density: f64,
    fixed: bool,
    tag: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    group: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scan: Option<Scan>,
}

/// What a stone holds where its faces are those of the hull of its scan.
#[derive(Serialize)]
struct Scan {
    volume: f64,
    centroid: Vec3,
    inertia: [[f64; 3]; 3],
}

/// The wall as `wall.json`: `{"unit":"m","blocks":[{"id","vertices":[[x,y,z],...],"faces":[[i,j,k,...],...],"density",
/// "fixed","tag","group","scan"},...]}`; `group` for the parts of a stone only, `scan` for the hull of one.
///
/// Axes: x along the wall, y out of plane (positive downhill), z up. Faces run counter-clockwise seen from outside
/// and count their block's vertices from 0; densities are in kg/m^3. One block per line; every number is the
/// shortest one that reads back to the same bits, so the text depends on the wall alone.
///
/// `fixed` tells a fixed block from all others: a support that holds a block out of plane only belongs to the
/// protocol, not to the wall, and is not part of the format.
///
/// ```
/// let text = pirca::exchange::write_wall_json(&pirca::generate::canonical::wall_72());
/// assert!(text.starts_with("{\"unit\":\"m\",\"blocks\":[\n{\"id\":0,\"vertices\":[[0.0,-0.057,0.0],"));
/// ```
pub fn write_wall_json(wall: &Wall) -> String {
    let lines: Vec<String> = wall
        .blocks
        .iter()
        .enumerate()
        .map(|(id, block)| {
            serde_json::to_string(&Entry {
                id,
                vertices: &block.shape.vertices,
                faces: &block.shape.faces,
                density: block.density,
                fixed: block.support == Support::Fixed,
                tag: block.tag.name(),
                group: block.group.as_deref(),
                scan: block.scan.map(|scan| Scan {
                    volume: scan.volume,
                    centroid: scan.centroid,
                    // Symmetric: rows are columns.
                    inertia: scan.inertia.into(),
                }),
            })
            .expect("numbers, lists and names always have a JSON form")
        })
        .collect();
    format!("{{\"unit\":\"m\",\"blocks\":[\n{}\n]}}\n", lines.join(",\n"))
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::model::{Block, Tag};
    use crate::shape::Polyhedron;

    fn wall() -> Wall {
        let stone = Block {
            tag: Tag::Header,
            ..Block::stone(
                Polyhedron::cuboid(Vec3::new(0.0, -0.1, 0.0), Vec3::new(0.1 + 0.2, 0.1, 1.0 / 3.0)),
                2400.0,
            )
        };
        Wall { blocks: vec![stone] }.with_base()
    }

    #[test]
    fn the_file_holds_every_value_of_the_wall_bit_by_bit() {
        let wall = wall();
        let read: Value = serde_json::from_str(&write_wall_json(&wall)).unwrap();
        assert_eq!(read["unit"], "m");
        let blocks = read["blocks"].as_array().unwrap();
        assert_eq!(blocks.len(), 2);
        for (id, (entry, block)) in blocks.iter().zip(&wall.blocks).enumerate() {
            assert_eq!(entry["id"], id);
            assert_eq!(entry["density"], block.density);
            for (v, expected) in entry["vertices"].as_array().unwrap().iter().zip(&block.shape.vertices) {
                for k in 0..3 {
                    assert_eq!(v[k].as_f64().unwrap().to_bits(), expected[k].to_bits());
                }
            }
            let faces: Vec<Vec<u32>> = serde_json::from_value(entry["faces"].clone()).unwrap();
            assert_eq!(faces, block.shape.faces);
        }
        assert_eq!((&blocks[0]["fixed"], &blocks[0]["tag"]), (&Value::from(false), &Value::from("header")));
        assert_eq!((&blocks[1]["fixed"], &blocks[1]["tag"]), (&Value::from(true), &Value::from("base")));
    }
}
