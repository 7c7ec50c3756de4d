//! Broad phase: pairs of blocks whose bounding boxes come near each other, by parry3d's bounding volume hierarchy.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use crate::shape::Polyhedron;

/// Pairs (lower id, higher id) whose bounding boxes, grown by half of `margin` (m) on all sides, overlap; sorted.
pub fn candidate_pairs(shapes: &[Polyhedron], margin: f64) -> Vec<(u32, u32)> {
    candidate_pairs_up_to(shapes, margin, usize::MAX).unwrap_or_default()
}

/// The same, but `None` as soon as there are more than `most` of them.
pub fn candidate_pairs_up_to(shapes: &[Polyhedron], margin: f64, most: usize) -> Option<Vec<(u32, u32)>> {
    let boxes: Vec<Aabb> = shapes
        .iter()
        .map(|shape| {
            let (low, high) = shape.bounds();
            let grow = 0.5 * margin;
            Aabb::new(
                Vector::new(low.x - grow, low.y - grow, low.z - grow),
                Vector::new(high.x + grow, high.y + grow, high.z + grow),
            )
        })
        .collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    let mut pairs = Vec::new();
    for (a, bounds) in boxes.iter().enumerate() {
        let left = most - pairs.len();
        let above = tree.intersect_aabb(bounds).filter(|&b| b > a as u32).map(|b| (a as u32, b));
        // One more than allowed tells that there are too many.
        pairs.extend(above.take(left.saturating_add(1)));
        if pairs.len() > most {
            return None;
        }
    }
    pairs.sort_unstable();
    Some(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn every_near_pair_is_found_once_and_no_far_one() {
        let cube =
            |x: f64, y: f64| Polyhedron::cuboid(Vec3::new(x, y, 0.0), Vec3::new(x + 1.0, y + 1.0, 1.0));
        let mut shapes = Vec::new();
        for i in 0..7 {
            for j in 0..5 {
                // Columns 1 m apart touch; rows are 0.01 m apart, so the margin decides.
                shapes.push(cube(f64::from(i), 1.01 * f64::from(j)));
            }
        }
        let brute = |margin: f64| {
            let mut pairs = Vec::new();
            for a in 0..shapes.len() {
                for b in a + 1..shapes.len() {
                    let ((la, ha), (lb, hb)) = (shapes[a].bounds(), shapes[b].bounds());
                    if (0..3).all(|k| la[k] - margin <= hb[k] && lb[k] - margin <= ha[k]) {
                        pairs.push((a as u32, b as u32));
                    }
                }
            }
            pairs
        };
        for margin in [1e-3, 0.02] {
            assert_eq!(candidate_pairs(&shapes, margin), brute(margin));
        }
    }
}
