//! Every block is a stone, none overlap, and together they fill the outline.

use approx::assert_relative_eq;

use super::*;
use crate::math::Vec3;
use crate::model::{Tag, Wall};
use crate::shape::overlap_depth;

/// Faces may be off their plane by the cut tolerance, 1e-9 m, at a few vertices.
const PLANE: f64 = 1e-8;

/// Walls checked per layout: with the twelve layouts below two thousand seeds.
const WALLS: u64 = 170;

fn check_walls(layout: &Layout, seed: u64) {
    let mut stones = 0;
    for number in 0..WALLS {
        let made =
            generate(layout, &Streams::new(seed, number)).unwrap_or_else(|e| panic!("wall {number}: {e}"));
        check_blocks(layout, &made);
        check_fit(&made.wall);
        let volume: f64 = made.wall.blocks.iter().map(|b| b.shape.volume()).sum();
        // Round-off of some hundred cuts, each 1e-16 of the wall, and rarely a vertex moved by 1e-9 m.
        assert_relative_eq!(volume, made.realised.volume, max_relative = 1e-9);
        stones += made.wall.blocks.len();
    }
    assert!(stones as u64 > 15 * WALLS, "{stones} stones in {WALLS} walls are too few to be a test");
}

fn check_blocks(layout: &Layout, made: &Generated) {
    let (limits, outline) = (&layout.limits, &layout.outline);
    for (id, block) in made.wall.blocks.iter().enumerate() {
        block.shape.validate(PLANE).unwrap_or_else(|e| panic!("block {id}: {e}"));
        for v in &block.shape.vertices {
            let [back, front] = outline.faces_at(v.z);
            let inside = v.x >= -PLANE && v.x <= outline.length + PLANE;
            assert!(
                inside && v.y >= back - PLANE && v.y <= front + PLANE && v.z >= -PLANE,
                "block {id}: {v}"
            );
            assert!(v.z <= outline.height + PLANE, "block {id}: {v}");
        }
        if block.tag == Tag::Wedge {
            assert_eq!(
                (block.shape.vertices.len(), block.shape.faces.len()),
                (6, 5),
                "block {id} is no wedge"
            );
            assert!(block.shape.volume() > limits.min_volume);
        } else {
            let width = block.shape.smallest_width();
            assert!(width >= limits.min_size, "block {id} is {width} m thin");
            assert!(block.shape.diameter() / width <= limits.max_aspect, "block {id} is slender");
        }
    }
}

/// No two blocks overlap, by separating axes: the generator itself only cuts and never asks.
fn check_fit(wall: &Wall) {
    let boxes: Vec<(Vec3, Vec3)> = wall.blocks.iter().map(|b| b.shape.bounds()).collect();
    for i in 0..boxes.len() {
        for j in i + 1..boxes.len() {
            let near = (0..3).all(|k| boxes[i].0[k] < boxes[j].1[k] && boxes[j].0[k] < boxes[i].1[k]);
            if near && let Some(depth) = overlap_depth(&wall.blocks[i].shape, &wall.blocks[j].shape, PLANE) {
                panic!("blocks {i} and {j} overlap by {depth:e} m");
            }
        }
    }
}

#[test]
fn regular_walls_are_sound() {
    let stack = layout(Arrangement::Continuous { length: 0.4, height: 0.2 });
    for wall in [stack, with_wedges(two_wythes(discontinuous()))] {
        check_walls(&wall, 1);
    }
}

#[test]
fn coursed_walls_are_sound() {
    check_walls(&coursed(), 2);
    check_walls(&with_wedges(two_wythes(coursed())), 3);
}

#[test]
fn coursed_walls_of_every_section_are_sound() {
    for (seed, face) in [(4, BatteredFace::Back), (5, BatteredFace::Both)] {
        let mut wall = with_wedges(coursed());
        wall.outline.battered_face = face;
        wall.head_joint_gap = 0.0;
        check_walls(&wall, seed);
    }
}

