//! What holds a block: springs, tensile strength, a support, friction that lasts while contacts are found anew.

use pirca::law::{Coulomb, Sampling};
use pirca::math::{Vec3, cos, radians, sin};
use pirca::model::{Level, Outcome, Support, Wall};
use pirca::protocol::{Ends, Lateral, Protocol, Restraint, run};
use pirca::shape::Polyhedron;
use pirca::solve::explicit::Settings;
use pirca::solve::{Solver, Status};

use crate::fixture::{G, dry, in_time, on_floor, resting, simulation, stone, tilted};

/// A free block of 0.2 x 0.2 x 0.1 m between fixed ones: below a ceiling, or between two side walls.
fn between(fixed: &[(Vec3, Vec3)]) -> Wall {
    let block = Polyhedron::cuboid(Vec3::new(-0.1, -0.1, -0.1), Vec3::new(0.1, 0.1, 0.0));
    let mut blocks = vec![stone(block, 2400.0)];
    for (low, high) in fixed {
        let mut held = stone(Polyhedron::cuboid(*low, *high), 2400.0);
        held.support = Support::Fixed;
        blocks.push(held);
    }
    Wall { blocks }
}

const WEIGHT: f64 = 2400.0 * 0.2 * 0.2 * 0.1 * G;

#[test]
fn a_block_hangs_from_a_joint_with_tensile_strength_until_it_tears() {
    let ceiling = between(&[(Vec3::new(-0.3, -0.3, 0.0), Vec3::new(0.3, 0.3, 0.1))]);
    let pull = WEIGHT / 0.04;
    let settings = Settings { unbalanced_ratio: 1e-7, ..Settings::default() };
    for sampling in [Sampling::Area, Sampling::Vertices] {
        let strong = Coulomb { tension: 3.0 * pull, sampling, ..dry(1e8, 30.0) };
        let mut hanging = simulation(&ceiling, &strong, settings, 0.2);
        assert_eq!(hanging.relax(|_| false).0, Status::Equilibrium);
        let sag = -0.05 - hanging.assembly.bodies.all[0].position.z;
        assert!((sag / (WEIGHT / (1e8 * 0.04)) - 1.0).abs() < 1e-5, "{sag:e}");
        // The first swing of a suddenly hung block pulls less than twice its weight: at 0.9 it tears all the same.
        let weak = Coulomb { tension: 0.9 * pull, sampling, ..dry(1e8, 30.0) };
        let mut falling = simulation(&ceiling, &weak, settings, 0.2);
        let (status, _) = falling.relax(|bodies| bodies.all[0].position.z < -0.1);
        assert_eq!(status, Status::Stopped);
    }
}

#[test]
fn a_torn_joint_does_not_heal_when_the_blocks_meet_again() {
    let ceiling = between(&[(Vec3::new(-0.3, -0.3, 0.0), Vec3::new(0.3, 0.3, 0.1))]);
    let law = Coulomb { tension: 3.0 * WEIGHT / 0.04, ..dry(1e8, 30.0) };
    let mut block = simulation(&ceiling, &law, Settings::default(), 0.2);
    let down = block.assembly.gravity;
    assert_eq!(block.relax(|_| false).0, Status::Equilibrium, "three times its weight holds it");
    block.assembly.gravity = down * 10.0;
    assert_eq!(block.relax(|bodies| bodies.all[0].position.z < -0.06).0, Status::Stopped, "ten times tears");
    block.assembly.gravity = -down;
    assert_eq!(block.relax(|_| false).0, Status::Equilibrium, "pressed against the ceiling from below");
    block.assembly.gravity = down;
    assert_eq!(block.relax(|bodies| bodies.all[0].position.z < -0.06).0, Status::Stopped, "torn for good");
}

