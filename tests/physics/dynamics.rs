//! Motion in time: free fall, free rotation, a bounce, an oscillation, a collision.

use pirca::law::Coulomb;
use pirca::math::{Mat3, Vec3, cos};
use pirca::model::Wall;
use pirca::shape::Polyhedron;
use pirca::solve::explicit::{Settings, Simulation};

use crate::fixture::{G, dry, in_time, on_floor, resting, simulation, stone};

fn brick() -> Polyhedron {
    Polyhedron::cuboid(Vec3::new(-0.15, -0.1, -0.05), Vec3::new(0.15, 0.1, 0.05))
}

fn free_brick(law: &Coulomb, dt: f64) -> Simulation<'_> {
    let wall = Wall { blocks: vec![stone(brick(), 2400.0)] };
    simulation(&wall, law, Settings { longest_step: dt, ..in_time(0.5) }, 0.2)
}

#[test]
fn free_fall_is_exact() {
    let law = dry(1e8, 30.0);
    let (dt, n) = (1e-3, 1000);
    let mut falling = free_brick(&law, dt);
    let start = falling.assembly.bodies.all[0].position;
    for _ in 0..n {
        falling.step();
    }
    let body = &falling.assembly.bodies.all[0];
    // Central differences from rest at the half step: z = -g dt^2 n (n + 1) / 2, which is g t^2 / 2 half a step later.
    let n = f64::from(n);
    assert!((body.position.z + G * dt * dt * n * (n + 1.0) / 2.0).abs() < 1e-12);
    assert!((body.velocity.z + G * dt * n).abs() < 1e-12);
    assert_eq!((body.position.x, body.position.y), (start.x, start.y));
}

/// Attitude and angular momentum after half a second of free rotation about an axis that is not principal.
fn after_rotation(law: &Coulomb, dt: f64) -> (Mat3, Vec3, Vec3) {
    let mut rotating = free_brick(law, dt);
    rotating.assembly.gravity = Vec3::zeros();
    rotating.assembly.bodies.all[0].set_spin(Vec3::new(3.0, -4.0, 5.0));
    let before = rotating.assembly.bodies.all[0].angular_momentum;
    for _ in 0..(0.5 / dt).round() as u32 {
        rotating.step();
    }
    let body = &rotating.assembly.bodies.all[0];
    (body.rotation, before, body.angular_momentum)
}

#[test]
fn free_rotation_keeps_angular_momentum_and_is_second_order() {
    let law = dry(1e8, 30.0);
    let (reference, before, after) = after_rotation(&law, 1e-5);
    assert_eq!(before, after, "nothing acts on the angular momentum of a free body");
    let error = |dt: f64| (after_rotation(&law, dt).0 - reference).norm();
    let (coarse, fine) = (error(2e-3), error(1e-3));
    println!("attitude error {coarse:e} and {fine:e}");
    // Second order: halving the step divides the error by four, within the next order.
    assert!((3.6..4.4).contains(&(coarse / fine)), "{coarse:e} / {fine:e}");
}

