//! Writing a file whole or not at all.

use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

use crate::ensemble::RunError;

/// Replaces a file by `bytes` so that a reader, or the next run after a kill, sees the old file or the new one and
/// never a part: written beside it under the name `<name>.partial`, brought to the disk, then renamed.
///
/// # Errors
/// [`RunError::File`] when it cannot be written; an old file of that name is then untouched.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), RunError> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".partial");
    let partial = path.with_file_name(name);
    let written = File::create(&partial).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    if let Err(error) = written.and_then(|()| fs::rename(&partial, path)) {
        // A part of a file is of use to nobody; when it cannot be removed either, the first error still tells the cause.
        let _ = fs::remove_file(&partial);
        return Err(RunError::file("write", path, error));
    }
    Ok(())
}
