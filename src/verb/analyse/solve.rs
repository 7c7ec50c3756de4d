//! From the arguments to a solver and its answer.

use crate::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use crate::math::{atan, cos, radians, tan};
use crate::model::{Level, Outcome, Wall};
use crate::protocol::{
    self, Behind, Changes, Confirmation, Criterion, Lifts, LoadPath, Recorder, Settlement, Task, Witness,
    amplified, borne, drive_seen_by, highest, raise,
};
use crate::solve::implicit::Equilibrium;
use crate::solve::{Equilibrate, Solver, explicit, implicit, limit, nonsmooth};
use crate::study::Fit;
use crate::terminal::doing::doing;
use crate::verb::analyse::answer::Answer;
use crate::verb::analyse::ask::{Analyse, FlowName, Growing};
use crate::verb::analyse::held::{Held, behind, factored};
use crate::verb::analyse::known::Known;
use crate::verb::analyse::state::Found;
use crate::verb::arguments::SolverName;

/// Rigid blocks need no stiffness, but a law has one; where contact dynamics loses a wall, the explicit solver asks on with it.
const ANY_STIFFNESS: f64 = 1e9;
/// A block is part of a mechanism when it moves at this share of the fastest corner.
const MOVES: f64 = 0.01;
/// Step of the tilt (deg) where none is asked for, and the largest tilt and multiplier.
pub(crate) const STEP_DEG: f64 = 0.5;
pub(crate) const LARGEST_TILT_DEG: f64 = 89.0;
pub(crate) const LARGEST_MULTIPLIER: f64 = 10.0;
/// The largest factor on a pressure or a force, its step and its bracket.
pub(crate) const LARGEST_FACTOR: f64 = 10.0;
const FACTOR_STEP: f64 = 0.1;
/// Heights that differ by less (m) are the same.
pub(crate) const BRACKET_M: f64 = 1e-3;
/// Width of the bracket around the collapse: angle (deg) and multiplier.
pub(crate) const BRACKET_DEG: f64 = 0.01;
pub(crate) const BRACKET: f64 = 1e-4;
/// A wall runs away when a block has moved by this share of the thickness of its pile in a step.
pub(crate) const RUNS_AWAY: f64 = 0.1;

/// The law of all joints, with the middle of what is not known exactly: no tension, cohesion kept after slip, ks = kn / 2 unless it is given.
pub(crate) fn law(arguments: &Analyse) -> Coulomb {
    let is_elastic = arguments.solver().is_elastic();
    let kn = arguments.kn.as_ref().filter(|_| is_elastic).map_or(ANY_STIFFNESS, Known::middle);
    Coulomb {
        normal: NormalLaw::Linear { kn },
        ks: arguments.ks.filter(|_| is_elastic).unwrap_or(0.5 * kn),
        tan_phi: tan(radians(arguments.phi_deg.middle())),
        cohesion: arguments.cohesion,
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    }
}

/// Processor time of contact dynamics for each joint (s), of walls with 80 to 200 joints that were tilted until they fell: the least is that of one
/// leaf tilted out of its plane, the most that of walls in their plane, of two leaves and with returns, whose last steps before the fall slide in
/// many joints (`docs/theory/solvers.md`).
const SECONDS_PER_JOINT: [f64; 2] = [0.01, 0.4];

/// How long contact dynamics takes for a wall of so many joints, in words.
fn estimate(joints: usize) -> String {
    let [low, high] = SECONDS_PER_JOINT.map(|each| (each * joints as f64).max(1.0));
    let high = if high < 100.0 { format!("{high:.0} s") } else { format!("{:.0} min", high / 60.0) };
    format!("{low:.0} s to {high}; the more, the more joints slide before it falls")
}

/// Solves the wall as asked.
pub(crate) fn solve(
    arguments: &Analyse,
    wall: (&Wall, &[Settlement]),
    law: &Coulomb,
    fit: &Fit,
    recorder: Option<&Recorder>,
) -> (Answer, Found) {
    let mut what =
        format!("solving {} blocks by the {} solver", wall.0.blocks.len(), arguments.solver().name());
    if arguments.solver() == SolverName::Nonsmooth {
        what.push_str(&format!(" ({})", estimate(fit.joints)));
    }
    doing(&what, |doing| {
        let witness = Witness { tell: &|level| doing.at(level), recorder };
        solve_seen_by(arguments, wall, law, fit, witness)
    })
}

