//! What the evaluations of an [influence](crate::ensemble::influence) came to, kept in the output folder: the first line says of which
//! study they are.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Mutex;

use serde::{Deserialize, Serialize};

use crate::ensemble::RunError;
use crate::ensemble::influence::{Evaluation, Influenced};
use crate::ensemble::lines::Lines;

/// File in the output folder.
const FILE: &str = "influence.jsonl";

/// A line: the first says which study, each other a wall with what it came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Line {
    Study(String),
    Wall { evaluation: Evaluation, came_to: Influenced },
}

/// The evaluations of a study of one arm at one kn point.
pub struct Kept {
    lines: Lines,
    known: Mutex<HashMap<Evaluation, Influenced>>,
}

impl Kept {
    /// Opens those of a study, by the hash of all that decides it, in an existing folder, or begins them.
    ///
    /// # Errors
    /// [`RunError::NotOurs`] where they are of another study, [`RunError::File`] where they cannot be read or written.
    pub fn open(folder: &Path, study: &str) -> Result<Kept, RunError> {
        let (lines, found) = Lines::open::<Line>(folder.join(FILE))?;
        let mut known = HashMap::new();
        let mut of = None;
        for line in found {
            match line {
                Line::Study(study) => of = Some(study),
                Line::Wall { evaluation, came_to } => {
                    known.insert(evaluation, came_to);
                }
            }
        }
        match of {
            Some(own) if own != study => {
                let found = format!("its {FILE} is of another study, or of the same with other values");
                return Err(RunError::NotOurs { folder: folder.to_path_buf(), found });
            }
            Some(_) => {}
            None => lines.add(std::iter::once(Line::Study(study.to_owned()))),
        }
        Ok(Kept { lines, known: Mutex::new(known) })
    }

    /// What an evaluation came to; `None` where it is not known yet.
    pub fn of(&self, evaluation: &Evaluation) -> Option<Influenced> {
        self.known.lock().expect("nothing panics that holds it").get(evaluation).cloned()
    }

    /// Keeps what evaluations came to.
    ///
    /// # Errors
    /// The first fault of the disk.
    pub fn keep(&self, all: &[(&Evaluation, Influenced)]) -> Result<(), RunError> {
        let line = |(evaluation, came_to): &(&Evaluation, Influenced)| Line::Wall {
            evaluation: (*evaluation).clone(),
            came_to: came_to.clone(),
        };
        self.lines.add(all.iter().map(line));
        let mut known = self.known.lock().expect("nothing panics that holds it");
        known.extend(all.iter().map(|(evaluation, came_to)| ((*evaluation).clone(), came_to.clone())));
        self.lines.fault().map_or(Ok(()), Err)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ensemble::influence::Wall;

    #[test]
    fn evaluations_are_found_again_and_those_of_another_study_are_refused() {
        let folder = std::env::temp_dir().join(format!("pirca-kept-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let evaluation = |base, wall| Evaluation { base, wall };
        let came_to = |value| Influenced { value, outcome: "collapsed".to_owned() };
        let (first, second) = (evaluation(3, Wall::Own), evaluation(3, Wall::Mixed("layout".to_owned())));
        let kept = Kept::open(&folder, "one").expect("it is new");
        kept.keep(&[(&first, came_to(Some(1.0 / 3.0))), (&second, came_to(None))])
            .expect("it can be written");
        let kept = Kept::open(&folder, "one").expect("the same study");
        assert_eq!(kept.of(&first), Some(came_to(Some(1.0 / 3.0))));
        assert_eq!((kept.of(&second), kept.of(&evaluation(3, Wall::Partner))), (Some(came_to(None)), None));
        assert!(matches!(Kept::open(&folder, "other"), Err(RunError::NotOurs { .. })));
        std::fs::remove_dir_all(&folder).expect("it is the test's own");
    }
}
