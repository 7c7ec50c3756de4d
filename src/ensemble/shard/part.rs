//! A shard that is being computed: `shards/0003-of-0064.<writer>.part`, a journal of the walls that have ended. Each writer has one of its
//! own and reads those of all others, so that two never write to one file and nothing is lost with a writer.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use crate::ensemble::RunError;
use crate::ensemble::files::own_name;
use crate::ensemble::journal::{Entry, Journal, locked, walls};
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

/// The walls in parts, by the hash of what decides each. Of a part that its writer takes away meanwhile there are none.
///
/// # Errors
/// [`RunError::File`] where a part cannot be read.
pub(super) fn evaluated(parts: &[PathBuf]) -> Result<BTreeMap<String, Entry>, RunError> {
    let mut all = BTreeMap::new();
    for path in parts {
        all.extend(walls(path)?);
    }
    Ok(all)
}

/// Whether some part is being written to. Where the file system knows no locks, none seems to be.
pub(super) fn is_written(parts: &[PathBuf]) -> Result<bool, RunError> {
    for path in parts {
        if let Ok(file) = File::open(path)
            && !locked(&file, path)?
        {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Takes away the parts of a shard that is complete, but for those that others still write to: they find it complete at their end.
pub(super) fn take_away(parts: &[PathBuf]) -> Result<(), RunError> {
    for path in parts {
        if let Ok(file) = File::open(path)
            && locked(&file, path)?
        {
            // What stays is of no harm: a complete shard is not looked up in parts.
            let _ = fs::remove_file(path);
        }
    }
    Ok(())
}

/// The parts of a shard.
///
/// # Errors
/// [`RunError::File`] where the folder cannot be read.
pub(super) fn of(out: &Path, share: Share) -> Result<Vec<PathBuf>, RunError> {
    Ok(all(out)?.remove(&share.name()).unwrap_or_default())
}

/// The parts of all shards, by the names that their files begin with: a folder of many is listed once.
///
/// # Errors
/// [`RunError::File`] where the folder cannot be read.
pub(super) fn all(out: &Path) -> Result<BTreeMap<String, Vec<PathBuf>>, RunError> {
    let folder = out.join(SHARDS);
    let entries = fs::read_dir(&folder).map_err(|error| RunError::file("read", &folder, error))?;
    let mut parts: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if let (Some((share, _)), true) = (name.split_once('.'), name.ends_with(&format!(".{PART}"))) {
            parts.entry(share.to_owned()).or_default().push(path);
        }
    }
    parts.values_mut().for_each(|own| own.sort());
    Ok(parts)
}
