//! A folder with the sound study of the fixtures, which a test may spoil; gone when it goes out of scope.

use std::fs;
use std::path::{Path, PathBuf};

use pirca::study::{Faults, Loaded, Study};

/// Files of the sound study, below the scratch folder.
const FILES: [(&str, &str); 4] = [
    (STUDY, include_str!("fixtures/good/studies/base/study.toml")),
    (PUBLISHED, include_str!("fixtures/good/studies/base/published.toml")),
    (SIZE, include_str!("fixtures/good/distributions/block/size.toml")),
    (DIP, include_str!("fixtures/good/distributions/block/dip.toml")),
];
pub const STUDY: &str = "studies/base/study.toml";
pub const PUBLISHED: &str = "studies/base/published.toml";
pub const SIZE: &str = "distributions/block/size.toml";
pub const DIP: &str = "distributions/block/dip.toml";

/// A scratch copy of the sound study.
pub struct Scratch {
    root: PathBuf,
}

impl Scratch {
    /// A fresh copy; `name` tells tests apart that run at the same time.
    pub fn new(name: &str) -> Scratch {
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("study-{name}"));
        let _ = fs::remove_dir_all(&root);
        let scratch = Scratch { root };
        for (file, text) in FILES {
            scratch.write(file, text.as_bytes());
        }
        scratch
    }

    /// Path of a file.
    pub fn path(&self, file: &str) -> PathBuf {
        self.root.join(file)
    }

    /// The text of a file.
    pub fn read(&self, file: &str) -> String {
        fs::read_to_string(self.path(file)).expect("the fixture is there")
    }

    /// Writes a file.
    pub fn write(&self, file: &str, bytes: &[u8]) {
        let path = self.path(file);
        fs::create_dir_all(path.parent().expect("a file has a folder"))
            .expect("the scratch folder can be written");
        fs::write(path, bytes).expect("the scratch folder can be written");
    }

    /// Replaces a text that must occur, and answers with the line (from 1) at which it began.
    pub fn replace(&self, file: &str, from: &str, to: &str) -> usize {
        let text = self.read(file);
        let at = text.find(from).unwrap_or_else(|| panic!("`{from}` is not in {file}"));
        self.write(file, text.replacen(from, to, 1).as_bytes());
        text[..at].matches('\n').count() + 1
    }

    /// Loads the study.
    pub fn load(&self, variant: Option<&str>) -> Result<Loaded, Faults> {
        Study::load(&self.path("studies/base"), variant)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.root);
    }
}
