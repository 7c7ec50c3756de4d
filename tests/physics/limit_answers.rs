//! The answers of limit analysis: typed endings, mechanism, thrust, loads at points, insets and gaps.

use nalgebra::Rotation3;
use pirca::contact;
use pirca::generate::canonical;
use pirca::law::Coulomb;
use pirca::math::{Vec3, radians, tan};
use pirca::model::{JointLaws, Outcome, Support, Wall};
use pirca::shape::Polyhedron;
use pirca::solve::limit::{Analysis, Loads, PointLoad, Settings, When};

use crate::fixture::{G, dry, on_floor, resting, stone};
use crate::limit_known::{CONES, analysis, collapse, with};

const SIZE: [f64; 3] = [0.3, 0.2, 0.5];
const WEIGHT: f64 = 2000.0 * 0.3 * 0.2 * 0.5 * G;

fn tower() -> Wall {
    on_floor(vec![resting(SIZE, 2000.0)])
}

/// A block on the edge of a fixed one, its centroid `out` beyond the edge (m).
fn over_the_edge(out: f64) -> Wall {
    let mut ledge = stone(Polyhedron::cuboid(Vec3::new(-0.2, -0.5, -0.3), Vec3::new(0.2, 0.0, 0.0)), 2000.0);
    ledge.support = Support::Fixed;
    let block = Polyhedron::cuboid(Vec3::new(-0.1, out - 0.2, 0.0), Vec3::new(0.1, out + 0.2, 0.1));
    Wall { blocks: vec![stone(block, 2000.0), ledge] }
}

#[test]
fn a_wall_that_cannot_stand_is_unstable_at_rest() {
    for cone in CONES {
        let falling = analysis(&over_the_edge(0.01), &dry(1e9, 30.0), with(cone));
        let limit = falling.multiplier(&Loads::lateral(Vec3::y()));
        assert_eq!(limit.outcome, Outcome::UnstableAtRest);
        assert_eq!(falling.tilt(Vec3::y(), &[]).outcome, Outcome::UnstableAtRest);
        let standing = falling.stands(&Loads::weight());
        assert_eq!(standing.stands, Some(false));
        assert!(standing.share < 1e-6, "{standing:?}");
        // It turns about the edge y = 0, z = 0 with its far side down: a spin towards -x.
        let motion = standing.mechanism[0];
        assert!(motion.spin.x < -0.1 && motion.velocity.z < 0.0, "{motion:?}");
        // Upside down the other way round: it stands only while it is pushed back, which is not standing.
        assert_eq!(falling.multiplier(&Loads::lateral(-Vec3::y())).outcome, Outcome::UnstableAtRest);
        let resting = analysis(&over_the_edge(-0.01), &dry(1e9, 30.0), with(cone));
        assert_eq!(resting.stands(&Loads::weight()).stands, Some(true));
    }
}

/// No friction on the ledge, much at the stop.
struct SlipperyLedge;

impl JointLaws for SlipperyLedge {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        Coulomb { tan_phi: if a.max(b) == 2 { 1.0 } else { 0.0 }, ..dry(1e9, 30.0) }
    }
}

#[test]
fn a_push_that_makes_a_falling_wall_stand_does_not_make_it_stable_at_rest() {
    // The block over the edge with a rough stop (mu = 1) 0.19 m behind the edge: pushed against the stop by lambda W at height
    // 0.05, with the stop's reaction at its foot, it is held when 0.19 lambda + 0.05 lambda >= 0.01. It stands from
    // lambda = 0.041667 up, and not at 0.
    let mut wall = over_the_edge(0.01);
    let mut stop = stone(Polyhedron::cuboid(Vec3::new(-0.1, -0.4, 0.0), Vec3::new(0.1, -0.19, 0.3)), 2000.0);
    stop.support = Support::Fixed;
    wall.blocks.push(stop);
    let contact = contact::Settings::for_size(0.2, [2, 2]);
    let analysis = Analysis::new(&wall, &SlipperyLedge, contact, Settings::default());
    let pushed = |lambda: f64| {
        let dead = Vec3::new(0.0, -lambda * G, -G);
        analysis.stands(&Loads { dead, ..Loads::default() }).stands
    };
    assert_eq!((pushed(0.0416), pushed(0.0417)), (Some(false), Some(true)));
    assert_eq!(analysis.multiplier(&Loads::lateral(-Vec3::y())).outcome, Outcome::UnstableAtRest);
}

#[test]
fn a_block_in_the_air_bears_nothing() {
    let mut wall = tower();
    wall.blocks[0].shape = wall.blocks[0].shape.translated(&Vec3::new(0.0, 0.0, 0.1));
    let standing = analysis(&wall, &dry(1e9, 30.0), Settings::default()).stands(&Loads::weight());
    assert_eq!((standing.stands, standing.thrust.len()), (Some(false), 0));
}

