//! The loop over time.

use crate::math::Vec3;
use crate::model::Level;
use crate::motion::Motion;
use crate::protocol::base_motion::observe::{Observer, Shaken, Verdict};
use crate::protocol::base_motion::settings::{InTime, Lean, Shaking};
use crate::protocol::base_motion::settled::Settled;
use crate::protocol::fallen::Bearings;
use crate::protocol::{Task, Witness};
use crate::solve::bodies::{Bodies, Body};
use crate::solve::nonsmooth::{self, Normal};
use crate::solve::{Assembly, Equilibrate, STANDARD_GRAVITY, Status, explicit};

/// Between two looks at a wall pass at least so many seconds.
const BETWEEN_LOOKS: f64 = 1e-3;
/// Between two states of a replay pass so many seconds; of long ones some are left out.
const BETWEEN_STATES: f64 = 0.02;
/// After the motion a wall whose fastest body is slower than this (m/s) is at rest.
const RESTS: f64 = 1e-4;
/// Looks in a row at which it has to be, as what swings is slow where it turns back.
const LOOKS_AT_REST: u32 = 100;
/// By so much (m/s) the stones of the twin of a wall move at the start, to and fro in turn.
const PERTURBED: f64 = 1e-9;

/// What unsolved steps left over may give a stone this share of the largest speed of the base. As much is wrong in the velocities of a record, which
/// are integrated from accelerations; a wall that needs it to stand stands by chance.
const LEFT_OVER: f64 = 0.01;

/// A wall in time.
enum Mover<'a> {
    Explicit(Box<explicit::Simulation<'a>>),
    Nonsmooth(Box<nonsmooth::Simulation<'a>>, f64),
}

/// Shakes a wall on a level ground. The task says what stands where; its load path plays no part.
pub fn shake(task: &Task<'_>, shaking: &Shaking, solver: InTime) -> Shaken {
    Rested::of(task, Lean::NONE, solver).shaken(shaking)
}

/// Shakes a wall, and the same once more with stones that move by next to nothing at the start. Where the two come to different verdicts that of the first is
/// [`Verdict::Undecided`].
pub fn shake_twice(task: &Task<'_>, shaking: &Shaking, solver: InTime) -> [Shaken; 2] {
    Rested::of(task, Lean::NONE, solver).shaken_twice(shaking)
}

/// A wall at rest under gravity, which any number of motions may begin at.
pub struct Rested<'t> {
    task: &'t Task<'t>,
    lean: Lean,
    solver: InTime,
    built: Assembly<'t>,
    /// Or why it is not at rest.
    assembly: Result<Assembly<'t>, Verdict>,
    /// How far it went from where it was built.
    settled: Option<Settled>,
}

impl<'t> Rested<'t> {
    /// By the solver that it is shaken with, on a ground that leans.
    pub fn of(task: &'t Task<'t>, lean: Lean, solver: InTime) -> Rested<'t> {
        let built = task.assembled();
        let assembly = at_rest(task, built.clone(), lean, &solver);
        let settled = assembly.as_ref().ok().and_then(|rest| Settled::between(&built.bodies, &rest.bodies));
        Rested { task, lean, solver, built, assembly, settled }
    }

    /// Number of joints as built.
    pub fn joints(&self) -> usize {
        self.built.joints.all.len()
    }

    /// As of [`shake`].
    pub fn shaken(&self, shaking: &Shaking) -> Shaken {
        self.shaken_seen_by(shaking, Witness::NOBODY)
    }

    /// The same, with somebody who sees how it goes.
    pub fn shaken_seen_by(&self, shaking: &Shaking, witness: Witness<'_>) -> Shaken {
        witness.begins(self.task, &self.built);
        match &self.assembly {
            Ok(assembly) => {
                witness.rests(Level::Time(0.0), assembly);
                let seen = self.follow(shaking, assembly, assembly.clone(), witness);
                Shaken { settled: self.settled, ..seen }
            }
            Err(verdict) => Shaken { verdict: *verdict, ..Shaken::nothing_yet() },
        }
    }

    /// As of [`shake_twice`].
    pub fn shaken_twice(&self, shaking: &Shaking) -> [Shaken; 2] {
        self.shaken_twice_seen_by(shaking, Witness::NOBODY)
    }

    /// The same, with somebody who sees how the first one goes.
    pub fn shaken_twice_seen_by(&self, shaking: &Shaking, witness: Witness<'_>) -> [Shaken; 2] {
        let mut first = self.shaken_seen_by(shaking, witness);
        let Ok(assembly) = &self.assembly else { return [first.clone(), first] };
        let mut moved = assembly.clone();
        let mut sign = 1.0;
        for body in moved.bodies.all.iter_mut().filter(|body| body.moves()) {
            body.velocity = Vec3::new(0.0, PERTURBED * sign, 0.0);
            sign = -sign;
        }
        let second = self.follow(shaking, assembly, moved, Witness::NOBODY);
        let second = Shaken { settled: self.settled, ..second };
        if [first.verdict, second.verdict].contains(&Verdict::NotSolved) {
            first.verdict = Verdict::NotSolved;
        } else if first.verdict != second.verdict {
            first.verdict = Verdict::Undecided;
        }
        [first, second]
    }
}

