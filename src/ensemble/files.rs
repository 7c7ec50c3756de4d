//! Writing a file whole or not at all.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::ensemble::RunError;

/// Replaces a file by `bytes` so that a reader, or the next run after a kill, sees the old file or the new one and
/// never a part: see [`Replacement`].
///
/// # Errors
/// [`RunError::File`] when it cannot be written; an old file of that name is then untouched.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), RunError> {
    let mut replacement = Replacement::begin(path)?;
    replacement.write(bytes)?;
    replacement.end()
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
        let mut name = path.file_name().unwrap_or_default().to_os_string();
        name.push(".partial");
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
