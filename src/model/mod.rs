//! The nouns, for people: block, wall, clump, heap, outcome. No arrays for the machine here.

mod block;
mod clump;
mod outcome;
mod wall;

pub use block::{Block, Support, Tag};
pub use clump::{Clump, Heap};
pub use outcome::{Level, Outcome};
pub use wall::{JointLaws, Wall};
