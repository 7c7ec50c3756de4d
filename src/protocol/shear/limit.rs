//! The push that a sheared wall bears by limit analysis.

use crate::model::{Level, Outcome};
use crate::protocol::drive::drive_seen_by;
use crate::protocol::path::LoadPath;
use crate::protocol::pressure::Load;
use crate::protocol::shear::readings::Sheared;
use crate::protocol::{Run, Task, Witness};
use crate::solve::{Solver, Tie, limit};

/// A push as large as the vertical load, at the jack.
pub fn push_on(jack: &Tie, vertical_load: f64) -> Load {
    Load { block: jack.body, point: jack.point, force: jack.direction * vertical_load }
}

/// A wall's task by limit analysis. Rigid blocks fall as built: the largest push is that of drift 0.
pub fn by_limit(task: Task<'_>, vertical_load: f64, settings: limit::Settings, witness: Witness<'_>) -> Run {
    let loads = task.ties.first().map(|jack| push_on(jack, vertical_load)).into_iter().collect();
    let task = Task { loads, ties: Vec::new(), path: LoadPath::factor(1), ..task };
    let mut run = drive_seen_by(&task, &Solver::Limit(settings), witness);
    let none = Level::Drift(0.0);
    let found = matches!(run.outcome, Outcome::Collapsed { .. } | Outcome::Equilibrium);
    for step in &mut run.steps {
        step.push = Some(step.level.value() * vertical_load);
        step.level = none;
    }
    run.bracket = None;
    run.shear = run.steps.get(1).filter(|_| found).and_then(|step| step.push).map(Sheared::rigid);
    run.outcome = match run.outcome {
        // A push above the vertical load is beyond the path's end, and is what the wall bears all the same.
        Outcome::Collapsed { .. } | Outcome::Equilibrium => Outcome::Collapsed { at: none },
        Outcome::NotConverged { unbalanced_ratio, why, .. } => {
            Outcome::NotConverged { at: none, unbalanced_ratio, why }
        }
        other => other,
    };
    run
}
