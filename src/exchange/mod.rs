//! Walls from and to other programs, drawings and pictures. What is wrong with a file is named block by block.

mod closing;
mod draft;
mod drawing;
mod fault;
mod flatten;
mod format;
mod json;
mod json_node;
mod json_place;
mod mended;
mod mesh;
mod obj;
mod parts;
mod read;
mod read_compas;
mod read_json;
mod read_obj;
mod read_table;
mod scan;
mod sheet;
mod solid;
mod threedec;
mod vain;

pub use draft::{Drawn, WallFile};
pub use fault::{Fault, WallFaults};
pub use format::{Format, WALL_FILES};
pub use json::write_wall_json;
pub use mesh::meshes_of;
pub use obj::write_obj;
pub use read::{
    ReadOptions, Unit, Up, leaves_units_open, read_wall, read_wall_bytes, states_no_units, wall_bytes,
};
pub use read_json::{read_wall_json, read_wall_json_with};
pub use read_obj::read_obj;
pub use vain::{Choice, Nature};
