//! The loop over load steps, the same for every solver: apply, solve, observe; back and halve where no equilibrium is
//! found; confirm before a wall is called collapsed.

use crate::model::{Level, Outcome};
use crate::protocol::back::back_to_0;
use crate::protocol::confirm::{Fall, Judge, Told, watch_fall};
use crate::protocol::fallen::has_fallen;
use crate::protocol::kept::keeps_contacts;
use crate::protocol::mechanism::{Failure, failure, joint_states};
use crate::protocol::pace::Pace;
use crate::protocol::rigid::rigid;
use crate::protocol::route::Route;
use crate::protocol::settlement::settle_supports;
use crate::protocol::task::{displacements, turns};
use crate::protocol::undecided::left_open;
use crate::protocol::watch::{Criterion, LoadStep, Watch};
use crate::protocol::{Run, Task, Witness};
use crate::solve::bodies::Body;
use crate::solve::explicit::Simulation;
use crate::solve::implicit::{self, Equilibrium};
use crate::solve::nonsmooth;
use crate::solve::{Ahead, Assembly, Equilibrate, Followed, Solver, Status, Way};

/// Takes an assembly along a load path with the solver asked for.
pub fn drive(task: &Task<'_>, solver: &Solver) -> Run {
    drive_seen_by(task, solver, Witness::NOBODY)
}

/// [`drive`], with somebody who sees how it goes.
pub fn drive_seen_by(task: &Task<'_>, solver: &Solver, witness: Witness<'_>) -> Run {
    match solver {
        Solver::Explicit(settings) => {
            // What a service load does is answered by this solver alone.
            let suspects = task.path.bracket.is_finite();
            let of = |assembly| {
                let simulation = Simulation::of(assembly, *settings);
                if suspects { simulation.suspected_soon() } else { simulation }
            };
            climb_seen_by(task, &of, witness)
        }
        Solver::Implicit(settings) => {
            // A path that brackets a collapse halves its steps itself; twice costs half as much again and gains nothing.
            let brackets = task.path.bracket.is_finite();
            let max_halvings = if brackets { 0 } else { settings.max_halvings };
            let of = |assembly| Equilibrium::of(assembly, implicit::Settings { max_halvings, ..*settings });
            climb_seen_by(task, &of, witness)
        }
        Solver::Nonsmooth(settings) => {
            let run =
                climb_seen_by(task, &|assembly| nonsmooth::Simulation::of(assembly, *settings), witness);
            Run { undecided: settings.is_rigid().then(|| left_open(task, &run)).flatten(), ..run }
        }
        Solver::Limit(settings) => rigid(task, *settings, witness),
    }
}

/// Takes an assembly along a load path. `of` makes a solver of an assembly as it stands.
///
/// Goes up by full steps. Where no equilibrium is found, or the wall moves past the criterion, it goes back to the last state
/// at rest and halves the step until the capacity is bracketed. A wall that moves past the criterion falls. A solver that
/// finds no equilibrium only suspects a fall: at the first suspicion it is confirmed there, by limit analysis or by explicit
/// relaxation, before the step is halved; a wall that comes to rest after all goes on from there. At the shortest step
/// relaxation is asked again, unless limit analysis has shown that the fall is near and the wall has become so soft that
/// this is the limit point of its path; a doubt that stays widens the bracket up to where the fall is certain.
pub fn climb<'a, S: Equilibrate<'a>>(task: &Task<'a>, of: &dyn Fn(Assembly<'a>) -> S) -> Run {
    climb_seen_by(task, of, Witness::NOBODY)
}

