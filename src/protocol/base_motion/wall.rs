//! A wall of a study on a base that shakes.

use crate::model::{JointLaws, Wall};
use crate::motion::Motion;
use crate::protocol::base_motion::observe::Shaken;
use crate::protocol::base_motion::settings::{BaseMotion, Lean};
use crate::protocol::base_motion::shake::Rested;
use crate::protocol::path::LoadPath;
use crate::protocol::run::task;
use crate::protocol::stage::{Stage, thickness};
use crate::protocol::{Contacts, Criterion, Protocol, Restraint};
use crate::solve::Solver;

/// Brings a wall of stones to rest as [`run`](crate::protocol::run()) does, and lets `each` shake it by as many motions as it likes, on as many
/// threads: each begins at that rest. Of a motion come the run and its twin, see [`shake_twice`](crate::protocol::shake_twice), or the run itself
/// twice where no twin is asked for. Gives what `each` does, and the number of joints as built; `None` of a solver that knows no time.
pub fn shake_wall<R>(
    wall: &Wall,
    laws: &dyn JointLaws,
    base: &BaseMotion,
    restraint: &Restraint,
    contacts: impl Into<Contacts>,
    solver: &Solver,
    each: impl FnOnce(&(dyn Fn(Motion) -> [Shaken; 2] + Sync)) -> R,
) -> Option<(R, usize)> {
    let solver = base.in_time(solver)?;
    let stage = Stage::new(wall, laws, &Protocol::BaseMotion(*base), restraint, contacts.into());
    let thickness = thickness(wall);
    let criterion = Criterion::AnyBlock(thickness);
    let task = task(&stage, &stage.assembly, LoadPath::factor(1), criterion, thickness);
    let rested = Rested::of(&task, Lean::NONE, solver);
    let shaken = each(&|motion| {
        let shaking = base.shaking(motion);
        if base.twice {
            return rested.shaken_twice(&shaking);
        }
        let seen = rested.shaken(&shaking);
        [seen.clone(), seen]
    });
    Some((shaken, rested.joints()))
}