pub(crate) fn solve_seen_by(
    arguments: &Analyse,
    (wall, settlements): (&Wall, &[Settlement]),
    law: &Coulomb,
    fit: &Fit,
    witness: Witness<'_>,
) -> (Answer, Found) {
    match arguments.solver() {
        SolverName::Limit => by_limit_analysis(arguments, wall, law, fit, witness),
        SolverName::Implicit => {
            let settings = implicit::Settings::default();
            let task = task(arguments, (wall, settlements), law, fit);
            let mut at_rest = Equilibrium::new(wall, law, settings, task.contact);
            at_rest.settle(&mut |_| false);
            let loose = Some(at_rest.loose().iter().map(|&i| i as usize).collect());
            let (answer, found) = by_steps(arguments, &task, &Solver::Implicit(settings), witness);
            (Answer { loose, ..answer }, found)
        }
        SolverName::Explicit => {
            let solver = Solver::Explicit(explicit::Settings::default());
            by_steps(arguments, &task(arguments, (wall, settlements), law, fit), &solver, witness)
        }
        SolverName::Nonsmooth => {
            let solver = Solver::Nonsmooth(nonsmooth::Settings::default());
            let (answer, found) =
                by_steps(arguments, &task(arguments, (wall, settlements), law, fit), &solver, witness);
            let meaning = format!("{}; rigid blocks without dilatancy, in time", answer.meaning);
            (Answer { meaning, ..answer }, found)
        }
    }
}

/// The load path of the solvers that go by steps.
pub(crate) fn task<'t>(
    arguments: &Analyse,
    (wall, settlements): (&'t Wall, &[Settlement]),
    law: &'t Coulomb,
    fit: &Fit,
) -> Task<'t> {
    let (towards, step) = (arguments.direction, radians(arguments.step_deg.unwrap_or(STEP_DEG)));
    let path = match arguments.growing() {
        Growing::Tilt => LoadPath::tilt(towards, step, radians(LARGEST_TILT_DEG), radians(BRACKET_DEG)),
        Growing::Lateral => LoadPath::multiplier(towards, tan(step), LARGEST_MULTIPLIER, BRACKET)
            .with_vertical(arguments.vertical.unwrap_or(0.0)),
        // Of what rises behind it each height has a path of its own.
        Growing::Height => LoadPath::factor(1),
        Growing::Factor => LoadPath {
            growing: protocol::Growing::Factor,
            end: LARGEST_FACTOR,
            steps: LARGEST_FACTOR / FACTOR_STEP,
            bracket: BRACKET,
            goes_back: false,
        },
    };
    Task {
        wall,
        laws: law,
        contact: fit.contact,
        loads: factored(arguments, wall),
        ties: Vec::new(),
        platform: None,
        changes: Changes { settlements: settlements.to_vec(), ..Changes::default() },
        path,
        piles: fit.piles.clone(),
        criterion: Criterion::AnyBlock(RUNS_AWAY * fit.thickness),
        confirmation: Confirmation::for_thickness(fit.thickness),
    }
}

fn by_steps(arguments: &Analyse, task: &Task<'_>, solver: &Solver, witness: Witness<'_>) -> (Answer, Found) {
    let behind = behind(arguments, task.wall).and_then(Result::ok);
    let run = match &behind {
        Some(behind) => raise(task, behind, Lifts::COARSE, solver, witness),
        None => drive_seen_by(task, solver, witness),
    };
    let meaning = match &behind {
        Some(_) => format!("the highest borne, {} heights", run.steps.len().saturating_sub(1)),
        None => format!("the largest load borne on the way, {} load steps", run.steps.len()),
    };
    let answer = Answer {
        clamped: Vec::new(),
        undecided: run.undecided.clone(),
        between: None,
        moving: run
            .failure
            .as_ref()
            .map_or_else(Vec::new, |f| f.moving.iter().map(|&i| i as usize).collect()),
        loose: None,
        settled: run.settled_joints.clone(),
        bracket: run.bracket,
        meaning,
        held: behind.map(|behind| held(&behind, None)),
        outcome: run.outcome.clone(),
    };
    (answer, Found::Steps(Box::new(run)))
}