#[test]
fn cut_walls_are_sound() {
    check_walls(&cut(DipAbout::LongAxis), 6);
    check_walls(&cut(DipAbout::Both), 7);
}

#[test]
fn cut_walls_with_everything_are_sound() {
    check_walls(&with_wedges(two_wythes(cut(DipAbout::LongAxis))), 8);
    check_walls(&with_wedges(cut(DipAbout::ThicknessAxis)), 9);
}

#[test]
fn thin_walls_with_steep_beds_are_sound() {
    check_walls(&draws::thin_wall(0.150), 10);
    check_walls(&with_wedges(draws::thin_wall(0.114)), 11);
}

#[test]
fn a_stack_bond_is_what_was_asked_for() {
    let asked = layout(Arrangement::Continuous { length: 0.4, height: 0.2 });
    let made = member(&asked, 0);
    assert_eq!(made.wall.blocks.len(), 10 * 5);
    assert_eq!((made.attempts, made.merges, made.redraws), (1, 0, 0));
    let section = 0.5 * (0.45 + 0.25);
    // Nine slots of 1 mm in every course, through the whole section.
    assert_relative_eq!(made.realised.volume, section * (4.0 - 9.0 * 0.001), max_relative = 1e-12);
    for block in &made.wall.blocks[..10] {
        let (low, high) = block.shape.bounds();
        assert_relative_eq!(high.z, 0.2, epsilon = 1e-12);
        assert_relative_eq!(low.y, -0.225, epsilon = 1e-12);
    }
    // The front leans: 0.2 m of thickness over 1 m of height.
    assert_relative_eq!(made.wall.blocks[49].shape.bounds().1.y, 0.225 - 0.2 * 0.8, epsilon = 1e-12);
}

#[test]
fn a_running_bond_is_shifted_by_its_overlap() {
    for overlap in [0.25, 0.5] {
        let mut asked = layout(Arrangement::Discontinuous { length: 0.4, height: 0.2, overlap });
        asked.head_joint_gap = 0.0;
        let made = member(&asked, 0);
        assert_eq!(made.wall.blocks.len(), 3 * 10 + 2 * 11);
        let joint = |block: usize| made.wall.blocks[block].shape.bounds().1.x;
        assert_relative_eq!(joint(0), 0.4, epsilon = 1e-12);
        assert_relative_eq!(joint(10), 0.4 * overlap, epsilon = 1e-12);
        assert_relative_eq!(joint(11), 0.4 + 0.4 * overlap, epsilon = 1e-12);
        assert_relative_eq!(joint(21), 0.4, epsilon = 1e-12);
    }
}

#[test]
fn an_end_stone_too_short_to_be_one_is_merged_into_its_neighbour() {
    let mut asked = layout(Arrangement::Continuous { length: 0.4, height: 0.2 });
    asked.outline.length = 4.02;
    let made = member(&asked, 0);
    assert_eq!((made.merges, made.wall.blocks.len()), (5, 50));
    let last = made.realised.lengths[9];
    assert_relative_eq!(last, 0.42, epsilon = 1e-12);
    asked.arrangement = Arrangement::Discontinuous { length: 0.4, height: 0.2, overlap: 0.05 };
    let made = member(&asked, 0);
    // Both ends of the two odd courses: 0.02 m at the left, and no rest at the right (4.02 = 0.02 + 10 x 0.4).
    assert_eq!((made.merges, made.wall.blocks.len()), (3 + 2, 50));
    assert_relative_eq!(made.realised.lengths[10], 0.42, epsilon = 1e-12);
}

