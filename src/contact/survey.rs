//! What a wall that somebody else made is like where its blocks meet: which touch, which overlap, which just miss
//! each other, and which hang in the air.

use std::collections::BTreeMap;

use crate::contact::{Patch, Settings, candidate_pairs_up_to, contains, facing, find_patch};
use crate::math::Vec3;
use crate::model::{Support, Wall};
use crate::shape::{Polyhedron, overlap_depth};

/// Near pairs per block beyond which a wall is no wall but a tangle, whose search would fill the memory.
pub const MOST_NEAR: usize = 300;
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
    /// Pairs whose faces look at each other across more than the tolerance and at most `within`, and other pairs that miss each
    /// other by less than the reach, with the narrowest gap. A gap that a third block fills, touching both, is none.
    pub gaps: Vec<Pair>,
    /// Pairs that touch on a part of a joint only, with the gap (m) on its far side, up to `within`.
    pub gaping: Vec<Pair>,
    /// Joints of faces that are not parallel or overlap: by how much the gap differs over the joint as far as it touches within the tolerance, or how
    /// deep they overlap (m).
    pub uneven: Vec<Pair>,
    /// Parts of one stone that overlap by more than the tolerance, with the depth.
    pub shared: Vec<Pair>,
    /// The first parts of stones whose parts do not all hang together.
    pub scattered: Vec<usize>,
    /// Groups of blocks that touch one another but, in no chain of touching blocks, a fixed one.
    pub floating: Vec<Vec<usize>>,
    /// Deepest overlap of all joints (m), within the tolerance or not.
    pub deepest: f64,
}

/// Looks at every pair of blocks that may meet. `settings.closed` (m) is the tolerance: up to it, a gap is a joint and
/// an overlap is rounding; gaps between faces are listed up to `within` (m). Pairs of fixed blocks do not matter, and parts of
/// one stone have no joint.
///
/// `None` when the blocks are so entangled that looking on would take all memory or all day: more than 300 near pairs
/// per block, or solids of many corners that overlap by the hundred.
pub fn survey(wall: &Wall, settings: &Settings, within: f64) -> Option<Survey> {
    let (_, wall) = wall.about_local_origin();
    let shapes: Vec<Polyhedron> = wall.blocks.iter().map(|block| block.shape.clone()).collect();
    let most = MOST_NEAR * shapes.len();
    let fixed = |i: usize| wall.blocks[i].support == Support::Fixed;
    let leads = wall.leads();
    let (mut found, mut work) = (Found::default(), 0usize);
    for (a, b) in candidate_pairs_up_to(&shapes, within.max(2.0 * settings.reach), most)? {
        let (a, b) = (a as usize, b as usize);
        if fixed(a) && fixed(b) && leads[a] != leads[b] {
            continue;
        }
        let meeting = meet(&shapes[a], &shapes[b], settings, within);
        if let Meeting::Overlap(_) = meeting {
            let corners = [shapes[a].vertices.len(), shapes[b].vertices.len()];
            work += corners[0] * corners[1] * (corners[0] + corners[1]) / 2;
            if work > MOST_WORK {
                return None;
            }
        }
        if leads[a] == leads[b] {
            found.within_a_stone((a, b), &meeting);
        } else {
            found.between_stones((a, b), meeting, settings.closed, within);
        }
    }
    let Found { mut survey, across, held } = found;
    let touching: Vec<(usize, usize)> = survey.joints.iter().chain(&held).copied().collect();
    let beside = neighbours(shapes.len(), &touching);
    let is_filled = |(pair, patch): &(Pair, Box<Patch>)| {
        let (a, b) = pair.blocks;
        beside[a].iter().any(|third| beside[b].contains(third) && lies_between(&shapes[*third], patch))
    };
    survey.gaps = across.iter().filter(|gap| !is_filled(gap)).map(|(pair, _)| *pair).collect();
    // Parts that do not touch are one body all the same.
    let bound = leads.iter().copied().zip(0..).filter(|(lead, id)| lead != id);
    let together: Vec<(usize, usize)> = survey.joints.iter().copied().chain(bound).collect();
    survey.floating = groups(&neighbours(shapes.len(), &together));
    survey.floating.retain(|group| !group.iter().any(|&block| fixed(block)));
    survey.scattered = scattered(&leads, &groups(&neighbours(shapes.len(), &held)));
    Some(survey)
}

/// What is found pair by pair.
#[derive(Default)]
struct Found {
    survey: Survey,
    /// Gaps with the patch that there would be.
    across: Vec<(Pair, Box<Patch>)>,
    /// Parts of one stone that touch.
    held: Vec<(usize, usize)>,
}

impl Found {
    fn within_a_stone(&mut self, blocks: (usize, usize), meeting: &Meeting) {
        if let Meeting::Overlap(length) = *meeting {
            self.survey.shared.push(Pair { blocks, length });
        }
        if matches!(meeting, Meeting::Overlap(_) | Meeting::Joint(_)) {
            self.held.push(blocks);
        }
    }

