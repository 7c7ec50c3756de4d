//! Walls from and to other programs: `wall.json` and OBJ. What is wrong with a file is named block by block.

mod closing;
mod draft;
mod fault;
mod flatten;
mod json;
mod json_node;
mod json_place;
mod mended;
mod obj;
mod parts;
mod read;
mod read_compas;
mod read_json;
mod read_obj;
mod read_table;
mod scan;
mod solid;

pub use draft::WallFile;
pub use fault::{Fault, WallFaults};
pub use json::write_wall_json;
pub use obj::write_obj;
pub use read::{
    ReadOptions, Unit, Up, is_elevation, leaves_units_open, read_wall, read_wall_bytes, states_no_units,
    wall_bytes,
};
pub use read_json::{read_wall_json, read_wall_json_with};
pub use read_obj::read_obj;
