//! Contact dynamics of rigid blocks against closed forms: sliding, impact, tilting, standing; and its step solvers against one another.

use crate::fixture::{G, dry, irregular, on_floor, resting, stone, tilted};
use pirca::contact;
use pirca::generate::canonical;
use pirca::law::{Coulomb, NormalLaw};
use pirca::math::{Vec3, atan, atan2, degrees, radians, sin, tan};
use pirca::model::Wall;
use pirca::shape::Polyhedron;
use pirca::solve::nonsmooth::{Friction, Normal, Settings, Simulation, StepSolver, Stepped};
use pirca::solve::{Assembly, Equilibrate, Mount, STANDARD_GRAVITY, Status};

/// Standard gravity of the reference numbers (m/s^2).
const ROUND_G: f64 = 9.81;

fn simulation<'a>(wall: &Wall, law: &'a Coulomb, settings: Settings) -> Simulation<'a> {
    Simulation::new(wall, law, settings, contact::Settings::for_size(0.2, [2, 2]))
}

/// A block that slides at 1 m/s on a plane with tan(phi) 0.5: how far it comes (m), how high it hops (m), the worst step.
fn slides(time_step: f64, settings: Settings) -> (f64, f64, f64) {
    let wall = on_floor(vec![resting([0.4, 0.3, 0.2], 2400.0)]);
    let law = dry(1e9, degrees(atan(0.5)));
    let mut moving = simulation(&wall, &law, settings);
    moving.assembly.gravity = Vec3::new(0.0, 0.0, -ROUND_G);
    let from = moving.assembly.bodies.all[0].position;
    moving.assembly.bodies.all[0].velocity = Vec3::y();
    let (mut highest, mut worst) = (0.0f64, 0.0f64);
    for _ in 0..(0.25 / time_step) as u32 {
        let stepped = moving.step(time_step);
        highest = highest.max(moving.assembly.bodies.all[0].position.z - from.z);
        worst = worst.max(stepped.residual.natural_map);
    }
    (moving.assembly.bodies.all[0].position.y - from.y, highest, worst)
}

#[test]
fn a_platform_on_springs_turns_as_it_settles() {
    // Moment of inertia and stiffness in the ratio of mass and stiffness: both motions are the same oscillation.
    let omega = 30.0;
    let wall = on_floor(vec![resting([0.4, 0.3, 0.2], 2400.0)]);
    let law = dry(1e9, 30.0);
    let swings = |settles: bool| -> Vec<f64> {
        let mut assembly = Assembly::new(&wall, &law, contact::Settings::for_size(0.2, [2, 2]));
        let (mass, inertia) = (assembly.bodies.all[1].mass, assembly.bodies.all[1].inertia.x);
        let (settlement, rotation) = (mass * omega * omega, inertia * omega * omega);
        assembly.mount(Mount { body: 1, settlement, rotation }, &[]);
        // The stone is out of the way.
        assembly.gravity = Vec3::zeros();
        assembly.bodies.all[0].velocity = Vec3::z();
        let mut moving = Simulation::of(assembly, Settings::default());
        let platform = |moving: &Simulation<'_>| moving.assembly.bodies.all[1].clone();
        let from = platform(&moving);
        let body = &mut moving.assembly.bodies.all[1];
        if settles {
            body.velocity = -1e-4 * Vec3::z();
        } else {
            body.spin = -1e-4 * Vec3::x();
            body.angular_momentum = inertia * body.spin;
        }
        let mut way = Vec::new();
        for _ in 0..200 {
            moving.step(1e-3);
            let now = platform(&moving);
            let turned = now.rotation * from.rotation.transpose();
            way.push(if settles {
                now.position.z - from.position.z
            } else {
                atan2(turned[(2, 1)], turned[(1, 1)])
            });
        }
        way
    };
    let (settled, turned) = (swings(true), swings(false));
    let most = settled.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    // A period of 0.21 s: the swing is there.
    assert!(most > 0.8e-4 / omega, "{most:e}");
    for (step, (settles, turns)) in settled.iter().zip(&turned).enumerate() {
        // Rounding, and turns of 1e-6.
        assert!((settles - turns).abs() < 1e-5 * most, "{step}: {settles:e} {turns:e}");
    }
}

