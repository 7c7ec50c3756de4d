//! Walls of rare values that other processes evaluate. Where the next walls to be evaluated follow from those before, they are written down
//! as a batch, a folder that is shared out as a study is, and the work ends until the batch is complete. Started again it goes on from there,
//! and its files are those of a run that evaluated everything by itself.

use std::collections::BTreeMap;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::ensemble::rare::{Draw, signed_value};
use crate::ensemble::shard::{Merge, ShardError, Work};
use crate::ensemble::{Draws, Manifest, Row, RunError, Task, evaluate, replace_file};
use crate::study::Study;

/// The folder of the batches in the output folder.
const BATCHES: &str = "batches";
/// Name of the file in the folder of each.
const BATCH: &str = "batch.json";

/// Walls of one arm at one stiffness that are to be evaluated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Batch {
    /// Folder of the study.
    pub study: PathBuf,
    /// What decides the study's walls.
    pub manifest: Manifest,
    /// Index of the arm.
    pub arm: u32,
    /// Index of the kn point.
    pub point: u32,
    /// Whether high values are the rare ones.
    pub is_high: bool,
    /// What the walls are made of, in the order in which they are kept.
    pub draws: Vec<Draw>,
}

impl Batch {
    /// Whether a folder holds a batch.
    pub fn is_in(folder: &Path) -> bool {
        folder.join(BATCH).is_file()
    }

    /// The batch in a folder.
    ///
    /// # Errors
    /// [`ShardError::NoShards`] where there is none that can be read, [`RunError::File`].
    pub fn read(folder: &Path) -> Result<Batch, RunError> {
        let path = folder.join(BATCH);
        let text = fs::read_to_string(&path).map_err(|error| RunError::file("read", &path, error))?;
        let found =
            |error| format!("its {BATCH} is damaged ({error}); pirca capacity --batches writes it again");
        Ok(serde_json::from_str(&text)
            .map_err(|error| ShardError::NoShards { folder: folder.to_path_buf(), found: found(error) })?)
    }

    /// Its walls as a study with one arm, a member for each. `study` is the study that it was made for.
    pub fn walls(&self, study: &Study) -> Study {
        let mut arm = study.arms[self.arm as usize].clone();
        arm.kn_points = vec![arm.kn_points[self.point as usize]];
        (arm.members, arm.until) = (self.draws.len() as u64, None);
        let json =
            serde_json::to_string(&self.draws).expect("draws have string keys and finite numbers only");
        let hash = Sha256::digest(json.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
        let decided = BTreeMap::from([
            ("batch.study".to_owned(), study.hash.clone()),
            ("batch.arm".to_owned(), self.arm.to_string()),
            ("batch.point".to_owned(), self.point.to_string()),
            ("batch.draws".to_owned(), hash),
        ]);
        study.clone().of_arms(format!("{}-batch", study.name), vec![arm], decided)
    }

    /// The row of one of its walls; `study` is the study that it was made for.
    pub fn evaluate(&self, study: &Study, task: Task) -> Row {
        let draw = &self.draws[task.member as usize];
        let own = Task { arm: self.arm, point: self.point, member: draw.member };
        Row {
            arm_index: task.arm,
            point: task.point,
            member: task.member,
            ..evaluate(&draw.study(study), own)
        }
    }
}

/// The batches of a study in an output folder.
pub struct Batches<'s> {
    out: &'s Path,
    place: &'s Path,
    study: &'s Study,
    asked: Mutex<Option<Batch>>,
}

/// What unwinds from where walls are needed that are not evaluated.
struct Deferred;

impl<'s> Batches<'s> {
    /// Takes over what complete batches came to, in their order. `place` is the folder of the study.
    ///
    /// # Errors
    /// As of [`Merge`]; a batch of another study is passed over.
    pub fn open(
        out: &'s Path,
        place: &'s Path,
        study: &'s Study,
        draws: &Draws<'_>,
    ) -> Result<Batches<'s>, RunError> {
        let batches = Batches { out, place, study, asked: Mutex::default() };
        for number in 1.. {
            let folder = batches.folder(number);
            if !Batch::is_in(&folder) {
                break;
            }
            let batch = Batch::read(&folder)?;
            let is_own = batch.manifest.differences(&Manifest::of(study)).is_empty();
            let is_known = |draw: &Draw| draws.evaluated(batch.arm, batch.point, draw).is_some();
            if is_own && !batch.draws.iter().all(is_known) && Work::is_in(&folder) {
                let values = match batch.values(&folder, study) {
                    Err(RunError::Shard(ShardError::Missing { .. })) => break,
                    values => values?,
                };
                draws.keep(batch.arm, batch.point, batch.draws.iter().zip(&values));
            }
        }
        Ok(batches)
    }

    /// Asks for walls, and unwinds to [`Self::deferred`].
    pub(super) fn ask(&self, (arm, point, is_high): (u32, u32, bool), open: &[&Draw]) -> ! {
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        let batch = asked.get_or_insert_with(|| Batch {
            study: self.place.canonicalize().unwrap_or_else(|_| self.place.to_path_buf()),
            manifest: Manifest::of(self.study),
            arm,
            point,
            is_high,
            draws: Vec::new(),
        });
        batch.draws.extend(open.iter().map(|draw| (*draw).clone()));
        drop(asked);
        resume_unwind(Box::new(Deferred))
    }

    /// Does some work; `None` where it asked for walls.
    pub fn deferred<T>(&self, work: impl FnOnce() -> T) -> Option<T> {
        match catch_unwind(AssertUnwindSafe(work)) {
            Ok(done) => Some(done),
            Err(cause) if cause.is::<Deferred>() => None,
            Err(cause) => resume_unwind(cause),
        }
    }

    /// Writes the batch that was asked for, unless it is there, and gives its folder and the number of its walls.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub fn write(&self) -> Result<Option<(PathBuf, usize)>, RunError> {
        let asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(batch) = asked.as_ref() else { return Ok(None) };
        let mut number = 1;
        while Batch::is_in(&self.folder(number)) && Batch::read(&self.folder(number))? != *batch {
            number += 1;
        }
        let folder = self.folder(number);
        fs::create_dir_all(&folder).map_err(|error| RunError::file("create the folder", &folder, error))?;
        let json = serde_json::to_string(batch).expect("a batch has string keys and finite numbers only");
        replace_file(&folder.join(BATCH), format!("{json}\n").as_bytes())?;
        Ok(Some((folder, batch.draws.len())))
    }

    fn folder(&self, number: u32) -> PathBuf {
        self.out.join(BATCHES).join(format!("{number:04}"))
    }
}

impl Batch {
    /// What its walls came to, once all its shards are complete.
    fn values(&self, folder: &Path, study: &Study) -> Result<Vec<Option<f64>>, RunError> {
        let walls = self.walls(study);
        let work = Work::read(folder)?;
        let differences = work.manifest.differences(&Manifest::of(&walls));
        if !differences.is_empty() {
            return Err(ShardError::OtherWork { folder: folder.to_path_buf(), differences }.into());
        }
        let mut values = Vec::with_capacity(self.draws.len());
        Merge::of(&walls, &work, folder, false)?.rows(&[walls.arms[0].members], &mut |row| {
            values.push(signed_value(&walls, self.is_high, &row));
            Ok(())
        })?;
        Ok(values)
    }
}
