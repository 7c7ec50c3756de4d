//! The time loop of grains.

use crate::model::Heap;
use crate::solve::bodies::Body;
use crate::solve::grains::{Grains, Settings, critical};
use crate::solve::{Settled, Status};

/// Steps between two looks at the unbalanced force ratio.
const STEPS_BETWEEN_LOOKS: u64 = 10;

/// Grains stepped in time.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// Bodies, spheres, contacts and gravity.
    pub grains: Grains,
    /// Time step (s): the share `step_safety` of the critical step, which is the smaller of YADE's P-wave step
    /// `min r sqrt(rho / E)` and `2 / omega` from Gershgorin's bound on the listed contacts; found anew with them.
    pub dt: f64,
    /// Steps taken since the start.
    pub steps: u64,
    /// Time since the start (s).
    pub time: f64,
    settings: Settings,
    /// Length of the step that led to the positions now (s); 0 before the first one.
    last_dt: f64,
}

impl Simulation {
    /// Bodies at rest where the heap has its clumps, under gravity along -z.
    pub fn new(heap: &Heap, settings: Settings) -> Self {
        let radii = heap.clumps.iter().flat_map(|c| &c.spheres).map(|s| s.radius);
        let skin = settings.skin_share * radii.fold(f64::INFINITY, f64::min);
        let grains = Grains::new(heap, skin);
        let mut simulation = Simulation { grains, dt: 0.0, steps: 0, time: 0.0, settings, last_dt: 0.0 };
        simulation.adapt_step();
        simulation
    }

    /// One time step: forces at the positions now, then velocities at the half step, then new positions.
    pub fn step(&mut self) {
        let grains = &mut self.grains;
        grains.apply_gravity();
        grains.apply_contacts(self.last_dt);
        for body in &mut grains.bodies {
            body.advance(self.dt, self.settings.damping);
        }
        grains.place_spheres();
        self.last_dt = self.dt;
        self.steps += 1;
        self.time += self.dt;
        if grains.has_moved() && grains.is_finite() {
            grains.refresh();
            self.adapt_step();
        }
    }

    /// Steps until the unbalanced force ratio falls below `unbalanced_ratio`, `stop` says so, or the steps are spent.
    /// Grains that roll without a force on them count as balanced: whether they stand is for the caller to see.
    pub fn settle(&mut self, unbalanced_ratio: f64, stop: &mut dyn FnMut(&[Body]) -> bool) -> Settled {
        let mut ratio = f64::INFINITY;
        for steps in 1..=self.settings.max_steps {
            self.step();
            if steps % STEPS_BETWEEN_LOOKS == 0 || steps == self.settings.max_steps {
                let ended = |status, unbalanced_ratio| Settled { status, unbalanced_ratio, steps };
                if !self.grains.is_finite() {
                    return ended(Status::NonFinite, f64::NAN);
                }
                ratio = self.grains.unbalanced_ratio();
                if ratio < unbalanced_ratio {
                    return ended(Status::Equilibrium, ratio);
                }
                if stop(&self.grains.bodies) {
                    return ended(Status::Stopped, ratio);
                }
            }
        }
        Settled { status: Status::StepsSpent, unbalanced_ratio: ratio, steps: self.settings.max_steps }
    }

    fn adapt_step(&mut self) {
        self.dt = self.settings.step_safety * critical::step(&self.grains);
    }
}