fn climb_seen_by<'a, S: Equilibrate<'a>>(
    task: &Task<'a>,
    of: &dyn Fn(Assembly<'a>) -> S,
    witness: Witness<'_>,
) -> Run {
    let built = task.assembled();
    let joints = built.joints.all.len();
    witness.begins(task, &built);
    let watch = Watch::new(task, &built.bodies);
    let judge = Judge::new(task);
    let steps = Vec::new();
    let mut climber = Climber {
        task,
        of,
        witness,
        watch,
        judge,
        built,
        steps,
        spent: 0,
        relaxed: 0,
        doubted: false,
        followed: 0,
        certain: None,
        pace: Pace::default(),
    };
    let start = of(climber.built.clone());
    let mut rest = match climber.try_level(&start, 0.0) {
        Tried::Rest(next, ratio) => climber.read(next, 0.0, ratio),
        tried => match climber.judged(&start, 0.0, tried, true) {
            Verdict::Rest(next, _) => next,
            Verdict::GoBack => return climber.never_at_rest(None, joints),
            Verdict::Turns(_, end) | Verdict::End(end) => return climber.never_at_rest(Some(*end), joints),
        },
    };
    let at_rest = rest.assembly().bodies.all.clone();
    let mut route = Route::new(task.path);
    let (mut outcome, mut bracket, mut failure) = (Outcome::Equilibrium, None, None);
    let mut settled_joints = Vec::new();
    if !task.changes.settlements.is_empty() {
        let settled = settle_supports(task, (of, &climber.judge), &mut climber.watch, rest);
        climber.spent += settled.spent;
        rest = settled.rest;
        if let Some((failed, told)) = settled.ended {
            climber.falls_settling(rest.assembly(), (settled.share, failed), &told);
            let end = climber.ended_settling(rest.assembly(), failed, told);
            outcome = end.outcome(Level::Settlement(settled.share), Level::Settlement(failed));
            climber.steps.push(end.step);
            failure = end.failure;
        } else {
            climber.witness.rests(Level::Settlement(1.0), rest.assembly());
            settled_joints = joint_states(rest.assembly(), &at_rest);
        }
    }
    while outcome == Outcome::Equilibrium
        && let Some(place) = route.next()
    {
        let level = task.path.after(place);
        let tried = climber.try_level(&rest, level);
        if let Tried::Rest(next, ratio) = tried {
            rest = climber.read(next, level, ratio);
            route.borne(place);
            continue;
        }
        let is_final = route.failed(place);
        match climber.judged(&rest, level, tried, is_final) {
            Verdict::GoBack => {}
            Verdict::Rest(next, steps_further) => {
                rest = next;
                route.borne(place + steps_further);
            }
            Verdict::Turns(next, end) => {
                let last = climber.last_borne();
                (outcome, bracket) =
                    (Outcome::Collapsed { at: task.path.level(last) }, Some([last, end.step.level.value()]));
                rest = next;
                climber.steps.push(end.step);
                failure = end.failure;
                break;
            }
            Verdict::End(end) => {
                let last = climber.last_borne();
                let failed = end.step.level;
                outcome = end.outcome(task.path.level(last), failed);
                bracket = matches!(outcome, Outcome::Collapsed { .. }).then_some([last, failed.value()]);
                climber.steps.push(end.step);
                failure = end.failure;
                break;
            }
        }
    }
    let assembly = rest.assembly();
    if let Some([last, failed]) = bracket {
        witness.falls(task, assembly, (last, failed), &climber.watch);
    }
    let (now, built) = (&assembly.bodies.all, &climber.built.bodies);
    let moved = [displacements(now, &built.all, built), turns(now, &built.all, built)];
    Run {
        bracket,
        failure,
        joint_states: joint_states(assembly, &at_rest),
        settled_joints,
        ..Run::ended(outcome, climber.steps, moved, joints)
    }
}

struct Climber<'c, 'a, S> {
    task: &'c Task<'a>,
    of: &'c dyn Fn(Assembly<'a>) -> S,
    witness: Witness<'c>,
    watch: Watch,
    judge: Judge<'c, 'a>,
    /// The assembly as built, with its loads.
    built: Assembly<'a>,
    steps: Vec<LoadStep>,
    /// Solver steps since the last entry of `steps`.
    spent: u64,
    /// Time steps spent on suspicions that proved wrong.
    relaxed: u64,
    /// Whether a level was borne that the solver had not found by itself.
    doubted: bool,
    /// How often the path has been followed.
    followed: u32,
    /// The lowest level at which the wall is certain to fall.
    certain: Option<Fall<'a>>,
    pace: Pace,
}

/// What came of trying a level.
enum Tried<S> {
    Rest(S, f64),
    Away(S, f64),
    Lost(S, f64, Status),
    NonFinite(S),
}

