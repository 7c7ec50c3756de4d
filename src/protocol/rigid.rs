//! A load path by limit analysis alone: no steps, no displacements, the load at which rigid blocks fall and how.

use crate::contact;
use crate::math::{Vec3, cos};
use crate::model::{JointLaws, Level, Outcome, Wall};
use crate::protocol::amplified::amplified;
use crate::protocol::mechanism::{Failure, failure};
use crate::protocol::path::Growing;
use crate::protocol::pressure::Load;
use crate::protocol::watch::LoadStep;
use crate::protocol::{Run, Task, Witness, undecided};
use crate::solve::limit::{Analysis, BlockMotion, Limit, Loads, Settings, When};
use crate::solve::{Assembly, Tie};

/// How far (share of the wall's thickness) the fastest corner is moved along the mechanism for its shape to be read off.
const SHOWN: f64 = 0.01;

/// What limit analysis is asked about.
pub(super) struct Rigid<'q> {
    pub wall: &'q Wall,
    pub laws: &'q dyn JointLaws,
    pub contact: contact::Settings,
    pub ties: &'q [Tie],
    pub loads: &'q [Load],
    pub growing: Growing,
}

impl Rigid<'_> {
    /// What the wall bears, and the analysis that was asked.
    pub fn ask(&self, settings: Settings) -> (Limit, Analysis) {
        let analysis = Analysis::new(self.wall, self.laws, self.contact, settings).with_ties(self.ties);
        let limit = borne(&analysis, self.growing, self.loads);
        (limit, analysis)
    }
}

/// What an analysis finds of a load that grows.
pub fn borne(analysis: &Analysis, growing: Growing, loads: &[Load]) -> Limit {
    let points = |when| loads.iter().map(|load| load.when(when)).collect::<Vec<_>>();
    match growing {
        Growing::Tilt(towards) => analysis.tilt(towards.unit(), &points(When::Dead)),
        Growing::Factor | Growing::Drift => {
            analysis.multiplier(&Loads { points: points(When::Live), live: Vec3::zeros(), ..Loads::weight() })
        }
        Growing::Multiplier { towards, vertical } => analysis
            .multiplier(&Loads { points: points(When::Dead), ..Loads::seismic(towards.unit(), vertical) }),
    }
}

/// Takes a wall along a load path by limit analysis. What bears more than the path's end stands to the end; the last step's
/// level is then the end or, for a factor, what the wall bears: [`Outcome::Unbounded`] where that is any load. What rigid blocks do not have (displacements, remainders) is
/// NaN. The wall is taken as built: no change on the way is made.
pub(super) fn rigid(task: &Task<'_>, settings: Settings, witness: Witness<'_>) -> Run {
    let Task { wall, laws, contact, path, .. } = *task;
    let settings = match path.growing {
        Growing::Tilt(_) => Settings { largest_tilt: path.end.min(settings.largest_tilt), ..settings },
        Growing::Multiplier { .. } => Settings { largest_multiplier: path.end, ..settings },
        Growing::Factor | Growing::Drift => settings,
    };
    let asked = Rigid { wall, laws, contact, ties: &task.ties, loads: &task.loads, growing: path.growing };
    let (limit, analysis) = asked.ask(settings);
    let (outcome, last) = match limit.outcome.clone() {
        Outcome::Collapsed { at } if path.growing == Growing::Factor && at.value() >= path.end => {
            (Outcome::Equilibrium, Some(at.value()))
        }
        Outcome::Collapsed { at } => (Outcome::Collapsed { at: path.level(at.value()) }, Some(at.value())),
        Outcome::NotConverged { at, unbalanced_ratio, why } => {
            (Outcome::NotConverged { at: path.level(at.value()), unbalanced_ratio, why }, None)
        }
        // A capacity that is asked for as a factor is not there; a tilt that nothing falls at stands to the end of the path.
        Outcome::Unbounded if path.growing == Growing::Factor => (Outcome::Unbounded, None),
        Outcome::Equilibrium | Outcome::Unbounded => (Outcome::Equilibrium, Some(path.end)),
        other => (other, None),
    };
    let undecided = match outcome {
        Outcome::Collapsed { .. } => undecided(task, &analysis, last, last),
        // Without a bound as well: what presses without end may press only where statics lets it.
        Outcome::Equilibrium | Outcome::Unbounded => {
            let more = last.filter(|at| *at > path.end);
            undecided(task, &analysis, more, more)
        }
        _ => None,
    };
    // Tilt pushes with the tangent of the angle and leaves the weight as it is.
    let scale = match (path.growing, last) {
        (Growing::Tilt(_), Some(tilt)) => cos(tilt),
        _ => 1.0,
    };
    let (rest, last) = (path.level(0.0), last.map(|at| path.level(at)));
    let found = Found { limit: &limit, joints: analysis.joints(), outcome, levels: (rest, last), scale };
    Run { undecided, ..found.run(task, witness) }
}

