//! Putting shards together: their walls one after the other in the order of the results, however many they are.

use std::collections::BTreeMap;
use std::path::Path;

use rayon::prelude::*;

use crate::ensemble::design::all_in_order;
use crate::ensemble::enough::{first_looks, next_looks};
use crate::ensemble::journal::Entry;
use crate::ensemble::run::key_of;
use crate::ensemble::shard::file::{Found, Reader, look};
use crate::ensemble::shard::{ShardError, Share, Work};
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{AddedColumns, Manifest, Row, RunError, Task};
use crate::study::Study;

/// What all shards are read into memory at a time (bytes), and a shard at least.
const AT_A_TIME: usize = 1 << 26;
const PIECE: usize = 1 << 14;
/// Walls that are read from their lines at a time, on all threads.
const LINES: usize = 1 << 12;

/// The shards of a study's walls, complete or as far as there are some.
pub struct Merge<'s> {
    study: &'s Study,
    keys: WallKeys,
    out: &'s Path,
    of: u64,
    /// By number, those that are there.
    complete: Vec<bool>,
    /// What columns the tables of all have.
    pub added: AddedColumns,
    /// The numbers of those that are not.
    pub missing: Vec<u32>,
}

impl<'s> Merge<'s> {
    /// Of the shards in a folder, of which all must be there unless some are enough.
    ///
    /// # Errors
    /// [`ShardError::Missing`], [`ShardError::Foreign`], and [`RunError::File`] where a file cannot be read.
    pub fn of(
        study: &'s Study,
        work: &Work,
        out: &'s Path,
        some_are_enough: bool,
    ) -> Result<Merge<'s>, RunError> {
        let (mut complete, mut missing, mut added) = (Vec::new(), Vec::new(), AddedColumns::default());
        for share in work.shares() {
            let found = look(out, work, share)?;
            complete.push(matches!(found, Found::Complete(_)));
            match found {
                Found::Complete(head) => added.join(&head.added),
                Found::Foreign(found) => {
                    return Err(ShardError::Foreign { file: share.file(out), found }.into());
                }
                Found::Missing | Found::Damaged(_) => missing.push(share.index),
            }
        }
        if !missing.is_empty() && (!some_are_enough || missing.len() == work.of as usize) {
            return Err(ShardError::Missing { folder: out.to_path_buf(), missing, of: work.of }.into());
        }
        let keys = WallKeys::of(&work.manifest);
        Ok(Merge { study, keys, out, of: u64::from(work.of), complete, added, missing })
    }

    /// The study with the number of walls that each arm came to. Shards have all that an arm may come to, as none knows the walls of the
    /// others; a run stops where it has enough, and so does what is put together.
    ///
    /// # Errors
    /// As of [`Self::rows`].
    pub fn come_to(&self) -> Result<Study, RunError> {
        if self.study.arms.iter().all(|arm| arm.until.is_none()) {
            return Ok(self.study.clone());
        }
        let mut rows = BTreeMap::new();
        let all: Vec<u64> = self.study.arms.iter().map(|arm| arm.members).collect();
        self.rows(&all, &mut |row| {
            let task = Task { arm: row.arm_index, point: row.point, member: row.member };
            rows.insert(task, Row { load_steps: Vec::new(), ..row });
            Ok(())
        })?;
        let mut members = first_looks(self.study);
        while let Some(more) = next_looks(self.study, &members, &|task| rows.get(&task)) {
            members = more;
        }
        let mut study = self.study.clone();
        study.arms.iter_mut().zip(members).for_each(|(arm, members)| arm.members = members);
        Ok(study)
    }

    /// Takes the rows of so many members of each arm in the order of the results. What is not there is left out.
    ///
    /// # Errors
    /// [`ShardError::Damaged`] where a file is not as it was written, [`RunError::File`], and those of `take`.
    pub fn rows(
        &self,
        members: &[u64],
        take: &mut dyn FnMut(Row) -> Result<(), RunError>,
    ) -> Result<(), RunError> {
        let piece = (AT_A_TIME / self.complete.len()).max(PIECE);
        let shares = (0..).zip(&self.complete);
        let readers = shares.map(|(index, is_there)| {
            let share = Share { index, of: self.of as u32 };
            is_there.then(|| Reader::open(self.out, share, piece)).transpose()
        });
        let mut readers: Vec<Option<Reader>> = readers.collect::<Result<_, _>>()?;
        let mut next: Vec<(Task, u32, String)> = Vec::with_capacity(LINES);
        for (place, task) in (0u64..).zip(all_in_order(self.study)) {
            let index = (place % self.of) as u32;
            let Some(reader) = &mut readers[index as usize] else { continue };
            let line = reader.line()?;
            if task.member < members[task.arm as usize] {
                next.push((task, index, line));
            }
            if next.len() == LINES {
                self.read(&readers, &mut next)?.into_iter().try_for_each(&mut *take)?;
            }
        }
        self.read(&readers, &mut next)?.into_iter().try_for_each(take)
    }

    /// Writes the manifest of a run of these walls.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub fn write_manifest(&self) -> Result<(), RunError> {
        Manifest::of(self.study).write(self.out)
    }

    /// Reads rows from lines on all threads, in their order.
    fn read(
        &self,
        readers: &[Option<Reader>],
        lines: &mut Vec<(Task, u32, String)>,
    ) -> Result<Vec<Row>, RunError> {
        let of = |(task, index, line): (Task, u32, String)| -> Result<Row, RunError> {
            let reader = readers[index as usize].as_ref().expect("it gave the line");
            let Entry { wall, row, .. } = reader.entry(&line)?;
            let own = Task { arm: row.arm_index, point: row.point, member: row.member };
            let is_own = own == task && wall.is_some() && wall == key_of(self.study, &self.keys, task);
            is_own.then_some(row).ok_or_else(|| reader.damaged("a line is of another wall").into())
        };
        let lines = std::mem::replace(lines, Vec::with_capacity(LINES));
        let rows: Vec<Result<Row, RunError>> = lines.into_par_iter().map(of).collect();
        rows.into_iter().collect()
    }
}
