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
mod read;
mod read_json;
mod read_obj;
mod scan;
mod solid;

pub use draft::WallFile;
pub use fault::{Fault, WallFaults};
pub use json::write_wall_json;
pub use obj::write_obj;
pub use read::{ReadOptions, Unit, Up, read_wall, read_wall_bytes, wall_bytes};
pub use read_json::{read_wall_json, read_wall_json_with};
pub use read_obj::read_obj;
