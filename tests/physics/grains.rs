//! Bodies made of spheres: closed forms of resting, rolling, sliding and bouncing; balances; what must not matter.

use nalgebra::Rotation3;
use pirca::law::Frictional;
use pirca::math::{Vec3, cos, radians, sin, tan};
use pirca::model::Heap;
use pirca::random::Streams;
use pirca::shape::{Ball, Plane};
use pirca::solve::grains::{Settings, Simulation};
use pirca::solve::{STANDARD_GRAVITY as G, Status};

const DENSITY: f64 = 2400.0;

fn material(young: f64, phi_deg: f64) -> Frictional {
    Frictional { young, ks_over_kn: 0.5, phi: radians(phi_deg) }
}

fn ball(x: f64, y: f64, z: f64, radius: f64) -> Ball {
    Ball { centre: Vec3::new(x, y, z), radius }
}

/// Clumps of one material on the floor z = 0.
fn on_floor(clumps: Vec<Vec<Ball>>, material: Frictional) -> Heap {
    Heap::on_ground(clumps, DENSITY, material)
}

fn without_planes(clumps: Vec<Vec<Ball>>, material: Frictional) -> Heap {
    Heap { planes: Vec::new(), ..on_floor(clumps, material) }
}

fn undamped(step_safety: f64) -> Settings {
    Settings { damping: 0.0, step_safety, ..Settings::default() }
}

/// Gravity on a floor that is tilted towards +y.
fn tilted(tilt_deg: f64) -> Vec3 {
    let a = radians(tilt_deg);
    Vec3::new(0.0, G * sin(a), -G * cos(a))
}

/// Weight (N) of a ball.
fn weight(radius: f64) -> f64 {
    ball(0.0, 0.0, 0.0, radius).volume() * DENSITY * G
}

/// Four balls of radius r on the corners of a square: a body that slides or topples as a block does.
fn tile(r: f64, z: f64) -> Vec<Ball> {
    [(-r, -r), (r, -r), (r, r), (-r, r)].map(|(x, y)| ball(x, y, z, r)).to_vec()
}

#[test]
fn a_column_settles_by_the_weight_above_each_contact() {
    let (r, young) = (0.05, 1e7);
    let column = (0..4).map(|k| vec![ball(0.0, 0.0, r * (2.0 * f64::from(k) + 1.0), r)]).collect();
    let mut simulation = Simulation::new(&on_floor(column, material(young, 30.0)), Settings::default());
    assert_eq!(simulation.settle(1e-9, &mut |_| false).status, Status::Equilibrium);
    // kn = E r for equal spheres and for a sphere on a plane; k contacts up the column 4 - k weights rest.
    let (kn, w) = (young * r, weight(r));
    let mut sunk = 0.0;
    for (k, body) in simulation.grains.bodies.iter().enumerate() {
        sunk += f64::from(4 - k as u32) * w / kn;
        let found = r * (2.0 * k as f64 + 1.0) - body.position.z;
        // At rest to 1e-9 of the contact forces.
        assert!((found - sunk).abs() < 1e-7 * sunk, "ball {k}: {found:e} against {sunk:e}");
    }
}

/// Acceleration and angular acceleration of a ball let go on a tilted floor, from its path and its spin after `time`.
fn on_slope(phi_deg: f64, tilt_deg: f64, time: f64) -> (f64, f64) {
    let (r, young) = (0.05, 1e11);
    // Where its weight is borne from the start, so that it does not bounce.
    let z = r - weight(r) * cos(radians(tilt_deg)) / (young * r);
    let heap = on_floor(vec![vec![ball(0.0, 0.0, z, r)]], material(young, phi_deg));
    let mut simulation = Simulation::new(&heap, undamped(0.5));
    simulation.grains.gravity = tilted(tilt_deg);
    while simulation.time < time {
        simulation.step();
    }
    let body = &simulation.grains.bodies[0];
    assert!(body.position.x.abs() < 1e-12, "it must run straight down");
    // Central differences from rest at the half step go a dt^2 n (n + 1) / 2 in n steps.
    let t = simulation.time;
    (body.position.y * 2.0 / (t * (t + simulation.dt)), -body.spin.x / t)
}

