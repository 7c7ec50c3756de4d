//! Where a run lies, and how its files are read and written.

use std::fs;
use std::path::{Path, PathBuf};

use pirca::ensemble::replace_file;
use serde::de::DeserializeOwned;

/// Where a run lies.
#[derive(Clone)]
pub struct Folders {
    pub out: PathBuf,
    /// Whether all that is asked for must lie there already.
    pub is_whole: bool,
}

impl Folders {
    /// One of its folders, which is made if it is not there.
    pub fn of(&self, kind: &str) -> PathBuf {
        let folder = self.out.join(kind);
        fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        folder
    }

    /// Something is to be found out as it does not lie there.
    pub fn lack(&self, what: &str) {
        assert!(!self.is_whole, "{} lacks {what}", self.out.display());
    }
}

/// What a run was begun with, which lies with its labels. It goes on with nothing else.
pub fn begun_with(folders: &Folders, file: &str, now: String) -> String {
    let path = folders.of("sealed").join(file);
    if !path.exists() {
        write(&path, &now);
    }
    let first = read(&path);
    assert!(
        now == first,
        "{} is {first}, and this run is of {now}: give it another HIDDEN_EFFECT_OUT and HIDDEN_EFFECT_RECORD",
        path.display()
    );
    first
}

pub fn write(path: &Path, text: &str) {
    replace_file(path, text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
}

/// Writes what can be had again in a moment. A run that is stopped leaves it whole or not at all, but it is not brought to the disk,
/// which takes minutes for thousands of files.
pub fn put(path: &Path, text: &str) {
    let partial = path.with_extension("partial");
    let written = fs::write(&partial, text).and_then(|()| fs::rename(&partial, path));
    written.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

pub fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What was written in an earlier stage.
pub fn told<T: DeserializeOwned>(path: &Path) -> T {
    serde_json::from_str(&read(path)).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
