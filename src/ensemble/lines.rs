//! A file of the output folder that grows line by line, each checked as those of the journal are, so that work that was stopped goes
//! on where it stood.

use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::path::PathBuf;
use std::sync::Mutex;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::ensemble::RunError;
use crate::ensemble::journal::{sealed, unsealed};

/// The file, open for more lines.
pub(super) struct Lines {
    path: PathBuf,
    file: Mutex<File>,
    fault: Mutex<Option<RunError>>,
}

impl Lines {
    /// Opens a file, or begins it, with the lines that it has. Those that a kill has torn or a disk has damaged are left out.
    ///
    /// # Errors
    /// [`RunError::File`] where it cannot be read or written.
    pub fn open<L: DeserializeOwned>(path: PathBuf) -> Result<(Lines, Vec<L>), RunError> {
        let opened = OpenOptions::new().read(true).append(true).create(true).open(&path);
        let mut file = opened.map_err(|error| RunError::file("open", &path, error))?;
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(|error| RunError::file("read", &path, error))?;
        let text = String::from_utf8_lossy(&text);
        let lines = Lines { path, file: Mutex::new(file), fault: Mutex::default() };
        // What a kill has torn must not run into what comes next.
        lines.write(if text.is_empty() || text.ends_with('\n') { "" } else { "\n" })?;
        Ok((lines, Self::read(&text).collect()))
    }

    /// The lines of a text.
    pub fn read<L: DeserializeOwned>(text: &str) -> impl Iterator<Item = L> {
        text.lines().filter_map(|line| serde_json::from_str(unsealed(line)?).ok())
    }

    /// Adds lines; a fault of the disk is kept for [`Self::fault`].
    pub fn add<L: Serialize>(&self, lines: impl Iterator<Item = L>) {
        let text: String = lines.map(|line| written(&line)).collect();
        if let Err(error) = self.write(&text) {
            self.fault.lock().expect("nothing panics that holds it").get_or_insert(error);
        }
    }

    /// The first fault of the disk, if there was one: what was added since is not kept.
    pub fn fault(&self) -> Option<RunError> {
        self.fault.lock().expect("nothing panics that holds it").take()
    }

    fn write(&self, text: &str) -> Result<(), RunError> {
        let mut file = self.file.lock().expect("nothing panics that holds it");
        file.write_all(text.as_bytes()).map_err(|error| RunError::file("write", &self.path, error))
    }
}

fn written(line: &impl Serialize) -> String {
    sealed(&serde_json::to_string(line).expect("a line has string keys and finite numbers only"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_found_again_and_a_torn_one_is_left_out() {
        let path = std::env::temp_dir().join(format!("pirca-lines-{}.jsonl", std::process::id()));
        let (lines, none) = Lines::open::<(u64, f64)>(path.clone()).expect("it is new");
        assert!(none.is_empty());
        lines.add([(3_u64, 1.0 / 3.0), (4, 0.1 + 0.2)].into_iter());
        assert!(lines.fault().is_none());
        drop(lines);
        let mut text = std::fs::read_to_string(&path).expect("text");
        text.push_str(&written(&(5_u64, 2.0))[..20]);
        std::fs::write(&path, text).expect("written");
        let (lines, found) = Lines::open::<(u64, f64)>(path.clone()).expect("it is there");
        assert_eq!(found, [(3, 1.0 / 3.0), (4, 0.1 + 0.2)]);
        lines.add(std::iter::once((5_u64, 2.0)));
        let (_, found) = Lines::open::<(u64, f64)>(path.clone()).expect("it is there");
        assert_eq!(found.last(), Some(&(5, 2.0)));
        std::fs::remove_file(path).expect("it is the test's own");
    }
}
