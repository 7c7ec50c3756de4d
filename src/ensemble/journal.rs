//! The journal: every finished wall, one line each, so that a run that was killed goes on where it stood and a finished one can grow.
//!
//! Line 1 says which run it is ([`Manifest`]), and so does a later line where the run has grown; every other line is a wall with the
//! hash of what decides it ([`WallKeys`]). A line is `{"check":"<16 hex digits>","entry":<JSON>}` with the start of the SHA-256
//! of the JSON's bytes, written and flushed as a whole. A line that a kill has torn, or a disk has damaged, fails its check:
//! it is left out and its wall is evaluated again, which gives the same row because a row is a pure function of what decides it.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::ensemble::shard::Work;
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{Manifest, Row, RunError};

/// Name of the journal in the output folder.
pub(crate) const JOURNAL: &str = "journal.jsonl";
const HEAD: &str = "{\"check\":\"";
const MIDDLE: &str = "\",\"entry\":";
const CHECK_DIGITS: usize = 16;

/// A finished wall: its row, and what it took to get it, which no result depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Entry {
    /// Hash of what decides the row. Journals of before there were any have none: it follows from their head.
    #[serde(default)]
    pub wall: Option<String>,
    /// What it took. Shards keep it in files of their own.
    #[serde(flatten)]
    pub timing: Option<Timing>,
    /// The result.
    pub row: Row,
}

/// What a wall took, and where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Timing {
    /// Wall-clock time (s).
    pub seconds: f64,
    /// Where.
    #[serde(flatten)]
    pub place: Place,
}

/// Where a wall was evaluated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Place {
    /// Worker threads of the run.
    pub threads: u32,
    /// Name of the machine.
    pub host: String,
    /// Kind of its processor. Journals of before it was kept have none.
    #[serde(default)]
    pub processor: String,
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
}

/// The journal of a run, open for more walls and locked against a second run.
pub(crate) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
    /// Bytes of it, and of its whole lines.
    length: u64,
    whole: u64,
}

/// What a journal holds.
#[derive(Default)]
pub(crate) struct Recorded {
    /// The run that it was last; `None` of a new one.
    pub head: Option<Manifest>,
    /// The walls, by the hash of what decides them.
    pub walls: BTreeMap<String, Entry>,
    /// The hashes that follow from the first head, once one was needed.
    keys: Option<WallKeys>,
}

impl Journal {
    /// Opens the journal in `folder`, or begins one, and reads what it holds; nothing is written yet.
    ///
    /// # Errors
    /// [`RunError::NotOurs`] when the folder belongs to something else, [`RunError::Busy`] when another process has it open,
    /// [`RunError::File`] when it cannot be read.
    pub fn open(folder: &Path) -> Result<(Self, Recorded), RunError> {
        let path = folder.join(JOURNAL);
        refuse_orphans(folder, &path)?;
        let file = OpenOptions::new().read(true).append(true).create(true).open(&path);
        let file = file.map_err(|e| RunError::file("open", &path, e))?;
        if !locked(&file, &path)? {
            return Err(RunError::Busy { folder: folder.to_path_buf() });
        }
        let read = |e| RunError::file("read", &path, e);
        let length = match file.metadata().map_err(read)? {
            m if m.is_file() => m.len(),
            // A device (/dev/null) can be written to, but holds nothing to go on from.
            _ => 0,
        };
        let mut recorded = Recorded::default();
        let mut whole = 0;
        if length > 0 {
            let torn;
            (whole, torn) = recorded.read(&file).map_err(read)?;
            let torn_head =
                whole == 0 && (torn.starts_with(HEAD.as_bytes()) || HEAD.as_bytes().starts_with(&torn));
            if recorded.head.is_none() && !torn_head {
                let found = format!("its {JOURNAL} does not begin with the head of a run");
                return Err(RunError::NotOurs { folder: folder.to_path_buf(), found });
            }
        }
        Ok((Journal { path, file: Mutex::new(file), length, whole }, recorded))
    }