#[test]
fn a_ball_rolls_down_at_five_sevenths() {
    let (acceleration, turning) = on_slope(30.0, 10.0, 0.5);
    let expected = 5.0 / 7.0 * G * sin(radians(10.0));
    println!("{acceleration} against {expected}");
    // It swings in the shear spring that it starts without: by F / ks = 3e-10 m of 0.15 m, and in velocity by F over
    // the root of ks m = 1e-5 m/s of 0.6 m/s.
    assert!((acceleration / expected - 1.0).abs() < 1e-6);
    assert!((turning * 0.05 / expected - 1.0).abs() < 1e-4, "{turning}");
}

#[test]
fn a_ball_slips_down_where_friction_cannot_make_it_roll() {
    // Rolling needs tan(phi) >= 2/7 tan(tilt): 5.9 deg at 20.
    let (acceleration, turning) = on_slope(3.0, 20.0, 0.5);
    let (a, mu) = (radians(20.0), tan(radians(3.0)));
    let expected = G * (sin(a) - mu * cos(a));
    println!("{acceleration} against {expected}");
    // Friction is there in full once the ball has slipped by mu N / ks, after 1e-5 s of 0.5 s.
    assert!((acceleration / expected - 1.0).abs() < 1e-5);
    assert!((turning * 0.05 / (2.5 * mu * G * cos(a)) - 1.0).abs() < 5e-5, "{turning}");
}

#[test]
fn a_tile_of_balls_slides_at_its_friction_angle() {
    for (tilt, slides) in [(29.5, false), (30.5, true)] {
        let heap = on_floor(vec![tile(0.05, 0.05)], material(1e8, 30.0));
        let mut simulation = Simulation::new(&heap, Settings::default());
        simulation.grains.gravity = tilted(tilt);
        let ended = simulation.settle(1e-6, &mut |bodies| bodies[0].position.y > 0.01);
        let expected = if slides { Status::Stopped } else { Status::Equilibrium };
        assert_eq!(ended.status, expected, "{tilt} deg: {ended:?}");
    }
}

#[test]
fn a_stuck_ball_swings_in_its_shear_spring() {
    let (r, young) = (0.05, 1e8);
    let z = r - weight(r) / (young * r);
    let heap = on_floor(vec![vec![ball(0.0, 0.0, z, r)]], material(young, 60.0));
    let mut simulation = Simulation::new(&heap, undamped(0.02));
    simulation.grains.bodies[0].velocity.x = 1e-5;
    // The contact point moves with 1/m + r^2/I = 7/(2m) per force: omega^2 = 7 ks / (2 m). Velocity of the point, with the
    // lever that the closure has shortened.
    let mass = simulation.grains.bodies[0].mass;
    let omega = (3.5 * 0.5 * young * r / mass).sqrt();
    let slip = |s: &Simulation| s.grains.bodies[0].velocity.x - s.grains.bodies[0].spin.y * r;
    let (mut turns, mut last, mut first) = (0, slip(&simulation), None);
    while turns < 21 {
        simulation.step();
        let now = slip(&simulation);
        if last > 0.0 && now <= 0.0 {
            let at = simulation.time - simulation.dt * now / (now - last);
            first = first.or(Some(at));
            turns += 1;
            if turns == 21 {
                let period = (at - first.unwrap_or(0.0)) / 20.0;
                let expected = 2.0 * std::f64::consts::PI / omega;
                println!("period {period:e}, closed form {expected:e}");
                // The closure is 1e-5 of the radius; central differences shorten the period by (omega dt)^2 / 24 < 1e-4.
                assert!((period / expected - 1.0).abs() < 2e-4);
            }
        }
        last = now;
    }
}

