//! Limit analysis against known answers: published walls, block on a slope, overhang, wedge.

use pirca::contact;
use pirca::generate::canonical;
use pirca::law::Coulomb;
use pirca::math::{Mat3, Vec3, asin, atan, cos, degrees, radians, sin, tan};
use pirca::model::{Block, Level, Outcome, Support, Tag, Wall};
use pirca::shape::Polyhedron;
use pirca::solve::limit::{Analysis, Cone, Flow, Limit, Loads, Settings};

use crate::fixture::{dry, on_floor, resting, stone};

/// Both representations of the friction cone.
pub const CONES: [Cone; 2] = [Cone::SecondOrder, Cone::Linearised { sides: 8 }];

pub fn with(cone: Cone) -> Settings {
    Settings { cone, ..Settings::default() }
}

pub fn analysis(wall: &Wall, law: &Coulomb, settings: Settings) -> Analysis {
    Analysis::new(wall, law, contact::Settings::for_size(0.2, [2, 2]), settings)
}

/// The multiplier of a wall that collapses, after a look at how accurate it is.
pub fn collapse(limit: &Limit) -> f64 {
    let Outcome::Collapsed { at } = limit.outcome else { panic!("{:?}", limit.outcome) };
    let a = &limit.accuracy;
    // The solver was asked for 1e-10; two digits are left for the sums over a wall.
    assert!(a.residual < 1e-8 && a.excess < 1e-8, "{a:?}");
    assert!(a.gap.abs() < 1e-7 && a.incompatibility < 1e-7, "{a:?}");
    match at {
        Level::Tilt(angle) => {
            assert!((tan(angle) - limit.multiplier).abs() < 1e-12 * limit.multiplier.max(1.0))
        }
        _ => assert_eq!(at.value(), limit.multiplier),
    }
    limit.multiplier
}

/// The dry-joint walls of Ferris and Tin-Loi on a fixed base: stones of 0.4 x 0.175 m, odd courses with half stones at
/// both ends; thickness 0.2 m.
fn ferris_tin_loi(courses: usize) -> Wall {
    let mut blocks = Vec::new();
    for course in 0..courses {
        let lengths: &[f64] =
            if course % 2 == 0 { &[0.2, 0.4, 0.4, 0.4, 0.4, 0.2] } else { &[0.4, 0.4, 0.4, 0.4, 0.4] };
        let (bottom, top) = (0.175 * course as f64, 0.175 * (course + 1) as f64);
        let mut x = 0.0;
        for length in lengths {
            let shape = Polyhedron::cuboid(Vec3::new(x, -0.1, bottom), Vec3::new(x + length, 0.1, top));
            blocks.push(stone(shape, 2000.0));
            x += length;
        }
    }
    on_floor(blocks)
}

#[test]
fn the_walls_of_ferris_and_tin_loi_have_their_multipliers() {
    let law = Coulomb { tan_phi: 0.65, ..dry(1e9, 30.0) };
    for (courses, blocks, published) in [(6, 33, 0.64286), (10, 55, 0.58000)] {
        let wall = ferris_tin_loi(courses);
        assert_eq!(wall.blocks.len(), blocks + 1);
        for cone in CONES {
            let limit = analysis(&wall, &law, with(cone)).multiplier(&Loads::lateral(Vec3::x()));
            let lambda = collapse(&limit);
            println!(
                "{courses} courses, {cone:?}: {lambda:.7}, {} iterations, {:?}",
                limit.iterations, limit.accuracy
            );
            // Five digits are known. In a plane problem the pyramid has an edge along every shear force.
            assert!((lambda - published).abs() < 5e-6, "{courses} courses, {cone:?}: {lambda}");
        }
    }
}

#[test]
fn a_block_on_a_slope_slides_or_topples() {
    // Slides at tan a = mu, topples at tan a = b / h, whichever comes first.
    for (size, mu) in
        [([0.3, 0.4, 0.1], 0.5), ([0.3, 0.2, 0.5], 0.7), ([0.3, 0.3, 0.5], 0.599), ([0.3, 0.3, 0.5], 0.601)]
    {
        let exact: f64 = f64::min(mu, size[1] / size[2]);
        let law = Coulomb { tan_phi: mu, ..dry(1e9, 30.0) };
        let wall = on_floor(vec![resting(size, 2000.0)]);
        for cone in CONES {
            let limit = analysis(&wall, &law, with(cone)).tilt(Vec3::y(), &[]);
            let Outcome::Collapsed { at: Level::Tilt(angle) } = limit.outcome else {
                panic!("{:?}", limit.outcome)
            };
            collapse(&limit);
            println!("{size:?} {mu} {cone:?}: {:e} off", degrees(angle - atan(exact)));
            assert!(degrees(angle - atan(exact)).abs() < 1e-6, "{size:?} {mu} {cone:?}: {}", degrees(angle));
        }
    }
}

#[test]
fn wall_72_topples_out_of_plane_as_one() {
    let wall = canonical::wall_72().with_base();
    for cone in CONES {
        let limit = analysis(&wall, &dry(1e9, 40.0), with(cone)).tilt(Vec3::y(), &[]);
        let angle = degrees(atan(collapse(&limit)));
        println!("{cone:?}: {angle} {:?}", limit.accuracy);
        assert!((angle - degrees(atan(0.114 / 0.375))).abs() < 1e-6, "{angle}");
    }
}