const STEP_SOLVERS: [StepSolver; 3] = [StepSolver::Newton, StepSolver::ConeProgram, StepSolver::Sweeps];

#[test]
fn a_sliding_block_comes_as_far_as_the_scheme_says_and_does_not_hop() {
    // x = h sum (v0 - k mu g h) of implicit velocities; it stops in the step in which they would change their sign.
    for (time_step, wanted) in [(1e-2, 0.096_995_0), (1e-3, 0.101_437_1)] {
        for solver in STEP_SOLVERS {
            let (way, hop, worst) = slides(time_step, Settings { solver, ..Settings::default() });
            // The last digit given.
            assert!((way - wanted).abs() < 6e-8, "{solver:?} {time_step}: {way}");
            assert!(hop < 1e-9, "{solver:?} {time_step}: {hop:e}");
            // What clarabel gives is accurate to its own tolerance.
            assert!(worst < 3e-8, "{solver:?} {time_step}: {worst:e}");
        }
    }
}

#[test]
fn with_dilatancy_a_sliding_block_hops() {
    // Its first step leaves the plane with mu v0 / (1 + mu^2) (less gravity over the step); a hop of 8.155 mm whatever the step, and what
    // the step adds.
    let settings = Settings { friction: Friction::Dilating, ..Settings::default() };
    for (time_step, wanted) in [(1e-2, 9.33e-3), (1e-3, 8.28e-3)] {
        let (_, hop, _) = slides(time_step, settings);
        assert!((hop - wanted).abs() < 1e-5, "{time_step}: {hop}");
    }
}

/// A block of half sizes `b` and `h` (m) that has just come down on its face, turning at 1 rad/s about one edge: the step of the impact, and its
/// spin and the velocity along the floor of the edge about which it then turns.
fn comes_down(b: f64, h: f64, friction: f64) -> (f64, f64) {
    let wall = on_floor(vec![resting([0.5, 2.0 * b, 2.0 * h], 2400.0)]);
    let law = dry(1e9, degrees(atan(friction)));
    let mut block = simulation(&wall, &law, Settings::default());
    let spin = Vec3::x();
    // About the edge at y = -b: the centroid is b in front of it and h above it.
    let body = &mut block.assembly.bodies.all[0];
    body.velocity = spin.cross(&Vec3::new(0.0, b, h));
    body.set_spin(spin * -1.0);
    body.velocity = -body.velocity;
    // So short that gravity plays no part.
    block.step(1e-7);
    let body = &block.assembly.bodies.all[0];
    let edge = body.velocity + body.spin.cross(&Vec3::new(0.0, b, -h));
    (-body.spin.x, edge.y)
}

#[test]
fn an_impact_keeps_as_much_spin_as_housner_says_where_friction_suffices() {
    for (b, h, kept, friction) in [
        (0.1, 0.5, 0.942_308, 0.148_515),
        (0.2, 0.6, 0.85, 0.243_243),
        (0.25, 1.0, 0.911_765, 0.184_615),
        (0.5, 1.0, 0.70, 0.352_941),
    ] {
        let (spin, slides) = comes_down(b, h, 1.01 * friction);
        // Gravity over 1e-7 s: 1e-6 of the spin.
        assert!((spin - kept).abs() < 3e-6, "{b} {h}: {spin}");
        assert!(slides.abs() < 1e-7, "{b} {h}: {slides:e}");
        // A little less friction, and the edge slides.
        let (_, slides) = comes_down(b, h, 0.97 * friction);
        assert!(slides.abs() > 1e-3, "{b} {h}: {slides:e}");
    }
}

#[test]
fn a_wide_block_stops_dead_at_its_first_impact() {
    for (b, h) in [(0.3, 0.2), (0.5, 0.35)] {
        let (spin, slides) = comes_down(b, h, 2.0);
        assert!(spin.abs() < 1e-5 && slides.abs() < 1e-5, "{b} {h}: {spin:e} {slides:e}");
    }
    // Just narrower than sqrt(2) it goes on.
    assert!(comes_down(0.28, 0.2, 2.0).0 > 5e-3);
}