/// What a trial that did not end at rest means.
enum Verdict<S> {
    /// Try nearer to the last state at rest.
    GoBack,
    /// The wall is at rest after all, so many full steps further up.
    Rest(S, f64),
    /// The climb ends at a limit point, and this is the last state at rest.
    Turns(S, Box<End>),
    /// The climb ends here.
    End(Box<End>),
}

/// Time steps of a block that may be spent on suspicions that prove wrong before the solver is called lost: of a wall of 72
/// stones, twenty relaxations to their last step.
const MOST_RELAXED: u64 = 30_000_000;
/// A wall that bears so much of its weight sideways (rad of tilt, or a multiplier) is rare enough for limit analysis to be asked.
const RARE: f64 = 0.5;
/// The path of equilibria is followed so often: where it is lost, it is so again from nearby.
const MOST_FOLLOWED: u32 = 3;
/// A fall is followed for this share of how far a wall goes that runs away.
const FOLLOWED: f64 = 0.5;
/// So many full steps above a suspicion a fall is looked for, when it cannot be told there; and up to which of them a wall that
/// comes to rest there is taken to stand.
const STEPS_ABOVE: [u32; 7] = [0, 1, 2, 4, 8, 16, 32];
const STANDS_ABOVE: u32 = 4;

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

impl<'a, S: Equilibrate<'a>> Climber<'_, 'a, S> {
    /// Tries a level from a state, which stays as it is.
    fn try_level(&mut self, from: &S, level: f64) -> Tried<S> {
        let mut next = from.clone();
        self.task.changes.apply(next.assembly_mut(), self.last_borne(), level);
        let (gravity, factor) = self.task.path.loads(level);
        next.set_loads(gravity, factor);
        let settled = next.settle(&mut |bodies| self.watch.runs_away(bodies));
        self.spent += settled.steps;
        let ratio = settled.unbalanced_ratio;
        let is_doubtful = settled.status == Status::Equilibrium
            && !self.has_fallen(from, next.assembly(), level)
            && (self.is_doubtful(from, &next, level) || self.bears_too_much(from, level));
        match settled.status {
            Status::Equilibrium if is_doubtful => Tried::Lost(next, ratio, Status::NoEquilibrium),
            Status::Equilibrium if self.has_fallen(from, next.assembly(), level) => Tried::Away(next, ratio),
            Status::Equilibrium => Tried::Rest(next, ratio),
            Status::Stopped => Tried::Away(next, ratio),
            Status::StepsSpent | Status::NoEquilibrium => Tried::Lost(next, ratio, settled.status),
            Status::NonFinite => Tried::NonFinite(next),
        }
    }

    /// What a trial means that did not end at rest; `is_final` when its step cannot be shortened.
    fn judged(&mut self, from: &S, level: f64, tried: Tried<S>, is_final: bool) -> Verdict<S> {
        match tried {
            Tried::Rest(next, ratio) => Verdict::Rest(self.read(next, level, ratio), 0.0),
            Tried::Away(next, ratio) if is_final => {
                let away = next.assembly().clone();
                let fall = self.judge.fall(from.assembly(), away, &self.watch, level, ratio);
                let failure = match next.follows_falls() {
                    true => watch_fall(self.task, from.assembly(), next.clone(), &self.watch),
                    false => self.judge.failure(&fall, &self.watch),
                };
                self.ended(Why::Fell, next.assembly(), level, ratio, Some(failure))
            }
            Tried::Away(..) => Verdict::GoBack,
            Tried::Lost(next, ratio, status) => self.suspected(from, next, level, (ratio, status), is_final),
            Tried::NonFinite(next) => self.ended(Why::NonFinite, next.assembly(), level, f64::NAN, None),
        }
    }

