//! How far shared work is.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::Serialize;

use crate::ensemble::RunError;
use crate::ensemble::shard::file::{self, Found, look};
use crate::ensemble::shard::{Share, Work, array, part};

/// How far the work in a folder is, by what its files say: no clock is asked, and every line of a complete shard is read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Status {
    /// Number of shards.
    pub shards: u32,
    /// Evaluations of all.
    pub evaluations: u64,
    /// Shards that are complete.
    pub complete: u32,
    /// Evaluations in complete shards.
    pub evaluated: u64,
    /// Shards that are to be computed, damaged ones among them, as Slurm takes them in `--array`; empty if none are.
    pub missing: String,
    /// Shards of which some walls are evaluated.
    pub begun: Vec<Begun>,
    /// Shards whose file is not as it was written, with what is wrong. They are computed again.
    pub damaged: Vec<(u32, String)>,
    /// Files that are shards of other work, with what they are of. Nothing replaces them.
    pub foreign: Vec<(u32, String)>,
}

/// A shard of which some walls are evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Begun {
    /// Its number.
    pub index: u32,
    /// Walls that are evaluated.
    pub walls: u64,
    /// Of so many.
    pub of: u64,
    /// Whether a process is writing to it, as far as the file system knows locks; a shard that is begun and not written to was stopped.
    pub writing: bool,
}

impl Status {
    /// Of the shards in a folder.
    ///
    /// # Errors
    /// As of [`Work::read`], and [`RunError::File`] where a file cannot be read.
    pub fn of(out: &Path) -> Result<(Work, Status), RunError> {
        let work = Work::read(out)?;
        let mut status = Status {
            shards: work.of,
            evaluations: work.evaluations,
            complete: 0,
            evaluated: 0,
            missing: String::new(),
            begun: Vec::new(),
            damaged: Vec::new(),
            foreign: Vec::new(),
        };
        let (mut missing, parts) = (Vec::new(), part::all(out)?);
        let shares: Vec<Share> = work.shares().collect();
        let found: Vec<Result<Found, RunError>> =
            shares.par_iter().map(|share| verified(out, &work, *share)).collect();
        for (share, found) in shares.into_iter().zip(found) {
            match found? {
                Found::Complete(head) => {
                    status.complete += 1;
                    status.evaluated += head.walls;
                    continue;
                }
                Found::Foreign(found) => {
                    status.foreign.push((share.index, found));
                    continue;
                }
                Found::Damaged(found) => status.damaged.push((share.index, found)),
                Found::Missing => {
                    let own = parts.get(&share.name()).map_or(&[][..], Vec::as_slice);
                    status.begun.extend(begun(&work, share, own)?);
                }
            }
            missing.push(share.index);
        }
        status.missing = array(&missing);
        Ok((work, status))
    }
}

/// What the file of a shard is, with all its lines read: one whose head is right may still have lost a bit.
fn verified(out: &Path, work: &Work, share: Share) -> Result<Found, RunError> {
    let found = look(out, work, share)?;
    let damage = match &found {
        Found::Complete(head) => file::damage(out, share, head)?,
        _ => None,
    };
    Ok(damage.map_or(found, Found::Damaged))
}

fn begun(work: &Work, share: Share, parts: &[PathBuf]) -> Result<Option<Begun>, RunError> {
    let walls = part::evaluated(parts)?.len() as u64;
    let writing = part::is_written(parts)?;
    let of = share.count(work.evaluations);
    Ok((walls > 0 || writing).then_some(Begun { index: share.index, walls, of, writing }))
}
