//! Rapier, a game engine's solver of rigid contacts, on the tilting table.
//!
//! Cuboids on a fixed one, gravity turned step by step; at every step the wall moves in time until it is at rest or has
//! collapsed. No bracket narrower than a step is asked of it.

use pirca::math::{Vec3, cos, radians, sin};
use pirca::model::{Support, Wall};
use pirca::solve::STANDARD_GRAVITY;
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{
    ColliderBuilder, FrictionModel, IntegrationParameters, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
    SpringCoefficients,
};

/// How Rapier is run.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Time step (s).
    pub dt: f64,
    /// Solver iterations (substeps) per time step.
    pub iterations: usize,
    /// Natural frequency (Hz) of the contacts; `None` for Rapier's own.
    pub frequency: Option<f64>,
    /// Whether friction acts at each contact point instead of once per face.
    pub coulomb: bool,
}

/// Setups that bring `wall_72` to its limit angle: the fastest one found, and a stiff one. By Rapier's own contacts (30 Hz)
/// the wall sinks and leans until it falls on the level platform, at 1/240 s with 4 and with 20 iterations and at 1 ms with
/// 4. At half the iterations or at twice the time step of the first setup it creeps at every tilt and falls a degree too
/// early.
pub const SETUPS: [(&str, Setup); 2] = [
    ("fast", Setup { dt: 1.0 / 240.0, iterations: 10, frequency: Some(240.0), coulomb: false }),
    ("stiff", Setup { dt: 1.0 / 1000.0, iterations: 16, frequency: Some(2000.0), coulomb: true }),
];

/// Speed (m/s, mean over [`LOOK`]) of the fastest block below which the wall is at rest.
const REST: f64 = 1e-4;
/// Time between two looks at the wall (s).
const LOOK: f64 = 0.05;
/// Longest time at a tilt (s); a wall that still moves by then creeps, and is tilted on.
const LONGEST: f64 = 2.0;
/// A wall one of whose blocks moves by so much (m) at a tilt has collapsed.
const COLLAPSE: f64 = 0.01;

/// How a tilting test went.
#[derive(Clone, Copy, Debug)]
pub struct Tilted {
    /// The first tilt (deg) at which the wall collapsed; infinite if it never did.
    pub collapse_deg: f64,
    /// Largest movement of a block from the level platform to the last tilt borne (m): creep, as nothing is elastic.
    pub crept: f64,
    /// Tilts at which the wall still moved after [`LONGEST`].
    pub restless: u32,
    /// Time simulated (s), and time steps.
    pub time: f64,
    pub steps: u64,
}

/// Tilts a wall of cuboids by steps (deg) towards +y until it collapses.
pub fn tilt(wall: &Wall, tan_phi: f64, step_deg: f64, setup: &Setup) -> Tilted {
    let (mut world, handles) = built(wall, tan_phi, setup);
    let mut tilted = Tilted { collapse_deg: f64::INFINITY, crept: 0.0, restless: 0, time: 0.0, steps: 0 };
    let at_first = places(&world, &handles);
    let most = (89.0 / step_deg) as u32;
    for tilt_deg in (0..=most).map(|k| f64::from(k) * step_deg) {
        let tilt = radians(tilt_deg);
        world.gravity = Vector::new(0.0, sin(tilt), -cos(tilt)) * STANDARD_GRAVITY;
        if let Ended::Collapsed = settle(&mut world, &handles, &mut tilted) {
            tilted.collapse_deg = tilt_deg;
            break;
        }
        tilted.crept = furthest(&at_first, &places(&world, &handles));
    }
    tilted
}

enum Ended {
    Rest,
    Collapsed,
}

/// Lets the wall move until it rests, collapses or has had its time.
fn settle(world: &mut PhysicsWorld, handles: &[RigidBodyHandle], tilted: &mut Tilted) -> Ended {
    let dt = world.integration_parameters.dt;
    let steps_between_looks = (LOOK / dt).round().max(1.0) as u64;
    let looks = (LONGEST / (dt * steps_between_looks as f64)).ceil() as u64;
    let start = places(world, handles);
    let mut before = start.clone();
    for _ in 0..looks {
        for _ in 0..steps_between_looks {
            world.step();
        }
        let time = dt * steps_between_looks as f64;
        tilted.time += time;
        tilted.steps += steps_between_looks;
        let now = places(world, handles);
        if furthest(&start, &now) > COLLAPSE {
            return Ended::Collapsed;
        }
        if furthest(&before, &now) < REST * time {
            return Ended::Rest;
        }
        before = now;
    }
    tilted.restless += 1;
    Ended::Rest
}

fn built(wall: &Wall, tan_phi: f64, setup: &Setup) -> (PhysicsWorld, Vec<RigidBodyHandle>) {
    let mut world = PhysicsWorld::new();
    let own = IntegrationParameters::default();
    let softness = |own| match setup.frequency {
        Some(frequency) => SpringCoefficients::new(frequency, 10.0),
        None => own,
    };
    world.integration_parameters = IntegrationParameters {
        dt: setup.dt,
        num_solver_iterations: setup.iterations,
        contact_softness: softness(own.contact_softness),
        static_contact_softness: softness(own.static_contact_softness),
        friction_model: if setup.coulomb { FrictionModel::Coulomb } else { FrictionModel::Simplified },
        // Tolerances are made for bodies of a metre; these stones are a tenth of that.
        length_unit: 0.1,
        ..own
    };
    let mut handles = Vec::new();
    for block in &wall.blocks {
        let (low, high) = block.shape.bounds();
        let (middle, half): (Vec3, Vec3) = (0.5 * (low + high), 0.5 * (high - low));
        let body = match block.support {
            Support::Fixed => RigidBodyBuilder::fixed(),
            _ => RigidBodyBuilder::dynamic(),
        };
        // Asleep, a body would take no notice of the next tilt.
        let body = body.translation(Vector::new(middle.x, middle.y, middle.z)).can_sleep(false);
        // The two values of a pair are averaged.
        let collider = ColliderBuilder::cuboid(half.x, half.y, half.z)
            .density(block.density)
            .friction(tan_phi)
            .restitution(0.0);
        let (handle, _) = world.insert(body, collider);
        if block.support != Support::Fixed {
            handles.push(handle);
        }
    }
    (world, handles)
}

fn places(world: &PhysicsWorld, handles: &[RigidBodyHandle]) -> Vec<Vector> {
    handles.iter().map(|&handle| world.bodies[handle].translation()).collect()
}

fn furthest(from: &[Vector], to: &[Vector]) -> f64 {
    from.iter().zip(to).map(|(a, b)| (*b - *a).length()).fold(0.0, f64::max)
}