    fn between_stones(&mut self, blocks: (usize, usize), meeting: Meeting, closed: f64, within: f64) {
        let pair = |length: f64| Pair { blocks, length };
        match meeting {
            Meeting::Apart => {}
            // Faces that see one another through a slit narrower than the gap were never meant as a joint.
            Meeting::Gap(gap, patch) if narrower(&patch) < gap => {}
            Meeting::Gap(gap, patch) => self.across.push((pair(gap), patch)),
            Meeting::Overlap(depth) => {
                self.survey.joints.push(blocks);
                self.survey.overlaps.push(pair(depth));
                self.survey.uneven.push(pair(depth));
                self.survey.deepest = self.survey.deepest.max(depth);
            }
            Meeting::Joint([narrowest, widest]) => {
                self.survey.joints.push(blocks);
                self.survey.deepest = self.survey.deepest.max(-narrowest);
                // A gap that is as wide everywhere is one plane to all solvers.
                let apart = (widest.min(closed) - narrowest).max(-narrowest);
                if apart > 0.0 {
                    self.survey.uneven.push(pair(apart));
                }
                if widest > closed && widest <= within {
                    self.survey.gaping.push(pair(widest));
                }
            }
        }
    }
}

enum Meeting {
    /// How deep.
    Overlap(f64),
    /// Where it gapes least, negative where it overlaps, and most.
    Joint([f64; 2]),
    /// How wide it is at its narrowest, and the patch that there would be.
    Gap(f64, Box<Patch>),
    Apart,
}

fn meet(a: &Polyhedron, b: &Polyhedron, settings: &Settings, within: f64) -> Meeting {
    if let Some(depth) = overlap_depth(a, b, settings.closed) {
        return Meeting::Overlap(depth);
    }
    let patch = find_patch(a, b, settings).or_else(|| facing(a, b, within, settings));
    let Some(patch) = patch else { return Meeting::Apart };
    let [narrowest, widest] = patch.gaps();
    if narrowest > settings.closed {
        Meeting::Gap(narrowest, Box::new(patch))
    } else {
        Meeting::Joint([narrowest, widest])
    }
}

/// The smaller one of the extents (m) of a patch along its axes.
fn narrower(patch: &Patch) -> f64 {
    let extent = |axis: usize| {
        let along = patch.polygon.vertices.iter().map(|st| st[axis]);
        let ends = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        ends[1] - ends[0]
    };
    extent(0).min(extent(1))
}

/// Whether the middle of a block lies in the gap over a patch.
fn lies_between(block: &Polyhedron, patch: &Patch) -> bool {
    let middle = block.vertices.iter().sum::<Vec3>() / block.vertices.len() as f64;
    let (beyond, before) =
        (patch.plane.distance(&middle), patch.frame.normal.dot(&(middle - patch.frame.origin)));
    beyond > 0.0 && before > 0.0 && contains(&patch.polygon, &patch.frame.project(&middle))
}

/// The blocks that each one is paired with.
fn neighbours(count: usize, pairs: &[(usize, usize)]) -> Vec<Vec<usize>> {
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); count];
    for &(a, b) in pairs {
        beside[a].push(b);
        beside[b].push(a);
    }
    beside
}

/// Blocks that hang together, lowest index first.
fn groups(beside: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; beside.len()];
    let mut groups = Vec::new();
    for start in 0..beside.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let (mut group, mut next) = (vec![start], 0);
        while let Some(&block) = group.get(next) {
            next += 1;
            for &other in &beside[block] {
                if !std::mem::replace(&mut seen[other], true) {
                    group.push(other);
                }
            }
        }
        group.sort_unstable();
        groups.push(group);
    }
    groups
}