#[test]
fn a_dead_load_moves_with_its_block() {
    // A free block without joints, pushed sideways below its centroid for a while: the lever is that of the point as
    // added, however far the block has gone meanwhile and whatever the load factor.
    let law = dry(1e8, 30.0);
    let wall = Wall { blocks: vec![resting([0.2, 0.2, 0.1], 2400.0)] };
    let mut pushed = simulation(&wall, &law, Settings { longest_step: 1e-4, ..in_time(0.5) }, 0.2);
    pushed.assembly.gravity = Vec3::zeros();
    pushed.assembly.add_load(0, Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 10.0, 0.0));
    let body = |s: &pirca::solve::explicit::Simulation| s.assembly.bodies.all[0].clone();
    pushed.step();
    let first = body(&pushed).angular_momentum.x;
    // Force along +y at 0.05 m below the centroid: moment +0.5 N m about x.
    assert!((first - 0.5 * 1e-4).abs() < 1e-12, "{first:e}");
    pushed.assembly.bodies.all[0].position.y += 3.0;
    pushed.assembly.load_factor = 2.0;
    let before = body(&pushed).angular_momentum.x;
    pushed.step();
    // The lever has turned by less than a millionth of a radian.
    assert!((body(&pushed).angular_momentum.x - before - 1.0 * 1e-4).abs() < 1e-10);
}

#[test]
fn a_block_between_joint_springs_sags_by_their_shear() {
    let walls = between(&[
        (Vec3::new(-0.2, -0.2, -0.2), Vec3::new(-0.1, 0.2, 0.1)),
        (Vec3::new(0.1, -0.2, -0.2), Vec3::new(0.2, 0.2, 0.1)),
    ]);
    let springs = Coulomb { bonded: true, ..dry(1e7, 30.0) };
    let settings = Settings { unbalanced_ratio: 1e-7, ..Settings::default() };
    let mut held = simulation(&walls, &springs, settings, 0.2);
    assert_eq!(held.relax(|_| false).0, Status::Equilibrium);
    let sag = -0.05 - held.assembly.bodies.all[0].position.z;
    // Two faces of 0.2 x 0.1 m, ks = kn / 2.
    assert!((sag / (WEIGHT / (2.0 * 0.5e7 * 0.02)) - 1.0).abs() < 1e-5, "{sag:e}");
    // The same joints without attachment carry no normal force, hence no friction: the block falls.
    let loose = dry(1e7, 30.0);
    let mut falling = simulation(&walls, &loose, settings, 0.2);
    assert_eq!(falling.relax(|bodies| bodies.all[0].position.z < -0.1).0, Status::Stopped);
}

#[test]
fn finding_contacts_anew_leaves_a_block_on_a_slope_where_it_is() {
    let law = dry(1e8, 30.0);
    let wall = on_floor(vec![resting([0.4, 0.4, 0.1], 2400.0)]);
    let settings = Settings { unbalanced_ratio: 1e-9, ..Settings::default() };
    let mut resting = simulation(&wall, &law, settings, 0.25);
    resting.assembly.gravity = tilted(20.0);
    assert_eq!(resting.relax(|_| false).0, Status::Equilibrium);
    let before = resting.assembly.bodies.all[0].position;
    for _ in 0..5 {
        resting.refresh();
        assert_eq!(resting.relax(|_| false).0, Status::Equilibrium);
    }
    let moved = (resting.assembly.bodies.all[0].position - before).norm();
    // Without its history the joint would shear by W sin a / (ks A) again, 1e-5 m each time.
    assert!(moved < 1e-11, "{moved:e}");
}

