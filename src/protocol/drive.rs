//! The loop over load steps, the same for every solver: apply, solve, observe; back and halve where no equilibrium is
//! found; confirm before a wall is called collapsed.

use crate::contact;
use crate::math::Vec3;
use crate::model::{JointLaws, Level, Outcome, Wall};
use crate::protocol::confirm::{Confirmation, Relaxed, relax, watch_fall};
use crate::protocol::mechanism::{Failure, JointState, joint_states};
use crate::protocol::path::LoadPath;
use crate::protocol::pressure::Load;
use crate::protocol::route::Route;
use crate::protocol::watch::{Criterion, LoadStep, Watch};
use crate::solve::bodies::Body;
use crate::solve::explicit::Simulation;
use crate::solve::implicit::Equilibrium;
use crate::solve::{Assembly, Equilibrate, Solver, Status, explicit};

/// A wall with all that surrounds it, its loads, and how far it is to be taken.
pub struct Task<'t> {
    /// The blocks, supports included.
    pub wall: &'t Wall,
    /// Laws of all joints.
    pub laws: &'t dyn JointLaws,
    /// Tolerances of contact detection.
    pub contact: contact::Settings,
    /// Dead loads, on the wall as built; from then on each moves with its block.
    pub loads: Vec<Load>,
    /// The load path.
    pub path: LoadPath,
    /// When a wall counts as running away.
    pub criterion: Criterion,
    /// How a suspected collapse is confirmed; without it the wall is then not converged.
    pub confirmation: Option<Confirmation>,
}

/// How the evaluation of one wall went.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// How it ended; a collapse is stated at the last level borne.
    pub outcome: Outcome,
    /// For a collapse after the first level: the last level borne and the lowest one at which the wall falls (SI units).
    pub bracket: Option<[f64; 2]>,
    /// One entry per level at which the wall came to rest, gravity alone first, and one for the level at which it did not.
    pub steps: Vec<LoadStep>,
    /// Displacement of every block's centroid (m) from its position as built, by block id: at the last state at rest, or
    /// where it was left if it never came to rest.
    pub displacements: Vec<Vec3>,
    /// Number of joints found as built.
    pub joints: usize,
    /// The mechanism of a collapse.
    pub failure: Option<Failure>,
    /// The joints at the last state at rest; empty if there was none.
    pub joint_states: Vec<JointState>,
}

/// Takes an assembly along a load path with the solver asked for.
pub fn drive(task: &Task<'_>, solver: &Solver) -> Run {
    match solver {
        Solver::Explicit(settings) => {
            climb(task, Stops::Falling, &|assembly| Simulation::of(assembly, *settings))
        }
        Solver::Implicit(settings) => {
            climb(task, Stops::Jumping, &|assembly| Equilibrium::of(assembly, *settings))
        }
    }
}

/// What it means when a wall is stopped for having moved past the criterion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stops {
    /// The solver follows the wall's motion: it was seen falling.
    Falling,
    /// The solver went to an equilibrium far away, which nobody has seen the wall reach.
    Jumping,
}

/// Takes an assembly along a load path. `of` makes a solver of an assembly as it stands.
///
/// Goes up by full steps. Where no equilibrium is found, or the wall moves past the criterion, it goes back to the last state
/// at rest and halves the step until the capacity is bracketed. A wall that was seen falling at the last, shortest step has
/// collapsed; one for which the solver found no equilibrium nearby is suspected of it, and is relaxed explicitly from the last
/// state at rest: it runs away (collapsed), comes to rest (the solver goes on from there) or does neither (not converged).
pub fn climb<'a, S: Equilibrate>(task: &Task<'a>, stops: Stops, of: &dyn Fn(Assembly<'a>) -> S) -> Run {
    let built = task.assembled();
    let joints = built.joints.all.len();
    let watch = Watch::new(task.wall, &built.bodies, task.path.direction(), task.criterion);
    let mut climber = Climber { task, stops, of, watch, built, steps: Vec::new(), spent: 0, wrong: 0 };
    let start = of(climber.built.clone());
    let tried = climber.try_level(&start, 0.0);
    let mut rest = match climber.settled(&start, 0.0, tried) {
        Ok(rest) => rest,
        Err(end) => return climber.never_at_rest(end, joints),
    };
    let at_rest = rest.assembly().bodies.all.clone();
    let mut route = Route::new(task.path);
    let (mut outcome, mut bracket, mut failure) = (Outcome::Equilibrium, None, None);
    while let Some(place) = route.next() {
        let level = task.path.after(place);
        let tried = climber.try_level(&rest, level);
        let is_final = !matches!(tried, Tried::Rest(..)) && route.failed(place);
        if !is_final && !matches!(tried, Tried::Rest(..) | Tried::NonFinite(..)) {
            continue;
        }
        match climber.settled(&rest, level, tried) {
            Ok(next) => {
                rest = next;
                route.borne(place);
            }
            Err(end) => {
                let last = climber.last_borne();
                outcome = end.outcome(task.path.level(last), task.path.level(level));
                bracket = matches!(outcome, Outcome::Collapsed { .. }).then_some([last, level]);
                climber.steps.push(end.step);
                failure = end.failure;
                break;
            }
        }
    }
    let assembly = rest.assembly();
    Run {
        outcome,
        bracket,
        steps: climber.steps,
        displacements: displacements(&assembly.bodies.all, &climber.built.bodies.all),
        joints,
        failure,
        joint_states: joint_states(assembly, &at_rest),
    }
}