    /// What it means that the solver found no equilibrium.
    fn suspected(
        &mut self,
        from: &S,
        next: S,
        level: f64,
        (ratio, status): (f64, Status),
        is_final: bool,
    ) -> Verdict<S> {
        let words = match status {
            Status::StepsSpent => "the steps ran out",
            _ => "no equilibrium was found",
        };
        let lost = |climber: &mut Self, why: &str| {
            let block = next.assembly().most_unbalanced();
            let place =
                block.map_or(String::new(), |(id, force)| format!(", worst at block {id} ({force:.1e} N)"));
            let why = Why::Lost { unbalanced_ratio: ratio, why: format!("{words}{place}: {why}") };
            climber.ended(why, next.assembly(), level, ratio, None)
        };
        if status == Status::StepsSpent && self.task.path.bracket.is_infinite() {
            return lost(self, "a service load is no question of collapse");
        }
        let blocks = next.assembly().bodies.all.len() as u64;
        let is_lost = self.relaxed * blocks >= MOST_RELAXED
            && self.judge.cannot_stand(from.assembly(), level, &self.watch).is_none();
        if is_lost {
            return lost(self, "the wall kept coming to rest where the solver had lost it");
        }
        if self.task.path.bracket.is_finite()
            && self.followed < MOST_FOLLOWED
            && let Some(verdict) = self.follow(from, level)
        {
            return verdict;
        }
        let first = self.certain.is_none();
        if !first && !is_final {
            return Verdict::GoBack;
        }
        // The pace speaks for a limit point only where one is certain to be near; what fell after a whole step may have been
        // thrown off its balance by it.
        if self.pace.is_at_limit() && self.certain.as_ref().is_some_and(|fall| fall.by_bound) {
            return self.fell(level, ratio);
        }
        let before = self.spent;
        for further in STEPS_ABOVE.into_iter().take(if first { STEPS_ABOVE.len() } else { 1 }) {
            let at = self.task.path.higher(level, further);
            let way = (self.last_borne(), at);
            match self.judge.told(from.assembly(), way, &self.watch, is_final, &mut self.spent) {
                Told::Falls(fall) => {
                    self.certain = Some(*fall);
                    return match is_final {
                        true => self.fell(at, ratio),
                        false => Verdict::GoBack,
                    };
                }
                // Where it has come to rest beyond the criterion, or elsewhere, it has fallen there.
                Told::Rests(assembly, ratio) if !self.comes_to(from, &assembly) => {
                    let fall = self.judge.fall(from.assembly(), *assembly, &self.watch, at, ratio);
                    self.certain = Some(fall);
                    return match is_final {
                        true => self.fell(at, ratio),
                        false => Verdict::GoBack,
                    };
                }
                Told::Rests(..) if further > STANDS_ABOVE => {}
                Told::Rests(assembly, ratio) => {
                    self.relaxed += self.spent - before;
                    self.doubted = true;
                    let next = (self.of)(*assembly);
                    return Verdict::Rest(self.read(next, at, ratio), f64::from(further));
                }
                Told::NonFinite(assembly) => {
                    return self.ended(Why::NonFinite, &assembly, at, f64::NAN, None);
                }
                Told::Nothing => {}
            }
        }
        match &self.certain {
            // In doubt here, certain further up.
            Some(fall) => self.fell(fall.level, ratio),
            None => lost(self, "neither limit analysis nor relaxation told whether it stands"),
        }
    }

    /// Whether a block has come to rest fallen: it toppled or left its bearing on the way, and lies. What carried a block that is lost may drop.
    fn has_fallen(&self, from: &S, rest: &Assembly<'_>, level: f64) -> bool {
        let loses = self.task.changes.loses(self.last_borne(), level);
        !loses && has_fallen(self.task.wall, from.assembly(), rest)
    }

    /// Whether a state at rest may be another equilibrium than the one that the wall comes to: a block has lost its contacts, or
    /// moved further than contacts are looked for and far out of pace.
    fn is_doubtful(&self, from: &S, next: &S, level: f64) -> bool {
        let moved = self.watch.moved(&next.assembly().bodies);
        let leapt = moved > self.task.contact.reach && self.pace.is_leap(level, moved);
        let loses = self.task.changes.loses(self.last_borne(), level);
        (leapt && !loses) || !keeps_contacts(from.assembly(), next.assembly())
    }

