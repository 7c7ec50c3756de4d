//! The tilting table: the platform turns about its edge towards a side, in steps or steadily.

use crate::model::Outcome;
use crate::protocol::fallen::has_fallen;
use crate::protocol::mechanism::joint_states;
use crate::protocol::path::LoadPath;
use crate::protocol::task::{displacements, turns};
use crate::protocol::watch::{Criterion, LoadStep, Watch};
use crate::protocol::{Run, Task, Tilting, Turning, Witness, confirm};
use crate::solve::explicit::{Settings, Simulation};
use crate::solve::{Assembly, Equilibrate, Status};

/// Time steps between two looks at a wall on a turning platform.
const STEPS_BETWEEN_LOOKS: u64 = 10;
/// A wall begins to fall when it has moved by this share of what counts as running away.
const BEGINS: f64 = 0.1;

impl Tilting {
    /// The load path of the static test.
    pub fn path(&self) -> LoadPath {
        let path = LoadPath::tilt(self.towards, self.step, self.end, self.bracket);
        LoadPath { goes_back: self.remainders, ..path }
    }
}

/// Turns the platform steadily, with `at_rest` as the settings that bring the wall to rest on the level platform.
///
/// A reading is taken at every step of the path. The wall has collapsed when some block has moved past the criterion since
/// the last reading; the collapse angle is the tilt at which it had gone a tenth of that way, and the bracket runs from
/// there to the tilt at which it had passed. A wall that takes its time to fall has been tilted further meanwhile: the
/// angle of a dynamic test lags behind the static one, the more so the faster the platform turns.
/// `witness` sees every reading.
pub fn turn(task: &Task<'_>, turning: &Turning, at_rest: Settings, witness: Witness<'_>) -> Run {
    let built = task.assembled();
    let joints = built.joints.all.len();
    witness.begins(task, &built);
    let mut watch = Watch::new(task, &built.bodies);
    let mut level = Simulation::of(built.clone(), at_rest);
    let settled = level.settle(&mut |bodies| watch.runs_away(bodies));
    let run = |outcome, steps, assembly: &Assembly<'_>| {
        let now = &assembly.bodies.all;
        let (before, bodies) = (&built.bodies.all, &built.bodies);
        let moved = [displacements(now, before, bodies), turns(now, before, bodies)];
        Run::ended(outcome, steps, moved, joints)
    };
    let at = task.path.level(0.0);
    let unbalanced_ratio = settled.unbalanced_ratio;
    let outcome = match settled.status {
        Status::Equilibrium => Outcome::Equilibrium,
        Status::Stopped => Outcome::UnstableAtRest,
        Status::StepsSpent | Status::NoEquilibrium => {
            Outcome::NotConverged { at, unbalanced_ratio, why: "the steps ran out".to_string() }
        }
        Status::NonFinite => Outcome::NonFinite { at },
    };
    let stands = outcome == Outcome::Equilibrium;
    if stands {
        witness.rests(at, &level.assembly);
        watch.begins(&level.assembly.bodies);
    }
    let first = watch.read(&level.assembly.bodies, at, unbalanced_ratio, settled.steps);
    if !stands {
        if outcome == Outcome::UnstableAtRest {
            witness.falls(task, &built, (0.0, 0.0), &watch);
        }
        return run(outcome, vec![first], &level.assembly);
    }
    let turned = Turned::new(task, turning, watch, &level.assembly).until_the_end(vec![first], witness);
    let mut ended = run(turned.outcome, turned.steps, &turned.last);
    ended.joint_states = joint_states(&turned.last, &level.assembly.bodies.all);
    ended.bracket = turned.bracket;
    if let Some(falling) = turned.falling {
        let simulation = Simulation::of(falling, turned.settings);
        if let Some(recorder) = witness.recorder {
            let at = ended.steps.last().map_or(0.0, |step| step.level.value());
            recorder.follows(task, simulation.clone(), at, &turned.watch);
        }
        let failure = confirm::watch_fall(task, &turned.last, simulation, &turned.watch);
        ended.failure = Some(failure);
    }
    ended
}

/// A platform that turns.
struct Turned<'t, 'a> {
    task: &'t Task<'a>,
    rate: f64,
    settings: Settings,
    watch: Watch,
    /// How far (m) a wall has moved that begins to fall.
    begins: f64,
    simulation: Simulation<'a>,
    outcome: Outcome,
    bracket: Option<[f64; 2]>,
    steps: Vec<LoadStep>,
    /// The wall at the last reading.
    last: Assembly<'a>,
    /// The wall when it ran away.
    falling: Option<Assembly<'a>>,
}

impl<'t, 'a> Turned<'t, 'a> {
    fn new(task: &'t Task<'a>, turning: &Turning, watch: Watch, at_rest: &Assembly<'a>) -> Self {
        let mut assembly = at_rest.clone();
        assembly.bodies.all.iter_mut().for_each(|body| body.rescale(1.0));
        assembly.bodies.stop();
        let settings = Settings {
            damping: turning.damping,
            step_safety: turning.step_safety,
            scaled_inertia: false,
            ..Settings::default()
        };
        let (Criterion::AnyBlock(limit) | Criterion::Top(limit)) = task.criterion;
        Turned {
            task,
            rate: turning.rate,
            settings,
            watch,
            begins: BEGINS * limit,
            simulation: Simulation::of(assembly, settings),
            outcome: Outcome::Equilibrium,
            bracket: None,
            steps: Vec::new(),
            last: at_rest.clone(),
            falling: None,
        }
    }

    fn until_the_end(mut self, steps: Vec<LoadStep>, witness: Witness<'_>) -> Self {
        self.steps = steps;
        self.watch.rests(&self.simulation.assembly.bodies);
        let path = self.task.path;
        let (mut time, mut readings, mut since, mut begun) = (0.0, 1.0, 0, None);
        let mut seen = 0.0;
        loop {
            let tilt = (self.rate * time).min(path.end);
            let (gravity, factor) = path.loads(tilt);
            self.simulation.set_loads(gravity, factor);
            self.simulation.step();
            time += self.simulation.dt;
            since += 1;
            if !self.simulation.steps.is_multiple_of(STEPS_BETWEEN_LOOKS) {
                continue;
            }
            self.task.changes.apply(&mut self.simulation.assembly, seen, tilt);
            seen = tilt;
            let bodies = &self.simulation.assembly.bodies;
            let level = path.level(tilt);
            if !self.simulation.assembly.is_finite() {
                self.outcome = Outcome::NonFinite { at: level };
                return self;
            }
            begun = (self.watch.strayed(bodies) > self.begins).then(|| begun.unwrap_or(tilt));
            let is_read = tilt >= path.after(readings);
            let away = self.watch.runs_away(bodies)
                || (is_read && has_fallen(self.task.wall, &self.last, &self.simulation.assembly));
            if away || is_read {
                (witness.tell)(level);
                let ratio = self.simulation.assembly.unbalanced_ratio();
                self.steps.push(self.watch.read(bodies, level, ratio, std::mem::take(&mut since)));
                if away {
                    let from = begun.unwrap_or(tilt);
                    self.outcome = Outcome::Collapsed { at: path.level(from) };
                    self.bracket = Some([from, tilt]);
                    self.falling = Some(self.simulation.assembly.clone());
                    return self;
                }
                if tilt >= path.end {
                    return self;
                }
                readings += 1.0;
                begun = None;
                self.last = self.simulation.assembly.clone();
                if let Some(recorder) = witness.recorder {
                    recorder.rests(level, &self.last);
                }
                self.watch.rests(&self.last.bodies);
            }
        }
    }
}
