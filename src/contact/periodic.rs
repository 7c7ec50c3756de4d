//! The joints of a periodic cell: each once, whether it lies inside the cell or across its border.

use crate::contact::{Patch, Settings, find_patch};
use crate::math::Vec3;
use crate::model::Cell;

/// A joint between a stone and an image of another one, or of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicJoint {
    /// The stone in the cell.
    pub first: usize,
    /// The stone whose image touches it.
    pub second: usize,
    /// The translation from the second stone to that image (m); zero for a joint inside the cell.
    pub shift: Vec3,
    /// Where the first stone and the image touch.
    pub patch: Patch,
}

/// Finds all joints, in the order of their stones and images.
///
/// Of a pair of stones and its mirror, in which the other stone is the image, one is taken: the joint is the same.
pub fn periodic_joints(cell: &Cell, settings: &Settings) -> Vec<PeriodicJoint> {
    let bounds: Vec<(Vec3, Vec3)> = cell.blocks.iter().map(|b| b.shape.bounds()).collect();
    let near = |a: usize, b: usize, shift: &Vec3| {
        let ((low, high), (from, to)) = (bounds[a], bounds[b]);
        (0..3).all(|k| {
            from[k] + shift[k] <= high[k] + settings.reach && low[k] - settings.reach <= to[k] + shift[k]
        })
    };
    let images = images(cell, &bounds);
    let mut joints = Vec::new();
    for first in 0..cell.blocks.len() {
        for second in 0..cell.blocks.len() {
            for &(p, q) in &images {
                // Inside the cell every pair once; across its border every image once, not its mirror as well.
                let is_taken = if (p, q) == (0, 0) { first < second } else { q > 0 || (q == 0 && p > 0) };
                let shift = cell.shift(p, q);
                if !is_taken || !near(first, second, &shift) {
                    continue;
                }
                let image = cell.blocks[second].shape.translated(&shift);
                if let Some(patch) = find_patch(&cell.blocks[first].shape, &image, settings) {
                    joints.push(PeriodicJoint { first, second, shift, patch });
                }
            }
        }
    }
    joints
}

/// The images that stones of the cell can touch: those within the size of all stones together.
fn images(cell: &Cell, bounds: &[(Vec3, Vec3)]) -> Vec<(i32, i32)> {
    let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    for (from, to) in bounds {
        (low, high) = (low.inf(from), high.sup(to));
    }
    let extent = (high - low) * 1.01;
    let [[length, _], [slant, height]] = cell.lattice;
    let rows = (extent.z / height).ceil() as i32;
    let columns = ((extent.x + f64::from(rows) * slant.abs()) / length).ceil() as i32;
    let all = (-rows..=rows).flat_map(|q| (-columns..=columns).map(move |p| (p, q)));
    let reaches = |&(p, q): &(i32, i32)| {
        let shift = cell.shift(p, q);
        shift.x.abs() <= extent.x && shift.z.abs() <= extent.z
    };
    all.filter(reaches).collect()
}