/// The wall at rest under gravity.
fn at_rest<'a>(
    task: &Task<'a>,
    mut built: Assembly<'a>,
    lean: Lean,
    solver: &InTime,
) -> Result<Assembly<'a>, Verdict> {
    built.gravity = lean.gravity();
    built.load_factor = 1.0;
    let bearings = Bearings::of(task.wall, &built, -built.gravity.normalize());
    let from: Vec<Vec3> = built.bodies.all.iter().map(|body| body.position).collect();
    // What slides by its own size does not stand where it was built.
    let strays = |(body, from): (&Body, &Vec3)| (body.position - from).norm() > 2.0 * body.radius;
    let mut stop = |bodies: &Bodies| bodies.all.iter().zip(&from).any(strays);
    let (settled, assembly) = match *solver {
        InTime::Explicit(settings, _) => {
            let mut simulation = explicit::Simulation::of(built.clone(), settings);
            (simulation.settle(&mut stop), simulation.assembly)
        }
        InTime::Nonsmooth(settings) => {
            // What parts again comes to no rest; a restitution is for the way through the motion.
            let normal = match settings.normal {
                Normal::Velocity { restitution } if restitution > 0.0 => Normal::Gap,
                other => other,
            };
            let settings = nonsmooth::Settings { normal, ..settings };
            let mut simulation = nonsmooth::Simulation::of(built.clone(), settings);
            (simulation.settle(&mut stop), simulation.assembly)
        }
    };
    match settled.status {
        Status::Equilibrium if bearings.any_fell(&built, &assembly) => Err(Verdict::UnstableAtRest),
        Status::Equilibrium => {
            let mut assembly = assembly;
            assembly.bodies.stop();
            assembly.bodies.all.iter_mut().for_each(|body| body.rescale(1.0));
            Ok(assembly)
        }
        Status::Stopped => Err(Verdict::UnstableAtRest),
        Status::StepsSpent | Status::NoEquilibrium | Status::NonFinite => Err(Verdict::NotSolved),
    }
}

