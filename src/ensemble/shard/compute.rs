//! Computing one shard.

use crate::ensemble::design::all_in_order;
use crate::ensemble::files::publish;
use crate::ensemble::journal::Entry;
use crate::ensemble::run::{Evaluations, key_of};
use crate::ensemble::shard::file::{self, Found, look};
use crate::ensemble::shard::{ShardError, Share, Work, part};
use crate::ensemble::table::{TIMING_HEADS, timing};
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{Progress, Row, RunError, Settings, Task};
use crate::study::Study;

/// What became of a shard that was to be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Computed {
    /// Its walls.
    pub walls: u64,
    /// Of them, those that had been evaluated before.
    pub before: u64,
    /// Whether it had been complete before.
    pub was_complete: bool,
}

/// Computes a shard of a study's walls, as far as it has not been: a shard that is complete is read through and left alone; of a damaged
/// one the walls that cannot be read are computed again; those in parts that others left are taken over. `evaluate` must be a pure
/// function of its arguments.
///
/// # Errors
/// [`ShardError`] where the folder or the file of the shard is of other work, and as of [`run`](crate::ensemble::run); what was evaluated
/// until then is in a part.
pub fn compute(
    study: &Study,
    work: &Work,
    share: Share,
    settings: &Settings,
    progress: &dyn Progress,
    evaluate: &(dyn Fn(&Study, Task) -> Row + Sync),
) -> Result<Computed, RunError> {
    let out = &settings.out;
    work.begin(out)?;
    let found = look(out, work, share)?;
    if let Found::Foreign(found) = found {
        return Err(ShardError::Foreign { file: share.file(out), found }.into());
    }
    let own = (0u64..).zip(all_in_order(study));
    let own = own.filter(|(place, _)| place % u64::from(share.of) == u64::from(share.index));
    let tasks: Vec<Task> = own.map(|(_, task)| task).collect();
    let keys = WallKeys::of(&work.manifest);
    let key = |task: &Task| key_of(study, &keys, *task);
    let walls = tasks.len() as u64;
    if let Found::Complete(_) = found
        && file::is_whole(out, share, tasks.iter().map(key))?
    {
        return Ok(Computed { walls, before: walls, was_complete: true });
    }
    let parts = part::of(out, share)?;
    let mut recorded = file::walls(out, share)?;
    recorded.extend(part::evaluated(&parts)?);
    let is_known = |task: &&Task| key(task).is_some_and(|key| recorded.contains_key(&key));
    let before = tasks.iter().filter(is_known).count() as u64;
    let journal = part::begin(out, work, share)?;
    let mut evaluations = Evaluations::recorded_in(journal, recorded, study, settings)?;
    evaluations.of(&tasks, progress, evaluate)?;
    let entries: Vec<Entry> = evaluations.entries().into_values().collect();
    let text = TIMING_HEADS.to_owned() + &timing(entries.iter());
    publish(&share.timing_file(out), |file| file.write_all(text.as_bytes()))?;
    file::write(out, work, share, &entries)?;
    part::take_away(&part::of(out, share)?)?;
    Ok(Computed { walls, before, was_complete: false })
}