    /// Begins a journal at a path where there is none yet, and locks it.
    ///
    /// # Errors
    /// [`RunError::File`] when it cannot be written.
    pub fn begin(path: PathBuf, head: &Manifest) -> Result<Self, RunError> {
        let file = OpenOptions::new().append(true).create_new(true).open(&path);
        let file = file.map_err(|e| RunError::file("open", &path, e))?;
        locked(&file, &path)?;
        let journal = Journal { path, file: Mutex::new(file), length: 0, whole: 0 };
        journal.go_on(Some(head))?;
        Ok(journal)
    }

    /// Cuts off a torn end, so that walls may follow; where the run is new or has grown, they follow its head.
    ///
    /// # Errors
    /// [`RunError::File`] when it cannot be written.
    pub fn go_on(&self, head: Option<&Manifest>) -> Result<(), RunError> {
        if self.length > self.whole {
            let file = self.file.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            file.set_len(self.whole).map_err(|e| RunError::file("write", &self.path, e))?;
        }
        match head {
            Some(head) => {
                let json = serde_json::to_string(head).expect("a manifest has string keys only");
                self.append(&sealed(&json))
            }
            None => Ok(()),
        }
    }

    /// Adds one line in one write, so that a kill tears the last line at most.
    pub fn append(&self, line: &str) -> Result<(), RunError> {
        let mut file = self.file.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        file.write_all(line.as_bytes()).map_err(|e| RunError::file("write", &self.path, e))
    }
}

/// Locks a file; false where another process has it locked. A file system that knows no locks is no reason not to run.
///
/// # Errors
/// [`RunError::File`].
pub(super) fn locked(file: &File, path: &Path) -> Result<bool, RunError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(e)) if e.kind() != ErrorKind::Unsupported => {
            Err(RunError::file("lock", path, e))
        }
        Err(TryLockError::Error(_)) | Ok(()) => Ok(true),
    }
}

/// The walls that can be read in a file of such lines, a journal or a shard, which another process may be writing to: by the hash of what
/// decides each. None where there is no such file.
///
/// # Errors
/// [`RunError::File`] where it cannot be read.
pub(super) fn walls(path: &Path) -> Result<BTreeMap<String, Entry>, RunError> {
    let mut recorded = Recorded::default();
    match File::open(path).and_then(|file| recorded.read(&file)) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(RunError::file("read", path, error)),
        _ => Ok(recorded.walls),
    }
}

impl Recorded {
    /// Walls of a run, by the hash of what decides them.
    pub fn of(head: Manifest, walls: BTreeMap<String, Entry>) -> Recorded {
        Recorded { head: Some(head), walls, keys: None }
    }

    /// Takes the whole lines of a file, which another process may be writing to. Gives their bytes, and the line behind them that is not
    /// whole.
    fn read(&mut self, file: &File) -> std::io::Result<(u64, Vec<u8>)> {
        let mut reader = BufReader::new(file);
        let (mut whole, mut line) = (0, Vec::new());
        while reader.read_until(b'\n', &mut line)? > 0 && line.ends_with(b"\n") {
            let json = std::str::from_utf8(&line).ok().and_then(|text| unsealed(text.trim_end()));
            self.take(json, whole == 0);
            whole += line.len() as u64;
            line.clear();
        }
        Ok((whole, line))
    }

    /// Takes a line: the first one must be a head.
    fn take(&mut self, json: Option<&str>, is_first: bool) {
        let head = || json.and_then(|json| serde_json::from_str::<Manifest>(json).ok());
        if is_first {
            self.head = head();
        } else if let Some(entry) = json.and_then(|json| serde_json::from_str::<Entry>(json).ok()) {
            let row = &entry.row;
            let wall = match (&entry.wall, &self.head) {
                (Some(wall), _) => Some(wall.clone()),
                (None, Some(head)) => {
                    let keys = self.keys.get_or_insert_with(|| WallKeys::of(head));
                    keys.key(&row.arm, row.kn_pa_per_m, row.member)
                }
                (None, None) => None,
            };
            if let Some(wall) = wall {
                self.walls.insert(wall, entry);
            }
        } else if let Some(head) = head() {
            self.head = Some(head);
        }
    }
}

/// Results without a journal cannot be told to be ours: they are not overwritten.
fn refuse_orphans(folder: &Path, journal: &Path) -> Result<(), RunError> {
    // Shards say themselves of which run they are.
    if journal.symlink_metadata().is_ok() || Work::is_in(folder) {
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
