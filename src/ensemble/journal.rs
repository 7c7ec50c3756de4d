//! The journal: every finished member, one line each, so that a run that was killed goes on where it stood.
//!
//! Line 1 says which run it is ([`Manifest`]); every other line is a member. A line is
//! `{"check":"<16 hex digits>","entry":<JSON>}` with the start of the SHA-256 of the JSON's bytes, written and flushed
//! as a whole. A line that a kill has torn, or a disk has damaged, fails its check: it is left out and its member is
//! evaluated again, which gives the same row because a row is a pure function of study, seed and task.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::ensemble::{Manifest, Row, RunError, Task};

/// Name of the journal in the output folder.
pub(crate) const JOURNAL: &str = "journal.jsonl";
const HEAD: &str = "{\"check\":\"";
const MIDDLE: &str = "\",\"entry\":";
const CHECK_DIGITS: usize = 16;

/// A finished member: its row, and what it took to get it, which no result depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Entry {
    /// Wall-clock time (s).
    pub seconds: f64,
    /// Worker threads of the run.
    pub threads: u32,
    /// Name of the machine.
    pub host: String,
    /// The result.
    pub row: Row,
}

impl Entry {
    /// The entry as a line of the journal.
    ///
    /// Panics when the line would not give the very same entry back (JSON has no NaN): a resumed run would then end
    /// with other bytes than an uninterrupted one.
    pub fn line(&self) -> String {
        let json = serde_json::to_string(self).expect("an entry has string keys only");
        let back = serde_json::from_str::<Entry>(&json);
        crate::check!(back.as_ref().is_ok_and(|entry| entry == self), "a row that JSON cannot hold: {json}");
        sealed(&json)
    }

    fn task(&self) -> Task {
        Task { arm: self.row.arm_index, point: self.row.point, member: self.row.member }
    }
}

/// The journal of a run, open for more members and locked against a second run.
pub(crate) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
}

impl Journal {
    /// Opens the journal of this run in `folder`, or begins one, and reads the members that it holds.
    ///
    /// # Errors
    /// [`RunError::OtherRun`] and [`RunError::NotOurs`] when the folder belongs to something else, [`RunError::Busy`]
    /// when another process has it open, [`RunError::File`] when it cannot be read or written.
    pub fn open(folder: &Path, manifest: &Manifest) -> Result<(Self, BTreeMap<Task, Entry>), RunError> {
        let path = folder.join(JOURNAL);
        refuse_orphans(folder, &path)?;
        let file = OpenOptions::new().read(true).append(true).create(true).open(&path);
        let file = file.map_err(|e| RunError::file("open", &path, e))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(RunError::Busy { folder: folder.to_path_buf() }),
            // A file system that knows no locks is no reason not to run.
            Err(TryLockError::Error(e)) if e.kind() != ErrorKind::Unsupported => {
                return Err(RunError::file("lock", &path, e));
            }
            Err(TryLockError::Error(_)) | Ok(()) => {}
        }
        let journal = Journal { path, file: Mutex::new(file) };
        let entries = journal.take_up(folder, manifest)?;
        Ok((journal, entries))
    }

    /// Reads what is there, cuts off a torn end, and writes the head if there is none yet.
    fn take_up(&self, folder: &Path, manifest: &Manifest) -> Result<BTreeMap<Task, Entry>, RunError> {
        let read = |e| RunError::file("read", &self.path, e);
        let mut file = self.file.lock().expect("nobody else has it yet");
        let length = match file.metadata().map_err(read)? {
            m if m.is_file() => m.len(),
            // A device (/dev/null) can be written to, but holds nothing to go on from.
            _ => 0,
        };
        let (mut whole, mut head, mut entries) = (0, None, BTreeMap::new());
        if length > 0 {
            let mut reader = BufReader::new(&*file);
            let mut line = Vec::new();
            while reader.read_until(b'\n', &mut line).map_err(read)? > 0 && line.ends_with(b"\n") {
                let json = std::str::from_utf8(&line).ok().and_then(|text| unsealed(text.trim_end()));
                if whole == 0 {
                    head = json.and_then(|j| serde_json::from_str::<Manifest>(j).ok());
                } else if let Some(entry) = json.and_then(|j| serde_json::from_str::<Entry>(j).ok()) {
                    entries.insert(entry.task(), entry);
                }
                whole += line.len() as u64;
                line.clear();
            }
            let torn_head =
                whole == 0 && (line.starts_with(HEAD.as_bytes()) || HEAD.as_bytes().starts_with(&line));
            if head.is_none() && !torn_head {
                let found = format!("its {JOURNAL} does not begin with the head of a run");
                return Err(RunError::NotOurs { folder: folder.to_path_buf(), found });
            }
        }
        if let Some(recorded) = &head {
            let differences = recorded.differences(manifest);
            if !differences.is_empty() {
                return Err(RunError::OtherRun { folder: folder.to_path_buf(), differences });
            }
        }
        let write = |e| RunError::file("write", &self.path, e);
        if length > whole {
            file.set_len(whole).map_err(write)?;
        }
        if head.is_none() {
            let json = serde_json::to_string(manifest).expect("a manifest has string keys only");
            file.write_all(sealed(&json).as_bytes()).map_err(write)?;
        }
        Ok(entries)
    }

    /// Adds one line in one write, so that a kill tears the last line at most.
    pub fn append(&self, line: &str) -> Result<(), RunError> {
        let mut file = self.file.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        file.write_all(line.as_bytes()).map_err(|e| RunError::file("write", &self.path, e))
    }
}

/// Results without a journal cannot be told to be ours: they are not overwritten.
fn refuse_orphans(folder: &Path, journal: &Path) -> Result<(), RunError> {
    if journal.symlink_metadata().is_ok() {
        return Ok(());
    }
    match ["members.parquet", "steps.parquet", "summary.json"].iter().find(|name| folder.join(name).exists())
    {
        None => Ok(()),
        Some(name) => {
            let found = format!("holds {name} but no {JOURNAL} that says of which run");
            Err(RunError::NotOurs { folder: folder.to_path_buf(), found })
        }
    }
}

/// JSON as a line with its check.
pub(super) fn sealed(json: &str) -> String {
    format!("{HEAD}{}{MIDDLE}{json}}}\n", check(json))
}

/// The JSON of a line whose check is right.
pub(super) fn unsealed(line: &str) -> Option<&str> {
    let rest = line.strip_prefix(HEAD)?;
    let (stated, rest) = rest.split_at_checked(CHECK_DIGITS)?;
    let json = rest.strip_prefix(MIDDLE)?.strip_suffix('}')?;
    (stated == check(json)).then_some(json)
}

fn check(json: &str) -> String {
    let digest = Sha256::digest(json.as_bytes());
    digest.iter().take(CHECK_DIGITS / 2).map(|byte| format!("{byte:02x}")).collect()
}
