//! A wall in three dimensions, to be turned and moved from rest to where it is drawn. The page's script, view.js, shows it.

use serde::Serialize;

use crate::math::Vec3;
use crate::report::picture::{Picture, Stone};

/// The script with the library that it needs.
pub const VIEWER: &str = include_str!("solid/solid.min.js");
/// Lengths and angles are given to a hundredth of a millimetre, or of a milliradian.
const DIGITS: f64 = 1e5;

/// A figure in three dimensions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solid {
    /// What links lead to it by; once in a page.
    pub id: String,
    /// What it shows.
    pub caption: String,
    /// What the end of the slider is.
    pub moved: String,
    /// The wall as JSON: numbers and no text, so that nothing in it is markup.
    pub data: String,
}

/// The wall, as the script takes it.
#[derive(Serialize)]
struct Data {
    from_front: bool,
    blocks: Vec<Block>,
}

/// A block where it rests, and how it moves from there as it is drawn.
#[derive(Serialize)]
struct Block {
    /// Whether it neither moved before nor moves.
    still: bool,
    /// Coordinates (m) of its corners, one after the other.
    vertices: Vec<f64>,
    faces: Vec<Vec<u32>>,
    centroid: [f64; 3],
    /// Displacement (m) and rotation vector (rad) about the centroid, magnified.
    shift: [f64; 3],
    turn: [f64; 3],
}

impl Solid {
    /// The wall of a picture.
    pub fn of(id: &str, caption: &str, picture: &Picture) -> Solid {
        let blocks = picture.stones.iter().map(|stone| Block::of(stone, picture.magnification)).collect();
        let data = serde_json::to_string(&Data { from_front: picture.from_front, blocks });
        crate::check!(data.is_ok(), "a wall is not finite: {data:?}");
        Solid {
            id: id.to_owned(),
            caption: caption.to_owned(),
            moved: format!("moved, times {}", picture.magnification),
            data: data.unwrap_or_default(),
        }
    }
}

impl Block {
    fn of(stone: &Stone, magnification: f64) -> Block {
        let rounded = |x: f64| (x * DIGITS).round() / DIGITS;
        let list = |v: &Vec3| [v.x, v.y, v.z].map(rounded);
        // Not magnified at all: where it rests.
        let at_rest = stone.drawn(0.0);
        let movement = stone.movement.times(magnification);
        Block {
            still: stone.is_still(),
            vertices: at_rest.vertices.iter().flat_map(list).collect(),
            centroid: list(&at_rest.mass_properties().centroid),
            faces: at_rest.faces,
            shift: list(&movement.shift),
            turn: list(&movement.turn),
        }
    }
}
