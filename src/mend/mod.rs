//! One wall for all solvers: stones whose measured faces nearly meet get joints that are shared planes.
//!
//! Corners that come from a survey are off by millimetres. Beds become wedges, neighbours overlap here and gape there, and each solver reads
//! that in its own way. Faces that belong together become one plane; the stones are what lies behind their planes then.

mod cut;
mod face;
mod link;
mod plane;
mod report;
mod stone;

pub use report::{Mended, Moved};

use crate::contact::{MOST_NEAR, candidate_pairs_up_to};
use crate::mend::cut::cut_overlaps;
use crate::mend::face::faces;
use crate::mend::link::links;
use crate::mend::plane::shared_planes;
use crate::mend::stone::rebuilt;
use crate::model::Wall;
use crate::shape::Polyhedron;

/// Share of a block's size within which planes are the same and corners lie on them: rounding alone.
pub(crate) const ROUNDING: f64 = 1e-9;

/// Mends a wall (its ground included) in which faces that belong together are up to `within` (m) apart, overlap by as much or lean by that
/// over their extent. No face moves further. Fixed blocks stay as they are; wider gaps stay open. A wall that needs nothing comes back as it is,
/// to the bit.
///
/// `None` for a wall so entangled that there are more than 300 near pairs per block.
pub fn mend(wall: &Wall, within: f64) -> Option<Mended> {
    let (origin, local) = wall.about_local_origin();
    let before: Vec<Polyhedron> = local.blocks.iter().map(|block| block.shape.clone()).collect();
    let pairs = candidate_pairs_up_to(&before, 2.0 * within, MOST_NEAR * before.len())?;
    let faces = faces(&local);
    let links = links(&faces, &pairs, within);
    let shared = shared_planes(&faces, links, within);
    let mut after = rebuilt(&local, &faces, &shared.planes);
    let left = cut_overlaps(&local, &mut after, &pairs, within);
    let mut mended = wall.clone();
    for ((block, own), shape) in mended.blocks.iter_mut().zip(&before).zip(&after) {
        // What has not changed keeps its bits, also far from the origin.
        if shape != own {
            block.shape = shape.translated(&origin);
        }
    }
    Some(Mended::of(mended, (&local, &after), (&faces, &shared), left))
}

#[cfg(test)]
mod tests;