/// Two balls that meet off centre: energy before and after, largest rise on the way, change of angular momentum.
fn collision(phi_deg: f64, step_safety: f64) -> [f64; 4] {
    let heap = without_planes(
        vec![vec![ball(0.0, 0.0, 0.0, 0.05)], vec![ball(0.105, 0.04, 0.01, 0.06)]],
        material(1e7, phi_deg),
    );
    let mut simulation = Simulation::new(&heap, undamped(step_safety));
    let grains = &mut simulation.grains;
    grains.gravity = Vec3::zeros();
    grains.bodies[0].velocity = Vec3::new(2.0, 0.0, 0.0);
    grains.bodies[1].velocity = Vec3::new(-1.0, 0.3, 0.0);
    grains.bodies[1].set_spin(Vec3::new(3.0, 10.0, -20.0));
    let momentum = |s: &Simulation| {
        s.grains
            .bodies
            .iter()
            .map(|b| b.angular_momentum + b.position.cross(&b.velocity) * b.mass)
            .sum::<Vec3>()
    };
    let (before, turning) = (simulation.grains.kinetic_energy(), momentum(&simulation));
    let (mut touched, mut highest, mut last) = (false, 0.0f64, before);
    while !touched || simulation.grains.contact_count() > 0 {
        simulation.step();
        touched |= simulation.grains.contact_count() > 0;
        // Velocities stand at half steps, stored energy at the step between them.
        let now = simulation.grains.kinetic_energy();
        highest = highest.max(0.5 * (last + now) + simulation.grains.stored_energy());
        last = now;
    }
    let change = (momentum(&simulation) - turning).norm() / turning.norm();
    [before, simulation.grains.kinetic_energy(), highest, change]
}

#[test]
fn a_frictionless_collision_keeps_its_energy() {
    let [before, after, highest, turned] = collision(0.0, 0.02);
    println!("{before} J before, {after} after, {highest} at most; angular momentum changed by {turned:e}");
    // Contact begins and ends between two steps, some thousand of which make up a collision.
    assert!((after / before - 1.0).abs() < 1e-4);
    assert!((highest / before - 1.0).abs() < 1e-4);
    assert!(turned < 1e-12, "{turned:e}");
}

#[test]
fn friction_takes_energy_and_keeps_angular_momentum() {
    let [before, after, highest, turned] = collision(25.0, 0.02);
    println!("{before} J before, {after} after, {highest} at most; angular momentum changed by {turned:e}");
    assert!(after < 0.99 * before, "friction must have taken something");
    assert!(highest < before * (1.0 + 1e-4));
    // The force acts at the same point on both: round-off of the steps of a collision.
    assert!(turned < 1e-12, "{turned:e}");
}

#[test]
fn a_clump_has_the_mass_and_inertia_of_its_balls_and_spins_freely() {
    let r = 0.05;
    let dumb_bell = vec![ball(0.3, 0.1, 0.2, r), ball(0.3 + 3.0 * r, 0.1, 0.2, r)];
    let mut simulation =
        Simulation::new(&without_planes(vec![dumb_bell], material(1e7, 30.0)), undamped(0.5));
    simulation.grains.gravity = Vec3::zeros();
    let body = &mut simulation.grains.bodies[0];
    let m = 4.0 / 3.0 * std::f64::consts::PI * r * r * r * DENSITY;
    assert!((body.mass / (2.0 * m) - 1.0).abs() < 1e-14);
    // 2 x 2/5 m r^2 along, with 2 m (1.5 r)^2 across.
    let expected = Vec3::new(0.8, 5.3, 5.3) * (m * r * r);
    assert!((body.inertia - expected).norm() < 1e-12 * expected.norm(), "{}", body.inertia);
    body.set_spin(Vec3::new(10.0, -4.0, 7.0));
    let before = body.angular_momentum;
    (0..10_000).for_each(|_| simulation.step());
    let body = &simulation.grains.bodies[0];
    assert_eq!(body.angular_momentum, before, "nothing acts on it");
    for (id, now) in simulation.grains.balls() {
        assert_eq!(id, 0);
        // The balls stay where they are in the body: round-off of 10 000 turns, each exactly orthogonal.
        assert!(((now.centre - body.position).norm() - 1.5 * r).abs() < 1e-14);
    }
}

/// Balls and small clumps thrown at random over a square, without overlap: layer above layer.
fn cloud(seed: u64, count: u32) -> Vec<Vec<Ball>> {
    let mut draw = Streams::new(seed, 0).of("cloud of a test");
    let mut uniform = |low: f64, high: f64| low + (high - low) * draw.uniform();
    (0..count)
        .map(|k| {
            let at = |n: u32| 0.12 * f64::from(n) + 0.06;
            let (x, y, z) = (at(k % 3), at(k / 3 % 3), at(k / 9));
            let r = uniform(0.02, 0.03);
            let first = ball(x + uniform(-0.01, 0.01), y + uniform(-0.01, 0.01), z, r);
            let shift = Vec3::new(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)).normalize();
            if k % 2 == 0 {
                vec![first]
            } else {
                vec![first, Ball { centre: first.centre + shift * (1.6 * r), radius: 0.5 * r }]
            }
        })
        .collect()
}

