//! Writing a file whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::ensemble::{RunError, machine};

/// Replaces a file by `bytes` so that a reader, or the next run after a kill, sees the old file or the new one and
/// never a part: it is written beside it, brought to the disk and renamed.
///
/// # Errors
/// [`RunError::File`] when it cannot be written; an old file of that name is then untouched.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), RunError> {
    let mut replacement = Replacement::begin(path)?;
    replacement.write(bytes)?;
    replacement.end()
}

/// Removes a file if it is there, and says whether it was.
///
/// # Errors
/// [`RunError::File`] when it is there and cannot be removed.
pub fn remove_file(path: &Path) -> Result<bool, RunError> {
    match fs::remove_file(path) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(RunError::file("remove", path, error)),
    }
}

/// A file that takes the place of another once it is whole: written beside it under the name `<name>.partial`, brought to the disk, then
/// renamed. Dropped before its end it leaves nothing behind.
pub(super) struct Replacement {
    path: PathBuf,
    partial: PathBuf,
    file: File,
    is_in_place: bool,
}

impl Replacement {
    /// Begins an empty file.
    ///
    /// # Errors
    /// [`RunError::File`], as of all that follows; it names the file that was to be replaced.
    pub fn begin(path: &Path) -> Result<Replacement, RunError> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Replacement::under(path, &format!("{name}.partial"))
    }

    /// The same, written under this name.
    fn under(path: &Path, name: &str) -> Result<Replacement, RunError> {
        let (path, partial) = (path.to_path_buf(), path.with_file_name(name));
        let file = File::create(&partial).map_err(|error| RunError::file("write", &path, error))?;
        Ok(Replacement { path, partial, file, is_in_place: false })
    }

    /// Writes what follows.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), RunError> {
        self.file.write_all(bytes).map_err(|error| RunError::file("write", &self.path, error))
    }

    /// Brings it to the disk and puts it in place.
    pub fn end(mut self) -> Result<(), RunError> {
        let placed = self.file.sync_all().and_then(|()| fs::rename(&self.partial, &self.path));
        self.is_in_place = placed.is_ok();
        placed.map_err(|error| RunError::file("write", &self.path, error))
    }
}

impl Drop for Replacement {
    fn drop(&mut self) {
        if !self.is_in_place {
            // A part of a file is of use to nobody; where it cannot be removed either, the first error still tells the cause.
            let _ = fs::remove_file(&self.partial);
        }
    }
}

/// [`replace_file`] for a file that other processes, on other machines too, may write at the same time: each writes under a name of its
/// own, and the last one to rename stays. What is written need not fit into memory.
///
/// # Errors
/// As [`replace_file`].
pub(super) fn publish(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), RunError> {
    let mut replacement = Replacement::under(path, &own_name(path, "partial"))?;
    let mut file = BufWriter::new(&mut replacement.file);
    let written = write(&mut file).and_then(|()| file.flush());
    drop(file);
    written.map_err(|error| RunError::file("write", path, error))?;
    replacement.end()
}

/// The name of a file with an ending that no other writer of it has: by machine, process and number.
pub(super) fn own_name(path: &Path, ending: &str) -> String {
    static NUMBER: AtomicUsize = AtomicUsize::new(0);
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    let host: String = machine::host().chars().map(plain).collect();
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    format!("{name}.{host}-{}-{number}.{ending}", std::process::id())
}
