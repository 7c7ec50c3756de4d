//! The time loop.

use crate::contact;
use crate::math::Vec3;
use crate::model::{JointLaws, Wall};
use crate::solve::bodies::{Bodies, Body};
use crate::solve::explicit::{Settings, critical};
use crate::solve::{Assembly, Equilibrate, Settled, Status};

/// Share of the critical damping of the motion with which a rest is approached. What is seen of the motion is faster than the
/// slowest part of it, for which the damping is to be right.
const APPROACH: f64 = 0.5;
/// Steps between two looks at the unbalanced force ratio.
const STEPS_BETWEEN_LOOKS: u64 = 10;

/// An assembly stepped in time.
#[derive(Clone)]
pub struct Simulation<'a> {
    /// Bodies, joints and loads.
    pub assembly: Assembly<'a>,
    /// Time step (s); with scaled inertia its length has no meaning and it is 1.
    pub dt: f64,
    /// Steps taken since the start.
    pub steps: u64,
    settings: Settings,
    /// Length of the step that led to the positions now (s); 0 before the first one.
    last_dt: f64,
    /// Whether rests are approached with damping of the motion as a whole, before the settings' own has its say.
    approaches: bool,
    /// Force and moment on every body at the step before, while a rest is approached.
    before: Vec<(Vec3, Vec3)>,
}

impl<'a> Simulation<'a> {
    /// Blocks at rest in the positions of the wall, under gravity along -z.
    pub fn new(wall: &Wall, laws: &'a dyn JointLaws, settings: Settings, contact: contact::Settings) -> Self {
        Simulation::of(Assembly::new(wall, laws, contact), settings)
    }

    /// Goes on from an assembly as it stands.
    pub fn of(assembly: Assembly<'a>, settings: Settings) -> Self {
        let (approaches, before) = (false, Vec::new());
        let mut simulation =
            Simulation { assembly, dt: 1.0, steps: 0, settings, last_dt: 0.0, approaches, before };
        simulation.adapt_step();
        simulation
    }

    /// The same for a wall that is only asked where it comes to rest. Local damping slows all motions alike, and a wall near its
    /// limit moves slowly: it is damped as a whole instead, by what is critical for the frequency it moves with (P. A.
    /// Cundall's adaptive global damping; P. Underwood, 1983), and has come to rest where it stays so under local damping.
    /// With true inertia, or without damping, it is [`Simulation::of`].
    pub fn approaching(assembly: Assembly<'a>, settings: Settings) -> Self {
        let approaches = settings.scaled_inertia && settings.damping > 0.0;
        Simulation { approaches, ..Simulation::of(assembly, settings) }
    }

    /// [`Equilibrate::settle`] with the status and the unbalanced force ratio alone.
    pub fn relax(&mut self, mut stop: impl FnMut(&Bodies) -> bool) -> (Status, f64) {
        let settled = self.settle(&mut stop);
        (settled.status, settled.unbalanced_ratio)
    }

    /// [`Equilibrate::settle`] with another limit of the unbalanced force ratio than the settings'.
    pub fn settle_below(&mut self, limit: f64, stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        let mut unbalanced_ratio = f64::INFINITY;
        let mut approaches = self.approaches;
        self.before.clear();
        for step in 1..=self.settings.max_steps {
            self.step_damped(approaches);
            if step % STEPS_BETWEEN_LOOKS == 0 || step == self.settings.max_steps {
                let ended = |status, unbalanced_ratio| Settled { status, unbalanced_ratio, steps: step };
                if !self.assembly.is_finite() {
                    return ended(Status::NonFinite, f64::NAN);
                }
                unbalanced_ratio = self.assembly.unbalanced_ratio();
                if unbalanced_ratio < limit && approaches {
                    approaches = false;
                    continue;
                }
                approaches = self.approaches;
                if unbalanced_ratio < limit {
                    return ended(Status::Equilibrium, unbalanced_ratio);
                }
                if stop(&self.assembly.bodies) {
                    return ended(Status::Stopped, unbalanced_ratio);
                }
            }
        }
        Settled { status: Status::StepsSpent, unbalanced_ratio, steps: self.settings.max_steps }
    }

    /// One time step: forces at the positions now, then velocities at the half step, then new positions.
    pub fn step(&mut self) {
        self.step_damped(false);
    }

    fn step_damped(&mut self, approaches: bool) {
        self.assembly.apply_loads();
        let Assembly { bodies, joints, .. } = &mut self.assembly;
        joints.apply(&mut bodies.all, self.last_dt);
        let damping = if approaches {
            let kept = kept(&bodies.all, &self.before, self.dt);
            for body in &mut bodies.all {
                body.velocity *= kept;
                body.angular_momentum *= kept;
            }
            self.before.clear();
            self.before.extend(bodies.all.iter().map(|body| (body.force, body.torque)));
            0.0
        } else {
            self.before.clear();
            self.settings.damping
        };
        for body in &mut bodies.all {
            body.advance(self.dt, damping);
        }
        self.last_dt = self.dt;
        self.steps += 1;
        if self.assembly.has_moved() {
            self.refresh();
        }
    }

    /// Looks for contacts anew and adapts the step to them.
    pub fn refresh(&mut self) {
        self.assembly.refresh();
        self.adapt_step();
    }

    /// Adapts the step to the joints there are now.
    fn adapt_step(&mut self) {
        let bounds = critical::block_bounds(&self.assembly);
        let Assembly { bodies, gravity, contact, .. } = &mut self.assembly;
        let safety = self.settings.step_safety;
        if self.settings.scaled_inertia {
            // dt = 1 and dt^2 (2 bound / scale) = 4 safety^2 for every block. A block without joints keeps the scale it
            // had; one that never had any falls by a hundredth of the reach in its first step.
            let falling = gravity.norm() / (0.01 * contact.reach);
            for (body, &bound) in bodies.all.iter_mut().zip(&bounds).filter(|(b, _)| b.moves()) {
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

/// The share of their velocities that bodies keep in a step, from the forces now and at the step before. Forces change by
/// `-K v dt`, so `v K v / v M v` is the square of a frequency; where it is negative the wall is on its way down and nothing is
/// damped.
fn kept(bodies: &[Body], before: &[(Vec3, Vec3)], dt: f64) -> f64 {
    let (mut stiffness, mut inertia) = (0.0, 0.0);
    for (body, (force, torque)) in bodies.iter().zip(before).filter(|(body, _)| body.moves()) {
        stiffness -= (body.force - force).dot(&body.velocity) + (body.torque - torque).dot(&body.spin);
        inertia += body.mass * body.inertia_scale * body.velocity.norm_squared()
            + body.angular_momentum.dot(&body.spin);
    }
    let share = APPROACH * dt * (stiffness / (inertia * dt)).sqrt();
    // NaN where nothing moves, on the way down, and where the numbers have gone bad, which is for others to tell.
    if share.is_finite() { ((1.0 - share) / (1.0 + share)).max(0.0) } else { 1.0 }
}

impl<'a> Equilibrate<'a> for Simulation<'a> {
    fn assembly(&self) -> &Assembly<'a> {
        &self.assembly
    }

    fn assembly_mut(&mut self) -> &mut Assembly<'a> {
        &mut self.assembly
    }

    fn settle(&mut self, stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        self.settle_below(self.settings.unbalanced_ratio, stop)
    }
}
