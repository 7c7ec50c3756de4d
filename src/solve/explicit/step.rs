//! The time loop.

use crate::contact;
use crate::math::Vec3;
use crate::model::{JointLaws, Wall};
use crate::solve::bodies::{Bodies, Body};
use crate::solve::explicit::{Settings, critical};
use crate::solve::joints::Joints;

/// Steps between two looks at the unbalanced force ratio.
const STEPS_BETWEEN_LOOKS: u64 = 10;

/// How a relaxation ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Status {
    /// The unbalanced force ratio fell below its limit.
    Equilibrium,
    /// The caller's criterion stopped it.
    Stopped,
    /// The steps ran out.
    StepsSpent,
    /// A position became NaN or infinite.
    NonFinite,
}

/// A dead load: a force of fixed direction at a point that moves with a body.
#[derive(Clone, Copy, Debug)]
struct DeadLoad {
    body: usize,
    /// In the body's axes, from its centroid (m).
    lever: Vec3,
    force: Vec3,
}

/// Blocks, joints and loads, stepped in time.
#[derive(Clone)]
pub struct Simulation<'a> {
    /// The bodies, by block id.
    pub bodies: Bodies,
    /// The joints.
    pub joints: Joints,
    /// Gravity (m/s^2).
    pub gravity: Vec3,
    /// Time step (s); with scaled inertia its length has no meaning and it is 1.
    pub dt: f64,
    /// Factor on all dead loads; 1 unless it is changed.
    pub load_factor: f64,
    /// Steps taken since the start.
    pub steps: u64,
    laws: &'a dyn JointLaws,
    settings: Settings,
    contact: contact::Settings,
    loads: Vec<DeadLoad>,
    /// Length of the step that led to the positions now (s); 0 before the first one.
    last_dt: f64,
    /// Where each body was when contacts were last looked for.
    seen: Vec<(Vec3, crate::math::Mat3)>,
}

impl<'a> Simulation<'a> {
    /// Blocks at rest in the positions of the wall, under gravity along -z.
    pub fn new(wall: &Wall, laws: &'a dyn JointLaws, settings: Settings, contact: contact::Settings) -> Self {
        let mut simulation = Simulation {
            bodies: Bodies::from_wall(wall),
            joints: Joints::default(),
            gravity: Vec3::new(0.0, 0.0, -STANDARD_GRAVITY),
            dt: 1.0,
            load_factor: 1.0,
            steps: 0,
            laws,
            settings,
            contact,
            loads: Vec::new(),
            last_dt: 0.0,
            seen: Vec::new(),
        };
        simulation.refresh();
        simulation
    }

    /// Adds a force (N), at load factor 1, of fixed direction at a world point (m) that from now on moves with the block.
    pub fn add_load(&mut self, body: usize, point: Vec3, force: Vec3) {
        let b = &self.bodies.all[body];
        let lever = b.rotation.tr_mul(&(point - b.position));
        self.loads.push(DeadLoad { body, lever, force });
    }

    /// Steps until the unbalanced force ratio is small, `stop` says so, the steps are spent or the numbers go bad.
    pub fn relax(&mut self, mut stop: impl FnMut(&Bodies) -> bool) -> (Status, f64) {
        let mut ratio = f64::INFINITY;
        for step in 1..=self.settings.max_steps {
            self.step();
            if step % STEPS_BETWEEN_LOOKS == 0 || step == self.settings.max_steps {
                if !self.is_finite() {
                    return (Status::NonFinite, f64::NAN);
                }
                ratio = self.unbalanced_ratio();
                if ratio < self.settings.unbalanced_ratio {
                    return (Status::Equilibrium, ratio);
                }
                if stop(&self.bodies) {
                    return (Status::Stopped, ratio);
                }
            }
        }
        (Status::StepsSpent, ratio)
    }