fn by_limit_analysis(
    arguments: &Analyse,
    wall: &Wall,
    law: &Coulomb,
    fit: &Fit,
    witness: Witness<'_>,
) -> (Answer, Found) {
    let flow = match arguments.flow.unwrap_or(FlowName::Associative) {
        FlowName::Associative => limit::Flow::Associative,
        FlowName::NonAssociative => limit::Flow::NonAssociative,
    };
    let settings = limit::Settings { flow, ..limit::Settings::default() };
    let analysis = limit::Analysis::new(wall, law, fit.contact, settings);
    let direction = arguments.direction.unit();
    let (behind, mut bracket) = (behind(arguments, wall).and_then(Result::ok), None);
    let found = match arguments.growing() {
        Growing::Tilt => analysis.tilt(direction, &[]),
        Growing::Lateral => {
            analysis.multiplier(&limit::Loads::seismic(direction, arguments.vertical.unwrap_or(0.0)))
        }
        Growing::Factor => borne(&analysis, protocol::Growing::Factor, &factored(arguments, wall)),
        Growing::Height => match &behind {
            Some(behind) => {
                let highest = highest(&analysis, behind, Lifts::default());
                bracket = highest.bracket;
                highest.limit
            }
            None => analysis.multiplier(&limit::Loads::weight()),
        },
    };
    let speed = |i: usize| {
        let (motion, block) = (&found.mechanism[i], &wall.blocks[i]);
        motion.velocity.norm() + motion.spin.norm() * 0.5 * block.shape.diameter()
    };
    let fastest = (0..found.mechanism.len()).map(speed).fold(0.0, f64::max);
    // What a solver leaves where nothing collapses is no mechanism.
    let falls = matches!(found.outcome, Outcome::Collapsed { .. } | Outcome::UnstableAtRest);
    let scale = match arguments.growing() {
        Growing::Tilt => cos(atan(found.multiplier)),
        Growing::Lateral | Growing::Height | Growing::Factor => 1.0,
    };
    if let Some(recorder) = witness.recorder {
        let level = match arguments.growing() {
            Growing::Tilt => Level::Tilt(atan(found.multiplier)),
            Growing::Lateral => Level::Multiplier(found.multiplier),
            Growing::Factor => Level::Factor(found.multiplier),
            Growing::Height => match found.outcome {
                Outcome::Collapsed { at } => at,
                _ => Level::Height(behind.as_ref().map_or(0.0, |behind| behind.height)),
            },
        };
        recorder.takes(amplified((wall, &fit.contact), &found, (level, scale), falls));
    }
    let answer = Answer {
        clamped: clamped(&analysis, wall, &found.outcome),
        undecided: None,
        between: found.between,
        settled: Vec::new(),
        bracket,
        held: behind.map(|behind| held(&behind, margin(&found))),
        moving: (0..found.mechanism.len()).filter(|&i| falls && speed(i) > MOVES * fastest).collect(),
        loose: None,
        meaning: format!("{}: {}", arguments.flow.unwrap_or(FlowName::Associative).name(), flow.meaning()),
        outcome: found.outcome.clone(),
    };
    (answer, Found::Limit { found: Box::new(found), falls, scale })
}

fn held(behind: &Behind, margin: Option<f64>) -> Held {
    Held { back: behind.height, lean: behind.lean, coefficient: behind.coefficient, margin }
}

/// How many times the pressure of its whole back a wall bears that stands to its top.
fn margin(found: &limit::Limit) -> Option<f64> {
    (found.outcome == Outcome::Equilibrium).then_some(found.multiplier)
}

/// The blocks that stand at rest only by forces that no weight causes.
fn clamped(analysis: &limit::Analysis, wall: &Wall, outcome: &Outcome) -> Vec<usize> {
    if *outcome == Outcome::UnstableAtRest {
        return Vec::new();
    }
    let moves = analysis.self_stressed(&limit::Loads::weight()).unwrap_or_default();
    let far =
        |i: usize| moves[i].velocity.norm() + moves[i].spin.norm() * 0.5 * wall.blocks[i].shape.diameter();
    (0..moves.len()).filter(|&i| far(i) > MOVES).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_estimate_grows_with_the_joints() {
        assert!(estimate(50).starts_with("1 s to 20 s;"), "{}", estimate(50));
        assert!(estimate(2000).starts_with("20 s to 13 min;"), "{}", estimate(2000));
    }
}
