//! What mending did, stone by stone and in a sentence.

use crate::mend::face::{Face, farthest};
use crate::mend::plane::Shared;
use crate::model::{Support, Wall};
use crate::shape::{Polyhedron, corners_apart};

/// What became of a stone.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Moved {
    /// The block.
    pub block: usize,
    /// How far its corners moved at most (m).
    pub moved_m: f64,
    /// What was cut off it, or it was extended by, as a share of its volume; negative where it lost.
    pub volume_share: f64,
}

/// A mended wall.
#[derive(Clone, Debug)]
pub struct Mended {
    /// The wall.
    pub wall: Wall,
    /// The stones that changed, in their order.
    pub stones: Vec<Moved>,
    /// Faces of the wall's free blocks.
    pub faces: usize,
    /// How many of them moved, and how far (m) a corner of one was from its plane at most.
    pub moved: (usize, f64),
    /// By how much the volume of the free blocks changed, as a share of it.
    pub volume_share: f64,
    /// Pairs of blocks whose faces see each other within the tolerance and did not become one plane.
    pub parted: Vec<(usize, usize)>,
    /// Pairs of blocks that overlap still, and how deep (m).
    pub overlaps: Vec<((usize, usize), f64)>,
}

/// A corner that lies this far (m) off has not moved: rounding.
const MOVED: f64 = 1e-9;

impl Mended {
    /// What was done to a wall, `now` as it is mended: what it was, and the shapes of its blocks now, both about the same origin.
    pub(super) fn of(
        now: Wall,
        (wall, after): (&Wall, &[Polyhedron]),
        (faces, shared): (&[Face], &Shared),
        overlaps: Vec<((usize, usize), f64)>,
    ) -> Mended {
        let free = |face: &&Face| !face.is_fixed;
        let offs = faces.iter().zip(&shared.planes).filter(|(face, _)| free(face));
        let offs = offs.filter_map(|(face, plane)| plane.map(|plane| farthest(face, &plane)));
        let offs: Vec<f64> = offs.filter(|off| *off > MOVED).collect();
        let volumes: Vec<(f64, f64)> =
            wall.blocks.iter().zip(after).map(|(block, now)| (block.shape.volume(), now.volume())).collect();
        let changed =
            wall.blocks.iter().zip(after).enumerate().filter(|(_, (block, now))| block.shape != **now);
        let stones = changed
            .map(|(block, (own, now))| Moved {
                block,
                moved_m: corners_apart(&own.shape.vertices, &now.vertices),
                volume_share: volumes[block].1 / volumes[block].0 - 1.0,
            })
            .collect();
        let of_free = wall.blocks.iter().zip(&volumes).filter(|(block, _)| block.support != Support::Fixed);
        let (before, since) = of_free.fold((0.0, 0.0), |sum, (_, of)| (sum.0 + of.0, sum.1 + of.1));
        let mut parted: Vec<(usize, usize)> =
            shared.parted.iter().map(|(a, b)| (faces[*a].block, faces[*b].block)).collect();
        parted.sort_unstable();
        parted.dedup();
        Mended {
            wall: now,
            stones,
            faces: faces.iter().filter(free).count(),
            moved: (offs.len(), offs.iter().copied().fold(0.0, f64::max)),
            volume_share: if before > 0.0 { since / before - 1.0 } else { 0.0 },
            parted,
            overlaps,
        }
    }
}