/// Largest movement of a block between two states (m).
fn moved(simulation: &Simulation<'_>, from: &[Vec3]) -> f64 {
    let bodies = &simulation.assembly.bodies.all;
    bodies.iter().zip(from).map(|(body, from)| (body.position - from).norm()).fold(0.0, f64::max)
}

fn places(simulation: &Simulation<'_>) -> Vec<Vec3> {
    simulation.assembly.bodies.all.iter().map(|body| body.position).collect()
}

#[test]
fn a_wall_stands_for_100_seconds_without_creeping_and_falls_a_sixth_of_a_degree_further() {
    let wall = canonical::wall_72().with_base();
    let law = dry(1e9, 45.0);
    let mut standing = simulation(&wall, &law, Settings::default());
    standing.assembly.gravity = tilted(16.75);
    let from = places(&standing);
    let mut seconds = 0.0;
    while seconds < 100.0 {
        let stepped = standing.step(0.02);
        assert!(stepped.is_solved, "{stepped:?}");
        seconds += 0.02;
    }
    assert!(moved(&standing, &from) < 1e-8, "{:e}", moved(&standing, &from));
    // As a rigid body it topples at atan(0.114 / 0.375) = 16.91 degrees.
    standing.assembly.gravity = tilted(16.92);
    let settled = standing.settle(&mut |bodies| (bodies.all[70].position - from[70]).norm() > 0.02);
    assert_eq!(settled.status, Status::Stopped);
}

#[test]
fn no_step_gains_energy() {
    // A slender block let go from 0.15 rad: it rocks, with impacts on either edge. Its weight times its height is 9.4 kJ.
    let (b, h) = (0.2, 0.6);
    let wall = on_floor(vec![resting([0.5, 2.0 * b, 2.0 * h], 2400.0)]);
    let law = dry(1e9, 60.0);
    let mut rocking = simulation(&wall, &law, Settings::default());
    let from = rocking.assembly.bodies.all[0].clone();
    let angle = 0.15;
    let pivot = Vec3::new(0.0, b, -h);
    let turned = nalgebra::Rotation3::from_axis_angle(&nalgebra::Vector3::x_axis(), -angle);
    rocking.assembly.bodies.all[0].place(
        &from,
        &(pivot - turned * pivot),
        &Vec3::new(-2.0 * tan(0.5 * angle), 0.0, 0.0),
    );
    rocking.refresh();
    let size = from.mass * G * 2.0 * h;
    // Steps of impacts are divided, whatever their length.
    for time_step in [1e-3, 5e-3] {
        let mut rocking = rocking.clone();
        let mut gained: f64 = 0.0;
        for _ in 0..2000 {
            gained = gained.max(rocking.step(time_step).energy_gain);
        }
        assert!(gained < 1e-12 * size, "{time_step}: {gained:e} J of {size:e} J");
    }
    // A wall that falls to pieces.
    let wall = canonical::wall_72().with_base();
    let mut falling = simulation(&wall, &law, Settings::default());
    falling.assembly.gravity = tilted(25.0);
    let mass: f64 =
        falling.assembly.bodies.all.iter().filter(|body| body.moves()).map(|body| body.mass).sum();
    let size = mass * G * 0.375;
    for step in 0..300 {
        let Stepped { energy_gain, is_solved, .. } = falling.step(1e-3);
        assert!(is_solved && energy_gain < 1e-12 * size, "step {step}: {energy_gain:e} J of {size:e} J");
    }
}