impl<'t> Task<'t> {
    /// The assembly as built, with its loads.
    pub(crate) fn assembled(&self) -> Assembly<'t> {
        let mut built = Assembly::new(self.wall, self.laws, self.contact);
        for load in &self.loads {
            built.add_load(load.block, load.point, load.force);
        }
        built
    }
}

struct Climber<'c, 'a, S> {
    task: &'c Task<'a>,
    stops: Stops,
    of: &'c dyn Fn(Assembly<'a>) -> S,
    watch: Watch,
    /// The assembly as built, with its loads.
    built: Assembly<'a>,
    steps: Vec<LoadStep>,
    /// Solver steps since the last entry of `steps`.
    spent: u64,
    /// Suspicions that proved wrong.
    wrong: u32,
}

/// What came of trying a level.
enum Tried<S> {
    Rest(S, f64),
    Away(S, f64),
    Lost(S, f64, Status),
    NonFinite(S),
}

/// Why the climb ends below the end of the path.
struct End {
    why: Why,
    step: LoadStep,
    failure: Option<Failure>,
    /// Where the bodies were left.
    bodies: Vec<Body>,
}

enum Why {
    Fell,
    Lost { unbalanced_ratio: f64, why: String },
    NonFinite,
}

impl End {
    fn outcome(&self, borne: Level, failed: Level) -> Outcome {
        match &self.why {
            Why::Fell => Outcome::Collapsed { at: borne },
            Why::Lost { unbalanced_ratio, why } => {
                Outcome::NotConverged { at: failed, unbalanced_ratio: *unbalanced_ratio, why: why.clone() }
            }
            Why::NonFinite => Outcome::NonFinite { at: failed },
        }
    }
}

