//! Walls of surveyed stones: every stone comes as often, and length and height stay together.

use super::*;
use crate::math::Vec3;
use crate::random::Pairs;

fn constant(value: f64) -> Family {
    Family::Constant { value }
}

fn survey(stones: &[[f64; 2]]) -> Sizes {
    Sizes::Together { stones: Pairs::of(stones.to_vec()).expect("stones of finite size") }
}

/// How many standard deviations the most frequent and the rarest of equally likely outcomes lie from their expectation.
fn furthest(counts: &[u32]) -> f64 {
    let (total, share) = (counts.iter().sum::<u32>(), 1.0 / counts.len() as f64);
    let sd = (f64::from(total) * share * (1.0 - share)).sqrt();
    counts.iter().map(|own| (f64::from(*own) - f64::from(total) * share).abs() / sd).fold(0.0, f64::max)
}

#[test]
fn a_cut_takes_length_and_height_from_one_stone() {
    // Long stones are high; no length is another stone's height.
    let stones = [[0.3, 0.12], [0.35, 0.15], [0.4, 0.16], [0.5, 0.24], [0.6, 0.26]];
    let wall = layout(Arrangement::Cut {
        sizes: survey(&stones),
        wall_size_factor: Family::Uniform { low: 0.9, high: 1.1 },
        dip: constant(0.0),
        dip_about: DipAbout::LongAxis,
    });
    let mut seen = [0_u32; 5];
    for number in 0..60 {
        let made = member(&wall, number);
        let factor = made.realised.size_factor;
        let (lengths, heights) = (&made.realised.first_lengths, &made.realised.first_heights);
        assert!(lengths.len() == heights.len() && made.attempts == 1);
        for (length, height) in lengths.iter().zip(heights) {
            let near = |a: f64, b: f64| (a - factor * b).abs() < 1e-12;
            let one = stones.iter().position(|own| near(*length, own[0]) && near(*height, own[1]));
            seen[one.unwrap_or_else(|| panic!("[{length}, {height}] is no stone of the survey"))] += 1;
        }
    }
    assert!(seen.iter().sum::<u32>() > 2000 && furthest(&seen) < 4.0, "{seen:?}");
}

#[test]
fn courses_are_built_of_stones_of_like_height_and_each_comes_as_often() {
    // Two groups of two: the low ones short, the high ones long.
    let stones = [[0.2, 0.1], [0.31, 0.11], [0.53, 0.29], [0.64, 0.3]];
    let mut wall = layout(Arrangement::Coursed {
        sizes: survey(&stones),
        wall_size_factor: constant(1.0),
        dip: constant(0.0),
        least_overlap: 0.0,
    });
    (wall.outline.length, wall.outline.height, wall.head_joint_gap) = (100.0, 2.0, 0.0);
    let mut seen = [0_u32; 4];
    for number in 0..24 {
        let made = member(&wall, number);
        for block in &made.wall.blocks {
            let (low, high) = block.shape.bounds();
            if low.x < 1e-9 || high.x > 100.0 - 1e-9 {
                continue;
            }
            let [length, height] = [Vec3::x(), Vec3::z()].map(|axis| block.shape.width(&axis));
            let one = stones.iter().position(|own| (own[0] - length).abs() < 1e-9);
            let one = one.unwrap_or_else(|| panic!("{length} is no stone's length"));
            // Heights are scaled by one factor, so that the courses fill the wall.
            assert_eq!(one >= 2, height > 0.2, "a stone {length} m long in a course {height} m high");
            seen[one] += 1;
        }
    }
    // The numbers of courses of each kind scatter beside those of the stones in them: a course holds 180 to 400 stones, so
    // that a share of the low courses that is off by chance shifts hundreds of stones. Within a group that does not matter.
    assert!(furthest(&seen[..2]) < 4.0 && furthest(&seen[2..]) < 4.0, "{seen:?}");
    let low = f64::from(seen[0] + seen[1]) / f64::from(seen.iter().sum::<u32>());
    assert!((low - 0.5).abs() < 0.05, "{low} of the stones are low ones, {seen:?}");
}

#[test]
fn walls_of_a_survey_are_a_function_of_seed_and_member() {
    let stones = survey(&[[0.3, 0.12], [0.5, 0.24], [0.4, 0.2]]);
    for mut wall in [coursed(), cut(DipAbout::Both)] {
        let (Arrangement::Coursed { sizes, .. } | Arrangement::Cut { sizes, .. }) = &mut wall.arrangement
        else {
            panic!("a random wall")
        };
        *sizes = stones.clone();
        assert_eq!(member(&wall, 3), member(&wall, 3));
        assert_ne!(member(&wall, 3).wall, member(&wall, 4).wall);
    }
}
