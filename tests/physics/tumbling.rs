//! Blocks that tumble and meet corner to face and edge to edge.

use nalgebra::Rotation3;
use pirca::math::Vec3;
use pirca::model::{Support, Wall};
use pirca::shape::Polyhedron;
use pirca::solve::Status;
use pirca::solve::explicit::{Settings, Simulation};

use crate::fixture::{dry, on_floor, simulation, stone};

fn cube() -> Polyhedron {
    Polyhedron::cuboid(Vec3::repeat(-0.1), Vec3::repeat(0.1))
}

/// Dropped, damped, in true time, until at rest.
fn settle(simulation: &mut Simulation) -> f64 {
    let mut deepest = 0.0f64;
    for _ in 0..40 {
        for _ in 0..500 {
            simulation.step();
            let low = simulation.assembly.bodies.world_shape(0).bounds().0.z;
            deepest = deepest.min(low);
        }
        if simulation.assembly.unbalanced_ratio() < 1e-3 && simulation.assembly.bodies.kinetic_energy() < 1e-6
        {
            break;
        }
    }
    deepest
}

#[test]
fn a_cube_dropped_on_its_corner_comes_to_rest_on_a_face() {
    let law = dry(1e8, 30.0);
    let turn = Rotation3::from_euler_angles(0.9, 0.5, 0.3).into_inner();
    let shape = cube().moved(&turn, &Vec3::zeros());
    let low = shape.bounds().0.z;
    let shape = shape.translated(&Vec3::new(0.0, 0.0, 0.01 - low));
    let wall = on_floor(vec![stone(shape, 2400.0)]);
    let settings =
        Settings { scaled_inertia: false, longest_step: 1e-4, damping: 0.3, ..Settings::default() };
    let mut falling = simulation(&wall, &law, settings, 0.2);
    let deepest = settle(&mut falling);
    let body = &falling.assembly.bodies.all[0];
    println!("rests at {:?}, deepest {deepest:e}, steps {}", body.position, falling.steps);
    // On a face: its centre is half an edge above the floor, less the closure of the joint (2e-5 m).
    assert!((body.position.z - 0.1).abs() < 1e-3, "{:?}", body.position);
    // A corner touches in a square of 40 mm (1.6e5 N/m): 19 kg falling 10 mm dip about 6 mm into it.
    assert!(deepest > -0.012, "{deepest}");
}

#[test]
fn crossed_ridges_push_each_other_apart_along_their_common_normal() {
    // A fixed ridge along x and a falling one along y meet edge to edge at a point; the upper one bounces straight up.
    let law = dry(1e8, 30.0);
    let about = |axis: Vec3| Rotation3::new(axis * std::f64::consts::FRAC_PI_4).into_inner();
    let half_diagonal = 0.1 * 2f64.sqrt();
    let mut lower = stone(cube().moved(&about(Vec3::x()), &Vec3::zeros()), 2400.0);
    lower.support = Support::Fixed;
    let upper = cube().moved(&about(Vec3::y()), &Vec3::new(0.0, 0.0, 2.0 * half_diagonal + 1e-3));
    let wall = Wall { blocks: vec![stone(upper, 2400.0), lower] };
    let settings = Settings {
        scaled_inertia: false,
        longest_step: 1e-5,
        damping: 0.0,
        step_safety: 0.1,
        ..Settings::default()
    };
    let mut meeting = simulation(&wall, &law, settings, 0.2);
    let start = meeting.assembly.bodies.all[0].position.z;
    let mut highest_after = f64::NEG_INFINITY;
    for _ in 0..60_000 {
        meeting.step();
        let body = &meeting.assembly.bodies.all[0];
        if body.velocity.z > 0.0 {
            highest_after = highest_after.max(body.position.z);
        }
        if body.velocity.z < 0.0 && highest_after > 0.0 {
            break;
        }
    }
    let body = &meeting.assembly.bodies.all[0];
    println!("from {start} back to {highest_after}; {:?}", body.position);
    // Straight up again to where it came from: no energy lost in a linear contact, nothing sideways by symmetry.
    assert!((highest_after - start).abs() < 2e-5, "{highest_after} {start}");
    assert!(body.position.x.abs() < 1e-9 && body.position.y.abs() < 1e-9);
}

#[test]
fn a_cube_balanced_on_an_edge_by_two_supports_stands() {
    // In a V groove of two fixed planes at 45 degrees the cube rests on two faces, its edge down.
    let law = dry(1e8, 30.0);
    let turn = Rotation3::new(Vec3::x() * std::f64::consts::FRAC_PI_4).into_inner();
    let half_diagonal = 0.1 * 2f64.sqrt();
    let resting = cube().moved(&turn, &Vec3::new(0.0, 0.0, half_diagonal));
    let slab = |side: f64| {
        let plain = Polyhedron::cuboid(Vec3::new(-0.3, -0.4, -0.1), Vec3::new(0.3, 0.4, 0.0));
        let lean = Rotation3::new(Vec3::x() * (side * std::f64::consts::FRAC_PI_4)).into_inner();
        let mut block = stone(plain.moved(&lean, &Vec3::zeros()), 2400.0);
        block.support = Support::Fixed;
        block
    };
    let wall = Wall { blocks: vec![stone(resting, 2400.0), slab(1.0), slab(-1.0)] };
    let mut groove = simulation(&wall, &law, Settings::default(), 0.2);
    assert_eq!(groove.relax(|_| false).0, Status::Equilibrium);
    let sunk = half_diagonal - groove.assembly.bodies.all[0].position.z;
    // Each face carries W / sqrt 2 less what friction takes off: between no friction and full stick of ks = kn / 2.
    let weight = groove.assembly.bodies.all[0].mass * crate::fixture::G;
    let area = 0.04;
    let frictionless = weight / (1e8 * area);
    println!("sunk {sunk:e}, frictionless {frictionless:e}");
    // kn cos^2 + ks sin^2 on two faces: sunk = W / (2 A (kn + ks) / 2) = W / (1.5 kn A).
    assert!((sunk / (frictionless / 1.5) - 1.0).abs() < 1e-3, "{sunk:e}");
}
