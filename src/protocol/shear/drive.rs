//! The loop over the way of the jack.

use crate::model::{Level, Outcome};
use crate::protocol::mechanism::{Failure, FailureMode, failure, joint_states};
use crate::protocol::observe::{extent, movable};
use crate::protocol::shear::readings::{ShearMode, Sheared};
use crate::protocol::shear::settings::Shear;
use crate::protocol::task::{displacements, turns};
use crate::protocol::watch::Watch;
use crate::protocol::{LoadStep, Run, Task, Witness};
use crate::solve::bodies::Bodies;
use crate::solve::explicit::{self, Simulation};
use crate::solve::implicit::{self, Equilibrium};
use crate::solve::nonsmooth;
use crate::solve::{Assembly, Equilibrate, Settled, Status};

/// Time steps over which the jack goes from one level to the next. A jack that went at once would be a blow, under which joints
/// slip that would have held: with 0.1 mm at a time walls bore two thirds of what they bear.
const RAMP: u32 = 500;
/// The same with rigid blocks, whose steps are so much longer.
const STEPS_OF_RAMP: u32 = 20;
/// The jack aims so far (share of a step) beyond the drift at which it turns back, so that this is reached.
const BEYOND: f64 = 0.01;
/// A jack that has gone so many times as far as it should has a wall before it that does not move.
const MOST_WAY: f64 = 3.0;
/// How a wall is let go where Newton's method finds no equilibrium.
const LET_GO: explicit::Settings = explicit::Settings {
    unbalanced_ratio: 1e-6,
    damping: 0.8,
    step_safety: 0.5,
    max_steps: 200_000,
    scaled_inertia: true,
    longest_step: 1e-3,
};

/// A wall at rest under a solver that goes on from there.
enum Pushed<'a> {
    Implicit(Box<Equilibrium<'a>>),
    Explicit(Box<Assembly<'a>>, explicit::Settings),
    Nonsmooth(Box<nonsmooth::Simulation<'a>>),
}

impl<'a> Pushed<'a> {
    fn assembly(&self) -> &Assembly<'a> {
        match self {
            Pushed::Implicit(equilibrium) => equilibrium.assembly(),
            Pushed::Explicit(assembly, _) => assembly,
            Pushed::Nonsmooth(simulation) => simulation.assembly(),
        }
    }

    /// Goes on to another level of the jack.
    fn go(&self, task: &Task<'a>, [from, to]: [f64; 2], watch: &Watch) -> (Pushed<'a>, Settled) {
        let mut stop = |bodies: &Bodies| watch.runs_away(bodies);
        match self {
            Pushed::Explicit(assembly, settings) => {
                let (assembly, settled) = let_go(task, assembly, [from, to], *settings, &mut stop);
                (Pushed::Explicit(Box::new(assembly), *settings), settled)
            }
            Pushed::Nonsmooth(at_rest) => {
                let mut next = at_rest.clone();
                let ramp = if from == to { 0 } else { STEPS_OF_RAMP };
                for step in 1..=ramp {
                    let (gravity, factor) =
                        task.path.loads(from + (to - from) * f64::from(step) / f64::from(ramp));
                    next.set_loads(gravity, factor);
                    next.step_once();
                }
                let (gravity, factor) = task.path.loads(to);
                next.set_loads(gravity, factor);
                let settled = next.settle(&mut stop);
                (Pushed::Nonsmooth(next), Settled { steps: settled.steps + u64::from(ramp), ..settled })
            }
            Pushed::Implicit(at_rest) => {
                let mut next = at_rest.clone();
                let (gravity, factor) = task.path.loads(to);
                next.set_loads(gravity, factor);
                let settled = next.settle(&mut stop);
                if settled.status == Status::Equilibrium {
                    return (Pushed::Implicit(next), settled);
                }
                let (assembly, free) = let_go(task, at_rest.assembly(), [from, to], LET_GO, &mut stop);
                let steps = settled.steps + free.steps;
                let next = Box::new(at_rest.again(assembly));
                if free.status != Status::Equilibrium {
                    return (Pushed::Implicit(next), Settled { steps, ..free });
                }
                // Closer to the balance, if Newton's method finds it from there.
                let mut closer = next.clone();
                let settled = closer.settle(&mut stop);
                let steps = steps + settled.steps;
                match settled.status {
                    Status::Equilibrium => (Pushed::Implicit(closer), Settled { steps, ..settled }),
                    _ => (Pushed::Implicit(next), Settled { steps, ..free }),
                }
            }
        }
    }
}

/// Lets a wall at rest go, in time and damped, while the jack goes slowly from one level to another; it has stopped where it is
/// handed back.
fn let_go<'a>(
    task: &Task<'a>,
    at_rest: &Assembly<'a>,
    [from, to]: [f64; 2],
    settings: explicit::Settings,
    stop: &mut dyn FnMut(&Bodies) -> bool,
) -> (Assembly<'a>, Settled) {
    let mut simulation = Simulation::of(at_rest.clone(), settings);
    let set = |simulation: &mut Simulation<'a>, level: f64| {
        let (gravity, factor) = task.path.loads(level);
        simulation.set_loads(gravity, factor);
    };
    if from != to {
        for step in 1..=RAMP {
            set(&mut simulation, from + (to - from) * f64::from(step) / f64::from(RAMP));
            simulation.step();
        }
    }
    set(&mut simulation, to);
    let settled = simulation.settle(stop);
    let mut assembly = simulation.assembly;
    assembly.bodies.stop();
    (assembly, Settled { steps: settled.steps + if from != to { u64::from(RAMP) } else { 0 }, ..settled })
}