    /// Whether a state at rest is one that the wall comes to from the last one: no block has moved past the criterion, none has
    /// lost its contacts or fallen.
    fn comes_to(&self, from: &S, rest: &Assembly<'_>) -> bool {
        !self.watch.runs_away(&rest.bodies)
            && keeps_contacts(from.assembly(), rest)
            && !has_fallen(self.task.wall, from.assembly(), rest)
    }

    /// Whether a wall at rest at a level bears more there than limit analysis says that it can: asked where the solver was in
    /// doubt on the way, or where few walls come.
    fn bears_too_much(&self, from: &S, level: f64) -> bool {
        // Below by the width of a bracket: at the limit itself rounding decides.
        let below = level - self.task.path.bracket;
        (self.doubted || level > RARE)
            && below > 0.0
            && self.judge.cannot_stand(from.assembly(), below, &self.watch).is_some()
    }

    /// What following the path of equilibria from the last state at rest tells of a level where none was found: it may reach
    /// that level after all, or turn below it.
    fn follow(&mut self, from: &S, level: f64) -> Option<Verdict<S>> {
        self.followed += 1;
        let path = self.task.path;
        let (Criterion::AnyBlock(far) | Criterion::Top(far)) = self.task.criterion;
        let loads = |level| path.loads(level);
        let last = self.last_borne();
        let far = FOLLOWED * far;
        let ahead = Ahead { loads: &loads, from: last, to: level, far, bracket: path.bracket };
        let changes = &self.task.changes;
        if changes.loses(last, level) {
            // What is lost on the way is there below and gone above.
            return None;
        }
        let crept = changes.creep.is_some().then(|| {
            let mut crept = from.clone();
            changes.apply(crept.assembly_mut(), last, level);
            let settled = crept.settle(&mut |_| false);
            self.spent += settled.steps;
            (settled.status == Status::Equilibrium).then_some(crept)
        });
        let from = match &crept {
            Some(crept) => crept.as_ref()?,
            None => from,
        };
        let Followed { rest, level: highest, ratio, steps, way } = from.follow(&ahead)?;
        self.spent += steps;
        match way {
            // More than rigid blocks on these joints bear, or a state that this wall does not come to: the path was lost.
            Way::Stands if !self.comes_to(from, rest.assembly()) => None,
            Way::Stands if self.judge.cannot_stand(from.assembly(), highest, &self.watch).is_some() => None,
            Way::Stands => {
                self.doubted = true;
                if rest.assembly().joints.close_softly() {
                    // A path that was found says nothing of where it is lost: of such walls it is asked for more often.
                    self.followed -= 1;
                }
                let further = (highest - level) / path.higher(0.0, 1);
                Some(Verdict::Rest(self.read(rest, highest, ratio), further))
            }
            Way::Falls { above, bodies, ratio: left, .. } => {
                let at_rest = rest.assembly();
                let before = &at_rest.bodies.all;
                let failure = failure(self.task.wall, at_rest, before, &bodies, path.direction());
                let step = self.watch.read(&bodies, path.level(above), left, 0);
                let rest = if highest > last { self.read(rest, highest, ratio) } else { rest };
                let end = End { why: Why::Fell, step, failure: Some(failure), bodies: bodies.all };
                Some(Verdict::Turns(rest, Box::new(end)))
            }
        }
    }

    /// The end of a wall that falls at a level, as it was seen to fall.
    fn fell(&mut self, level: f64, ratio: f64) -> Verdict<S> {
        let Some(fall) = self.certain.take() else { return Verdict::GoBack };
        let failure = Some(self.judge.failure(&fall, &self.watch));
        let spent = std::mem::take(&mut self.spent);
        let step = LoadStep {
            level: self.task.path.level(level),
            unbalanced_ratio: ratio,
            solver_steps: spent,
            ..fall.step
        };
        let bodies = fall.away.bodies.all;
        Verdict::End(Box::new(End { why: Why::Fell, step, failure, bodies }))
    }

    /// Shows how a wall falls whose supports go on from one share of their way to another one.
    fn falls_settling(&self, rest: &Assembly<'a>, (share, failed): (f64, f64), told: &Told<'_>) {
        if !matches!(told, Told::Falls(_)) {
            return;
        }
        let mut lowered = rest.clone();
        let settlements = &self.task.changes.settlements;
        let down: Vec<(usize, f64)> =
            settlements.iter().map(|of| (of.block, (failed - share) * of.down)).collect();
        lowered.lower(&down);
        lowered.refresh();
        self.witness.falls(self.task, &lowered, (0.0, 0.0), &self.watch);
    }