impl Rested<'_> {
    /// Follows the wall from the beginning of the motion.
    fn follow(
        &self,
        shaking: &Shaking,
        at_rest: &Assembly<'_>,
        start: Assembly<'_>,
        witness: Witness<'_>,
    ) -> Shaken {
        let gravity = start.gravity;
        let mut observer = Observer::new(self.task.wall, at_rest, -gravity.normalize(), shaking.shares);
        // The weight of all stones over that of one: of a natural map of 1, the weight of all was left over.
        let stones = start.bodies.all.iter().filter(|body| body.moves()).count() as f64;
        let mut mover = Mover::new(start, &self.solver);
        let motion = &shaking.motion;
        let (shakes, end) = (motion.duration(), motion.duration() + shaking.after);
        let mut shown = 0.0;
        let mut before: Vec<Vec3> = Vec::new();
        let (mut time, mut looked, mut resting) = (0.0, 0.0, 0);
        let (mut steps, mut unsolved, mut base, mut weight, mut friction) = (0, 0, 0.0, 0.0, 0.0);
        let (mut largest_residual, mut left_over) = (0.0f64, 0.0);
        while time < end {
            let acceleration = self.lean.seen(&mover.acceleration(motion, time));
            before.clear();
            before.extend(mover.assembly().bodies.all.iter().map(|body| body.position));
            let stepped = mover.step(gravity, acceleration);
            time += stepped.seconds;
            steps += 1;
            largest_residual = largest_residual.max(stepped.residual);
            if !stepped.is_solved {
                unsolved += 1;
                left_over += stepped.residual * stones * STANDARD_GRAVITY * stepped.seconds;
            }
            friction += stepped.friction;
            let bodies = &mover.assembly().bodies;
            for (body, before) in bodies.all.iter().zip(&before).filter(|(body, _)| body.moves()) {
                let way = body.position - before;
                base -= body.mass * acceleration.dot(&way);
                weight += body.mass * gravity.dot(&way);
            }
            if time - looked < BETWEEN_LOOKS {
                continue;
            }
            looked = time;
            if !mover.assembly().is_finite() {
                let seen = observer.end(&at_rest.bodies);
                return Shaken {
                    verdict: Verdict::NotSolved,
                    residual_m: None,
                    residual_rad: None,
                    time_s: time,
                    steps,
                    ..seen
                };
            }
            observer.read(mover.assembly(), time);
            if time - shown >= BETWEEN_STATES {
                shown = time;
                witness.moves(Level::Time(time), mover.assembly());
            }
            if observer.is_over() {
                break;
            }
            resting = if time > shakes && bodies.fastest() < RESTS { resting + 1 } else { 0 };
            if resting >= LOOKS_AT_REST {
                break;
            }
        }
        if time > shown {
            witness.moves(Level::Time(time), mover.assembly());
        }
        let bodies = mover.assembly().bodies.clone();
        let mut seen = observer.end(&bodies);
        let kinetic = bodies.kinetic_energy();
        seen.energy.base_work_j = base;
        seen.energy.gravity_work_j = weight;
        seen.energy.kinetic_j = kinetic;
        seen.energy.lost_j = base + weight - kinetic;
        seen.energy.friction_j = matches!(mover, Mover::Nonsmooth(..)).then_some(friction);
        // Also where it is not a number. A collapse is on the safe side.
        let is_off = left_over.is_nan() || left_over > LEFT_OVER * shaking.motion.pgv();
        if is_off && seen.verdict != Verdict::Collapsed {
            seen.verdict = Verdict::NotSolved;
        }
        let left_over_m_per_s = left_over;
        Shaken { time_s: time, steps, unsolved_steps: unsolved, largest_residual, left_over_m_per_s, ..seen }
    }
}

/// What a step took.
struct Step {
    seconds: f64,
    is_solved: bool,
    /// Natural map that is left.
    residual: f64,
    friction: f64,
}

impl<'a> Mover<'a> {
    fn new(assembly: Assembly<'a>, solver: &InTime) -> Self {
        match *solver {
            InTime::Explicit(settings, rayleigh) => {
                let settings = explicit::Settings { damping: 0.0, scaled_inertia: false, ..settings };
                Mover::Explicit(Box::new(explicit::Simulation::of(assembly, settings).damped(rayleigh)))
            }
            InTime::Nonsmooth(settings) => {
                Mover::Nonsmooth(Box::new(nonsmooth::Simulation::of(assembly, settings)), settings.time_step)
            }
        }
    }

    fn assembly(&self) -> &Assembly<'a> {
        match self {
            Mover::Explicit(simulation) => &simulation.assembly,
            Mover::Nonsmooth(simulation, _) => &simulation.assembly,
        }
    }

    /// The acceleration of the base (m/s^2) that a step from a time (s) on takes: that of the moment where forces are taken at the positions of the moment, else
    /// the mean over the step.
    fn acceleration(&self, motion: &Motion, time: f64) -> Vec3 {
        match self {
            Mover::Explicit(_) => motion.acceleration(time),
            Mover::Nonsmooth(_, step) => (motion.velocity(time + step) - motion.velocity(time)) / *step,
        }
    }

    fn step(&mut self, gravity: Vec3, base: Vec3) -> Step {
        match self {
            Mover::Explicit(simulation) => {
                simulation.assembly.gravity = gravity - base;
                let seconds = simulation.dt;
                simulation.step();
                Step { seconds, is_solved: true, residual: 0.0, friction: 0.0 }
            }
            Mover::Nonsmooth(simulation, step) => {
                simulation.assembly.gravity = gravity - base;
                let stepped = simulation.step(*step);
                Step {
                    seconds: *step,
                    is_solved: stepped.is_solved,
                    residual: stepped.residual.natural_map,
                    friction: stepped.friction_work,
                }
            }
        }
    }
}