/// The jack as it stands: how far its beam has come (m), and its push (N).
fn at_jack(assembly: &Assembly<'_>) -> (f64, f64) {
    let (way, pull) = assembly.ties().first().map_or((0.0, 0.0), |jack| {
        let body = &assembly.bodies.all[jack.tie.body];
        (jack.displacement(body), jack.force(body, assembly.load_factor))
    });
    // Not the negative of 0.
    (way, 0.0 - pull)
}

/// How the solver begins.
pub enum Begin {
    /// By Newton's method.
    Implicit(implicit::Settings),
    /// In time.
    Explicit(explicit::Settings),
    /// In time, with rigid blocks.
    Nonsmooth(nonsmooth::Settings),
}

/// Takes a wall with its beam and jack, the first of the task's ties, along the history of a test.
pub fn push(task: &Task<'_>, shear: &Shear, begin: Begin, witness: Witness<'_>) -> Run {
    let built = task.assembled();
    let joints = built.joints.all.len();
    witness.begins(task, &built);
    let mut watch = Watch::new(task, &built.bodies);
    let start = match begin {
        Begin::Implicit(settings) => Pushed::Implicit(Box::new(Equilibrium::of(built.clone(), settings))),
        Begin::Explicit(settings) => Pushed::Explicit(Box::new(built.clone()), settings),
        Begin::Nonsmooth(settings) => {
            Pushed::Nonsmooth(Box::new(nonsmooth::Simulation::of(built.clone(), settings)))
        }
    };
    let (mut state, settled) = start.go(task, [0.0; 2], &watch);
    let mut test = Test { steps: Vec::new(), shear: *shear, zero: 0.0 };
    let mut outcome = ended(&settled, None);
    let mut at_rest = None;
    if outcome.is_none() {
        watch.begins(&state.assembly().bodies);
        test.zero = at_jack(state.assembly()).0;
        test.read(&state, &settled, &mut watch, witness);
        at_rest = Some(state.assembly().clone());
        outcome = test.along(task, &mut state, &mut watch, witness);
    } else {
        if outcome == Some(Outcome::UnstableAtRest) {
            witness.falls(task, &built, (0.0, 0.0), &watch);
        }
        test.read(&state, &settled, &mut watch, Witness::NOBODY);
    }
    let (now, before) = (state.assembly(), &built.bodies);
    let states = at_rest.as_ref().map_or_else(Vec::new, |rest| joint_states(now, &rest.bodies.all));
    let mode = ShearMode::of(test.turned(task, &now.bodies, at_rest.as_ref()), &states, section(task));
    let moved = at_rest.as_ref().filter(|_| test.steps.len() > 1).map(|rest| {
        let seen = failure(task.wall, rest, &rest.bodies.all, &now.bodies, task.path.direction());
        // Head joints slip as their stones turn: that is no sliding of the wall.
        let mode = if mode == ShearMode::Sliding { FailureMode::Sliding } else { FailureMode::Rocking };
        Failure { mode, ..seen }
    });
    let opening = states.iter().fold(0.0, |widest: f64, joint| widest.max(joint.opening));
    let read = moved.as_ref().and_then(|_| Sheared::of(&test.steps, shear.force_height, mode, opening));
    let after = &now.bodies.all;
    let moved_by = [displacements(after, &before.all, before), turns(after, &before.all, before)];
    Run {
        failure: moved,
        joint_states: states,
        shear: read,
        ..Run::ended(outcome.unwrap_or(Outcome::Equilibrium), test.steps, moved_by, joints)
    }
}

