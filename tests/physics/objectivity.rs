//! Frame indifference: the same wall turned and moved gives the same answer, turned and moved.

use nalgebra::Rotation3;
use pirca::generate::canonical;
use pirca::law::Coulomb;
use pirca::math::Vec3;
use pirca::model::Wall;
use pirca::solve::Status;
use pirca::solve::explicit::{Settings, Simulation};

use crate::fixture::{dry, simulation, tilted};

fn tilted_wall<'a>(wall: &Wall, law: &'a Coulomb, gravity: Vec3) -> Simulation<'a> {
    let settings = Settings { unbalanced_ratio: 1e-9, ..Settings::default() };
    let mut simulation = simulation(wall, law, settings, 0.1);
    simulation.assembly.gravity = gravity;
    assert_eq!(simulation.relax(|_| false).0, Status::Equilibrium);
    simulation
}

/// Largest displacement, and largest difference between a wall and the same wall turned by `turn` and moved.
fn compare(law: &Coulomb, tilt_deg: f64, turn: Rotation3<f64>) -> (f64, f64) {
    let wall = canonical::running_bond(4, 3).with_base();
    let turn = turn.into_inner();
    let shift = Vec3::new(3.0, -2.0, 5.0);
    let mut elsewhere = wall.clone();
    for block in &mut elsewhere.blocks {
        block.shape = block.shape.moved(&turn, &shift);
    }
    let here = tilted_wall(&wall, law, tilted(tilt_deg));
    let there = tilted_wall(&elsewhere, law, turn * tilted(tilt_deg));
    let (mut largest, mut difference) = (0.0f64, 0.0f64);
    for (k, (a, b)) in here.assembly.bodies.all.iter().zip(&there.assembly.bodies.all).enumerate() {
        let moved = a.position - wall.blocks[k].shape.mass_properties().centroid;
        let moved_there = b.position - elsewhere.blocks[k].shape.mass_properties().centroid;
        largest = largest.max(moved.norm());
        difference = difference.max((turn * moved - moved_there).norm());
    }
    println!("{tilt_deg} deg: displacement {largest:e}, difference {difference:e}");
    assert!(largest > 1e-5, "the wall must have moved for this to say anything");
    (largest, difference)
}

#[test]
fn a_turned_and_moved_wall_answers_the_same() {
    // Joints that neither open nor slip: the answer does not depend on the path to it.
    let law = Coulomb { tension: 1e9, cohesion: 1e9, ..dry(1e8, 30.0) };
    for turn in [Rotation3::identity(), Rotation3::from_euler_angles(0.7, -0.4, 1.9)] {
        let (largest, difference) = compare(&law, 10.0, turn);
        // Gravity comes at once, and the bounds by which inertia is scaled depend on the axes: the two swing to rest in
        // different ways. Shear is added up along the way, and what differs are squares of turns: 6e-6 of the displacement,
        // whether they stop at 1e-9 or 1e-10 of unbalanced force.
        assert!(difference < 1e-5 * largest, "{difference:e}");
    }
}

#[test]
fn a_turned_and_moved_wall_answers_the_same_where_joints_open() {
    for turn in [Rotation3::identity(), Rotation3::from_euler_angles(0.7, -0.4, 1.9)] {
        let (largest, difference) = compare(&dry(1e8, 30.0), 10.0, turn);
        // The shear that an opening sub-contact forgets depends on the path, on which round-off grows: a mere shift
        // of the wall shows the same difference as a turn.
        assert!(difference < 1e-3 * largest, "{difference:e}");
    }
}
