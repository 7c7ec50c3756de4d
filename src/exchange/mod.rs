//! Walls from and to other programs: `wall.json` and OBJ.

mod json;
mod obj;

pub use json::write_wall_json;
pub use obj::write_obj;
