use super::*;
use crate::contact::{Settings, survey};
use crate::math::Vec3;
use crate::model::{Block, Support, Tag};

/// A ground and courses of boxes of 0.5 x 0.3 x 0.2 m in running bond.
fn running_bond(courses: usize) -> Wall {
    let block = |from: [f64; 3], to: [f64; 3]| {
        Block::stone(Polyhedron::cuboid(Vec3::from(from), Vec3::from(to)), 2400.0)
    };
    let ground = block([-0.5, -0.5, -0.2], [2.5, 0.8, 0.0]);
    let mut blocks = vec![Block { support: Support::Fixed, tag: Tag::Base, ..ground }];
    for course in 0..courses {
        let (low, high) = (0.2 * course as f64, 0.2 * (course + 1) as f64);
        let ends: &[f64] =
            if course % 2 == 0 { &[0.0, 0.5, 1.0, 1.5, 2.0] } else { &[0.0, 0.25, 0.75, 1.25, 1.75, 2.0] };
        blocks.extend(ends.windows(2).map(|pair| block([pair[0], 0.0, low], [pair[1], 0.3, high])));
    }
    Wall { blocks }
}

/// The wall with the corners of its stones off by up to `most` (m), and their faces made plane.
fn off(mut wall: Wall, most: f64) -> Wall {
    let mut state = 12345u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        2.0 * ((state >> 11) as f64 / (1u64 << 53) as f64) - 1.0
    };
    for block in wall.blocks.iter_mut().filter(|block| block.support == Support::Free) {
        for corner in &mut block.shape.vertices {
            *corner += Vec3::new(next(), next(), next()) * most;
        }
        let planes: Vec<_> = (0..block.shape.faces.len()).map(|face| block.shape.face_plane(face)).collect();
        block.shape = Polyhedron::behind(&planes, &block.shape.vertices, 1.0, 1e-9).unwrap();
    }
    wall
}

/// The deepest overlap and the number of joints, with those whose faces are not one plane.
fn meets(wall: &Wall) -> (f64, usize, usize) {
    let found = survey(wall, &Settings { closed: 1e-8, ..Settings::for_size(0.3, [2, 2]) }, 0.03).unwrap();
    (found.deepest, found.joints.len(), found.uneven.iter().filter(|pair| pair.length > 1e-9).count())
}

#[test]
fn a_sound_wall_stays_as_it_is_to_the_bit() {
    let wall = running_bond(4);
    let done = mend(&wall, 3e-3).unwrap();
    assert_eq!((done.wall, done.stones.len(), done.moved), (wall, 0, (0, 0.0)));
    assert!(done.parted.is_empty() && done.overlaps.is_empty());
}

#[test]
fn a_wall_whose_corners_are_off_gets_the_joints_of_the_one_that_was_meant() {
    let clean = running_bond(4);
    for (most, within) in [(0.5e-3, 2e-3), (1.5e-3, 4e-3), (3e-3, 8e-3)] {
        let wall = off(clean.clone(), most);
        assert!(meets(&wall).2 > 10, "{:?}", meets(&wall));
        let done = mend(&wall, within).unwrap();
        let (deepest, joints, uneven) = meets(&done.wall);
        assert!(deepest < 1e-9 && uneven == 0, "{deepest:e} {uneven}");
        assert!(joints >= meets(&clean).1, "{joints}");
        assert!(done.parted.is_empty() && done.overlaps.is_empty());
        assert_eq!((done.stones.len(), done.faces), (18, 6 * 18));
        assert!(done.moved.0 > 80 && done.moved.1 <= within, "{:?}", done.moved);
        assert!(done.stones.iter().all(|own| own.moved_m < 2.0 * within && own.volume_share.abs() < 0.05));
        assert!(done.volume_share.abs() < 0.01, "{}", done.volume_share);
    }
}

