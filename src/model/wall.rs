//! A wall: its blocks, and the law of every joint.

use std::collections::BTreeMap;

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

/// The law of each joint: one for all, and exceptions by pair of blocks (lower id first).
#[derive(Clone, Debug, PartialEq)]
pub struct JointLaws {
    /// The law of every joint without an entry of its own.
    pub default: Coulomb,
    /// Joints with their own law, keyed by (lower id, higher id).
    pub by_pair: BTreeMap<(u32, u32), Coulomb>,
}

impl JointLaws {
    /// The same law for every joint.
    pub fn uniform(law: Coulomb) -> Self {
        JointLaws { default: law, by_pair: BTreeMap::new() }
    }

    /// The law of the joint between two blocks.
    pub fn of(&self, a: u32, b: u32) -> &Coulomb {
        self.by_pair.get(&(a.min(b), a.max(b))).unwrap_or(&self.default)
    }
}
