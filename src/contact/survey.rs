//! What a wall that somebody else made is like where its blocks meet: which touch, which overlap, which just miss
//! each other, and which hang in the air.

use crate::contact::{Settings, candidate_pairs_up_to, find_patch};
use crate::model::{Support, Wall};
use crate::shape::{Plane, Polyhedron, overlap_depth};

/// Near pairs per block beyond which a wall is no wall but a tangle, whose search would fill the memory.
const MOST_NEAR: usize = 300;
/// Most work on overlaps, as a sum of (corners)^3 over the pairs; a second or so per 2e8. Two million pairs of boxes.
const MOST_WORK: usize = 2_000_000_000;

/// Two blocks (lower index first) and a length (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The blocks.
    pub blocks: (usize, usize),
    /// Depth of the overlap, or width of the gap (m).
    pub length: f64,
}

/// How the blocks of a wall meet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Survey {
    /// Pairs that touch within the tolerance or overlap.
    pub joints: Vec<(usize, usize)>,
    /// Pairs that overlap by more than the tolerance, with the depth.
    pub overlaps: Vec<Pair>,
    /// Pairs whose faces look at each other across more than the tolerance and less than the reach, with the
    /// narrowest gap.
    pub gaps: Vec<Pair>,
    /// Groups of blocks that touch one another but, in no chain of touching blocks, a fixed one.
    pub floating: Vec<Vec<usize>>,
    /// Deepest overlap of all joints (m), within the tolerance or not.
    pub deepest: f64,
}

/// Looks at every pair of blocks that may meet. `settings.touch` (m) is the tolerance: up to it, a gap is a joint and
/// an overlap is rounding; gaps are listed up to `settings.reach`. Pairs of fixed blocks do not matter.
///
/// `None` when the blocks are so entangled that looking on would take all memory or all day: more than 300 near pairs
/// per block, or solids of many corners that overlap by the hundred.
pub fn survey(wall: &Wall, settings: &Settings) -> Option<Survey> {
    let shapes: Vec<Polyhedron> = wall.blocks.iter().map(|block| block.shape.clone()).collect();
    let most = MOST_NEAR * shapes.len();
    let fixed = |i: usize| wall.blocks[i].support == Support::Fixed;
    let (mut survey, mut work) = (Survey::default(), 0usize);
    for (a, b) in candidate_pairs_up_to(&shapes, 2.0 * settings.reach, most)? {
        let (a, b) = (a as usize, b as usize);
        if fixed(a) && fixed(b) {
            continue;
        }
        match meet(&shapes[a], &shapes[b], settings) {
            Meeting::Overlap(length) => {
                let corners = [shapes[a].vertices.len(), shapes[b].vertices.len()];
                work += corners[0] * corners[1] * (corners[0] + corners[1]) / 2;
                if work > MOST_WORK {
                    return None;
                }
                survey.joints.push((a, b));
                survey.overlaps.push(Pair { blocks: (a, b), length });
                survey.deepest = survey.deepest.max(length);
            }
            Meeting::Joint(depth) => {
                survey.joints.push((a, b));
                survey.deepest = survey.deepest.max(depth);
            }
            Meeting::Gap(length) => survey.gaps.push(Pair { blocks: (a, b), length }),
            Meeting::Apart => {}
        }
    }
    survey.floating = floating(wall.blocks.len(), fixed, &survey.joints);
    Some(survey)
}

enum Meeting {
    Overlap(f64),
    Joint(f64),
    Gap(f64),
    Apart,
}

fn meet(a: &Polyhedron, b: &Polyhedron, settings: &Settings) -> Meeting {
    if let Some(depth) = overlap_depth(a, b, settings.touch) {
        return Meeting::Overlap(depth);
    }
    let Some(patch) = find_patch(a, b, settings) else { return Meeting::Apart };
    // The gap is affine over the patch: it is narrowest at a corner.
    let gap = narrowest(&patch.plane, patch.polygon.vertices.iter().map(|st| patch.frame.lift(*st)));
    if gap > settings.touch { Meeting::Gap(gap) } else { Meeting::Joint(-gap) }
}