#[test]
fn a_sliding_block_accelerates_as_coulomb_says() {
    let (law, tilt) = (dry(1e8, 20.0), radians(35.0));
    let wall = on_floor(vec![resting([0.2, 0.2, 0.05], 2400.0)]);
    let settings = Settings { longest_step: 1e-5, ..in_time(0.2) };
    let mut sliding = simulation(&wall, &law, settings, 0.15);
    sliding.assembly.gravity = tilted(35.0);
    let speed_after = |sliding: &mut pirca::solve::explicit::Simulation, seconds: f64| {
        for _ in 0..(seconds / sliding.dt) as u32 {
            sliding.step();
        }
        (sliding.assembly.bodies.all[0].velocity.y, sliding.dt * sliding.steps as f64)
    };
    // 20 ms for the shear springs to fill, then 60 ms in which the block slides through many contact searches.
    let (v0, t0) = speed_after(&mut sliding, 0.02);
    let (v1, t1) = speed_after(&mut sliding, 0.06);
    let found = (v1 - v0) / (t1 - t0);
    let exact = G * (sin(tilt) - law.tan_phi * cos(tilt));
    println!("acceleration {found} against {exact}, moved {}", sliding.assembly.bodies.all[0].position.y);
    // The undamped bounce on the bed swings the normal force, and with it the friction, about its mean.
    assert!((found / exact - 1.0).abs() < 0.02, "{found} against {exact}");
}

#[test]
fn ends_hold_a_wall_in_the_order_of_their_stiffness() {
    let wall = pirca::generate::canonical::running_bond(5, 4);
    let law = Coulomb { cohesion: 1e5, ..dry(1e8, 30.0) };
    let lateral = Lateral { mean_pressure: 100.0, base_over_top: 2.0, steps: 3, collapse_share: 0.5 };
    let solver = Solver::Explicit(Settings::default());
    let top = |ends: Ends| {
        let run = run(&wall, &law, &Protocol::Lateral(lateral), &Restraint::at_ends(ends), [2, 2], &solver);
        assert_eq!(run.outcome, Outcome::Equilibrium, "{ends:?}");
        (run.steps.last().expect("steps were taken").top_displacement, run)
    };
    let (free, _) = top(Ends::Free);
    let (blocks, _) = top(Ends::FixedEndBlocks);
    let (plane, in_plane) = top(Ends::OutOfPlane);
    let (springs, _) = top(Ends::JointSprings);
    println!("free {free:e}, end blocks {blocks:e}, out of plane {plane:e}, springs {springs:e}");
    // Springs hold what joints let go; joints hold a little by the cohesion of what still touches.
    assert!(springs < 0.95 * blocks && blocks < 0.95 * free && plane < free);
    // Block 0 stands at the left end, block 2 in the middle of the lowest course.
    assert_eq!(in_plane.displacements[0].y, 0.0);
    assert!(in_plane.displacements[2].y > 0.0);
}

#[test]
fn the_ways_a_wall_ends_are_told_apart() {
    let wall = pirca::generate::canonical::running_bond(4, 3);
    let law = dry(1e8, 30.0);
    let ends_as = |mean_pressure: f64, max_steps: u64| {
        let lateral = Lateral { mean_pressure, base_over_top: 2.0, steps: 4, collapse_share: 0.5 };
        let solver = Solver::Explicit(Settings { max_steps, ..Settings::default() });
        run(&wall, &law, &Protocol::Lateral(lateral), &Restraint::at_ends(Ends::Free), [2, 2], &solver)
    };
    assert_eq!(ends_as(50.0, 100_000).outcome, Outcome::Equilibrium);
    // Toppling of the whole: p H^2 4/9 = W t / 2 per length gives some 1900 Pa; ten times that cannot stand.
    let fallen = ends_as(2e4, 100_000);
    assert_eq!(fallen.outcome, Outcome::Collapsed { at: Level::Factor(0.0) });
    assert_eq!(fallen.bracket, Some([0.0, 0.25]));
    assert!(
        matches!(ends_as(50.0, 20).outcome, Outcome::NotConverged { at, .. } if at == Level::Factor(0.0))
    );
    assert!(
        matches!(ends_as(1e300, 100_000).outcome, Outcome::NonFinite { at } if at == Level::Factor(0.25))
    );
}
