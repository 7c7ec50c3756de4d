//! The time loop.

use crate::contact;
use crate::math::Vec3;
use crate::model::{JointLaws, Wall};
use crate::solve::bodies::{Bodies, Body};
use crate::solve::nonsmooth::cone_program::cone_program;
use crate::solve::nonsmooth::contacts::Contacts;
use crate::solve::nonsmooth::impact::Allowance;
use crate::solve::nonsmooth::newton::{Kept, Start, newton};
use crate::solve::nonsmooth::part::{Found, Part, Solved};
use crate::solve::nonsmooth::problem::{Inertia, Matrix, masses};
use crate::solve::nonsmooth::project::project;
use crate::solve::nonsmooth::sweeps::sweeps;
use crate::solve::nonsmooth::{Friction, Problem, Residual, Settings, StepSolver};
use crate::solve::system::{DOF, System};
use crate::solve::{Assembly, Equilibrate, STANDARD_GRAVITY, Settled, Status};

/// While a wall comes to rest each step is so much longer than the one before, up to so many times the time step.
const LENGTHENS: f64 = 1.25;
const LONGEST: f64 = 10.0;
/// What moves slower (m/s) is at rest as far as rounding goes.
const LEAST_SPEED: f64 = 1e-9;
/// Rigid joints that overlap by more than this share of the reach of the contact search are pushed apart: of stones of 0.2 m, 0.1 micrometres, by which
/// they turn 3e-5 deg at the most.
const OVERLAP: f64 = 1e-4;

/// What a step came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Stepped {
    /// What is left over of the contact problem.
    pub residual: Residual,
    /// Iterations: factorisations, cone programs or sweeps.
    pub iterations: u32,
    /// Whether the residual is small enough.
    pub is_solved: bool,
    /// Largest speed (m/s) of a body after the step: of its centroid, or of its turning at its radius.
    pub speed: f64,
    /// By how much energy grew (J): of motion, less the impulses of gravity and dead loads times the velocities that they lead to; without what
    /// springs store. At most rounding in a step with rigid joints.
    pub energy_gain: f64,
    /// Work (J) that sliding joints took: shear impulses times sliding velocities.
    pub friction_work: f64,
    /// Work (J) of pushing joints apart that overlapped, done on the weights of the bodies apart from their velocities.
    pub projection_work: f64,
    /// Largest overlap (m) that was pushed apart.
    pub projected: f64,
}

/// An assembly stepped in time.
#[derive(Clone)]
pub struct Simulation<'a> {
    /// Bodies, joints and loads.
    pub assembly: Assembly<'a>,
    /// Steps taken since the start.
    pub steps: u64,
    pub(super) settings: Settings,
    contacts: Contacts,
    system: System,
    /// What the system is factorised for.
    kept: Kept,
    /// With which Newton's method begins.
    weight: f64,
    /// For how long (s) loads have still to act on the velocities before the next step begins; half of that step where nothing is said.
    pub(super) owed: Option<f64>,
    /// How many steps may be divided.
    pub(super) allowance: Allowance,
}

impl<'a> Simulation<'a> {
    /// Blocks at rest in the positions of the wall, under gravity along -z.
    pub fn new(wall: &Wall, laws: &'a dyn JointLaws, settings: Settings, contact: contact::Settings) -> Self {
        Simulation::of(Assembly::new(wall, laws, contact), settings)
    }

    /// Goes on from an assembly as it stands.
    pub fn of(assembly: Assembly<'a>, settings: Settings) -> Self {
        let bodies = &assembly.bodies.all;
        let contacts = Contacts::find(&assembly.joints, bodies, settings.normal, &Default::default());
        let system = System::new(bodies, &assembly.joints);
        Simulation {
            assembly,
            steps: 0,
            settings,
            contacts,
            system,
            kept: Kept::default(),
            weight: 0.0,
            owed: None,
            allowance: Allowance::full(),
        }
    }

    /// Looks for contacts anew.
    pub fn refresh(&mut self) {
        self.kept = Kept::default();
        let past = self.contacts.past(&self.assembly.joints, &self.assembly.bodies.all);
        self.assembly.refresh();
        let (bodies, joints) = (&self.assembly.bodies.all, &self.assembly.joints);
        self.contacts = Contacts::find(joints, bodies, self.settings.normal, &past);
        self.fit();
    }

    /// Fits the system to the joints as they are.
    fn fit(&mut self) {
        if !self.system.fits(&self.assembly.joints) {
            self.kept = Kept::default();
            self.system = System::new(&self.assembly.bodies.all, &self.assembly.joints);
        }
    }

    /// The contact problem of a step of length `step` (s) from here, and the bodies half a step ahead.
    pub fn problem(&mut self, step: f64) -> Problem {
        self.posed(self.whole(step))
    }

