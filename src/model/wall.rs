//! A wall: its blocks, and who gives a joint its law.

use std::collections::BTreeMap;

use crate::law::Coulomb;
use crate::math::{Mat3, Vec3};
use crate::model::{Block, Support, Tag};
use crate::shape::Polyhedron;

/// How far the base reaches beyond the wall on all sides, and its thickness (m).
const BASE_MARGIN: f64 = 0.1;
/// A wall so many of its extents away from the origin of the coordinates is far: its positions lose two digits there.
const NEAR: f64 = 50.0;

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

    /// Whether the wall stands on fixed blocks of its own: those tagged as base, which lie behind the stones in the walls of studies.
    pub fn has_base(&self) -> bool {
        self.blocks.iter().any(|block| block.tag == Tag::Base)
    }

    /// How many blocks come before the first one of the base; all where there is none.
    pub fn before_base(&self) -> usize {
        self.blocks.iter().position(|block| block.tag == Tag::Base).unwrap_or(self.blocks.len())
    }

    /// For every block the first one of its [group](Block::group), which stands for their common body; itself without one.
    pub fn leads(&self) -> Vec<usize> {
        let mut first: BTreeMap<&str, usize> = BTreeMap::new();
        let mut leads = Vec::with_capacity(self.blocks.len());
        for (id, block) in self.blocks.iter().enumerate() {
            leads.push(block.group.as_deref().map_or(id, |group| *first.entry(group).or_insert(id)));
        }
        leads
    }

    /// The stones of several parts: the first part and all parts, itself among them.
    pub fn parts(&self) -> BTreeMap<usize, Vec<usize>> {
        let mut parts: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (id, lead) in
            self.leads().into_iter().enumerate().filter(|(id, _)| self.blocks[*id].group.is_some())
        {
            parts.entry(lead).or_default().push(id);
        }
        parts.retain(|_, parts| parts.len() > 1);
        parts
    }

    /// Lowest and highest corner of the box around all blocks (m); infinite and inside out for a wall without blocks.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        box_around(self.blocks.iter())
    }

    /// The same of the stones alone.
    pub fn bounds_of_stones(&self) -> (Vec3, Vec3) {
        box_around(self.stones().map(|(_, block)| block))
    }

    /// The point (m) that the solvers count from, so that a wall has the same answer wherever it stands: far from the origin
    /// of the coordinates the last digit of a position is as coarse as joints close.
    ///
    /// It is the origin itself for a wall within fifty of its extents of it. Else it lies within four extents of the middle of
    /// the blocks that can move, on a grid of a power of two, so that the difference to it is exact.
    pub fn local_origin(&self) -> Vec3 {
        let free = self.blocks.iter().filter(|block| block.support != Support::Fixed);
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        for (from, to) in free.map(|block| block.shape.bounds()) {
            (low, high) = (low.inf(&from), high.sup(&to));
        }
        let extent = (high - low).max();
        let middle = (low + high) * 0.5;
        if !(extent.is_finite() && extent > 0.0) || middle.amax() <= NEAR * extent {
            return Vec3::zeros();
        }
        let mut grid = 1.0;
        while grid < 4.0 * extent {
            grid *= 2.0;
        }
        while grid >= 8.0 * extent {
            grid *= 0.5;
        }
        middle.map(|x| (x / grid).round() * grid)
    }

    /// [`Wall::local_origin`], and the wall with its positions counted from there.
    pub fn about_local_origin(&self) -> (Vec3, Wall) {
        let (origin, mut wall) = (self.local_origin(), self.clone());
        for block in &mut wall.blocks {
            block.shift(&-origin);
        }
        (origin, wall)
    }

    /// The same wall out of plumb: everything moved along y by `slope` times its height above z = 0, so that level beds stay
    /// level.
    pub fn leaning(mut self, slope: f64) -> Wall {
        for vertex in self.blocks.iter_mut().flat_map(|block| &mut block.shape.vertices) {
            vertex.y += slope * vertex.z;
        }
        let lean = Mat3::new(1.0, 0.0, 0.0, 0.0, 1.0, slope, 0.0, 0.0, 1.0);
        for scan in self.blocks.iter_mut().filter_map(|block| block.scan.as_mut()) {
            *scan = scan.mapped(&lean);
        }
        self
    }

    /// The wall turned round: by half a turn about the vertical axis through the middle of a wall of this length (m) whose base has
    /// its middle at y = 0.
    pub fn turned(mut self, length: f64) -> Wall {
        for vertex in self.blocks.iter_mut().flat_map(|block| &mut block.shape.vertices) {
            (vertex.x, vertex.y) = (length - vertex.x, -vertex.y);
        }
        for scan in self.blocks.iter_mut().filter_map(|block| block.scan.as_mut()) {
            *scan = scan.mapped(&Mat3::from_diagonal(&Vec3::new(-1.0, -1.0, 1.0)));
            scan.centroid.x += length;
        }
        self
    }

    /// The wall on the ground: adds one fixed block as the last one, so that the stones keep their ids. Its top is
    /// the plane z = 0; it is 0.1 m thick and reaches 0.1 m beyond the wall on all sides. Its density is that of the
    /// first stone; being fixed, its weight acts on nothing.
    ///
    /// A wall without blocks is returned as it is, and one with a base of its own.
    pub fn with_base(mut self) -> Wall {
        if self.has_base() {
            return self;
        }
        let Some(density) = self.blocks.first().map(|b| b.density) else { return self };
        let (low, high) = self.bounds();
        self.blocks.push(Block {
            support: Support::Fixed,
            tag: Tag::Base,
            ..Block::stone(
                Polyhedron::cuboid(
                    Vec3::new(low.x - BASE_MARGIN, low.y - BASE_MARGIN, -BASE_MARGIN),
                    Vec3::new(high.x + BASE_MARGIN, high.y + BASE_MARGIN, 0.0),
                ),
                density,
            )
        });
        self
    }
}

/// Lowest and highest corner of the box around blocks.
fn box_around<'b>(blocks: impl Iterator<Item = &'b Block>) -> (Vec3, Vec3) {
    let mut box_around = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    for (low, high) in blocks.map(|block| block.shape.bounds()) {
        box_around = (box_around.0.inf(&low), box_around.1.sup(&high));
    }
    box_around
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
