//! What tasks came to, a line each in a file of the output folder, so that work that was stopped goes on where it stood, may grow, and can
//! be shared out to shards.
//!
//! A line is the key of a task with its row, checked as those of the journal are. A key holds all that decides the row, so that a row is
//! never taken for that of another task. A shard writes into a file of its own beside the others; whoever works in the folder later takes
//! up the rows of all of them.

use std::collections::HashMap;
use std::fs;
use std::hash::Hash;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::ensemble::RunError;
use crate::ensemble::lines::Lines;
use crate::ensemble::shard::Share;
use crate::interrupt;

/// What the files of a ledger end with.
const ENDING: &str = "jsonl";

/// A line: whose rows they are where one study alone may have them, or a task with what it came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Line<K, R> {
    Study(String),
    Task { key: K, row: R },
}

/// Rows of tasks by their keys.
pub struct Ledger<K, R> {
    lines: Lines,
    rows: Mutex<HashMap<K, R>>,
    share: Option<Share>,
}

impl<K, R> Ledger<K, R>
where
    K: Clone + Eq + Hash + Send + Sync + Serialize + DeserializeOwned,
    R: Clone + PartialEq + Send + Sync + Serialize + DeserializeOwned,
{
    /// Opens the ledger of that name in an existing folder, or begins it, with the rows of all its shards. A shard, if one is given,
    /// writes into a file of its own.
    ///
    /// # Errors
    /// [`RunError::File`] where it cannot be read or written.
    pub fn open(folder: &Path, name: &str, share: Option<Share>) -> Result<Self, RunError> {
        Ok(Self::checked(folder, name, None, share)?.0)
    }

    /// The same of rows that one study alone may have, by the hash of all that decides it: its keys need not say so.
    ///
    /// # Errors
    /// [`RunError::NotOurs`] where they are of another study, and as of [`Ledger::open`].
    pub fn of_study(folder: &Path, name: &str, study: &str, share: Option<Share>) -> Result<Self, RunError> {
        let (ledger, is_stated) = Self::checked(folder, name, Some(study), share)?;
        if !is_stated {
            ledger.lines.add(std::iter::once(Line::<K, R>::Study(study.to_owned())));
        }
        ledger.lines.fault().map_or(Ok(ledger), Err)
    }

    /// Opens it, and says whether its own file states the study.
    fn checked(
        folder: &Path,
        name: &str,
        study: Option<&str>,
        share: Option<Share>,
    ) -> Result<(Self, bool), RunError> {
        let own = folder.join(file(name, share));
        let mut rows = HashMap::new();
        let mut take = |line, path: &Path| match line {
            Line::Task { key, row } => {
                rows.insert(key, row);
                Ok(false)
            }
            Line::Study(other) if study.is_none_or(|study| study == other) => Ok(true),
            Line::Study(_) => {
                let file = path.file_name().unwrap_or_default().to_string_lossy();
                let found = format!("its {file} is of another study, or of the same with other values");
                Err(RunError::NotOurs { folder: folder.to_path_buf(), found })
            }
        };
        for path in shards(folder, name)?.into_iter().filter(|path| *path != own) {
            let text = fs::read(&path).map_err(|error| RunError::file("read", &path, error))?;
            for line in Lines::read(&String::from_utf8_lossy(&text)) {
                take(line, &path)?;
            }
        }
        let (lines, found) = Lines::open(own.clone())?;
        let mut is_stated = false;
        for line in found {
            is_stated |= take(line, &own)?;
        }
        Ok((Ledger { lines, rows: Mutex::new(rows), share }, is_stated))
    }

    /// What a task came to; `None` where it is not known yet.
    pub fn row(&self, key: &K) -> Option<R> {
        self.rows.lock().expect("nothing panics that holds it").get(key).cloned()
    }

    /// What all tasks came to, in their order. Those that are not known yet are evaluated on all threads, and kept as they end; `finished`
    /// is told, from these threads, how many of how many are done. A shard evaluates its own alone and gives `None` for those of others
    /// that are not there yet.
    ///
    /// Panics when the disk would not give a row back as it is (JSON has no NaN): work that goes on would end with other bytes.
    ///
    /// # Errors
    /// The first fault of the disk.
    pub fn rows<T: Sync>(
        &self,
        tasks: &[T],
        key: impl Fn(&T) -> K + Sync,
        finished: &(dyn Fn(usize, usize) + Sync),
        evaluate: impl Fn(&T) -> R + Sync,
    ) -> Result<Vec<Option<R>>, RunError> {
        let keys: Vec<K> = tasks.iter().map(key).collect();
        let all = keys.iter().zip(tasks).enumerate();
        let open: Vec<(&K, &T)> = all
            .filter(|(at, (key, _))| self.has(*at) && self.row(key).is_none())
            .map(|(_, keyed)| keyed)
            .collect();
        let done = AtomicUsize::new(0);
        open.par_iter().with_max_len(1).try_for_each(|(key, task)| {
            interrupt::look();
            self.keep(key, evaluate(task))?;
            finished(done.fetch_add(1, Ordering::Relaxed) + 1, open.len());
            Ok::<(), RunError>(())
        })?;
        Ok(keys.iter().map(|key| self.row(key)).collect())
    }

    /// Whether the task at that place among all is this shard's.
    fn has(&self, at: usize) -> bool {
        self.share.is_none_or(|share| at as u64 % u64::from(share.of) == u64::from(share.index))
    }

    fn keep(&self, key: &K, row: R) -> Result<(), RunError> {
        let line = Line::Task { key: key.clone(), row: row.clone() };
        let json = serde_json::to_string(&line).expect("a line has string keys only");
        let back = serde_json::from_str::<Line<K, R>>(&json);
        crate::check!(
            back.is_ok_and(|back| matches!(back, Line::Task { row: same, .. } if same == row)),
            "a row that JSON cannot hold: {json}"
        );
        self.lines.add(std::iter::once(line));
        self.rows.lock().expect("nothing panics that holds it").insert(key.clone(), row);
        self.lines.fault().map_or(Ok(()), Err)
    }
}