#[test]
fn what_stands_to_the_end_is_told_from_what_nothing_brings_down() {
    for cone in CONES {
        // Slides at 20 only, which is beyond the end at 10.
        let steep = Coulomb { tan_phi: 20.0, ..dry(1e9, 30.0) };
        let flat = on_floor(vec![resting([2.0, 2.0, 0.05], 2000.0)]);
        let limit = analysis(&flat, &steep, with(cone)).multiplier(&Loads::lateral(Vec3::x()));
        assert_eq!((&limit.outcome, limit.multiplier), (&Outcome::Equilibrium, 10.0));
        let further = Settings { largest_multiplier: 100.0, ..with(cone) };
        let lambda = collapse(&analysis(&flat, &steep, further).multiplier(&Loads::lateral(Vec3::x())));
        assert!((lambda - 20.0).abs() < 1e-6, "{lambda}");
        // Attached: nothing.
        let attached = Coulomb { bonded: true, ..dry(1e9, 30.0) };
        let limit = analysis(&tower(), &attached, with(cone)).multiplier(&Loads::lateral(Vec3::x()));
        assert_eq!(limit.outcome, Outcome::Unbounded);
        assert_eq!(
            analysis(&tower(), &attached, with(cone)).tilt(Vec3::y(), &[]).outcome,
            Outcome::Equilibrium
        );
        // Glued with much cohesion, but not without limit.
        let glued = Coulomb { cohesion: 1e9, tension: 1e9, ..dry(1e9, 30.0) };
        let limit = analysis(&tower(), &glued, with(cone)).multiplier(&Loads::lateral(Vec3::x()));
        assert_eq!(limit.outcome, Outcome::Equilibrium);
    }
}

#[test]
fn a_block_held_out_of_plane_falls_in_its_plane_only() {
    let mut wall = on_floor(vec![resting([0.2, 0.3, 0.5], 2000.0)]);
    wall.blocks[0].support = Support::OutOfPlane;
    for cone in CONES {
        let analysis = analysis(&wall, &dry(1e9, 40.0), with(cone));
        let lambda = collapse(&analysis.multiplier(&Loads::lateral(Vec3::x())));
        assert!((lambda - 0.4).abs() < 1e-8, "{lambda}");
        assert_eq!(analysis.multiplier(&Loads::lateral(Vec3::y())).outcome, Outcome::Unbounded);
    }
}

#[test]
fn a_toppling_block_turns_about_its_toe_and_stands_on_it() {
    for cone in CONES {
        let limit = analysis(&tower(), &dry(1e9, 40.0), with(cone)).multiplier(&Loads::lateral(Vec3::y()));
        let lambda = collapse(&limit);
        let motion = limit.mechanism[0];
        let toe = motion.velocity + motion.spin.cross(&Vec3::new(0.0, 0.1, -0.25));
        // The heel is the fastest contact: 0.2 m from the toe at 1 m/s, a spin of 5 rad/s, towards +y over the top.
        assert!(toe.norm() < 1e-7, "{motion:?}");
        assert!((motion.spin - Vec3::new(-5.0, 0.0, 0.0)).norm() < 1e-6, "{motion:?}");
        assert_eq!(limit.mechanism[1], Default::default());
        // What the base feels, the block being the first of the two: its weight and its push, at the toe.
        let [thrust] = limit.thrust[..] else { panic!("{:?}", limit.thrust) };
        assert_eq!(thrust.blocks, (0, 1));
        assert!((thrust.force - Vec3::new(0.0, lambda, -1.0) * WEIGHT).norm() < 1e-7 * WEIGHT, "{thrust:?}");
        assert!((thrust.at.unwrap() - Vec3::new(0.0, 0.1, 0.0)).norm() < 1e-7, "{thrust:?}");
    }
}

#[test]
fn loads_at_points_count_as_dead_and_as_live() {
    // On top a dead force P = W / 2; at the height a live force of 1 N per unit of multiplier: topples when
    // lambda a = (W + P) b / 2, slides when lambda = mu (W + P).
    let on_top = PointLoad {
        block: 0,
        point: Vec3::new(0.0, 0.0, 0.5),
        force: Vec3::new(0.0, 0.0, -0.5 * WEIGHT),
        when: When::Dead,
    };
    let (mu, settings) = (0.5, Settings { largest_multiplier: 1e4, ..Settings::default() });
    let law = Coulomb { tan_phi: mu, ..dry(1e9, 30.0) };
    for height in [0.05, 0.4] {
        let push =
            PointLoad { block: 0, point: Vec3::new(0.0, 0.0, height), force: Vec3::y(), when: When::Live };
        let loads = Loads { points: vec![on_top, push], ..Loads::weight() };
        let exact = f64::min(1.5 * WEIGHT * 0.1 / height, mu * 1.5 * WEIGHT);
        for cone in CONES {
            let lambda = collapse_scaled(&analysis(&tower(), &law, Settings { cone, ..settings }), &loads);
            assert!((lambda - exact).abs() < 1e-7 * exact, "{height} {cone:?}: {lambda} against {exact}");
        }
    }
}

/// The multiplier of a live load of 1 N, whose gap is that of newtons.
fn collapse_scaled(analysis: &Analysis, loads: &Loads) -> f64 {
    let limit = analysis.multiplier(loads);
    assert!(matches!(limit.outcome, Outcome::Collapsed { .. }), "{:?}", limit.outcome);
    assert!(limit.accuracy.gap.abs() < 1e-7 * limit.multiplier, "{:?}", limit.accuracy);
    limit.multiplier
}