fn narrowest(plane: &Plane, points: impl Iterator<Item = crate::math::Vec3>) -> f64 {
    points.map(|p| plane.distance(&p)).fold(f64::INFINITY, f64::min)
}

/// Groups of blocks that hold together by joints and reach no fixed block, lowest index first.
fn floating(count: usize, fixed: impl Fn(usize) -> bool, joints: &[(usize, usize)]) -> Vec<Vec<usize>> {
    let mut touching: Vec<Vec<usize>> = vec![Vec::new(); count];
    for &(a, b) in joints {
        touching[a].push(b);
        touching[b].push(a);
    }
    let mut seen = vec![false; count];
    let mut group_of = |start: usize| {
        let (mut group, mut next) = (vec![start], 0);
        seen[start] = true;
        while let Some(&block) = group.get(next) {
            next += 1;
            for &other in &touching[block] {
                if !std::mem::replace(&mut seen[other], true) {
                    group.push(other);
                }
            }
        }
        group.sort_unstable();
        group
    };
    let mut groups = Vec::new();
    let mut reached = vec![false; count];
    for start in 0..count {
        if !reached[start] {
            let group = group_of(start);
            group.iter().for_each(|&block| reached[block] = true);
            if !group.iter().any(|&block| fixed(block)) {
                groups.push(group);
            }
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::model::{Block, Tag};

    /// Cubes of 1 m in a row along x at these places, the first fixed.
    fn row(places: &[f64]) -> Wall {
        let block = |(i, x): (usize, &f64)| Block {
            shape: Polyhedron::cuboid(Vec3::new(*x, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 1.0)),
            density: 2400.0,
            support: if i == 0 { Support::Fixed } else { Support::Free },
            tag: Tag::Stone,
            group: None,
        };
        Wall { blocks: places.iter().enumerate().map(block).collect() }
    }

    fn surveyed(places: &[f64]) -> Survey {
        survey(&row(places), &Settings { touch: 1e-6, ..Settings::for_size(1.0, [2, 2]) }).unwrap()
    }

    #[test]
    fn touching_overlapping_and_parted_blocks_are_told_apart_with_their_lengths() {
        // Touching; a gap of half the tolerance; an overlap of 1 mm; a gap of 2 mm; a gap beyond the reach of 5 mm.
        let found = surveyed(&[0.0, 1.0, 2.000_000_5, 2.999_000_5, 4.001_000_5, 5.1]);
        assert_eq!(found.joints, [(0, 1), (1, 2), (2, 3)]);
        let close = |pairs: &[Pair], blocks, length: f64| {
            assert_eq!(pairs.len(), 1, "{pairs:?}");
            assert_eq!(pairs[0].blocks, blocks);
            assert!((pairs[0].length - length).abs() < 1e-12, "{pairs:?}");
        };
        close(&found.overlaps, (2, 3), 1e-3);
        close(&found.gaps, (3, 4), 2e-3);
        assert_eq!(found.floating, [vec![4], vec![5]]);
        assert!((found.deepest - 1e-3).abs() < 1e-12);
    }

    #[test]
    fn blocks_that_float_together_are_one_group() {
        let found = surveyed(&[0.0, 3.0, 1.0, 4.0]);
        assert_eq!(found.floating, [vec![1, 3]]);
        assert_eq!(found.joints, [(0, 2), (1, 3)]);
    }

    #[test]
    fn blocks_that_share_an_edge_only_make_no_joint() {
        let mut wall = row(&[0.0, 1.0]);
        wall.blocks[1].shape = wall.blocks[1].shape.translated(&Vec3::new(0.0, 0.0, 1.0));
        let found = survey(&wall, &Settings::for_size(1.0, [2, 2])).unwrap();
        assert_eq!((found.joints.len(), found.gaps.len()), (0, 0));
    }

    #[test]
    fn a_tangle_is_refused_instead_of_listed() {
        let wall = row(&vec![0.0; 700]);
        assert_eq!(survey(&wall, &Settings::for_size(1.0, [2, 2])), None);
    }
}
