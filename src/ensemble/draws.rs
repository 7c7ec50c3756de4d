//! Values of walls that are not members of an ensemble as it was drawn, kept so that a run that was stopped goes on where it stood: a
//! line per wall in a file of the output folder, checked as those of the journal are.

use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::ensemble::RunError;
use crate::ensemble::journal::{sealed, unsealed};

/// A line: the first says which study, each other a wall with its value.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Line<D, V> {
    Study(String),
    Wall { arm: u32, point: u32, draw: D, value: V },
}

/// The values of a study's walls: `D` says how a wall was drawn, `V` what it came to.
pub struct Draws<D, V> {
    path: PathBuf,
    file: Mutex<File>,
    known: Mutex<HashMap<String, V>>,
    fault: Mutex<Option<RunError>>,
    of: PhantomData<fn(D)>,
}

impl<D: Clone + Serialize + DeserializeOwned, V: Clone + Serialize + DeserializeOwned> Draws<D, V> {
    /// Opens those of a study, by its hash, in a file of an existing folder, or begins them. Lines that a kill has torn or a disk has damaged are
    /// left out.
    ///
    /// # Errors
    /// [`RunError::NotOurs`] where they are of another study, [`RunError::File`] where they cannot be read or written.
    pub fn open(folder: &Path, name: &str, study: &str) -> Result<Self, RunError> {
        let path = folder.join(name);
        let opened = OpenOptions::new().read(true).append(true).create(true).open(&path);
        let mut file = opened.map_err(|error| RunError::file("open", &path, error))?;
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(|error| RunError::file("read", &path, error))?;
        let text = String::from_utf8_lossy(&text);
        let mut known = HashMap::new();
        let mut of = None;
        for line in text.lines().filter_map(|line| serde_json::from_str::<Line<D, V>>(unsealed(line)?).ok()) {
            match line {
                Line::Study(study) => of = Some(study),
                Line::Wall { arm, point, draw, value } => {
                    known.insert(key(arm, point, &draw), value);
                }
            }
        }
        let draws = Draws {
            path,
            file: Mutex::new(file),
            known: Mutex::new(known),
            fault: Mutex::default(),
            of: PhantomData,
        };
        match of {
            Some(own) if own != study => {
                let found = format!("its {name} is of another study, or of the same with other values");
                Err(RunError::NotOurs { folder: folder.to_path_buf(), found })
            }
            Some(_) => {
                // What a kill has torn must not run into what comes next.
                draws.write(if text.ends_with('\n') { "" } else { "\n" })?;
                Ok(draws)
            }
            None => {
                draws.write(&line(&Line::<D, V>::Study(study.to_owned())))?;
                Ok(draws)
            }
        }
    }

    /// The value of a wall; `None` where it is not known yet.
    pub fn value(&self, arm: u32, point: u32, draw: &D) -> Option<V> {
        self.known.lock().expect("nothing panics that holds it").get(&key(arm, point, draw)).cloned()
    }

    /// Keeps values; a fault of the disk is kept for [`Self::fault`].
    pub fn keep<'d>(&self, arm: u32, point: u32, all: impl Iterator<Item = (&'d D, &'d V)>)
    where
        D: 'd,
        V: 'd,
    {
        let mut text = String::new();
        let mut known = self.known.lock().expect("nothing panics that holds it");
        for (draw, value) in all {
            text.push_str(&line(&Line::Wall { arm, point, draw: draw.clone(), value: value.clone() }));
            known.insert(key(arm, point, draw), value.clone());
        }
        if let Err(error) = self.write(&text) {
            self.fault.lock().expect("nothing panics that holds it").get_or_insert(error);
        }
    }

    /// The first fault of the disk, if there was one: what was computed since is not kept.
    pub fn fault(&self) -> Option<RunError> {
        self.fault.lock().expect("nothing panics that holds it").take()
    }

    fn write(&self, text: &str) -> Result<(), RunError> {
        let mut file = self.file.lock().expect("nothing panics that holds it");
        file.write_all(text.as_bytes()).map_err(|error| RunError::file("write", &self.path, error))
    }
}

fn line<D: Serialize, V: Serialize>(line: &Line<D, V>) -> String {
    sealed(&serde_json::to_string(line).expect("a line has string keys and finite numbers only"))
}

fn key(arm: u32, point: u32, draw: &impl Serialize) -> String {
    let draw = serde_json::to_string(draw).expect("a draw has string keys and finite numbers only");
    format!("{arm} {point} {draw}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ensemble::rare::{DRAWS, Draw, RareDraws};

    #[test]
    fn draws_are_found_again_and_those_of_another_study_are_refused() {
        let folder = std::env::temp_dir().join(format!("pirca-draws-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let wall = |member: u64| Draw { member, moves: vec![(7, 0.8), (8, 0.1 + 0.2)] };
        let draws = RareDraws::open(&folder, DRAWS, "one").expect("it is new");
        draws.keep(1, 0, [(&wall(3), &Some(1.0 / 3.0)), (&wall(4), &None)].into_iter());
        assert!(draws.fault().is_none());
        drop(draws);
        // A kill has torn the last line.
        let path = folder.join(DRAWS);
        let mut text = std::fs::read_to_string(&path).expect("text");
        text.push_str(&line(&Line::Wall { arm: 1, point: 0, draw: wall(5), value: Some(2.0_f64) })[..40]);
        std::fs::write(&path, text).expect("written");
        let draws = RareDraws::open(&folder, DRAWS, "one").expect("the same study");
        assert_eq!(draws.value(1, 0, &wall(3)), Some(Some(1.0 / 3.0)));
        assert_eq!((draws.value(1, 0, &wall(4)), draws.value(1, 0, &wall(5))), (Some(None), None));
        assert_eq!(draws.value(0, 0, &wall(3)), None);
        draws.keep(1, 0, std::iter::once((&wall(5), &Some(2.0))));
        drop(draws);
        let draws = RareDraws::open(&folder, DRAWS, "one").expect("the same study");
        assert_eq!(draws.value(1, 0, &wall(5)), Some(Some(2.0)));
        assert!(matches!(RareDraws::open(&folder, DRAWS, "other"), Err(RunError::NotOurs { .. })));
        std::fs::remove_dir_all(&folder).expect("it is the test's own");
    }
}
