//! Limit analysis against known answers: published walls, block on a slope, overhang, wedge.

use pirca::contact;
use pirca::generate::canonical;
use pirca::law::Coulomb;
use pirca::math::{Vec3, asin, atan, cos, degrees, radians, tan};
use pirca::model::{Level, Outcome, Support, Wall};
use pirca::shape::Polyhedron;
use pirca::solve::limit::{Analysis, Cone, Limit, Loads, Settings};

use crate::fixture::{G, dry, on_floor, resting, stone};

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
pub fn ferris_tin_loi(courses: usize) -> Wall {
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

#[test]
fn cohesion_holds_a_block_beyond_its_friction_angle() {
    // Slides when W sin a = c A + W cos a tan phi; with r = c A / W: a = phi + asin(r cos phi). Flat enough not to topple,
    // and its cohesion needs no tension.
    let (phi, area, weight) = (20.0, 0.16, 2400.0 * 0.016 * G);
    let wall = on_floor(vec![resting([0.4, 0.4, 0.1], 2400.0)]);
    for r in [0.2, 0.6, 0.0] {
        let law = Coulomb { cohesion: r * weight / area, ..dry(1e9, phi) };
        let exact = phi + degrees(asin(r * cos(radians(phi))));
        for cone in CONES {
            let limit = analysis(&wall, &law, with(cone)).tilt(Vec3::y(), &[]);
            let angle = degrees(atan(collapse(&limit)));
            println!("r {r} {cone:?}: {:e} off, {} iterations", angle - exact, limit.iterations);
            assert!((angle - exact).abs() < 1e-6, "r {r} {cone:?}: {angle} against {exact}");
        }
    }
}

#[test]
fn tension_holds_a_block_beyond_its_toppling_angle() {
    // Tension T on four corner shares of the base b x b: about the toe W (sin a h / 2 - cos a b / 2) = T A b / 2, so with
    // r = T A / W: h sin a - b cos a = r b. The envelope's apex lies beyond T, and friction is ample.
    let (b, h, r) = (0.2, 0.5, 0.3);
    let weight = 2400.0 * b * b * h * G;
    let law = Coulomb { tension: r * weight / (b * b), cohesion: 100.0 * weight / (b * b), ..dry(1e9, 30.0) };
    let wall = on_floor(vec![resting([b, b, h], 2400.0)]);
    let exact = degrees(atan(b / h) + asin(r * b / (b * b + h * h).sqrt()));
    for cone in CONES {
        let angle = degrees(atan(collapse(&analysis(&wall, &law, with(cone)).tilt(Vec3::y(), &[]))));
        assert!((angle - exact).abs() < 1e-6, "{cone:?}: {angle} against {exact}");
    }
}

/// Blocks of length 1 on a fixed one, each reaching beyond the one below: the k-th from the top by `share` / (2 k).
fn overhang(blocks: usize, share: f64) -> Wall {
    let mut x = 0.0;
    let mut stack = vec![stone(Polyhedron::cuboid(Vec3::zeros(), Vec3::new(1.0, 0.3, 0.2)), 2000.0)];
    stack[0].support = Support::Fixed;
    for level in 1..=blocks {
        x += share / (2.0 * (blocks + 1 - level) as f64);
        let z = 0.2 * level as f64;
        let shape = Polyhedron::cuboid(Vec3::new(x, 0.0, z), Vec3::new(x + 1.0, 0.3, z + 0.2));
        stack.push(stone(shape, 2000.0));
    }
    Wall { blocks: stack }
}

#[test]
fn a_stack_overhangs_by_half_the_harmonic_series() {
    for cone in CONES {
        for blocks in [1, 2, 5, 12] {
            let stands = |share: f64| {
                let wall = overhang(blocks, share);
                analysis(&wall, &dry(1e9, 30.0), with(cone)).stands(&Loads::weight()).stands
            };
            // The whole overhang (1/2)(1 + 1/2 + 1/3 + ...), a hundred-thousandth less and more.
            assert_eq!(stands(1.0 - 1e-5), Some(true), "{blocks} blocks, {cone:?}");
            assert_eq!(stands(1.0 + 1e-5), Some(false), "{blocks} blocks, {cone:?}");
        }
    }
}

/// A wedge with its edge down between two fixed blocks whose faces lean outwards by `half_deg`.
fn wedge(half_deg: f64) -> Wall {
    let (depth, width) = (0.3, 0.3 * tan(radians(half_deg)));
    let at = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    let prism = |lower: [f64; 2], upper: [f64; 2]| {
        let [a, b] = lower;
        let [c, d] = upper;
        Polyhedron::hexahedron([
            at(a, 0.0, 0.0),
            at(b, 0.0, 0.0),
            at(b, 0.2, 0.0),
            at(a, 0.2, 0.0),
            at(c, 0.0, depth),
            at(d, 0.0, depth),
            at(d, 0.2, depth),
            at(c, 0.2, depth),
        ])
    };
    let tip = 0.02;
    let mut blocks = vec![
        stone(prism([-tip, tip], [-tip - width, tip + width]), 2000.0),
        stone(prism([-tip - 0.5, -tip], [-tip - 0.5 - width, -tip - width]), 2000.0),
        stone(prism([tip, tip + 0.5], [tip + width, tip + 0.5 + width]), 2000.0),
    ];
    blocks[1].support = Support::Fixed;
    blocks[2].support = Support::Fixed;
    Wall { blocks }
}

#[test]
fn a_wedge_stays_while_its_half_angle_is_at_most_the_friction_angle() {
    for cone in CONES {
        for (half_deg, locked) in [(10.0, true), (19.99, true), (20.01, false), (30.0, false)] {
            let analysis = analysis(&wedge(half_deg), &dry(1e9, 20.0), with(cone));
            // Head down: its weight pulls it out of the wedge's mouth.
            let out = Loads { dead: Vec3::new(0.0, 0.0, G), ..Loads::default() };
            let standing = analysis.stands(&out);
            assert_eq!(standing.stands, Some(locked), "{half_deg} {cone:?}: {standing:?}");
            // Head up, and pulled: a locked wedge bears any pull, a free one its weight.
            let pulled = Loads { live: Vec3::new(0.0, 0.0, G), ..Loads::weight() };
            let limit = analysis.multiplier(&pulled);
            if locked {
                assert_eq!(limit.outcome, Outcome::Unbounded, "{half_deg} {cone:?}");
            } else {
                assert!((collapse(&limit) - 1.0).abs() < 1e-7);
            }
        }
    }
}

/// A wall of stones of 2 : 1 in running bond, 2 m high and 0.1 m thick: it topples as one at atan(0.1 / 2).
fn tall(courses: usize, stones: usize) -> Wall {
    let height = 2.0 / courses as f64;
    let mut blocks = Vec::new();
    for course in 0..courses {
        let shift = if course % 2 == 0 { 0.0 } else { 0.5 };
        let end = stones as f64;
        let mut joints: Vec<f64> = (0..=stones).map(|i| i as f64 + shift).filter(|x| *x < end).collect();
        if shift > 0.0 {
            joints.insert(0, 0.0);
        }
        joints.push(end);
        for ends in joints.windows(2) {
            let [from, to] = [ends[0], ends[1]].map(|x| 2.0 * height * x);
            let (bottom, top) = (course as f64 * height, (course + 1) as f64 * height);
            let shape = Polyhedron::cuboid(Vec3::new(from, -0.05, bottom), Vec3::new(to, 0.05, top));
            blocks.push(stone(shape, 2000.0));
        }
    }
    on_floor(blocks)
}

#[test]
fn a_great_wall_topples_as_exactly_as_a_small_one() {
    // Of its bending stiffness a wall of n courses has n^4 between its stiffest and its softest shape, and its lowest joints
    // carry n stones: what is lost of ten digits to that must not reach the fourth decimal of a degree.
    for (courses, stones) in [(10, 5), (40, 50), (200, 1)] {
        let wall = tall(courses, stones);
        let limit = analysis(&wall, &dry(1e9, 30.0), Settings::default()).tilt(Vec3::y(), &[]);
        let angle = degrees(atan(collapse(&limit)));
        println!(
            "{} blocks: {angle}, {} iterations, {:?}",
            wall.blocks.len() - 1,
            limit.iterations,
            limit.accuracy
        );
        assert!((angle - degrees(atan(0.05))).abs() < 1e-6, "{courses} courses: {angle}");
    }
}