/// What limit analysis found of a task.
pub(super) struct Found<'f> {
    pub limit: &'f Limit,
    /// Joints of the wall.
    pub joints: usize,
    /// How the wall ends, at a level of its load.
    pub outcome: Outcome,
    /// The level at rest under its weight, and the one that it is about: where it falls, or the last that it is known to bear.
    pub levels: (Level, Option<Level>),
    /// Of the forces that were found to those of that level.
    pub scale: f64,
}

impl Found<'_> {
    /// As a run, shown to a witness.
    pub fn run(self, task: &Task<'_>, witness: Witness<'_>) -> Run {
        let Found { limit, joints, outcome, levels: (rest, last), scale } = self;
        let falls = matches!(outcome, Outcome::Collapsed { .. });
        let step = |level: Level, solver_steps: u32| LoadStep {
            level,
            top_displacement: f64::NAN,
            points: None,
            remainders: None,
            push: None,
            unbalanced_ratio: limit.accuracy.residual,
            solver_steps: u64::from(solver_steps),
        };
        let mut steps = vec![step(rest, limit.iterations)];
        steps.extend(last.map(|at| step(at, 0)));
        // As with the other solvers, the last step of a wall that falls is the one that it does not bear.
        steps.extend(last.filter(|_| falls).map(|at| step(at, 0)));
        let fell = falls || outcome == Outcome::UnstableAtRest;
        if let Some(recorder) = witness.recorder {
            let at = (last.unwrap_or(rest), scale);
            recorder.takes(amplified((task.wall, &task.contact), limit, at, fell));
        }
        let still = vec![Vec3::zeros(); task.wall.blocks.len()];
        Run {
            bracket: last.filter(|_| falls).map(|at| [at.value(); 2]),
            failure: fell.then(|| failure_by(task, &limit.mechanism)).flatten(),
            ..Run::ended(outcome, steps, [still.clone(), still], joints)
        }
    }
}

/// How the wall falls, read off its mechanism; `None` where there is none.
fn failure_by(task: &Task<'_>, mechanism: &[BlockMotion]) -> Option<Failure> {
    if mechanism.iter().all(|motion| motion.velocity.norm() == 0.0 && motion.spin.norm() == 0.0) {
        return None;
    }
    let built = Assembly::new(task.wall, task.laws, task.contact);
    let (low, high) = task.wall.bounds();
    let mut away = built.clone();
    for (body, motion) in away.bodies.all.iter_mut().zip(mechanism) {
        let far = SHOWN * (high.y - low.y);
        let here = body.clone();
        body.place(&here, &(motion.velocity * far), &(motion.spin * far));
    }
    Some(failure(task.wall, &built, &built.bodies.all, &away.bodies, task.path.direction()))
}

/// The level of collapse that an analysis found.
pub(super) fn level(limit: &Limit) -> Option<f64> {
    match limit.outcome {
        Outcome::Collapsed {
            at: Level::Tilt(x) | Level::Multiplier(x) | Level::Factor(x) | Level::Height(x),
        } => Some(x),
        _ => None,
    }
}
