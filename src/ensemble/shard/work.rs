//! What is shared out, and into how many shards: `shards/work.json`, which the first shard writes and all others agree with.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::ensemble::files::publish;
use crate::ensemble::shard::{SHARDS, ShardError};
use crate::ensemble::{Manifest, RunError, evaluations};
use crate::study::Study;

/// Name of the file in the folder of the shards.
const WORK: &str = "work.json";

/// Walls that are shared out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Folder of the study, as the first shard found it.
    pub study: PathBuf,
    /// Which of its walls.
    pub walls: Walls,
    /// Into so many shards.
    pub of: u32,
    /// Evaluations in all.
    pub evaluations: u64,
    /// What decides their results.
    pub manifest: Manifest,
}

/// Walls that are made from a study.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Walls {
    /// Its own.
    Own,
    /// Those that diagnoses of its measurements rest on.
    Bank {
        /// The file of the measurements, if not the study's own.
        measured: Option<PathBuf>,
        /// Points in the priors for each mechanism.
        points: u64,
    },
    /// Those of a batch that lies in the output folder.
    Batch,
}

/// One shard: the walls whose place in the order of the results leaves its index over when divided by the number of shards, so that each
/// shard has walls of all arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Share {
    /// Its number, from 0.
    pub index: u32,
    /// The number of shards.
    pub of: u32,
}

impl Share {
    /// How many of so many evaluations are its own.
    pub fn count(self, evaluations: u64) -> u64 {
        (evaluations + u64::from(self.of - 1 - self.index)) / u64::from(self.of)
    }

    /// Its file in the output folder.
    pub fn file(self, out: &Path) -> PathBuf {
        out.join(SHARDS).join(format!("{}.jsonl", self.name()))
    }

    /// The file of what its walls took.
    pub fn timing_file(self, out: &Path) -> PathBuf {
        out.join(SHARDS).join(format!("{}.timing.csv", self.name()))
    }

    /// What the names of its files begin with.
    pub fn name(self) -> String {
        format!("{:04}-of-{:04}", self.index, self.of)
    }
}

impl Work {
    /// A study's walls, shared out into so many shards.
    pub fn of(study: &Study, place: &Path, walls: Walls, of: u32) -> Work {
        let place = place.canonicalize().unwrap_or_else(|_| place.to_path_buf());
        Work { study: place, walls, of, evaluations: evaluations(study), manifest: Manifest::of(study) }
    }

    /// Whether a folder holds shards.
    pub fn is_in(out: &Path) -> bool {
        out.join(SHARDS).join(WORK).is_file()
    }

    /// What is shared out in a folder.
    ///
    /// # Errors
    /// [`ShardError::NoShards`] where nothing is, [`RunError::File`] where it cannot be read.
    pub fn read(out: &Path) -> Result<Work, RunError> {
        let path = out.join(SHARDS).join(WORK);
        let none = |found: String| ShardError::NoShards { folder: out.to_path_buf(), found };
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let found = match out.exists() {
                    true => format!("holds no shards: it has no {SHARDS}/{WORK}"),
                    false => "there is no such folder".to_owned(),
                };
                return Err(none(found).into());
            }
            Err(error) => return Err(RunError::file("read", &path, error)),
        };
        let own = env!("CARGO_PKG_VERSION");
        let whole: Option<serde_json::Value> = serde_json::from_str(&text).ok();
        // Before all else: another version may write other files.
        match whole.as_ref().and_then(|whole| whole["manifest"]["version"].as_str()) {
            Some(version) if version != own => {
                let differences = vec![format!("version of pirca: {version} there, {own} here")];
                return Err(ShardError::OtherWork { folder: out.to_path_buf(), differences }.into());
            }
            _ => {}
        }
        let work: Option<Work> = whole.and_then(|whole| serde_json::from_value(whole).ok());
        Ok(work.filter(|work| work.of > 0).ok_or_else(|| none(format!("its {SHARDS}/{WORK} is damaged")))?)
    }

    /// Begins the work in a folder, or finds that it is the one that is there. Two that begin different work at the same time: one is
    /// refused.
    ///
    /// # Errors
    /// [`ShardError::OtherWork`] where other work is there, [`RunError::File`] where it cannot be written.
    pub fn begin(&self, out: &Path) -> Result<(), RunError> {
        let folder = out.join(SHARDS);
        fs::create_dir_all(&folder).map_err(|e| RunError::file("create the folder", &folder, e))?;
        if !Work::is_in(out) {
            let json = serde_json::to_string_pretty(self).expect("work has string keys only");
            publish(&folder.join(WORK), |file| writeln!(file, "{json}"))?;
        }
        let differences = Work::read(out)?.differences(self);
        match differences.is_empty() {
            true => Ok(()),
            false => Err(ShardError::OtherWork { folder: out.to_path_buf(), differences }.into()),
        }
    }

    /// What makes `wanted` other work than this, one sentence each. The folder of the study may be another one on another machine.
    pub fn differences(&self, wanted: &Work) -> Vec<String> {
        let mut found = self.manifest.differences(&wanted.manifest);
        if self.walls != wanted.walls && found.is_empty() {
            found.push(format!("walls: {} there, {} asked for", self.walls.words(), wanted.walls.words()));
        }
        if self.of != wanted.of {
            found.push(format!("number of shards: {} there, {} asked for", self.of, wanted.of));
        }
        found
    }

    /// All shards.
    pub fn shares(&self) -> impl Iterator<Item = Share> {
        let of = self.of;
        (0..of).map(move |index| Share { index, of })
    }
}

impl Walls {
    fn words(&self) -> String {
        match self {
            Walls::Own => "those of the study".to_owned(),
            Walls::Batch => "those of a batch".to_owned(),
            Walls::Bank { points, .. } => format!("those of a bank of {points} points"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_even_and_complete() {
        for (evaluations, of) in [(0, 1), (1, 3), (20, 7), (21, 7), (64, 64), (5, 64)] {
            let counts: Vec<u64> = (0..of).map(|index| Share { index, of }.count(evaluations)).collect();
            let by_hand: Vec<u64> = (0..of)
                .map(|index| {
                    (0..evaluations).filter(|place| place % u64::from(of) == u64::from(index)).count() as u64
                })
                .collect();
            assert_eq!(counts, by_hand, "{evaluations} in {of}");
        }
    }
}
