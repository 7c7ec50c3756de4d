//! The nouns, for people: block, wall, cell, clump, heap, outcome, and what becomes of a wall over time. No arrays for the
//! machine here.

mod block;
mod cell;
mod clump;
mod movement;
mod outcome;
mod plate;
mod replay;
mod wall;

pub use block::{Block, Support, Tag};
pub use cell::Cell;
pub use clump::{Clump, Filling, Heap, Hollow, HollowFault};
pub use movement::Movement;
pub use outcome::{Level, Outcome};
pub use plate::{Six, image_motion, image_turn, plate_motion, plate_traction};
pub use replay::{BuiltJoint, JointReading, Replay, ReplayState};
pub use wall::{JointLaws, Wall};
