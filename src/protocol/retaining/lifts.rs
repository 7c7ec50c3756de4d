//! How high the fill or the water may rise, by solvers that go by steps.
//!
//! Each height is put behind the wall as built, under its weight: in steps from none of its pressure to all of it. The first lift that the wall does not
//! bear is halved down until the fall is bracketed.

use crate::model::{Level, Outcome};
use crate::protocol::drive::drive_seen_by;
use crate::protocol::path::{Growing, LoadPath};
use crate::protocol::retaining::behind::Behind;
use crate::protocol::retaining::settings::Lifts;
use crate::protocol::watch::LoadStep;
use crate::protocol::{Run, Task, Witness};
use crate::solve::Solver;

/// From none of a pressure to all of it in these steps, and the share of it to which a fall is bracketed on the way.
const STEPS: f64 = 4.0;
const BRACKET: f64 = 0.02;

/// Raises what is behind a wall until the wall falls, or to its top. The task's own loads and path play no part. The run is that of the last height borne, with a step
/// for each height and the failure of the first one that is not; the outcome's levels are heights. A witness sees the way to the height at which it falls, in shares of its
/// pressure.
pub fn raise(task: &Task<'_>, behind: &Behind, lifts: Lifts, solver: &Solver, witness: Witness<'_>) -> Run {
    let at = |height: f64, witness: Witness<'_>| {
        let path =
            LoadPath { growing: Growing::Factor, end: 1.0, steps: STEPS, bracket: BRACKET, goes_back: false };
        drive_seen_by(&task.under(behind.loads(height), path), solver, witness)
    };
    let seen = |height: f64, run: &Run| {
        (witness.tell)(Level::Height(height));
        let last = run.steps.last().map(|step| LoadStep { level: Level::Height(height), ..step.clone() });
        let solver_steps = run.steps.iter().map(|step| step.solver_steps).sum();
        last.map(|step| LoadStep { solver_steps, ..step })
    };
    let (mut steps, mut borne, mut low) = (Vec::new(), None, 0.0);
    let mut heights: Vec<f64> = lifts.heights(behind.height).collect();
    heights.reverse();
    let mut falls: Option<(f64, Run)> = None;
    let close = lifts.bracket * behind.height;
    loop {
        let height = match &falls {
            Some((high, _)) if high - low <= close => break,
            Some((high, _)) => 0.5 * (low + high),
            None => match heights.pop() {
                Some(height) => height,
                None => break,
            },
        };
        let run = at(height, Witness::NOBODY);
        if steps.is_empty() {
            steps
                .extend(run.steps.first().map(|rest| LoadStep { level: Level::Height(0.0), ..rest.clone() }));
        }
        match run.outcome {
            Outcome::Equilibrium => {
                steps.extend(seen(height, &run));
                (borne, low) = (Some(run), height);
            }
            Outcome::Collapsed { .. } => falls = Some((height, run)),
            // It does not stand at rest, or the solver lost it.
            _ => return Run { outcome: at_height(run.outcome, height), bracket: None, steps, ..run },
        }
    }
    // The way to the height that the answer is about, once more for who wants to see it.
    if witness.recorder.is_some() {
        at(falls.as_ref().map_or(low, |(high, _)| *high), Witness { tell: &|_| {}, ..witness });
    }
    let Some((high, fell)) = falls else {
        // There is at least one lift, and it was borne.
        return Run { steps, ..borne.unwrap_or_else(|| at(low, Witness::NOBODY)) };
    };
    let joints = fell.joints;
    let Run { displacements, turns, joint_states, .. } = borne.unwrap_or_else(|| fell.clone());
    steps.extend(seen(high, &fell));
    Run {
        outcome: Outcome::Collapsed { at: Level::Height(low) },
        bracket: Some([low, high]),
        steps,
        displacements,
        turns,
        joint_states,
        joints,
        ..fell
    }
}

/// An outcome at a share of the pressure of a height, as one at that height.
fn at_height(outcome: Outcome, height: f64) -> Outcome {
    let at = Level::Height(height);
    match outcome {
        Outcome::NotConverged { unbalanced_ratio, why, .. } => {
            Outcome::NotConverged { at, unbalanced_ratio, why }
        }
        Outcome::NonFinite { .. } => Outcome::NonFinite { at },
        other => other,
    }
}
