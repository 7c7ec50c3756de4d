//! The nouns, for people: block, wall, clump, heap, outcome, and what becomes of a wall over time. No arrays for the machine here.

mod block;
mod clump;
mod movement;
mod outcome;
mod replay;
mod wall;

pub use block::{Block, Support, Tag};
pub use clump::{Clump, Filling, Heap, Hollow, HollowFault};
pub use movement::Movement;
pub use outcome::{Level, Outcome};
pub use replay::{BuiltJoint, JointReading, Replay, ReplayState};
pub use wall::{JointLaws, Wall};