    /// One time step: forces at the positions now, then velocities at the half step, then new positions.
    pub fn step(&mut self) {
        self.sum_forces();
        for body in &mut self.bodies.all {
            body.advance(self.dt, self.settings.damping);
        }
        self.last_dt = self.dt;
        self.steps += 1;
        if self.has_moved() {
            self.refresh();
        }
    }

    fn sum_forces(&mut self) {
        for body in &mut self.bodies.all {
            body.force = self.gravity * body.mass;
            body.torque = Vec3::zeros();
        }
        for load in &self.loads {
            let body = &mut self.bodies.all[load.body];
            let force = load.force * self.load_factor;
            body.force += force;
            body.torque += (body.rotation * load.lever).cross(&force);
        }
        self.joints.apply(&mut self.bodies.all, self.last_dt);
    }

    fn is_finite(&self) -> bool {
        self.bodies.all.iter().all(|b| (b.position.sum() + b.force.sum() + b.torque.sum()).is_finite())
    }

    /// Mean unbalanced force of the blocks that move over the mean force of the joints that carry, after the forces
    /// of the last step (YADE's definition); an unbalanced moment counts as a force at the radius of gyration. 1 when no joint
    /// carries.
    pub fn unbalanced_ratio(&self) -> f64 {
        let (mut unbalanced, mut moving) = (0.0, 0u32);
        for body in self.bodies.all.iter().filter(|b| b.moves()) {
            let gyration = (0.5 * body.inertia.sum() / body.mass).sqrt();
            unbalanced += body.force.norm() + body.torque.norm() / gyration;
            moving += 1;
        }
        let (mut carried, mut carrying) = (0.0, 0u32);
        for joint in self.joints.all.iter().filter(|j| j.force > 0.0) {
            carried += joint.force;
            carrying += 1;
        }
        match (moving, carrying) {
            (0, _) => 0.0,
            (_, 0) => 1.0,
            _ => (unbalanced / f64::from(moving)) / (carried / f64::from(carrying)),
        }
    }

    /// Whether a block has moved so far that a new joint might exist: half the reach of the contact search.
    fn has_moved(&self) -> bool {
        let allowed = 0.5 * self.contact.reach;
        let moved = |body: &Body, (position, rotation): &(Vec3, crate::math::Mat3)| {
            let shift = (body.position - position).norm_squared();
            // The Frobenius norm of the change of rotation bounds the path of a vertex at unit distance.
            let turn = (body.rotation - rotation).norm_squared() * body.radius * body.radius;
            // (x + y)^2 <= 2 (x^2 + y^2)
            2.0 * (shift + turn) > allowed * allowed
        };
        self.bodies.all.iter().zip(&self.seen).any(|(body, seen)| body.moves() && moved(body, seen))
    }

    /// Looks for contacts anew and adapts the step to them.
    pub fn refresh(&mut self) {
        self.joints.refresh(&self.bodies, self.laws, &self.contact);
        self.seen = self.bodies.all.iter().map(|b| (b.position, b.rotation)).collect();
        let bounds = critical::block_bounds(&self.bodies, &self.joints);
        let safety = self.settings.step_safety;
        if self.settings.scaled_inertia {
            // dt = 1 and dt^2 (2 bound / scale) = 4 safety^2 for every block. A block without joints keeps the scale it
            // had; one that never had any falls by a hundredth of the reach in its first step.
            let falling = self.gravity.norm() / (0.01 * self.contact.reach);
            for (body, &bound) in self.bodies.all.iter_mut().zip(&bounds).filter(|(b, _)| b.moves()) {
                if bound > 0.0 {
                    body.rescale(0.5 * bound / (safety * safety));
                } else if body.inertia_scale == 1.0 {
                    body.rescale(falling.max(1.0));
                }
            }
            self.dt = 1.0;
        } else {
            let largest = bounds.iter().fold(0.0, |a: f64, &b| a.max(b));
            self.dt = self.settings.longest_step.min(safety * 2.0 / (2.0 * largest).sqrt());
        }
    }
}

/// Standard gravity (m/s^2).
pub const STANDARD_GRAVITY: f64 = 9.806_65;
