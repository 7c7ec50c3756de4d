//! Columns of full-width beds with random dips: every sample in closed form, and their distribution.
//!
//! A bed that dips by `d` towards the downhill side slides when the table is tilted by `phi - d`, with all that lies
//! above it: alpha = phi - max d. With n dips uniform in (-D, D), P(alpha <= a) = 1 - ((phi - a + D) / (2 D))^n.

use pirca::math::{Vec3, atan, cos, degrees, pow, radians, sin};
use pirca::model::{Support, Tag, Wall};
use pirca::random::Streams;
use pirca::shape::{Plane, Polyhedron};
use pirca::solve::limit::{Cone, Settings};
use pirca::stats::{ks_p_value, ks_statistic, mean, sigma};

use crate::fixture::{dry, stone};
use crate::limit_known::{CONES, analysis, collapse, with};

const BEDS: usize = 6;
const WIDTH: f64 = 1.0;
const HEIGHT: f64 = 1.2;
const PHI_DEG: f64 = 25.0;
const LARGEST_DIP_DEG: f64 = 5.0;

/// A column of equal courses on a fixed base; each bed, the base's too, dips by so much (rad) towards +y.
fn column(dips: &[f64]) -> Wall {
    let half = 0.5 * WIDTH;
    let mut rest = Polyhedron::cuboid(Vec3::new(-0.5, -half, -0.2), Vec3::new(0.5, half, HEIGHT));
    let mut blocks = Vec::new();
    for (i, &dip) in dips.iter().enumerate() {
        let middle = Vec3::new(0.0, 0.0, HEIGHT * i as f64 / dips.len() as f64);
        let (below, above) = rest.cut(&Plane::through(middle, Vec3::new(0.0, sin(dip), cos(dip))), 1e-9);
        blocks.push(stone(below.expect("the bed crosses the column"), 2000.0));
        rest = above.expect("the bed crosses the column");
    }
    blocks.push(stone(rest, 2000.0));
    blocks[0].support = Support::Fixed;
    blocks[0].tag = Tag::Base;
    Wall { blocks }
}

/// The dips (rad) of a member.
fn dips(member: u64) -> Vec<f64> {
    let mut stream = Streams::new(6, member).of("dip");
    (0..BEDS).map(|_| radians(LARGEST_DIP_DEG) * (2.0 * stream.uniform() - 1.0)).collect()
}

/// Tilt angle (deg) of a column, and its closed form.
fn angles(dips: &[f64], settings: Settings) -> (f64, f64) {
    let limit = analysis(&column(dips), &dry(1e9, PHI_DEG), settings).tilt(Vec3::y(), &[]);
    let steepest = dips.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (degrees(atan(collapse(&limit))), PHI_DEG - degrees(steepest))
}

#[test]
fn the_steepest_bed_slides_first() {
    let hand: [&[f64]; 3] = [&[0.0, 0.0, 0.0], &[-0.05, 0.03, -0.02, 0.08], &[0.06, -0.06]];
    for dips in hand {
        for cone in CONES {
            let (angle, exact) = angles(dips, with(cone));
            assert!((angle - exact).abs() < 1e-6, "{dips:?} {cone:?}: {angle} against {exact}");
        }
    }
}

#[test]
fn a_thousand_random_columns_follow_the_closed_form_one_by_one_and_as_a_whole() {
    let mut found = Vec::new();
    let mut worst: f64 = 0.0;
    for member in 0..1000 {
        let (angle, exact) = angles(&dips(member), with(Cone::SecondOrder));
        // 1e-6 degrees is 2e-8 of the multiplier, of which the solver was asked for 1e-10.
        assert!((angle - exact).abs() < 1e-6, "member {member}: {angle} against {exact}");
        worst = worst.max((angle - exact).abs());
        found.push(angle);
    }
    found.sort_by(f64::total_cmp);
    let spread = 2.0 * LARGEST_DIP_DEG;
    let cdf = |a: f64| 1.0 - pow(((PHI_DEG - a + LARGEST_DIP_DEG) / spread).clamp(0.0, 1.0), BEDS as f64);
    let distance = ks_statistic(&found, cdf);
    let p = ks_p_value(distance, found.len());
    let (m, s) = (mean(&found).unwrap(), sigma(&found).unwrap());
    println!("worst {worst:e} deg; distance {distance:.4}, p {p:.3}; mean {m:.3}, sd {s:.3}");
    assert!(p > 0.01, "distance {distance}, p {p}");
    // Closed form: mean phi - D (n - 1) / (n + 1) = 21.429, sd 2 D sqrt(n / ((n + 1)^2 (n + 2))) = 1.237; three standard
    // errors of 1,000 samples are 0.117 and, for this skewed law, about 0.12.
    assert!((m - 21.429).abs() < 0.117 && (s - 1.237).abs() < 0.12, "mean {m}, sd {s}");
}
