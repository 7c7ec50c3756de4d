//! A wall of a study through the study's protocol.

use crate::model::{JointLaws, Level, Support, Wall};
use crate::protocol::drive::drive_seen_by;
use crate::protocol::events::in_parts;
use crate::protocol::path::LoadPath;
use crate::protocol::pressure::back_loads;
use crate::protocol::retaining::hold;
use crate::protocol::shear::{Begin, by_limit, push};
use crate::protocol::stage::{Stage, thickness};
use crate::protocol::tilting::turn;
use crate::protocol::{
    Changes, Confirmation, Contacts, Criterion, Protocol, Rate, Restraint, Run, Task, Witness,
};
use crate::solve::{Solver, explicit};

/// Takes a wall of stones through a protocol: gravity first, then the load.
///
/// `wall` holds the stones only; base, strip and ends are added here as `restraint` says, with ids behind the stones'.
/// `contacts` may be the numbers of sub-contacts of a joint along its longer and its shorter extent alone. Of a base that shakes this is
/// the wall at rest before; the rest is [`shake_wall`](crate::protocol::shake_wall)'s.
pub fn run(
    wall: &Wall,
    laws: &dyn JointLaws,
    protocol: &Protocol,
    restraint: &Restraint,
    contacts: impl Into<Contacts>,
    solver: &Solver,
) -> Run {
    run_changing(wall, laws, protocol, restraint, contacts, &Changes::default(), solver)
}

/// [`run`] with a wall that changes on its way. Changes go by tilt: under a service load, and in shear, they must be none.
pub fn run_changing(
    wall: &Wall,
    laws: &dyn JointLaws,
    protocol: &Protocol,
    restraint: &Restraint,
    contacts: impl Into<Contacts>,
    changes: &Changes,
    solver: &Solver,
) -> Run {
    let way = Way { changes, witness: Witness::NOBODY };
    run_seen_by(wall, laws, protocol, restraint, contacts, way, solver)
}

/// What goes on while a wall is loaded.
#[derive(Clone, Copy)]
pub struct Way<'w> {
    /// What changes it.
    pub changes: &'w Changes,
    /// Who sees it.
    pub witness: Witness<'w>,
}

/// [`run_changing`], with somebody who sees how it goes.
pub fn run_seen_by(
    wall: &Wall,
    laws: &dyn JointLaws,
    protocol: &Protocol,
    restraint: &Restraint,
    contacts: impl Into<Contacts>,
    Way { changes, witness }: Way<'_>,
    solver: &Solver,
) -> Run {
    let stage = Stage::new(wall, laws, protocol, restraint, contacts.into());
    let thickness = thickness(wall);
    let mut run = match protocol {
        Protocol::Lateral(lateral) => {
            let criterion = Criterion::Top(lateral.collapse_share * thickness);
            let task = task(&stage, &stage.assembly, LoadPath::factor(lateral.steps), criterion, thickness);
            let task = Task { loads: back_loads(wall, lateral), changes: changes.clone(), ..task };
            drive_seen_by(&task, solver, witness)
        }
        Protocol::Tilting(tilting) => {
            let criterion = Criterion::AnyBlock(tilting.collapse_share * thickness);
            in_parts(&stage.assembly, &tilting.events, Level::Tilt(0.0), |left| {
                let task = task(&stage, left, tilting.path(), criterion, thickness);
                let task = Task { changes: changes.clone(), ..task };
                match tilting.rate {
                    Rate::Static => drive_seen_by(&task, solver, witness),
                    Rate::Dynamic(turning) => {
                        let at_rest = match solver {
                            Solver::Explicit(settings) => *settings,
                            Solver::Implicit(_) | Solver::Nonsmooth(_) | Solver::Limit(_) => {
                                explicit::Settings::default()
                            }
                        };
                        turn(&task, &turning, at_rest, witness)
                    }
                }
            })
        }
        Protocol::Shear(shear) => {
            let criterion = Criterion::AnyBlock(shear.collapse_share * thickness);
            let path = LoadPath::drift(shear.step, shear.history.widest());
            let task = task(&stage, &stage.assembly, path, criterion, thickness);
            match solver {
                Solver::Limit(settings) => by_limit(task, shear.vertical_load, *settings, witness),
                Solver::Implicit(settings) => push(&task, shear, Begin::Implicit(*settings), witness),
                Solver::Explicit(settings) => push(&task, shear, Begin::Explicit(*settings), witness),
                Solver::Nonsmooth(settings) => push(&task, shear, Begin::Nonsmooth(*settings), witness),
            }
        }
        Protocol::Retaining(retaining) => {
            let criterion = Criterion::AnyBlock(retaining.collapse_share * thickness);
            let task = task(&stage, &stage.assembly, LoadPath::factor(1), criterion, thickness);
            hold(&task, retaining, solver, witness)
        }
        Protocol::BaseMotion(_) => {
            let criterion = Criterion::AnyBlock(thickness);
            let task = task(&stage, &stage.assembly, LoadPath::factor(1), criterion, thickness);
            drive_seen_by(&task, solver, witness)
        }
    };
    run.displacements.truncate(wall.blocks.len());
    run.turns.truncate(wall.blocks.len());
    run
}

/// What is left of a wall in its surroundings, with its joints as built.
pub(super) fn task<'t>(
    stage: &'t Stage<'_>,
    left: &'t Wall,
    path: LoadPath,
    criterion: Criterion,
    thickness: f64,
) -> Task<'t> {
    let is_there = |id: usize| left.blocks[id].support != Support::Absent;
    Task {
        wall: left,
        laws: &stage.laws,
        contact: stage.contact,
        loads: Vec::new(),
        ties: stage.ties.iter().filter(|tie| is_there(tie.body)).cloned().collect(),
        platform: stage.platform.clone(),
        changes: Changes::default(),
        path,
        piles: Vec::new(),
        criterion,
        confirmation: Confirmation::for_thickness(thickness),
    }
}