/// The first parts of stones of which there are parts in several of the groups.
fn scattered(leads: &[usize], groups: &[Vec<usize>]) -> Vec<usize> {
    let mut pieces: BTreeMap<usize, usize> = BTreeMap::new();
    groups.iter().for_each(|group| *pieces.entry(leads[group[0]]).or_default() += 1);
    pieces.into_iter().filter(|(_, count)| *count > 1).map(|(lead, _)| lead).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::model::Block;

    /// Cubes of 1 m in a row along x at these places, the first fixed.
    fn row(places: &[f64]) -> Wall {
        let block = |(i, x): (usize, &f64)| Block {
            support: if i == 0 { Support::Fixed } else { Support::Free },
            ..Block::stone(Polyhedron::cuboid(Vec3::new(*x, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 1.0)), 2400.0)
        };
        Wall { blocks: places.iter().enumerate().map(block).collect() }
    }

    fn surveyed(places: &[f64]) -> Survey {
        let settings = Settings { closed: 1e-6, ..Settings::for_size(1.0, [2, 2]) };
        survey(&row(places), &settings, 0.1).unwrap()
    }

    #[test]
    fn touching_overlapping_and_parted_blocks_are_told_apart_with_their_lengths() {
        // Touching; a gap of half the tolerance; an overlap of 1 mm; a gap of 2 mm; one beyond a tenth of a stone.
        let found = surveyed(&[0.0, 1.0, 2.000_000_5, 2.999_000_5, 4.001_000_5, 5.102]);
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
    fn a_gap_is_told_up_to_a_tenth_of_a_stone_whatever_the_reach() {
        // The reach is 5 mm.
        for gap in [1.6e-3, 4e-3, 6e-3, 0.02, 0.099] {
            let found = surveyed(&[0.0, 1.0 + gap]);
            assert_eq!((found.gaps.len(), found.joints.len()), (1, 0), "{gap}");
            assert!((found.gaps[0].length - gap).abs() < 1e-12, "{:?}", found.gaps);
        }
        assert_eq!(surveyed(&[0.0, 1.101]).gaps, []);
    }

    /// Two courses whose stones see one another over 2 mm of their height, 23 mm apart: no joint was meant there.
    #[test]
    fn faces_that_see_one_another_through_a_slit_have_no_gap() {
        let settings = Settings { touch: 3e-3, ..Settings::for_size(1.0, [2, 2]) };
        let raised = |by: f64| {
            let mut wall = row(&[0.0, 1.023]);
            wall.blocks[1].shape = wall.blocks[1].shape.translated(&Vec3::new(0.0, 0.0, by));
            survey(&wall, &settings, 0.1).unwrap().gaps.len()
        };
        assert_eq!((raised(0.0), raised(0.9), raised(0.998)), (1, 1, 0));
    }

    #[test]
    fn a_gap_that_a_block_fills_is_none() {
        let mut wall = row(&[0.0, 1.02]);
        let shim = Polyhedron::cuboid(Vec3::new(1.0, 0.1, 0.1), Vec3::new(1.02, 0.9, 0.9));
        wall.blocks.push(Block { shape: shim.clone(), ..wall.blocks[1].clone() });
        let found = |wall: &Wall| survey(wall, &Settings::for_size(1.0, [2, 2]), 0.1).unwrap();
        assert_eq!((found(&wall).gaps, found(&wall).joints.len()), (vec![], 2));
        // Beside the gap it fills nothing.
        wall.blocks[2].shape = shim.translated(&Vec3::new(0.0, 1.0, 0.0));
        assert_eq!(found(&wall).gaps.len(), 1);
    }

    #[test]
    fn a_joint_that_leans_open_is_told_with_its_far_side() {
        let mut wall = row(&[0.0, 1.0]);
        for v in wall.blocks[1].shape.vertices.iter_mut().filter(|v| v.z > 0.5) {
            v.x += 3e-3;
        }
        let found = survey(&wall, &Settings::for_size(1.0, [2, 2]), 0.1).unwrap();
        assert_eq!((found.joints.len(), found.gaps.len(), found.gaping.len()), (1, 0, 1));
        // Measured square to the face that leans.
        assert!((found.gaping[0].length - 3e-3).abs() < 1e-5, "{:?}", found.gaping);
    }

    #[test]
    fn parts_of_one_stone_have_no_joint_and_float_or_stand_together() {
        let grouped = |places: &[f64]| {
            let mut wall = row(places);
            wall.blocks[1..3].iter_mut().for_each(|block| block.group = Some("L".to_owned()));
            survey(&wall, &Settings::for_size(1.0, [2, 2]), 0.1).unwrap()
        };
        let found = grouped(&[0.0, 1.0, 2.0]);
        assert_eq!((found.joints.len(), found.shared.len(), found.scattered.len()), (1, 0, 0));
        assert!(found.floating.is_empty());
        let overlapping = grouped(&[0.0, 1.0, 1.75]);
        assert!((overlapping.shared[0].length - 0.25).abs() < 1e-12 && overlapping.overlaps.is_empty());
        let apart = grouped(&[0.0, 1.0, 2.05]);
        assert_eq!((apart.gaps.len(), apart.scattered, apart.floating.len()), (0, vec![1], 0));
        assert_eq!(grouped(&[0.0, 3.0, 4.0]).floating, [vec![1, 2]]);
        // So do those of a support.
        let mut frame = row(&[0.0, 1.0, 2.0]);
        frame.blocks[..2].iter_mut().for_each(|block| {
            (block.group, block.support) = (Some("frame".to_owned()), Support::Fixed);
        });
        let found = survey(&frame, &Settings::for_size(1.0, [2, 2]), 0.1).unwrap();
        assert_eq!((found.joints, found.scattered), (vec![(1, 2)], vec![]));
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
        let found = survey(&wall, &Settings::for_size(1.0, [2, 2]), 0.1).unwrap();
        assert_eq!((found.joints.len(), found.gaps.len()), (0, 0));
    }

    #[test]
    fn a_tangle_is_refused_instead_of_listed() {
        let wall = row(&vec![0.0; 700]);
        assert_eq!(survey(&wall, &Settings::for_size(1.0, [2, 2]), 0.1), None);
    }
}