impl<'a, S: Equilibrate> Climber<'_, 'a, S> {
    /// Tries a level from a state, which stays as it is.
    fn try_level(&mut self, from: &S, level: f64) -> Tried<S> {
        let mut next = from.clone();
        let (gravity, factor) = self.task.path.loads(level);
        next.set_loads(gravity, factor);
        let settled = next.settle(&mut |bodies| self.watch.runs_away(bodies));
        self.spent += settled.steps;
        let ratio = settled.unbalanced_ratio;
        match settled.status {
            Status::Equilibrium => Tried::Rest(next, ratio),
            Status::Stopped if self.stops == Stops::Falling => Tried::Away(next, ratio),
            Status::Stopped | Status::StepsSpent | Status::NoEquilibrium => {
                Tried::Lost(next, ratio, settled.status)
            }
            Status::NonFinite => Tried::NonFinite(next),
        }
    }

    /// What a trial means when its step cannot be shortened: a state at rest, or the end.
    fn settled(&mut self, from: &S, level: f64, tried: Tried<S>) -> Result<S, End> {
        match tried {
            Tried::Rest(next, ratio) => {
                self.read(next.assembly(), level, ratio);
                Ok(next)
            }
            Tried::Away(next, ratio) => {
                let settings = explicit::Settings { damping: 0.0, ..explicit::Settings::default() };
                let simulation = Simulation::of(next.assembly().clone(), settings);
                Err(self.fell(from, simulation, level, ratio))
            }
            Tried::Lost(next, ratio, status) => self.confirm(from, next, level, ratio, status),
            Tried::NonFinite(next) => Err(self.ended(Why::NonFinite, next.assembly(), level, f64::NAN)),
        }
    }

    /// Finds out by explicit relaxation what a solver that found no equilibrium means.
    fn confirm(&mut self, from: &S, next: S, level: f64, ratio: f64, status: Status) -> Result<S, End> {
        let lost = |why: &str, unbalanced_ratio| Why::Lost { unbalanced_ratio, why: why.to_string() };
        let words = match status {
            Status::StepsSpent => "the steps ran out",
            _ => "no equilibrium was found, and no collapse confirmed",
        };
        let Some(confirmation) = self.task.confirmation else {
            return Err(self.ended(lost(words, ratio), next.assembly(), level, ratio));
        };
        if self.wrong >= confirmation.at_most {
            let why = format!("{words}: the wall kept coming to rest where the solver found no equilibrium");
            return Err(self.ended(lost(&why, ratio), next.assembly(), level, ratio));
        }
        let loads = self.task.path.loads(level);
        let (relaxed, steps) = relax(from.assembly(), loads, &confirmation, &self.watch);
        self.spent += steps;
        match relaxed {
            Relaxed::Rest(simulation, ratio) => {
                self.wrong += 1;
                let mut assembly = self.built.clone();
                assembly.gravity = simulation.assembly.gravity;
                assembly.load_factor = simulation.assembly.load_factor;
                assembly.bodies = simulation.assembly.bodies;
                assembly.joints = simulation.assembly.joints;
                assembly.refresh();
                self.read(&assembly, level, ratio);
                Ok((self.of)(assembly))
            }
            Relaxed::Away(simulation, ratio) => Err(self.fell(from, simulation, level, ratio)),
            Relaxed::Neither(simulation, ratio) => {
                let why = format!("{words}: relaxation neither came to rest nor ran away");
                Err(self.ended(lost(&why, ratio), &simulation.assembly, level, ratio))
            }
            Relaxed::NonFinite(simulation) => {
                Err(self.ended(Why::NonFinite, &simulation.assembly, level, f64::NAN))
            }
        }
    }

    /// The end of a wall that runs away, with its mechanism.
    fn fell(&mut self, from: &S, simulation: Simulation<'_>, level: f64, ratio: f64) -> End {
        let mut end = self.ended(Why::Fell, &simulation.assembly, level, ratio);
        let towards = self.task.path.direction();
        end.failure = Some(watch_fall(self.task.wall, from.assembly(), simulation, &self.watch, towards));
        end
    }

    fn ended(&mut self, why: Why, assembly: &Assembly<'_>, level: f64, ratio: f64) -> End {
        let level = self.task.path.level(level);
        let step = self.watch.read(&assembly.bodies, level, ratio, std::mem::take(&mut self.spent));
        End { why, step, failure: None, bodies: assembly.bodies.all.clone() }
    }

    /// Notes what is read at a state at rest. Displacements of the first one are taken from there on.
    fn read(&mut self, assembly: &Assembly<'_>, level: f64, ratio: f64) {
        if self.steps.is_empty() {
            self.watch.begins(&assembly.bodies);
        }
        let level = self.task.path.level(level);
        let step = self.watch.read(&assembly.bodies, level, ratio, std::mem::take(&mut self.spent));
        self.steps.push(step);
        self.watch.rests(&assembly.bodies);
    }

    /// The last level at which the wall came to rest.
    fn last_borne(&self) -> f64 {
        self.steps.last().map_or(0.0, |step| step.level.value())
    }

    /// The run of a wall that never came to rest.
    fn never_at_rest(mut self, end: End, joints: usize) -> Run {
        let zero = self.task.path.level(0.0);
        let outcome = match end.why {
            Why::Fell => Outcome::UnstableAtRest,
            _ => end.outcome(zero, zero),
        };
        self.steps.push(end.step);
        Run {
            outcome,
            bracket: None,
            steps: self.steps,
            displacements: displacements(&end.bodies, &self.built.bodies.all),
            joints,
            failure: end.failure,
            joint_states: Vec::new(),
        }
    }
}

/// Displacement of every body's centroid (m).
pub(crate) fn displacements(now: &[Body], built: &[Body]) -> Vec<Vec3> {
    now.iter().zip(built).map(|(now, built)| now.position - built.position).collect()
}
