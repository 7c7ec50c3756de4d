//! The time loop.

use crate::contact;
use crate::model::{JointLaws, Wall};
use crate::solve::bodies::Bodies;
use crate::solve::explicit::{Rayleigh, Settings, critical};
use crate::solve::{Assembly, Equilibrate, Settled, Status};

/// Steps between two looks at the unbalanced force ratio.
const STEPS_BETWEEN_LOOKS: u64 = 10;
/// Steps in which bodies are let down. In one step what stands on them would fall after them, bounce, and slip meanwhile.
const STEPS_DOWN: u32 = 1000;
/// A wall that is suspected soon has so many times the steps that it took at the most to come to rest before, and so many at the least.
const PATIENCE: u64 = 10;
const LEAST_PATIENCE: u64 = 5000;

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
    rayleigh: Rayleigh,
    /// Length of the step that led to the positions now (s); 0 before the first one.
    last_dt: f64,
    /// Most steps that it took to come to rest, where it is suspected soon; `None` where it has all steps of the settings each time.
    longest: Option<u64>,
}

impl<'a> Simulation<'a> {
    /// Blocks at rest in the positions of the wall, under gravity along -z.
    pub fn new(wall: &Wall, laws: &'a dyn JointLaws, settings: Settings, contact: contact::Settings) -> Self {
        Simulation::of(Assembly::new(wall, laws, contact), settings)
    }

    /// Goes on from an assembly as it stands.
    pub fn of(assembly: Assembly<'a>, settings: Settings) -> Self {
        let mut simulation = Simulation {
            assembly,
            dt: 1.0,
            steps: 0,
            settings,
            rayleigh: Rayleigh::default(),
            last_dt: 0.0,
            longest: None,
        };
        simulation.adapt_step();
        simulation
    }

    /// Suspected soon: it has ten times the steps that it took at the most to come to rest before. A wall near its limit slows down as its
    /// stiffness fades, some fivefold at a hundredth of a degree; one that falls creeps under local damping for a hundred thousand steps. For
    /// whoever asks another solver what becomes of a wall whose steps ran out.
    pub fn suspected_soon(mut self) -> Self {
        self.longest = Some(0);
        self
    }

    /// Steps that it has to come to rest.
    fn patience(&self) -> u64 {
        match self.longest {
            Some(longest) if longest > 0 => {
                (PATIENCE * longest).max(LEAST_PATIENCE).min(self.settings.max_steps)
            }
            _ => self.settings.max_steps,
        }
    }

    /// Damped as well in proportion to mass and stiffness. With scaled inertia that has no meaning.
    pub fn damped(mut self, rayleigh: Rayleigh) -> Self {
        self.rayleigh = rayleigh;
        self.adapt_step();
        self
    }

    /// [`Equilibrate::settle`] with the status and the unbalanced force ratio alone.
    pub fn relax(&mut self, mut stop: impl FnMut(&Bodies) -> bool) -> (Status, f64) {
        let settled = self.settle(&mut stop);
        (settled.status, settled.unbalanced_ratio)
    }

    /// [`Equilibrate::settle`] with another limit of the unbalanced force ratio than the settings'.
    pub fn settle_below(&mut self, limit: f64, stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        let mut unbalanced_ratio = f64::INFINITY;
        let most = self.patience();
        for step in 1..=most {
            self.step();
            if step % STEPS_BETWEEN_LOOKS == 0 || step == most {
                let ended = |status, unbalanced_ratio| Settled { status, unbalanced_ratio, steps: step };
                if !self.assembly.is_finite() {
                    return ended(Status::NonFinite, f64::NAN);
                }
                unbalanced_ratio = self.assembly.unbalanced_ratio();
                if unbalanced_ratio < limit {
                    self.longest = self.longest.map(|longest| longest.max(step));
                    return ended(Status::Equilibrium, unbalanced_ratio);
                }
                if stop(&self.assembly.bodies) {
                    return ended(Status::Stopped, unbalanced_ratio);
                }
            }
        }
        Settled { status: Status::StepsSpent, unbalanced_ratio, steps: most }
    }

    /// One time step: forces at the positions now, then velocities at the half step, then new positions.
    pub fn step(&mut self) {
        self.assembly.apply_loads();
        let Assembly { bodies, joints, .. } = &mut self.assembly;
        let Rayleigh { mass, stiffness } = self.rayleigh;
        if stiffness > 0.0 {
            joints.apply_damped(&mut bodies.all, self.last_dt, stiffness);
        } else {
            joints.apply(&mut bodies.all, self.last_dt);
        }
        if mass > 0.0 {
            for body in &mut bodies.all {
                body.force -= body.velocity * (mass * body.mass);
                body.torque -= body.angular_momentum * mass;
            }
        }
        for body in &mut bodies.all {
            body.advance(self.dt, self.settings.damping);
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
            let critical = self.rayleigh.step_factor() * 2.0 / (2.0 * largest).sqrt();
            self.dt = self.settings.longest_step.min(safety * critical);
        }
    }
}

impl<'a> Equilibrate<'a> for Simulation<'a> {
    fn assembly(&self) -> &Assembly<'a> {
        &self.assembly
    }

    fn assembly_mut(&mut self) -> &mut Assembly<'a> {
        &mut self.assembly
    }

    fn lower(&mut self, down: &[(usize, f64)], stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        let at_a_time: Vec<(usize, f64)> =
            down.iter().map(|(body, way)| (*body, way / f64::from(STEPS_DOWN))).collect();
        for _ in 0..STEPS_DOWN {
            self.assembly.lower(&at_a_time);
            self.step();
        }
        let settled = self.settle(stop);
        Settled { steps: settled.steps + u64::from(STEPS_DOWN), ..settled }
    }

    fn settle(&mut self, stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        self.settle_below(self.settings.unbalanced_ratio, stop)
    }
}
