//! The loop over time.

use crate::math::Vec3;
use crate::motion::Motion;
use crate::protocol::Task;
use crate::protocol::base_motion::observe::{Observer, Shaken, Verdict};
use crate::protocol::base_motion::settings::{InTime, Shaking};
use crate::protocol::base_motion::settled::Settled;
use crate::protocol::observe::extent;
use crate::solve::bodies::Bodies;
use crate::solve::{Assembly, Equilibrate, STANDARD_GRAVITY, Status, explicit, nonsmooth};

/// Between two looks at a wall pass at least so many seconds.
const BETWEEN_LOOKS: f64 = 1e-3;
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

/// Shakes a wall. The task says what stands where; its load path plays no part.
pub fn shake(task: &Task<'_>, shaking: &Shaking) -> Shaken {
    Rested::of(task, shaking.fallen_moved, &shaking.solver).shaken(shaking)
}

/// Shakes a wall, and the same once more with stones that move by next to nothing at the start. Where the two come to different verdicts that of the first is
/// [`Verdict::Undecided`].
pub fn shake_twice(task: &Task<'_>, shaking: &Shaking) -> [Shaken; 2] {
    Rested::of(task, shaking.fallen_moved, &shaking.solver).shaken_twice(shaking)
}

/// A wall at rest under gravity, which any number of motions may begin at.
pub(super) struct Rested<'t> {
    task: &'t Task<'t>,
    /// Number of joints as built.
    pub joints: usize,
    /// Or why it is not at rest.
    assembly: Result<Assembly<'t>, Verdict>,
    /// How far it went from where it was built.
    settled: Option<Settled>,
}

impl<'t> Rested<'t> {
    /// By the solver that it is shaken with; `fallen_moved` as of [`Shaking`].
    pub fn of(task: &'t Task<'t>, fallen_moved: f64, solver: &InTime) -> Rested<'t> {
        let built = task.assembled();
        let (joints, from) = (built.joints.all.len(), built.bodies.clone());
        let assembly = at_rest(task, built, fallen_moved, solver);
        let settled = assembly.as_ref().ok().and_then(|rest| Settled::between(&from, &rest.bodies));
        Rested { task, joints, assembly, settled }
    }

    /// As of [`shake`].
    pub fn shaken(&self, shaking: &Shaking) -> Shaken {
        match &self.assembly {
            Ok(assembly) => {
                let seen = follow(self.task, shaking, assembly, assembly.clone());
                Shaken { settled: self.settled, ..seen }
            }
            Err(verdict) => Shaken { verdict: *verdict, ..Shaken::nothing_yet() },
        }
    }

    /// As of [`shake_twice`].
    pub fn shaken_twice(&self, shaking: &Shaking) -> [Shaken; 2] {
        let mut first = self.shaken(shaking);
        let Ok(assembly) = &self.assembly else { return [first.clone(), first] };
        let mut moved = assembly.clone();
        let mut sign = 1.0;
        for body in moved.bodies.all.iter_mut().filter(|body| body.moves()) {
            body.velocity = Vec3::new(0.0, PERTURBED * sign, 0.0);
            sign = -sign;
        }
        let second = Shaken { settled: self.settled, ..follow(self.task, shaking, assembly, moved) };
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
    fallen_moved: f64,
    solver: &InTime,
) -> Result<Assembly<'a>, Verdict> {
    let (gravity, _) = task.path.loads(0.0);
    built.gravity = gravity;
    built.load_factor = 1.0;
    let from: Vec<Vec3> = built.bodies.all.iter().map(|body| body.position).collect();
    let far = fallen_moved * thickness(task);
    let mut stop = |bodies: &Bodies| {
        bodies.all.iter().zip(&from).any(|(body, from)| (body.position - from).norm() > far)
    };
    let (settled, assembly) = match *solver {
        InTime::Explicit(settings, _) => {
            let mut simulation = explicit::Simulation::of(built, settings);
            (simulation.settle(&mut stop), simulation.assembly)
        }
        InTime::Nonsmooth(settings) => {
            let mut simulation = nonsmooth::Simulation::of(built, settings);
            (simulation.settle(&mut stop), simulation.assembly)
        }
    };
    match settled.status {
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

/// Thickness of the wall (m).
fn thickness(task: &Task<'_>) -> f64 {
    let (low, high) = extent(task.wall);
    high.y - low.y
}

/// Follows a wall from the beginning of the motion.
fn follow(task: &Task<'_>, shaking: &Shaking, at_rest: &Assembly<'_>, start: Assembly<'_>) -> Shaken {
    let limits = [shaking.fallen_moved, shaking.fallen_down];
    let mut observer = Observer::new(task.wall, at_rest, (thickness(task), limits), shaking.shares);
    let gravity = start.gravity;
    // The weight of all stones over that of one: of a natural map of 1, the weight of all was left over.
    let stones = start.bodies.all.iter().filter(|body| body.moves()).count() as f64;
    let mut mover = Mover::new(start, &shaking.solver);
    let motion = &shaking.motion;
    let (shakes, end) = (motion.duration(), motion.duration() + shaking.after);
    let mut before: Vec<Vec3> = Vec::new();
    let (mut time, mut looked, mut resting) = (0.0, 0.0, 0);
    let (mut steps, mut unsolved, mut base, mut weight, mut friction) = (0, 0, 0.0, 0.0, 0.0);
    let (mut largest_residual, mut left_over) = (0.0f64, 0.0);
    while time < end {
        let acceleration = mover.acceleration(motion, time);
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
            return Shaken { verdict: Verdict::NotSolved, time_s: time, steps, ..observer.seen };
        }
        observer.read(bodies, time);
        if observer.is_over() {
            break;
        }
        resting = if time > shakes && bodies.fastest() < RESTS { resting + 1 } else { 0 };
        if resting >= LOOKS_AT_REST {
            break;
        }
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