#[test]
fn a_dead_force_on_a_tilted_table_keeps_its_direction_on_the_wall() {
    // Pressed on the table by P: slides when W sin a = mu (W cos a + P), with mu = tan(30): sin(a - 30) = sin(30) P / W.
    // Where P lifts, it carries the block away altogether beyond acos(-P / W).
    let flat = on_floor(vec![resting([0.6, 1.0, 0.05], 2000.0)]);
    for share in [0.5, -0.5] {
        let force = Vec3::new(0.0, 0.0, -WEIGHT * share);
        let press = PointLoad { block: 0, point: Vec3::zeros(), force, when: When::Dead };
        for cone in CONES {
            let lambda = collapse(&analysis(&flat, &dry(1e9, 30.0), with(cone)).tilt(Vec3::y(), &[press]));
            let exact = tan(radians(30.0) + pirca::math::asin(0.5 * share));
            // The bracket on the angle is 2e-9 rad.
            assert!((lambda - exact).abs() < 1e-8, "{cone:?}: {lambda} against {exact}");
        }
    }
}

#[test]
fn a_block_on_its_ridge_or_its_corner_has_no_width_to_stand_on() {
    // For the springs of the other solvers an edge is a strip and a corner a square, on which a block could stand.
    let stands = |about_x: f64, about_y: f64| {
        let turn = Rotation3::from_euler_angles(radians(about_x), radians(about_y), 0.0).into_inner();
        let cube = Polyhedron::cuboid(Vec3::repeat(-0.1), Vec3::repeat(0.1)).moved(&turn, &Vec3::zeros());
        let low = cube.bounds().0.z;
        let wall = on_floor(vec![stone(cube.translated(&Vec3::new(0.0, 0.0, -low)), 2000.0)]);
        // The floor reaches 0.1 m beyond the block.
        analysis(&wall, &dry(1e9, 60.0), Settings::default()).stands(&Loads::weight())
    };
    // Balanced on the ridge within 1e-8 of a right angle's half; a degree off is a fall.
    assert_eq!(stands(45.0, 0.0).stands, Some(true));
    let off = stands(44.0, 0.0);
    assert_eq!((off.stands, off.thrust.len()), (Some(false), 1), "it touches, and falls");
    let corner = stands(45.0, 34.0);
    assert_eq!((corner.stands, corner.thrust.len()), (Some(false), 1), "it touches, and falls");
}

#[test]
fn nothing_that_moves_is_nothing_that_falls() {
    let mut wall = tower();
    wall.blocks[0].support = Support::Fixed;
    let limit = analysis(&wall, &dry(1e9, 30.0), Settings::default()).multiplier(&Loads::lateral(Vec3::y()));
    assert_eq!(limit.outcome, Outcome::Unbounded);
}

#[test]
fn worn_arrises_bring_the_hinge_inwards() {
    for inset in [0.0, 0.008, 0.03] {
        let contact = contact::Settings { inset, ..contact::Settings::for_size(0.2, [2, 2]) };
        let analysis = Analysis::new(&tower(), &dry(1e9, 40.0), contact, Settings::default());
        let lambda = collapse(&analysis.multiplier(&Loads::lateral(Vec3::y())));
        assert!((lambda - (0.2 - 2.0 * inset) / 0.5).abs() < 1e-8, "{inset}: {lambda}");
    }
}

#[test]
fn open_head_joints_are_no_joints() {
    // Seven slots of 1 mm per course: 8 pairs of courses with 15 overlaps each, and 8 stones on the ground; the search
    // for contacts reaches as far as the slots are wide.
    let contact = contact::Settings::for_size(0.25, [2, 2]);
    let wall = canonical::wall_72().with_base();
    let found = |closed: f64| {
        let contact = contact::Settings { closed, ..contact };
        Analysis::new(&wall, &dry(1e9, 40.0), contact, Settings::default()).joints()
    };
    assert_eq!(found(contact.closed), 8 * 15 + 8);
    assert_eq!(found(1.1e-3), 8 * 15 + 8 + 9 * 7);
}

#[test]
fn a_block_that_leans_on_its_toe_stands_on_its_toe() {
    // Turned about its toe until its centroid is beyond it, or not yet: the face has left the floor but for that edge.
    let lean = |degrees: f64| {
        let turn = Rotation3::from_axis_angle(&Vec3::x_axis(), radians(-degrees)).into_inner();
        let toe = Vec3::new(0.0, 0.1, 0.0);
        let mut wall = tower();
        wall.blocks[0].shape = wall.blocks[0].shape.moved(&turn, &(toe - turn * toe));
        analysis(&wall, &dry(1e9, 60.0), Settings::default()).stands(&Loads::weight())
    };
    // Any lean is a fall, for the toe alone bears no moment: the rigid block stands upright or not at all.
    for degrees in [0.1, 5.0, 15.0, 25.0] {
        assert_eq!(lean(degrees).stands, Some(false), "{degrees}");
    }
    assert_eq!(lean(0.0).stands, Some(true));
}