    /// A step that is not divided.
    pub(super) fn whole(&self, step: f64) -> Part {
        let half = 0.5 * step;
        Part { loads: self.owed.unwrap_or(half) + half, moves: step, step }
    }

    /// The contact problem of a part of a step.
    pub(super) fn posed(&mut self, part: Part) -> Problem {
        self.assembly.apply_loads();
        let now = &self.assembly.bodies.all;
        let half_way: Vec<Body> = now.iter().map(|body| ahead(body, 0.5 * part.moves)).collect();
        let springs = self.springs(part.loads * part.moves);
        let inertias: Vec<Inertia> = half_way
            .iter()
            .zip(&springs)
            .map(|(body, springs)| Inertia::of(body, &body.rotation, springs))
            .collect();
        let mut free = Vec::with_capacity(DOF * now.len());
        for (body, inertia) in now.iter().zip(&inertias) {
            let linear = body.velocity * (body.mass * body.inertia_scale) + body.force * part.loads;
            let angular = body.angular_momentum + body.torque * part.loads;
            free.extend(inertia.velocity(&[linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]));
        }
        let (mass, mean_mass) = masses(now);
        let (joints, normal) = (&self.assembly.joints, self.settings.normal);
        let times = (part.bears(), part.closes());
        let points = self.contacts.points(joints, (now, &half_way), &inertias, normal, times);
        Problem {
            inertias,
            free,
            points,
            step: part.bears(),
            weight: mass * STANDARD_GRAVITY * part.step,
            fastest: self.assembly.bodies.fastest().max(LEAST_SPEED),
            mean_mass,
        }
    }

    /// Length of a step (s).
    pub(super) fn time_step(&self) -> f64 {
        self.settings.time_step
    }

    /// Stiffness of ties and of the platform's springs by body, times the square of the step (s^2).
    fn springs(&self, square: f64) -> Vec<Matrix> {
        let bodies = &self.assembly.bodies.all;
        let mut springs = vec![[[0.0; DOF]; DOF]; bodies.len()];
        for tie in self.assembly.ties() {
            let body = &bodies[tie.tie.body];
            let (row, slope) = tie.stretch(body, self.assembly.load_factor);
            for (k, a) in row.iter().enumerate() {
                row.iter()
                    .enumerate()
                    .for_each(|(l, b)| springs[tie.tie.body][k][l] += square * slope * a * b);
            }
        }
        if let Some(mounted) = self.assembly.mounted() {
            let own = &mut springs[mounted.mount.body];
            mounted.stiffness().iter().enumerate().for_each(|(k, spring)| own[k][k] += square * spring);
        }
        springs
    }

    /// One time step, of the length of the settings.
    pub fn step_once(&mut self) -> Stepped {
        self.step(self.settings.time_step)
    }

    /// One time step of length `step` (s); divided where bodies hit one another.
    pub fn step(&mut self, step: f64) -> Stepped {
        let whole = self.solved(self.whole(step));
        let stepped = match self.divided(&whole) {
            Some(stepped) => stepped,
            None => self.take(&whole),
        };
        self.end(stepped)
    }

    /// One time step that is not divided.
    fn undivided_step(&mut self, step: f64) -> Stepped {
        let whole = self.solved(self.whole(step));
        let stepped = self.take(&whole);
        self.end(stepped)
    }

    /// Solves a step; nothing moves.
    fn solved(&mut self, part: Part) -> Solved {
        let problem = self.posed(part);
        let found = self.solve(&problem);
        Solved::of(part, problem, found)
    }

    /// Takes a step as it was solved.
    fn take(&mut self, solved: &Solved) -> Stepped {
        let energy_gain = self.advance(solved);
        self.remember(solved);
        self.owed = None;
        let tolerance = self.settings.tolerance;
        let speed = self.assembly.bodies.fastest();
        Stepped { speed, ..solved.told(energy_gain, tolerance) }
    }

    /// Has the joints remember what a step or a part of it did to them.
    pub(super) fn remember(&mut self, solved: &Solved) {
        let Solved { problem, impulses, .. } = solved;
        self.contacts.remember(&mut self.assembly.joints, &problem.points, impulses, problem.step);
    }

    /// Ends a step: pushes joints apart that overlap, and looks for contacts anew where bodies have moved.
    fn end(&mut self, mut stepped: Stepped) -> Stepped {
        self.steps += 1;
        self.allowance.grow();
        if self.settings.is_rigid() {
            let enough = OVERLAP * self.assembly.contact.reach;
            let Simulation { assembly, contacts, system, kept, .. } = self;
            if let Some((overlap, work)) = project(assembly, contacts, (system, kept), enough) {
                (stepped.projected, stepped.projection_work) = (overlap, work);
            }
        }
        if self.assembly.has_moved() {
            self.refresh();
        }
        stepped
    }