#[test]
fn the_three_solvers_of_a_step_agree_on_the_velocities() {
    // Beyond what it bears, the wall begins to move: sliding, opening and sticking joints in one step.
    let wall = irregular(3, 1.0, 0.5);
    let law = dry(1e9, 35.0);
    let after = |solver| {
        let mut one =
            simulation(&wall, &law, Settings { solver, max_iterations: 200, ..Settings::default() });
        one.assembly.gravity = tilted(40.0);
        let stepped = one.step(2e-3);
        assert!(stepped.residual.natural_map < 1e-6, "{solver:?}: {stepped:?}");
        one.assembly.bodies.all.iter().map(|body| body.velocity).collect::<Vec<_>>()
    };
    let [newton, cones, sweeps] = STEP_SOLVERS.map(after);
    let fastest = newton.iter().map(Vec3::norm).fold(0.0, f64::max);
    assert!(fastest > 1e-3, "{fastest}");
    let apart =
        |other: &[Vec3]| newton.iter().zip(other).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max) / fastest;
    // A natural map of 1e-6 of the weight of all is 2e-5 of a stone's, and some ways in which stones move cost hardly any work.
    assert!(apart(&cones) < 5e-2 && apart(&sweeps) < 5e-2, "{:e} {:e}", apart(&cones), apart(&sweeps));
}

#[test]
fn a_compliant_joint_rests_where_its_springs_bear_the_block() {
    let (kn, size) = (1e8, [0.4, 0.3, 0.2]);
    let wall = on_floor(vec![resting(size, 2400.0)]);
    let law = dry(kn, 40.0);
    for solver in STEP_SOLVERS {
        let settings = Settings { normal: Normal::Compliant, solver, ..Settings::default() };
        let mut block = simulation(&wall, &law, settings);
        let from = block.assembly.bodies.all[0].position;
        let tilt = 10.0;
        block.assembly.gravity = tilted(tilt);
        let settled = block.settle(&mut |_| false);
        assert_eq!(settled.status, Status::Equilibrium, "{solver:?}");
        let body = &block.assembly.bodies.all[0];
        let (area, weight) = (size[0] * size[1], size[0] * size[1] * size[2] * 2400.0 * G);
        let (down, along) = (weight * pirca::math::cos(radians(tilt)), weight * sin(radians(tilt)));
        // Sunk by N / (kn A), leant by the moment of the weight about the bed over kn I, and gone along by T / (ks A) and the lean.
        let lean = along * 0.5 * size[2] / (kn * size[0] * (size[1] * size[1] * size[1]) / 12.0);
        let moved = body.position - from;
        // The lean turns the block, a second-order effect of 1e-5 of it; rest is reached at 1e-8 m/s.
        assert!((moved.z + down / (kn * area)).abs() < 1e-3 * down / (kn * area), "{moved}");
        let wanted = along / (0.5 * kn * area) + 0.5 * size[2] * lean;
        assert!((moved.y - wanted).abs() < 2e-3 * wanted, "{} {wanted}", moved.y);
    }
}

#[test]
fn cohesion_holds_a_block_on_a_slope_up_to_its_strength() {
    let size = [0.4, 0.3, 0.2];
    let wall = on_floor(vec![resting(size, 2400.0)]);
    let law = Coulomb { cohesion: 500.0, normal: NormalLaw::Linear { kn: 1e9 }, ..dry(1e9, 10.0) };
    // W sin(a) = c A + W cos(a) tan(phi).
    let weight = size[2] * 2400.0 * G;
    let (mut low, mut high) = (0.0f64, 45.0f64);
    while high - low > 1e-10 {
        let middle = 0.5 * (low + high);
        let a = radians(middle);
        let beyond = weight * sin(a) > 500.0 + weight * pirca::math::cos(a) * tan(radians(10.0));
        if beyond { high = middle } else { low = middle }
    }
    for (tilt, stands) in [(low - 0.01, true), (low + 0.01, false)] {
        let mut block = simulation(&wall, &law, Settings::default());
        block.assembly.gravity = tilted(tilt);
        let from = block.assembly.bodies.all[0].position;
        let settled = block.settle(&mut |bodies| (bodies.all[0].position - from).norm() > 0.01);
        assert_eq!(settled.status == Status::Equilibrium, stands, "{tilt}: {settled:?}");
    }
}

#[test]
fn a_bouncing_block_comes_up_with_its_restitution() {
    let wall = on_floor(vec![resting([0.3, 0.3, 0.3], 2400.0)]);
    let law = dry(1e9, 40.0);
    let settings = Settings { normal: Normal::Velocity { restitution: 0.6 }, ..Settings::default() };
    let mut block = simulation(&wall, &law, settings);
    block.assembly.bodies.all[0].velocity = Vec3::new(0.0, 0.0, -1.0);
    block.step(1e-6);
    // Gravity over 1e-6 s.
    assert!((block.assembly.bodies.all[0].velocity.z - 0.6).abs() < 2e-5);
}