    /// The end of a wall that came to no rest when its supports had gone a share of their way.
    fn ended_settling(&mut self, rest: &Assembly<'_>, share: f64, told: Told<'_>) -> End {
        let (why, assembly, ratio, failure) = match told {
            Told::Falls(fall) => {
                let failure = self.judge.failure(&fall, &self.watch);
                (Why::Fell, fall.away, fall.step.unbalanced_ratio, Some(failure))
            }
            Told::NonFinite(assembly) => (Why::NonFinite, *assembly, f64::NAN, None),
            Told::Rests(..) | Told::Nothing => {
                let why =
                    "no equilibrium was found, and relaxation did not tell whether it stands".to_owned();
                (Why::Lost { unbalanced_ratio: f64::NAN, why }, rest.clone(), f64::NAN, None)
            }
        };
        let spent = std::mem::take(&mut self.spent);
        let step = self.watch.read(&assembly.bodies, Level::Settlement(share), ratio, spent);
        End { why, step, failure, bodies: assembly.bodies.all }
    }

    fn ended(
        &mut self,
        why: Why,
        assembly: &Assembly<'_>,
        level: f64,
        ratio: f64,
        failure: Option<Failure>,
    ) -> Verdict<S> {
        let level = self.task.path.level(level);
        let step = self.watch.read(&assembly.bodies, level, ratio, std::mem::take(&mut self.spent));
        Verdict::End(Box::new(End { why, step, failure, bodies: assembly.bodies.all.clone() }))
    }

    /// Notes what is read at a state at rest. Displacements of the first one are taken from there on.
    fn read(&mut self, state: S, level: f64, ratio: f64) -> S {
        self.witness.rests(self.task.path.level(level), state.assembly());
        let bodies = &state.assembly().bodies;
        if self.steps.is_empty() {
            self.watch.begins(bodies);
        }
        let full_step = self.task.path.higher(0.0, 1);
        self.pace.note(level, self.watch.moved(bodies), full_step);
        // Where a step was halved the wall is near its end, from which nobody goes back.
        let full_steps = level / full_step;
        let goes_back =
            self.task.path.goes_back && level > 0.0 && (full_steps - full_steps.round()).abs() < 1e-9;
        let back = match goes_back {
            true => back_to_0(&state, level, &self.task.path, &mut self.spent),
            false => None,
        };
        let remainders = back.and_then(|back| self.watch.points(&back.assembly().bodies));
        let step =
            self.watch.read(bodies, self.task.path.level(level), ratio, std::mem::take(&mut self.spent));
        self.steps.push(LoadStep { remainders, ..step });
        self.watch.rests(bodies);
        if self.certain.as_ref().is_some_and(|fall| fall.level <= level) {
            self.certain = None;
        }
        state
    }

    /// The last level at which the wall came to rest.
    fn last_borne(&self) -> f64 {
        self.steps.last().map_or(0.0, |step| step.level.value())
    }

    /// The run of a wall that never came to rest.
    fn never_at_rest(mut self, end: Option<End>, joints: usize) -> Run {
        let zero = self.task.path.level(0.0);
        let (outcome, bodies, failure) = match end {
            Some(End { why: Why::Fell, bodies, step, failure }) => {
                self.witness.falls(self.task, &self.built, (0.0, 0.0), &self.watch);
                self.steps.push(step);
                (Outcome::UnstableAtRest, bodies, failure)
            }
            Some(end) => {
                let outcome = end.outcome(zero, zero);
                self.steps.push(end.step);
                (outcome, end.bodies, end.failure)
            }
            None => (Outcome::UnstableAtRest, self.built.bodies.all.clone(), None),
        };
        let built = &self.built.bodies;
        let moved = [displacements(&bodies, &built.all, built), turns(&bodies, &built.all, built)];
        Run { failure, ..Run::ended(outcome, self.steps, moved, joints) }
    }
}