#[test]
fn fixed_blocks_stay_and_what_stands_on_them_takes_their_plane() {
    let wall = off(running_bond(2), 1.5e-3);
    let done = mend(&wall, 4e-3).unwrap();
    assert_eq!(done.wall.blocks[0], wall.blocks[0]);
    for block in &done.wall.blocks[1..5] {
        assert!(block.shape.bounds().0.z.abs() < 1e-12);
    }
}

#[test]
fn a_gap_wider_than_the_length_stays_and_a_narrower_one_closes() {
    for (gap, closes) in [(2e-3, true), (4e-3, false)] {
        let mut wall = running_bond(1);
        wall.blocks.truncate(3);
        wall.blocks[2].shift(&Vec3::new(gap, 0.0, 0.0));
        let done = mend(&wall, 3e-3).unwrap();
        let [left, right] = [1, 2].map(|block: usize| done.wall.blocks[block].shape.bounds());
        let now = right.0.x - left.1.x;
        assert!((now - if closes { 0.0 } else { gap }).abs() < 1e-12, "{now}");
    }
}

#[test]
fn an_overlap_is_shared_out_between_two_stones() {
    let mut wall = running_bond(1);
    wall.blocks.truncate(3);
    wall.blocks[2].shift(&Vec3::new(-2e-3, 0.0, 0.0));
    let done = mend(&wall, 3e-3).unwrap();
    let [left, right] = [1, 2].map(|block: usize| done.wall.blocks[block].shape.bounds());
    assert!((left.1.x - 0.499).abs() < 1e-12 && (right.0.x - 0.499).abs() < 1e-12, "{left:?} {right:?}");
}

/// A corner that reaches into a neighbour's face, which no face of its own looks at.
#[test]
fn a_corner_that_reaches_into_a_neighbour_is_cut_off() {
    let mut wall = running_bond(1);
    wall.blocks.truncate(3);
    let turned = nalgebra::Rotation3::from_axis_angle(&Vec3::z_axis(), 0.8).into_inner();
    let right = Polyhedron::cuboid(Vec3::zeros(), Vec3::new(0.3, 0.3, 0.2)).moved(&turned, &Vec3::zeros());
    let reach = -right.bounds().0.x;
    wall.blocks[2].shape = right.translated(&Vec3::new(0.5 + reach - 1e-3, 0.0, 0.0));
    let done = mend(&wall, 3e-3).unwrap();
    assert!(done.overlaps.is_empty());
    assert_eq!(done.wall.blocks[1].shape, wall.blocks[1].shape);
    assert_eq!(done.wall.blocks[2].shape.faces.len(), 7);
    assert!((done.wall.blocks[2].shape.bounds().0.x - 0.5).abs() < 1e-12);
}

/// Beds that together bend by more than the length have no common plane: what is left apart is said.
#[test]
fn a_bent_bed_is_not_made_one_plane() {
    let mut wall = running_bond(2);
    for corner in wall.blocks[1..].iter_mut().flat_map(|block| &mut block.shape.vertices) {
        if (corner.z - 0.2).abs() < 1e-9 {
            corner.z += 0.04 * (corner.x - 1.0) * (corner.x - 1.0);
        }
    }
    let done = mend(&wall, 3e-3).unwrap();
    assert!(!done.parted.is_empty());
    assert!(done.moved.1 <= 3e-3);
    assert!(done.stones.iter().all(|own| own.moved_m < 0.02));
}

#[test]
fn a_wall_far_from_the_origin_is_mended_like_one_at_it() {
    let wall = off(running_bond(3), 1.5e-3);
    let mut far = wall.clone();
    let by = Vec3::new(4.0e5, -2.0e5, 1.0e3);
    far.blocks.iter_mut().for_each(|block| block.shift(&by));
    let (near, far) = (mend(&wall, 4e-3).unwrap(), mend(&far, 4e-3).unwrap());
    assert_eq!(near.moved.0, far.moved.0);
    assert!((near.volume_share - far.volume_share).abs() < 1e-6);
}
