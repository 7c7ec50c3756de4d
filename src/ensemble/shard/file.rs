//! A complete shard: `shards/0003-of-0064.jsonl`. Its first line says of what it is and how long the file is; a line per wall follows, in
//! the order of the results. Every line has its check, as those of the journal, and the bytes depend on the walls alone.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::ensemble::files::publish;
use crate::ensemble::journal::{self, Entry, Recorded, sealed, unsealed};
use crate::ensemble::shard::{ShardError, Share, Work};
use crate::ensemble::{AddedColumns, Manifest, RunError, Task};

/// The first line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Head {
    /// Version of pirca.
    pub version: String,
    /// Name of the study.
    pub study: String,
    /// Named variant, if any.
    pub variant: Option<String>,
    /// Seed of all random streams.
    pub seed: u64,
    /// SHA-256 over everything that decides a result.
    pub study_hash: String,
    /// Which shard.
    pub share: Share,
    /// Number of walls.
    pub walls: u64,
    /// Bytes of their lines.
    pub bytes: u64,
    /// What columns its tables have.
    pub added: AddedColumns,
}

/// What the file of a shard is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Found {
    /// There is none.
    Missing,
    /// It is complete as far as its head and its length tell.
    Complete(Head),
    /// It is not as it was written.
    Damaged(String),
    /// It is of other work.
    Foreign(String),
}

impl Head {
    fn of(manifest: &Manifest, share: Share) -> Head {
        Head {
            version: manifest.version.clone(),
            study: manifest.study.clone(),
            variant: manifest.variant.clone(),
            seed: manifest.seed,
            study_hash: manifest.study_hash.clone(),
            share,
            walls: 0,
            bytes: 0,
            added: AddedColumns::default(),
        }
    }

    /// What makes it the head of other work than this one's; `None` if nothing does.
    fn other_than(&self, wanted: &Head) -> Option<String> {
        let name = |head: &Head| match &head.variant {
            Some(variant) => format!("{} {variant}", head.study),
            None => head.study.clone(),
        };
        if self.version != wanted.version {
            return Some(format!(
                "it is of pirca {}, and the others are of pirca {}",
                self.version, wanted.version
            ));
        }
        if name(self) != name(wanted) {
            return Some(format!(
                "it is of the study {}, and the others are of {}",
                name(self),
                name(wanted)
            ));
        }
        if self.seed != wanted.seed {
            return Some(format!("it has the seed {}, and the others have {}", self.seed, wanted.seed));
        }
        if self.study_hash != wanted.study_hash {
            return Some(format!("it is of {} with other values than the others", name(self)));
        }
        let Share { index, of } = self.share;
        (self.share != wanted.share)
            .then(|| format!("it is shard {index} of {of}, which its name does not say"))
    }
}

/// Looks at the file of a shard, without reading its walls.
///
/// # Errors
/// [`RunError::File`] where it cannot be read.
pub(super) fn look(out: &Path, work: &Work, share: Share) -> Result<Found, RunError> {
    let path = share.file(out);
    let (head, begin, length) = match head(&path) {
        Ok(found) => found,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Found::Missing),
        Err(error) => return Err(RunError::file("read", &path, error)),
    };
    let Some(head) = head else {
        return Ok(Found::Damaged("its first line is damaged".to_owned()));
    };
    if let Some(other) = head.other_than(&Head::of(&work.manifest, share)) {
        return Ok(Found::Foreign(other));
    }
    if begin + head.bytes != length {
        return Ok(Found::Damaged(format!(
            "it has {length} bytes and was written with {}",
            begin + head.bytes
        )));
    }
    let walls = share.count(work.evaluations);
    if head.walls != walls {
        return Ok(Found::Damaged(format!("it has {} walls of {walls}", head.walls)));
    }
    Ok(Found::Complete(head))
}

/// The head of a file, where its walls begin, and its length (bytes).
fn head(path: &Path) -> std::io::Result<(Option<Head>, u64, u64)> {
    let file = File::open(path)?;
    let length = file.metadata()?.len();
    let mut line = Vec::new();
    let begin = BufReader::new(file).read_until(b'\n', &mut line)? as u64;
    let text = std::str::from_utf8(&line).unwrap_or_default();
    let json = unsealed(text.trim_end());
    // A head of another version may say other things; which version it is of, it says.
    let head = json.and_then(|json| serde_json::from_str(json).ok());
    Ok((head, begin, length))
}

/// Writes a complete shard, of walls in the order of the results.
///
/// # Errors
/// [`RunError::File`] where it cannot be written; what was there before is then untouched.
pub(super) fn write(out: &Path, work: &Work, share: Share, entries: &[Entry]) -> Result<(), RunError> {
    let mut head = Head { walls: entries.len() as u64, ..Head::of(&work.manifest, share) };
    let lines: Vec<String> = entries
        .iter()
        .map(|entry| Entry { timing: None, ..entry.clone() }.line())
        .inspect(|line| head.bytes += line.len() as u64)
        .collect();
    entries.iter().for_each(|entry| head.added.take(&entry.row));
    let head = sealed(&serde_json::to_string(&head).expect("a head has string keys only"));
    publish(&share.file(out), |file| {
        file.write_all(head.as_bytes())?;
        lines.iter().try_for_each(|line| file.write_all(line.as_bytes()))
    })
}