#[test]
fn wythes_divide_the_thickness_and_headers_do_not() {
    let mut asked = layout(Arrangement::Continuous { length: 0.4, height: 0.2 });
    asked.wythes = Wythes { count: 2, header_share: 0.0 };
    let made = member(&asked, 0);
    assert_eq!((made.wall.blocks.len(), made.realised.headers), (100, 0));
    // The joint of the lowest course lies in the middle of the section at its centroid, a little below 0.1 m.
    let joint = made.wall.blocks[0].shape.bounds().1.y;
    assert!(joint > asked.outline.middle_at(0.1) && joint < asked.outline.middle_at(0.09), "{joint}");
    asked.wythes.header_share = 1.0;
    let made = member(&asked, 0);
    assert_eq!((made.wall.blocks.len(), made.realised.headers), (50, 50));
    assert!(made.wall.blocks.iter().all(|b| b.tag == Tag::Header));
}

#[test]
fn a_wedge_has_its_size_and_sits_under_its_stone_at_a_face() {
    let mut asked = with_wedges(discontinuous());
    asked.head_joint_gap = 0.0;
    asked.outline.top_thickness = 0.45;
    asked.wedges.as_mut().unwrap().share = 1.0;
    let made = member(&asked, 3);
    let blocks = &made.wall.blocks;
    assert_eq!((made.realised.wedges, made.realised.wedges_wanted), (52 - 10, 52 - 10));
    let (mut fronts, mut sizes) = (0, made.realised.wedge_sizes.iter());
    for (id, wedge) in blocks.iter().enumerate().filter(|(_, b)| b.tag == Tag::Wedge) {
        let [height, depth] = *sizes.next().unwrap();
        let ((low, high), (under, _)) = (wedge.shape.bounds(), blocks[id + 1].shape.bounds());
        assert_relative_eq!(high.z - low.z, height, epsilon = 1e-9);
        assert_relative_eq!(high.y - low.y, depth, epsilon = 1e-9);
        assert_relative_eq!(
            wedge.shape.volume(),
            0.5 * height * depth * (high.x - low.x),
            max_relative = 1e-9
        );
        assert_relative_eq!(low.z, under.z, epsilon = 1e-9);
        fronts += u32::from((high.y - 0.225).abs() < 1e-9);
        assert!((high.y - 0.225).abs() < 1e-9 || (low.y + 0.225).abs() < 1e-9);
    }
    // Binomial, n = 42, p = 1/2: five standard deviations are 16.
    assert!((5..38).contains(&fronts), "{fronts} of 42 at the front");
}

#[test]
fn no_stone_of_a_random_course_is_thinner_than_the_limit_at_a_face() {
    for number in 0..100 {
        let asked = coursed();
        for (id, block) in member(&asked, number).wall.blocks.iter().enumerate() {
            for face in 0..2 {
                let on_face = |v: &&Vec3| (v.y - asked.outline.faces_at(v.z)[face]).abs() < 1e-9;
                let levels: Vec<f64> = block.shape.vertices.iter().filter(on_face).map(|v| v.z).collect();
                let low = levels.iter().copied().fold(f64::INFINITY, f64::min);
                let high = levels.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                assert!(
                    high - low >= asked.limits.min_size - 1e-9,
                    "block {id} of wall {number}: {levels:?}"
                );
            }
        }
    }
}

#[test]
fn head_joints_of_neighbouring_courses_keep_their_distance() {
    let asked = coursed();
    for number in 0..100 {
        let realised = member(&asked, number).realised;
        let clear = 0.15 * realised.size_factor * length().mean();
        let (mut below, mut course, mut at) = (vec![], vec![], 0.0);
        for stone in &realised.lengths {
            at += stone;
            if at < asked.outline.length - 1e-9 {
                course.push(at);
                let nearest = below.iter().map(|x: &f64| (x - at).abs()).fold(f64::INFINITY, f64::min);
                // Lengths are differences of joints: summed up again they are off by round-off.
                assert!(nearest > clear - 1e-9, "wall {number}: {nearest} < {clear}");
            } else {
                (below, course, at) = (course, vec![], 0.0);
            }
        }
    }
}
