//! A member is a pure function of layout, seed and member, and no quantity moves the draws of another.

use super::*;
use crate::model::{Block, Tag};
use crate::shape::Polyhedron;

fn shapes(made: &Generated) -> Vec<Polyhedron> {
    made.wall.blocks.iter().map(|b| b.shape.clone()).collect()
}

#[test]
fn the_same_member_is_the_same_wall_and_another_one_is_not() {
    for asked in [coursed(), with_wedges(two_wythes(cut(DipAbout::Both)))] {
        assert_eq!(member(&asked, 5), member(&asked, 5));
        assert_ne!(shapes(&member(&asked, 5)), shapes(&member(&asked, 6)));
        let other_seed = generate(&asked, &Streams::new(8, 5)).unwrap();
        assert_ne!(shapes(&member(&asked, 5)), shapes(&other_seed));
    }
}

#[test]
fn another_density_leaves_every_stone_as_it_was() {
    for asked in [with_wedges(two_wythes(coursed())), with_wedges(cut(DipAbout::Both))] {
        let mut other = asked.clone();
        other.density = Family::Constant { value: 2100.0 };
        for number in 0..20 {
            let (a, b) = (member(&asked, number), member(&other, number));
            assert_eq!(shapes(&a), shapes(&b));
            assert_eq!(a.realised, b.realised);
        }
    }
}

#[test]
fn wedges_switched_on_change_no_other_draw() {
    for asked in [two_wythes(coursed()), cut(DipAbout::LongAxis)] {
        let wedged = with_wedges(asked.clone());
        for number in 0..20 {
            let (without, with) = (member(&asked, number), member(&wedged, number));
            let (a, b) = (&without.realised, &with.realised);
            assert!(b.wedges > 0);
            assert_eq!((&a.dips, &a.lengths, &a.heights), (&b.dips, &b.lengths, &b.heights));
            assert_eq!(a.volume, b.volume);
            let stones: Vec<&Block> = with.wall.blocks.iter().filter(|b| b.tag != Tag::Wedge).collect();
            assert_eq!(stones.len(), without.wall.blocks.len());
            let mut untouched = 0;
            for (old, new) in without.wall.blocks.iter().zip(stones) {
                assert_eq!((old.density, &old.tag), (new.density, &new.tag));
                untouched += u32::from(old.shape == new.shape);
            }
            assert_eq!(untouched + b.wedges, without.wall.blocks.len() as u32);
        }
    }
}

#[test]
fn the_distribution_of_one_quantity_leaves_the_uniforms_of_the_others() {
    let (asked, mut other) = (coursed(), coursed());
    let Arrangement::Coursed { dip, .. } = &mut other.arrangement else { unreachable!() };
    *dip = Family::Constant { value: 0.0 };
    for number in 0..20 {
        let (a, b) = (member(&asked, number).realised, member(&other, number).realised);
        assert_eq!(a.size_factor, b.size_factor);
        assert_eq!(a.heights, b.heights);
        assert_eq!(a.first_lengths[0], b.first_lengths[0]);
        assert!(b.dips.iter().all(|d| *d == 0.0));
    }
}

/// The lengths of the two lowest courses.
fn lowest_courses(made: &Generated, length: f64) -> [Vec<f64>; 2] {
    let (mut courses, mut at) = ([vec![], vec![]], 0.0);
    for stone in &made.realised.lengths {
        let course = if at < length - 1e-6 { 0 } else { 1 };
        if at < 2.0 * length - 1e-6 {
            courses[course].push(*stone);
        }
        at += stone;
    }
    courses
}

#[test]
fn a_redraw_in_one_course_moves_no_other_course() {
    // With a smaller aspect allowed the lowest course is redrawn in many walls; the second one sees no difference in
    // its own first draw unless that very draw is refused as well.
    let (asked, mut strict) = (coursed(), coursed());
    strict.limits.max_aspect = 3.2;
    let (mut redrawn, mut same) = (0, 0);
    for number in 0..40 {
        let (a, b) = (member(&asked, number), generate(&strict, &Streams::new(7, number)));
        let Ok(b) = b else { continue };
        if b.attempts > 1 {
            continue;
        }
        let (a, b) = (lowest_courses(&a, 4.0), lowest_courses(&b, 4.0));
        if a[0] != b[0] {
            redrawn += 1;
            same += u32::from(a[1][0] == b[1][0]);
        }
    }
    assert!(redrawn > 5 && same > redrawn / 4, "{same} of {redrawn}");
}
