//! One wall of a study: written to a file, or drawn as it falls.

pub(crate) mod ask;
pub(crate) mod condition;
pub(crate) mod drawn;
pub(crate) mod frames;
pub(crate) mod generate;
pub(crate) mod one_wall;
pub(crate) mod picture;
pub(crate) mod replayed;
