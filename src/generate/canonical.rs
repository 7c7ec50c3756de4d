//! Walls with known answers: the named scenes of tests, benches and doc examples.

use crate::math::Vec3;
use crate::model::{Block, Wall};
use crate::shape::Polyhedron;

/// Length of a whole stone of the canonical walls, with its share of the head joints (m).
pub const STONE_LENGTH: f64 = 0.2;
/// Course height of the canonical walls (m): nine courses make 0.375 m.
pub const COURSE_HEIGHT: f64 = 0.375 / 9.0;
/// Thickness of the canonical walls (m), the same over the height.
pub const THICKNESS: f64 = 0.114;
/// Width of the open head joints of the canonical walls (m).
pub const HEAD_JOINT_GAP: f64 = 0.001;
/// Density of the canonical walls (kg/m^3).
pub const DENSITY: f64 = 2100.0;

/// The tilt-test wall of 72 stones: 9 courses, each of 7 whole stones and a half one, 1.5 x 0.114 x 0.375 m.
///
/// As a rigid body it topples over its long lower edge at atan(0.114 / 0.375) = 16.91 degrees. Stones only; add
/// the ground with [`Wall::with_base`].
///
/// ```
/// let wall = pirca::generate::canonical::wall_72();
/// assert_eq!(wall.blocks.len(), 72);
/// assert_eq!(wall.with_base().blocks.len(), 73);
/// ```
pub fn wall_72() -> Wall {
    running_bond(9, 7)
}

/// The small scene of the cost-per-block bench: 8 courses of 7 whole stones and a half one, 64 stones.
pub fn wall_64() -> Wall {
    running_bond(8, 7)
}

/// The large scene of the cost-per-block bench: 64 courses of 63 whole stones and a half one, 4096 stones.
pub fn wall_4096() -> Wall {
    running_bond(64, 63)
}

/// A running bond of the canonical stones: each course has `whole` whole stones and one half stone, which lies at
/// the left end (x = 0) in even courses, counted from 0 at the base, and at the right end in odd ones.
///
/// The thickness is centred on y = 0. Head joints are open by [`HEAD_JOINT_GAP`], half of it taken from either
/// stone; the wall's ends are flush. Ids run from the base up, in each course from the left.
pub fn running_bond(courses: usize, whole: usize) -> Wall {
    let mut blocks = Vec::with_capacity(courses * (whole + 1));
    for course in 0..courses {
        let half_left = course % 2 == 0;
        let shift = if half_left { 0.5 } else { 1.0 };
        // In stone lengths, so that joints above one another have the same bits.
        let joint = |i: usize| match i {
            0 => 0.0,
            i if i == whole + 1 => whole as f64 + 0.5,
            i => i as f64 - 1.0 + shift,
        };
        let (bottom, top) = (course as f64 * COURSE_HEIGHT, (course + 1) as f64 * COURSE_HEIGHT);
        for stone in 0..=whole {
            let opening = |end: usize| if end == 0 || end == whole + 1 { 0.0 } else { 0.5 * HEAD_JOINT_GAP };
            let left = joint(stone) * STONE_LENGTH + opening(stone);
            let right = joint(stone + 1) * STONE_LENGTH - opening(stone + 1);
            blocks.push(Block::stone(
                Polyhedron::cuboid(
                    Vec3::new(left, -0.5 * THICKNESS, bottom),
                    Vec3::new(right, 0.5 * THICKNESS, top),
                ),
                DENSITY,
            ));
        }
    }
    Wall { blocks }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Support, Tag};
    use approx::assert_relative_eq;

    #[test]
    fn wall_72_is_the_wall_of_its_description() {
        let wall = wall_72();
        assert_eq!(wall.blocks.len(), 72);
        let (mut low, mut high, mut volume) = (Vec3::repeat(1.0), Vec3::zeros(), 0.0);
        for block in &wall.blocks {
            block.shape.validate(1e-12).unwrap();
            let (a, b) = block.shape.bounds();
            (low, high) = (low.inf(&a), high.sup(&b));
            volume += block.shape.volume();
        }
        // Round-off of sums of a few numbers near 1.
        assert_relative_eq!(low, Vec3::new(0.0, -0.057, 0.0), epsilon = 1e-14);
        assert_relative_eq!(high, Vec3::new(1.5, 0.057, 0.375), epsilon = 1e-14);
        // Nine courses with seven slots of 1 mm each.
        assert_relative_eq!(volume, 0.114 * 0.375 * (1.5 - 7.0 * 0.001), max_relative = 1e-12);
    }

    #[test]
    fn the_half_stone_changes_sides_and_the_slots_are_open() {
        let wall = wall_72();
        let length = |i: usize| wall.blocks[i].shape.width(&Vec3::x());
        // End stones lose half a slot, inner ones a whole one.
        assert_relative_eq!(length(0), 0.1 - 0.0005, epsilon = 1e-14);
        assert_relative_eq!(length(7), 0.2 - 0.0005, epsilon = 1e-14);
        assert_relative_eq!(length(8), 0.2 - 0.0005, epsilon = 1e-14);
        assert_relative_eq!(length(15), 0.1 - 0.0005, epsilon = 1e-14);
        assert_relative_eq!(length(3), 0.2 - 0.001, epsilon = 1e-14);
        let slot = wall.blocks[4].shape.bounds().0.x - wall.blocks[3].shape.bounds().1.x;
        assert_relative_eq!(slot, 0.001, epsilon = 1e-14);
    }

    #[test]
    fn the_bench_walls_have_the_stones_of_their_names() {
        assert_eq!(wall_64().blocks.len(), 64);
        assert_eq!(wall_4096().blocks.len(), 4096);
    }

    #[test]
    fn the_base_lies_under_the_whole_wall() {
        let wall = wall_72().with_base();
        let base = &wall.blocks[72];
        assert_eq!((base.support, &base.tag), (Support::Fixed, &Tag::Base));
        let (low, high) = base.shape.bounds();
        assert_relative_eq!(low, Vec3::new(-0.1, -0.157, -0.1), epsilon = 1e-14);
        assert_relative_eq!(high, Vec3::new(1.6, 0.157, 0.0), epsilon = 1e-14);
        assert_eq!(wall.stones().count(), 72);
    }
}