    /// The impulses (N s) that solve the problem of a step from here, what is left over, and the iterations that it took.
    pub(super) fn solve(&mut self, problem: &Problem) -> Found {
        let Settings { solver, friction, tolerance, max_iterations, .. } = self.settings;
        let nearest = self.by_newton(problem);
        if nearest.as_ref().is_some_and(|nearest| nearest.1.natural_map <= tolerance) {
            return nearest.expect("it is solved");
        }
        let start = self.contacts.impulses(&problem.points, problem.step);
        // Cone programs know no springs.
        if !self.settings.is_rigid() || (solver == StepSolver::Sweeps && friction == Friction::Coulomb) {
            return sweeps(problem, &start, tolerance, max_iterations);
        }
        let found = cone_program(problem, friction, tolerance, max_iterations);
        // Where neither gets there, what is nearer goes on.
        match nearest {
            Some(nearest) if nearest.1.natural_map < found.1.natural_map => nearest,
            _ => found,
        }
    }

    /// The same by Newton's method alone, as far as it gets; `None` where the settings ask for another, or it gets nowhere.
    pub(super) fn by_newton(&mut self, problem: &Problem) -> Option<Found> {
        let Settings { solver, friction, tolerance, max_iterations, .. } = self.settings;
        if solver != StepSolver::Newton || friction != Friction::Coulomb {
            return None;
        }
        let start = self.contacts.impulses(&problem.points, problem.step);
        let bodies = &self.assembly.bodies.all;
        let v: Vec<f64> = bodies.iter().flat_map(Body::twist).collect();
        let from = Start { velocities: &v, impulses: &start, weight: self.weight };
        let system = (&mut self.system, &mut self.kept);
        let solved = newton(problem, system, bodies, from, (tolerance, max_iterations))?;
        if solved.residual.natural_map <= tolerance {
            self.weight = solved.weight;
        }
        Some((solved.impulses, solved.residual, solved.factorisations))
    }

    /// Gives the bodies their velocities, and moves them; says by how much their energy grows.
    pub(super) fn advance(&mut self, solved: &Solved) -> f64 {
        let Solved { part, problem, v, .. } = solved;
        let mut gain = 0.0;
        for (b, body) in self.assembly.bodies.all.iter_mut().enumerate().filter(|(_, body)| body.moves()) {
            let v = &v[DOF * b..DOF * b + DOF];
            let (velocity, spin) = (Vec3::new(v[0], v[1], v[2]), Vec3::new(v[3], v[4], v[5]));
            let mass = body.mass * body.inertia_scale;
            let before = mass * body.velocity.norm_squared() + body.spin.dot(&body.angular_momentum);
            body.velocity = velocity;
            body.angular_momentum = problem.inertias[b].moments * spin;
            body.spin = spin;
            let after = mass * velocity.norm_squared() + spin.dot(&body.angular_momentum);
            let from = body.clone();
            body.place(&from, &(velocity * part.moves), &(spin * part.moves));
            gain +=
                0.5 * (after - before) - part.loads * (body.force.dot(&velocity) + body.torque.dot(&spin));
        }
        gain
    }
}

/// A body where its velocity takes it in a time (s).
fn ahead(body: &Body, time: f64) -> Body {
    let mut moved = body.clone();
    if body.moves() {
        moved.place(body, &(body.velocity * time), &(body.spin * time));
    }
    moved
}

impl<'a> Equilibrate<'a> for Simulation<'a> {
    fn assembly(&self) -> &Assembly<'a> {
        &self.assembly
    }

    fn assembly_mut(&mut self) -> &mut Assembly<'a> {
        &mut self.assembly
    }

    fn follows_falls(&self) -> bool {
        true
    }

    fn lower(&mut self, down: &[(usize, f64)], stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        self.assembly.lower(down);
        self.refresh();
        self.settle(stop)
    }

    fn settle(&mut self, stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        self.contacts.forget(&self.assembly.joints);
        self.fit();
        let mut step = self.settings.time_step;
        let mut unbalanced_ratio = f64::INFINITY;
        for steps in 1..=self.settings.max_steps {
            let stepped = self.undivided_step(step);
            let ended = |status, unbalanced_ratio| Settled { status, unbalanced_ratio, steps };
            if !self.assembly.is_finite() || !stepped.speed.is_finite() {
                return ended(Status::NonFinite, f64::NAN);
            }
            unbalanced_ratio = stepped.residual.natural_map;
            if !stepped.is_solved {
                return ended(Status::NoEquilibrium, unbalanced_ratio);
            }
            if stepped.speed < self.settings.rest_speed {
                self.assembly.bodies.stop();
                return ended(Status::Equilibrium, unbalanced_ratio);
            }
            if stop(&self.assembly.bodies) {
                return ended(Status::Stopped, unbalanced_ratio);
            }
            step = (step * LENGTHENS).min(LONGEST * self.settings.time_step);
        }
        Settled { status: Status::StepsSpent, unbalanced_ratio, steps: self.settings.max_steps }
    }
}
