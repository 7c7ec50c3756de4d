//! A wall of a study with its fill or water, by any solver.

use crate::math::Vec3;
use crate::model::{Level, Outcome};
use crate::protocol::path::LoadPath;
use crate::protocol::retaining::behind::Behind;
use crate::protocol::retaining::lifts::raise;
use crate::protocol::retaining::limit::{Highest, highest};
use crate::protocol::retaining::settings::{Lifts, Retaining};
use crate::protocol::rigid::Found;
use crate::protocol::undecided::{height_of_stiff_joints, undecided};
use crate::protocol::{Lower, Run, Task, Undecided, Witness};
use crate::solve::Solver;
use crate::solve::limit::{Analysis, Flow, Settings};

/// Fills up the back of a wall until it falls; the task's own loads and path play no part.
pub fn hold(task: &Task<'_>, retaining: &Retaining, solver: &Solver, witness: Witness<'_>) -> Run {
    match (Behind::new(task.wall, task.path.direction(), &retaining.retained), solver) {
        (Err(fault), _) => without_back(task, fault.reason()),
        (Ok(behind), Solver::Limit(settings)) => by_limit(task, &behind, retaining.lifts, *settings, witness),
        (Ok(behind), _) => raise(task, &behind, retaining.lifts, solver, witness),
    }
}

fn by_limit(task: &Task<'_>, behind: &Behind, lifts: Lifts, settings: Settings, witness: Witness<'_>) -> Run {
    let analysis = Analysis::new(task.wall, task.laws, task.contact, settings).with_ties(&task.ties);
    let found = highest(&analysis, behind, lifts);
    let undecided = left_open_at(task, &analysis, behind, &found);
    let last = match found.limit.outcome {
        Outcome::Collapsed { .. } | Outcome::Equilibrium => Some(Level::Height(found.height)),
        _ => None,
    };
    let outcome = found.limit.outcome.clone();
    let told = Found {
        limit: &found.limit,
        joints: analysis.joints(),
        outcome,
        levels: (Level::Height(0.0), last),
        scale: 1.0,
    };
    let run = told.run(task, witness);
    Run { undecided, bracket: found.bracket, ..run }
}

/// What rigid blocks leave open of a height that was found, in heights (m); `None` where stiff joints bear it as well.
pub fn left_open_at(
    task: &Task<'_>,
    analysis: &Analysis,
    behind: &Behind,
    found: &Highest,
) -> Option<Undecided> {
    let bears = match found.limit.outcome {
        Outcome::Collapsed { .. } => Some(1.0),
        Outcome::Equilibrium => None,
        _ => return None,
    };
    let there = task.under(behind.loads(found.height), LoadPath::factor(1));
    let of_pressure = undecided(&there, analysis, bears, bears)?;
    let lower = match of_pressure.by {
        Lower::SmoothSides(_) => {
            Some(highest(&analysis.with_smooth_sides(), behind, Lifts::default()).height)
        }
        Lower::StiffJoints | Lower::StiffJointsAtLeast(_) => height_of_stiff_joints(task, behind),
    };
    let without_dilatancy = of_pressure.without_dilatancy.map(|_| {
        let settings = Settings { flow: Flow::NonAssociative, ..analysis.settings };
        highest(&Analysis { settings, ..analysis.clone() }, behind, Lifts::COARSE).height
    });
    // Lost on the way, it is known to bear nothing.
    Some(Undecided {
        lower: lower.unwrap_or(0.0),
        upper: bears.map(|_| found.height),
        without_dilatancy,
        ..of_pressure
    })
}

/// The run of a wall that nothing can press on.
fn without_back(task: &Task<'_>, reason: String) -> Run {
    let still = vec![Vec3::zeros(); task.wall.blocks.len()];
    Run::ended(Outcome::InvalidGeometry { reason }, Vec::new(), [still.clone(), still], 0)
}