#[test]
fn a_stone_that_is_taken_out_takes_its_contact_points_with_it() {
    // Of two stones side by side the first is taken out; the other, which is longer, keeps its own points and weighs on them.
    let at = |x: [f64; 2]| Polyhedron::cuboid(Vec3::new(x[0], -0.1, 0.0), Vec3::new(x[1], 0.1, 0.2));
    let stones = vec![stone(at([-0.5, -0.3]), 2400.0), stone(at([0.0, 0.6]), 2400.0)];
    let wall = on_floor(stones);
    let law = dry(1e9, 30.0);
    let mut left = simulation(&wall, &law, Settings::default());
    assert_eq!(left.settle(&mut |_| false).status, Status::Equilibrium);
    left.assembly.remove(0);
    let before = places(&left);
    assert_eq!(left.settle(&mut |_| false).status, Status::Equilibrium);
    assert!(moved(&left, &before) < 1e-9, "{:e}", moved(&left, &before));
    let joints = &left.assembly.joints.all;
    let carried = joints[0].carried(&left.assembly.bodies.all);
    // A step's problem is solved to 1e-8 of the weight.
    assert!(
        joints.len() == 1
            && (carried.norm() / (left.assembly.bodies.all[1].mass * STANDARD_GRAVITY) - 1.0).abs() < 1e-7
    );
}

/// Factorisations per step of a wall of so many courses, tilted from upright to a tenth beyond the angle at which it topples as one.
fn factorisations_while_tilted(courses: usize) -> f64 {
    let wall = canonical::running_bond(courses, 4).with_base();
    let law = dry(1e9, 35.0);
    let mut tilting = simulation(&wall, &law, Settings::default());
    let (low, high) = wall.bounds();
    // The wall alone: the base lies below z = 0 and is wider.
    let thickness = 0.114;
    assert!(low.z < 0.0 && high.y - low.y > thickness);
    let topples = degrees(atan(thickness / high.z));
    let (mut all, steps) = (0, 60);
    for step in 0..=steps {
        tilting.assembly.gravity = tilted(1.1 * topples * f64::from(step) / f64::from(steps));
        let stepped = tilting.step_once();
        assert!(stepped.is_solved, "{courses} courses, step {step}: {stepped:?}");
        all += stepped.iterations;
    }
    f64::from(all) / f64::from(steps + 1)
}

#[test]
fn a_wall_four_times_as_high_takes_no_more_factorisations_a_step() {
    // Sweeps would take sixteen times as many (cos^2(pi / 2N) of the error is left by each).
    let [low, middle, high] = [9, 18, 36].map(factorisations_while_tilted);
    println!("{low:.1} {middle:.1} {high:.1} factorisations a step of 9, 18 and 36 courses");
    // Forty are asked; half as many again for the contacts that change in single steps.
    assert!(low.max(middle).max(high) <= 40.0, "{low} {middle} {high}");
    assert!(middle.max(high) <= 1.5 * low, "{low} {middle} {high}");
}

#[test]
fn a_wall_in_which_something_hits_in_most_steps_is_not_divided_without_end() {
    // 72 stones under a sine of 0.42 g and 3.4 Hz: courses lift and come down. One step in 16 may be divided, into five problems more; dividing
    // all would take some six times as many factorisations as the fifteen a step that are found.
    let wall = canonical::wall_72().with_base();
    let law = dry(1e9, 40.0);
    let mut shaken = simulation(&wall, &law, Settings::default());
    let (mut iterations, steps) = (0, 100);
    for step in 0..steps {
        let time = 2e-3 * f64::from(step);
        let pushed = 0.42 * G * sin(2.0 * std::f64::consts::PI * 3.4 * time);
        shaken.assembly.gravity = Vec3::new(0.0, pushed, -G);
        iterations += shaken.step_once().iterations;
    }
    let each = f64::from(iterations) / f64::from(steps);
    assert!(each < 25.0, "{each} factorisations a step");
}
