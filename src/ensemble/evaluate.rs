//! One member: its wall, its joints, its protocol, its row. A pure function of study, seed and task.

use crate::ensemble::built::Built;
use crate::ensemble::design::Task;
use crate::ensemble::limit_analysis::limit_analysis;
use crate::ensemble::reading::base_motion::shaken;
use crate::ensemble::reading::{Reading, StepRow, finite};
use crate::ensemble::record::{Mechanism, Row};
use crate::ensemble::undecided::undecided;
use crate::generate::{Generated, InvalidGeometry, generate};
use crate::interrupt;
use crate::model::{Outcome, Wall};
use crate::protocol::{self, Witness};
use crate::study::{Arm, AsDrawn, DrawnJoints, Study};

/// The wall of a member, the same one at every kn: only the arm as drawn, the seed and the member enter.
///
/// # Errors
/// [`InvalidGeometry`] when the generator found no valid wall within its attempts.
pub fn build(study: &Study, arm: u32, member: u64) -> Result<Generated, InvalidGeometry> {
    let AsDrawn { arm, protocol, .. } = study.as_drawn(arm, member);
    let generated = generate(&arm.layout, &study.streams(member))?;
    let wall = arm.mechanisms.built(generated.wall, &protocol);
    let wall = if arm.turned { wall.turned(arm.layout.outline.length) } else { wall };
    Ok(Generated { wall, ..generated })
}

/// Evaluates one member at one kn: builds its wall, draws its joints, takes it through the study's protocol. A wall
/// that cannot be built, falls or does not come to rest gives a row whose outcome says so.
///
/// Every point builds its wall anew: that costs little beside solving it, and no task waits for another.
pub fn evaluate(study: &Study, task: Task) -> Row {
    interrupt::look();
    match build(study, task.arm, task.member) {
        Ok(generated) => match &study.earthquakes {
            Some(earthquakes) => shaken(study, earthquakes, task, &generated),
            None => solved(study, task, &generated),
        },
        Err(fault) => Row {
            built: Built { attempts: fault.attempts, redraws: fault.redraws, ..Built::default() },
            ..Row::of(study, task, Outcome::InvalidGeometry { reason: fault.to_string() })
        },
    }
}

/// Draws the joints of a member's wall and takes it through the study's protocol, seen by a witness.
pub fn solve(study: &Study, task: Task, wall: &Wall, witness: Witness<'_>) -> protocol::Run {
    let drawn = study.as_drawn(task.arm, task.member);
    let AsDrawn { arm, protocol, .. } = &drawn;
    let laws = laws(study, task, arm, wall);
    let contacts = arm.contacts();
    let changes = arm.mechanisms.changes(wall, &study.streams(task.member));
    let way = protocol::Way { changes: &changes, witness };
    protocol::run_seen_by(wall, &laws, protocol, &arm.restraint, contacts, way, &study.solver)
}

/// The laws of the joints of a task's member, from its arm as drawn.
pub(super) fn laws<'a>(study: &Study, task: Task, arm: &'a Arm, wall: &Wall) -> DrawnJoints<'a> {
    let kn = arm.kn_points[task.point as usize];
    DrawnJoints::new(&arm.joint, kn, study.streams(task.member)).altered(&arm.mechanisms, wall)
}

fn solved(study: &Study, task: Task, generated: &Generated) -> Row {
    let wall = &generated.wall;
    let run = solve(study, task, wall, Witness::NOBODY);
    let gauge = &study.arms[task.arm as usize].mechanisms;
    let steps = run.steps.iter().enumerate();
    Row {
        reading: Reading::of(&run, gauge),
        limit: limit_analysis(study, task, wall, &run),
        mechanism: run.failure.as_ref().map(Mechanism::of),
        undecided: undecided(study, task, &run),
        built: Built { joints: run.joints as u32, ..Built::of(generated) },
        solver_steps: run.steps.iter().map(|step| step.solver_steps).sum(),
        unbalanced_ratio: run.steps.last().and_then(|step| finite(step.unbalanced_ratio)),
        load_steps: steps.map(|(number, step)| StepRow::of(number, step, gauge)).collect(),
        ..Row::of(study, task, run.outcome)
    }
}