#[test]
fn an_undamped_bounce_keeps_its_energy() {
    let law = dry(1e7, 30.0);
    let mut block = resting([0.3, 0.2, 0.1], 2400.0);
    block.shape = block.shape.translated(&Vec3::new(0.0, 0.0, 5e-3));
    let wall = on_floor(vec![block]);
    let mut bouncing = simulation(&wall, &law, Settings { longest_step: 1e-5, ..in_time(0.02) }, 0.2);
    let mass = bouncing.assembly.bodies.all[0].mass;
    let height = |s: &Simulation| s.assembly.bodies.all[0].position.z - 0.05;
    let start = mass * G * 5e-3;
    let (mut worst, mut lowest, mut last) = (0.0f64, f64::INFINITY, bouncing.assembly.bodies.all[0].velocity);
    let mut rebound = 0.0f64;
    for _ in 0..20_000 {
        // Velocities stand at half steps: the mean of the two around a position belongs to it.
        let (z, stored) =
            (height(&bouncing), bouncing.assembly.joints.closure_energy(&bouncing.assembly.bodies.all));
        bouncing.step();
        let now = bouncing.assembly.bodies.all[0].velocity;
        let kinetic = 0.5 * mass * (0.5 * (last + now)).norm_squared();
        last = now;
        worst = worst.max(((kinetic + mass * G * z + stored) / start - 1.0).abs());
        lowest = lowest.min(z);
        if now.z > 0.0 {
            rebound = rebound.max(height(&bouncing));
        }
    }
    println!("energy error {worst:e}, lowest {lowest:e}, rebound {rebound:e}");
    assert!(lowest < -1e-4, "it must have been pressed");
    assert!(worst < 1e-3, "{worst}");
    assert!((rebound / 5e-3 - 1.0).abs() < 1e-3, "{rebound}");
}

#[test]
fn an_oscillation_converges_at_second_order() {
    // A block set free on its bed at zero closure: z = -w / k (1 - cos(omega t)).
    let (kn, density) = (1e8, 2400.0);
    let law = dry(kn, 30.0);
    let wall = on_floor(vec![resting([0.3, 0.2, 0.1], density)]);
    let mass = density * 0.006;
    let omega = (kn * 0.06 / mass).sqrt();
    let error = |safety: f64| {
        let mut swinging = simulation(&wall, &law, in_time(safety), 0.2);
        let dt = swinging.dt;
        // Start the half step back, so that time zero is at rest.
        swinging.assembly.bodies.all[0].velocity.z = 0.5 * dt * G;
        let mut worst = 0.0f64;
        let mut time = 0.0;
        while time < 4.0 * std::f64::consts::PI / omega {
            swinging.step();
            time += dt;
            let exact = -G / (omega * omega) * (1.0 - cos(omega * time));
            worst = worst.max((swinging.assembly.bodies.all[0].position.z - 0.05 - exact).abs());
        }
        worst / (G / (omega * omega))
    };
    let (coarse, fine) = (error(0.2), error(0.1));
    println!("oscillation error {coarse:e} and {fine:e}");
    assert!((3.5..4.5).contains(&(coarse / fine)), "{coarse:e} / {fine:e}");
}

#[test]
fn a_collision_of_free_blocks_keeps_momentum() {
    let law = dry(1e8, 30.0);
    let other = brick().translated(&Vec3::new(0.32, 0.08, 0.03));
    let wall = Wall { blocks: vec![stone(brick(), 2400.0), stone(other, 1800.0)] };
    let mut free = simulation(&wall, &law, Settings { longest_step: 1e-5, ..in_time(0.1) }, 0.2);
    free.assembly.gravity = Vec3::zeros();
    free.assembly.bodies.all[0].velocity = Vec3::new(2.0, 0.1, 0.0);
    free.assembly.bodies.all[0].set_spin(Vec3::new(0.5, 1.0, -0.7));
    let momenta = |s: &Simulation| {
        let mut linear = Vec3::zeros();
        let mut angular = Vec3::zeros();
        for b in &s.assembly.bodies.all {
            linear += b.velocity * b.mass;
            angular += b.angular_momentum + b.position.cross(&(b.velocity * b.mass));
        }
        (linear, angular)
    };
    let before = momenta(&free);
    for _ in 0..10_000 {
        free.step();
    }
    let after = momenta(&free);
    println!("{before:?} {after:?}");
    assert!(free.assembly.bodies.all[1].velocity.norm() > 0.5, "they must have met");
    assert!((after.0 - before.0).norm() < 1e-12 * before.0.norm());
    // Angular momentum with velocities half a step behind positions: forces act at positions, so the sum is kept
    // to round-off too, for a contact force and its reaction act at the same point.
    assert!((after.1 - before.1).norm() < 1e-10 * before.1.norm());
}