/// The file that a ledger or a shard of it writes.
fn file(name: &str, share: Option<Share>) -> String {
    match share {
        None => format!("{name}.{ENDING}"),
        Some(share) => format!("{name}-{}.{ENDING}", share.name()),
    }
}

/// The files of a ledger and its shards.
fn shards(folder: &Path, name: &str) -> Result<Vec<PathBuf>, RunError> {
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(|error| RunError::file("read", folder, error))?,
    };
    let is_one = |path: &PathBuf| {
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let rest = file.strip_prefix(name).and_then(|rest| rest.strip_suffix(&format!(".{ENDING}")));
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('-') && rest.contains("-of-"))
    };
    let mut files: Vec<PathBuf> =
        entries.filter_map(|entry| Some(entry.ok()?.path())).filter(is_one).collect();
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicU64;

    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("pirca-ledger-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        folder
    }

    /// Thirds of numbers by a ledger, and how many were computed.
    fn thirds(ledger: &Ledger<u64, f64>, numbers: &[u64]) -> (Vec<Option<f64>>, u64) {
        let computed = AtomicU64::new(0);
        let third = |number: &u64| {
            computed.fetch_add(1, Ordering::Relaxed);
            *number as f64 / 3.0
        };
        let rows = ledger.rows(numbers, |number| *number, &|_, _| {}, third).expect("it can be written");
        (rows, computed.into_inner())
    }

    #[test]
    fn what_is_known_is_not_computed_again_and_a_torn_line_is() {
        let folder = folder("grow");
        let open = || Ledger::open(&folder, "thirds", None).expect("it can be read");
        assert_eq!(thirds(&open(), &[1, 2]), (vec![Some(1.0 / 3.0), Some(2.0 / 3.0)], 2));
        let path = folder.join("thirds.jsonl");
        let text = fs::read_to_string(&path).expect("text");
        fs::write(&path, &text[..text.len() - 5]).expect("written");
        let (rows, computed) = thirds(&open(), &[1, 2, 5]);
        assert_eq!((rows[2], computed), (Some(5.0 / 3.0), 2));
        assert_eq!(thirds(&open(), &[5, 2]).1, 0);
        fs::remove_dir_all(&folder).expect("it is the test's own");
    }

    #[test]
    fn shards_compute_their_own_tasks_and_the_whole_takes_them_up() {
        let folder = folder("shards");
        let numbers = [1, 2, 3, 4, 5];
        let shard =
            |index| Ledger::open(&folder, "thirds", Some(Share { index, of: 2 })).expect("it can be read");
        let (rows, computed) = thirds(&shard(1), &numbers);
        assert_eq!((rows[0], rows[1], computed), (None, Some(2.0 / 3.0), 2));
        assert_eq!(thirds(&shard(0), &numbers).1, 3);
        let whole = Ledger::open(&folder, "thirds", None).expect("it can be read");
        let (rows, computed) = thirds(&whole, &numbers);
        assert_eq!((rows, computed), (numbers.map(|number| Some(number as f64 / 3.0)).to_vec(), 0));
        fs::remove_dir_all(&folder).expect("it is the test's own");
    }

    #[test]
    fn rows_of_another_study_are_refused() {
        let folder = folder("study");
        let open = |study| Ledger::<u64, f64>::of_study(&folder, "thirds", study, None);
        assert_eq!(thirds(&open("one").expect("it is new"), &[7]).1, 1);
        assert_eq!(thirds(&open("one").expect("the same study"), &[7]).1, 0);
        assert!(matches!(open("other"), Err(RunError::NotOurs { .. })));
        fs::remove_dir_all(&folder).expect("it is the test's own");
    }
}
