//! The nouns, for people: block, wall, load, outcome. No arrays for the machine here.

mod block;
mod outcome;
mod wall;

pub use block::{Block, Support, Tag};
pub use outcome::{Level, Outcome};
pub use wall::{JointLaws, Wall};
