//! A wall: its blocks, and who gives a joint its law.

use crate::law::Coulomb;
use crate::model::{Block, Tag};

/// Any assembly of convex blocks. Axes: x along the wall, y out of plane (positive downhill), z up (m).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Wall {
    /// The blocks; a block's id is its index.
    pub blocks: Vec<Block>,
}

impl Wall {
    /// The stones, without base and ends: what the wall weighs and what is observed.
    pub fn stones(&self) -> impl Iterator<Item = (usize, &Block)> {
        self.blocks.iter().enumerate().filter(|(_, b)| !matches!(b.tag, Tag::Base | Tag::End))
    }
}

/// Gives every joint its law; asked once per joint when it is first found, with the lower id first.
pub trait JointLaws: Sync {
    /// The law of the joint between blocks `a` and `b`; the same answer for (b, a).
    fn of(&self, a: u32, b: u32) -> Coulomb;
}

/// The same law for every joint.
impl JointLaws for Coulomb {
    fn of(&self, _a: u32, _b: u32) -> Coulomb {
        *self
    }
}
