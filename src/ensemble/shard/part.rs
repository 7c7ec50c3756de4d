//! A shard that is being computed: `shards/0003-of-0064.<writer>.part`, a journal of the walls that have ended. Each writer has one of its
//! own and reads those of all others, so that two never write to one file and nothing is lost with a writer.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use crate::ensemble::RunError;
use crate::ensemble::files::own_name;
use crate::ensemble::journal::{Entry, Journal, Recorded, locked};
use crate::ensemble::shard::{SHARDS, Share, Work};

/// What the names of parts end with.
const PART: &str = "part";

/// Begins a part of a shard.
///
/// # Errors
/// [`RunError::File`] where it cannot be written.
pub(super) fn begin(out: &Path, work: &Work, share: Share) -> Result<Journal, RunError> {
    let name = own_name(&share.file(out), PART);
    Journal::begin(out.join(SHARDS).join(name), &work.manifest)
}

/// The walls in all parts of a shard, by the hash of what decides each.
///
/// # Errors
/// [`RunError::File`] where a part cannot be read.
pub(super) fn evaluated(out: &Path, share: Share) -> Result<BTreeMap<String, Entry>, RunError> {
    let mut walls = BTreeMap::new();
    for path in parts(out, share)? {
        let mut recorded = Recorded::default();
        let read = File::open(&path).and_then(|file| recorded.read(&file));
        match read {
            Ok(_) => walls.extend(recorded.walls),
            // Another writer has ended meanwhile and taken its part away.
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
            Err(error) => return Err(RunError::file("read", &path, error)),
        }
    }
    Ok(walls)
}

/// Whether some part of a shard is being written to. Where the file system knows no locks, none seems to be.
pub(super) fn is_written(out: &Path, share: Share) -> Result<bool, RunError> {
    for path in parts(out, share)? {
        if let Ok(file) = File::open(&path)
            && !locked(&file, &path)?
        {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Takes away the parts of a shard that is complete, but for those that others still write to: they find it complete at their end.
pub(super) fn take_away(out: &Path, share: Share) -> Result<(), RunError> {
    for path in parts(out, share)? {
        if let Ok(file) = File::open(&path)
            && locked(&file, &path)?
        {
            // What stays is of no harm: a complete shard is not looked up in parts.
            let _ = fs::remove_file(&path);
        }
    }
    Ok(())
}

fn parts(out: &Path, share: Share) -> Result<Vec<PathBuf>, RunError> {
    let folder = out.join(SHARDS);
    let begin = format!("{}.", share.name());
    let entries = fs::read_dir(&folder).map_err(|error| RunError::file("read", &folder, error))?;
    let mut parts: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with(&begin) && name.ends_with(&format!(".{PART}"))
        })
        .collect();
    parts.sort();
    Ok(parts)
}