/// The lines of a complete shard one after the other. The file is opened anew for each piece of it, so that there may be more shards than a
/// process may have files open.
pub(super) struct Reader {
    path: PathBuf,
    share: Share,
    /// Where the next piece begins.
    at: u64,
    /// Bytes of a piece.
    piece: usize,
    lines: std::vec::IntoIter<String>,
}

impl Reader {
    /// From its first wall on, in pieces of so many bytes or one line.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub fn open(out: &Path, share: Share, piece: usize) -> Result<Reader, RunError> {
        let path = share.file(out);
        let (_, at, _) = head(&path).map_err(|error| RunError::file("read", &path, error))?;
        Ok(Reader { path, share, at, piece, lines: Vec::new().into_iter() })
    }

    /// The next line, with its end.
    ///
    /// # Errors
    /// [`ShardError::Damaged`] at the end of the file, [`RunError::File`] where it cannot be read.
    pub fn line(&mut self) -> Result<String, RunError> {
        if self.lines.len() == 0 {
            let read = self.read().map_err(|error| RunError::file("read", &self.path, error))?;
            self.at += read.iter().map(|line| line.len() as u64).sum::<u64>();
            self.lines = read.into_iter();
        }
        self.lines.next().ok_or_else(|| self.damaged("a wall is missing").into())
    }

    /// The entry of one of its lines.
    ///
    /// # Errors
    /// [`ShardError::Damaged`] where the line is not as it was written.
    pub fn entry(&self, line: &str) -> Result<Entry, ShardError> {
        let json = unsealed(line.trim_end());
        let entry = json.and_then(|json| serde_json::from_str(json).ok());
        entry.ok_or_else(|| self.damaged("the line of a wall is damaged"))
    }

    /// That the file is not as it was written.
    pub fn damaged(&self, found: &str) -> ShardError {
        ShardError::Damaged { file: self.path.clone(), index: self.share.index, found: found.to_owned() }
    }

    fn read(&self) -> std::io::Result<Vec<String>> {
        let mut file = File::open(&self.path)?;
        file.seek(SeekFrom::Start(self.at))?;
        let mut file = BufReader::with_capacity(self.piece.min(1 << 16), file);
        let (mut lines, mut read) = (Vec::new(), 0);
        while read < self.piece {
            let mut line = Vec::new();
            // A damaged file may have no ends of lines.
            let more = file.by_ref().take(LONGEST).read_until(b'\n', &mut line)?;
            if more == 0 {
                break;
            }
            read += more;
            lines.push(String::from_utf8_lossy(&line).into_owned());
        }
        Ok(lines)
    }
}

/// No line of a wall is longer (bytes).
const LONGEST: u64 = 1 << 26;

/// Whether every line of a shard is as it was written, and of the wall that it should be of, by the hashes of what decides each.
///
/// # Errors
/// [`RunError::File`] where the file cannot be read.
pub(super) fn is_whole(
    out: &Path,
    share: Share,
    walls: impl Iterator<Item = Option<String>>,
) -> Result<bool, RunError> {
    let mut reader = Reader::open(out, share, PIECE)?;
    for wall in walls {
        let line = match reader.line() {
            Err(RunError::Shard(ShardError::Damaged { .. })) => return Ok(false),
            line => line?,
        };
        if !reader.entry(&line).is_ok_and(|entry| entry.wall.is_some() && entry.wall == wall) {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The first thing that is not as it was written in a shard whose head and length are right: every line is held against its check, and
/// walls against their order. `None` of a sound shard.
///
/// # Errors
/// [`RunError::File`] where the file cannot be read.
pub(super) fn damage(out: &Path, share: Share, head: &Head) -> Result<Option<String>, RunError> {
    let mut reader = Reader::open(out, share, PIECE)?;
    let mut last = None;
    for wall in 1..=head.walls {
        let row = match reader.line() {
            Err(RunError::Shard(ShardError::Damaged { .. })) => None,
            line => reader.entry(&line?).ok().map(|entry| entry.row),
        };
        let Some(row) = row else {
            return Ok(Some(format!("the line of its wall {wall} of {} is damaged", head.walls)));
        };
        let task = Task { arm: row.arm_index, point: row.point, member: row.member };
        if last.replace(task) >= Some(task) {
            return Ok(Some(format!("the line of its wall {wall} of {} is out of order", head.walls)));
        }
    }
    Ok(None)
}

/// Bytes that are read at a time where one shard is read alone.
const PIECE: usize = 1 << 20;

/// The walls that can be read in the file of a shard, by the hash of what decides each.
///
/// # Errors
/// [`RunError::File`] where the file cannot be read.
pub(super) fn walls(out: &Path, share: Share) -> Result<BTreeMap<String, Entry>, RunError> {
    journal::walls(&share.file(out))
}

/// What the shards in a folder are of, with their walls as far as these can be read; `None` where it holds no shards.
///
/// # Errors
/// As of [`Work::read`], and [`RunError::File`] where a file cannot be read.
pub fn recorded(out: &Path) -> Result<Option<Recorded>, RunError> {
    if !Work::is_in(out) {
        return Ok(None);
    }
    let work = Work::read(out)?;
    let mut all = BTreeMap::new();
    for share in work.shares() {
        all.extend(walls(out, share)?);
    }
    Ok(Some(Recorded::of(work.manifest, all)))
}