/// Length times thickness of the wall (m^2).
fn section(task: &Task<'_>) -> f64 {
    let (low, high) = extent(task.wall);
    (high.x - low.x) * (high.y - low.y)
}

/// How a test ends on a wall that did not come to rest; `None` of one that did. `borne` is the last drift at rest.
fn ended(settled: &Settled, borne: Option<f64>) -> Option<Outcome> {
    let at = Level::Drift(borne.unwrap_or(0.0));
    match settled.status {
        Status::Equilibrium => None,
        Status::Stopped if borne.is_none() => Some(Outcome::UnstableAtRest),
        Status::Stopped => Some(Outcome::Collapsed { at }),
        Status::StepsSpent | Status::NoEquilibrium => Some(Outcome::NotConverged {
            at,
            unbalanced_ratio: settled.unbalanced_ratio,
            why: "the wall did not come to rest in the steps that it had".to_owned(),
        }),
        Status::NonFinite => Some(Outcome::NonFinite { at }),
    }
}

/// A test under way.
struct Test {
    steps: Vec<LoadStep>,
    shear: Shear,
    /// Where the beam was (m) before it was pushed.
    zero: f64,
}

impl Test {
    /// The mean turn about y of the stones that have moved by half of what the drift is at their height or more, by their mass, over
    /// the drift; 0 where nothing has moved.
    fn turned(&self, task: &Task<'_>, now: &Bodies, at_rest: Option<&Assembly<'_>>) -> f64 {
        let Some((rest, last)) = at_rest.zip(self.steps.last()) else { return 0.0 };
        let (drift, before) = (last.level.value(), &rest.bodies.all);
        let moved = displacements(&now.all, before, now);
        let turns = turns(&now.all, before, now);
        let (far, foot) = (0.5 * drift.abs(), extent(task.wall).0.z);
        let (mut turn, mut mass) = (0.0, 0.0);
        for (id, block) in movable(task.wall) {
            let height = now.centroid_in(before, id).z + now.origin.z - foot;
            if moved[id].x.abs() >= far * height && drift != 0.0 {
                let own = block.mass();
                turn += own * turns[id].y / drift;
                mass += own;
            }
        }
        if mass > 0.0 { turn / mass } else { 0.0 }
    }

    /// Reads drift and push at a state at rest; the drift.
    fn read(
        &mut self,
        state: &Pushed<'_>,
        settled: &Settled,
        watch: &mut Watch,
        witness: Witness<'_>,
    ) -> f64 {
        let assembly = state.assembly();
        let (way, push) = at_jack(assembly);
        let drift = (way - self.zero) / self.shear.force_height;
        let level = Level::Drift(drift);
        witness.rests(level, assembly);
        let step = watch.read(&assembly.bodies, level, settled.unbalanced_ratio, settled.steps);
        self.steps.push(LoadStep { push: Some(push), ..step });
        watch.rests(&assembly.bodies);
        drift
    }

    /// Goes along the history; how it ends before its end, if it does. `state` is the last one at rest.
    fn along<'a>(
        &mut self,
        task: &Task<'a>,
        state: &mut Pushed<'a>,
        watch: &mut Watch,
        witness: Witness<'_>,
    ) -> Option<Outcome> {
        let Shear { step, history, .. } = self.shear;
        let (mut level, mut drift) = (0.0f64, 0.0f64);
        for turn in history.turns() {
            let way: f64 = if turn > drift { 1.0 } else { -1.0 };
            let furthest = MOST_WAY * (turn - drift).abs() + MOST_WAY * step;
            let began = level;
            loop {
                let left = way * (turn - drift);
                if left <= 0.0 {
                    break;
                }
                if (level - began).abs() > furthest {
                    return Some(Outcome::NotConverged {
                        at: Level::Drift(drift),
                        unbalanced_ratio: self.steps.last().map_or(0.0, |last| last.unbalanced_ratio),
                        why: "the wall is stiffer than the jack that should move it".to_owned(),
                    });
                }
                let next = level + way * f64::min(step, left + BEYOND * step);
                let (pushed, settled) = state.go(task, [level, next], watch);
                if let Some(end) = ended(&settled, Some(drift)) {
                    if matches!(end, Outcome::Collapsed { .. }) {
                        witness.falls(task, state.assembly(), (level, next), watch);
                    }
                    return Some(end);
                }
                *state = pushed;
                level = next;
                drift = self.read(state, &settled, watch, witness);
            }
        }
        None
    }
}