fn fallen(heap: &Heap, gravity: Vec3, settings: Settings, steps: u32) -> Simulation {
    let mut simulation = Simulation::new(heap, settings);
    simulation.grains.gravity = gravity;
    (0..steps).for_each(|_| simulation.step());
    simulation
}

#[test]
fn a_turned_and_moved_heap_answers_the_same() {
    let heap = on_floor(cloud(3, 18), material(1e6, 30.0));
    let turn = Rotation3::from_euler_angles(0.7, -0.4, 1.9).into_inner();
    let shift = Vec3::new(3.0, -2.0, 5.0);
    let mut elsewhere = heap.clone();
    for ball in elsewhere.clumps.iter_mut().flat_map(|c| &mut c.spheres) {
        ball.centre = turn * ball.centre + shift;
    }
    elsewhere.planes = vec![Plane::through(shift, turn * Vec3::z())];
    // Until the first ones have hit the floor and one another: later on every collision magnifies small differences.
    let here = fallen(&heap, tilted(10.0), Settings::default(), 1500);
    let there = fallen(&elsewhere, turn * tilted(10.0), Settings::default(), 1500);
    assert!(here.grains.contact_count() > 6, "{} contacts", here.grains.contact_count());
    let mut worst = 0.0f64;
    for ((a, b), clump) in here.grains.bodies.iter().zip(&there.grains.bodies).zip(&heap.clumps) {
        let difference = (turn * a.position + shift - b.position).norm();
        let own = (clump.spheres[0].centre - a.position).norm();
        assert!(own > 1e-3, "it must have moved for this to say anything");
        worst = worst.max(difference / own);
    }
    println!("largest difference over displacement: {worst:e}");
    // Round-off, magnified by the collisions so far.
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn the_same_heap_gives_the_same_bits_whatever_is_listed() {
    let heap = on_floor(cloud(5, 27), material(1e6, 30.0));
    let bits = |skin_share: f64| {
        let run = fallen(&heap, tilted(5.0), Settings { skin_share, ..Settings::default() }, 3000);
        let of = |v: &Vec3| [v.x, v.y, v.z].map(f64::to_bits);
        let bodies: Vec<_> = run.grains.bodies.iter().map(|b| (of(&b.position), of(&b.spin))).collect();
        assert!(run.grains.contact_count() > 10, "{} contacts", run.grains.contact_count());
        bodies
    };
    let once = bits(0.2);
    assert_eq!(once, bits(0.2), "a repeat");
    // A longer list has more open contacts in it, which add nothing; the time step is the P-wave's with both.
    assert_eq!(once, bits(0.02), "a shorter list, made more often");
    assert_eq!(once, bits(0.4), "a longer list");
}

#[test]
fn a_heap_between_walls_comes_to_rest_in_balance() {
    let mut heap = on_floor(cloud(7, 36), material(1e7, 30.0));
    for (at, normal) in [(0.0, Vec3::x()), (0.36, -Vec3::x()), (0.0, Vec3::y()), (0.36, -Vec3::y())] {
        heap.planes.push(Plane::through(normal.abs() * at, normal));
    }
    let mut simulation = Simulation::new(&heap, Settings::default());
    // Balls that roll are slow to stop: nothing resists rolling.
    let ended = simulation.settle(1e-2, &mut |_| false);
    assert_eq!(ended.status, Status::Equilibrium);
    // Sinks by a good part of the gaps, stays between the walls.
    let highest = simulation.grains.bodies.iter().map(|b| b.position.z).fold(0.0, f64::max);
    println!("{ended:?}, highest {highest}, {} contacts", simulation.grains.contact_count());
    assert!(highest < 0.3);
    for (_, ball) in simulation.grains.balls() {
        for plane in &heap.planes {
            assert!(plane.distance(&ball.centre) > 0.99 * ball.radius, "a ball has gone through a wall");
        }
    }
}
