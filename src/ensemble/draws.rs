//! Walls that were drawn and moved, each with its value, kept so that a run that was stopped goes on where it stood and every one of
//! them can be built again: a line per wall in `draws.jsonl`, checked as those of the journal are. The number of a wall is that of
//! its line, from 0.

use std::collections::HashMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use polars::prelude::{Column, NamedFrom, Series};
use serde::{Deserialize, Serialize};

use crate::ensemble::lines::Lines;
use crate::ensemble::rare::Draw;
use crate::ensemble::table::parquet;
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{Manifest, RunError};
use crate::study::Study;

/// Name of the file in the output folder.
const DRAWS: &str = "draws.jsonl";
/// The same of limit analysis, where it is not the study's own solver.
const DRAWS_OF_LIMIT: &str = "draws-limit.jsonl";

/// A line of the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Line {
    /// Hash of what decides the wall that was drawn, before it was moved.
    wall: String,
    arm: String,
    kn_pa_per_m: f64,
    draw: Draw,
    value: Option<f64>,
}

/// A wall of a study that was drawn, moved and evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluated {
    /// Its number among all in the folder, from 0.
    pub number: u64,
    /// Index of the arm.
    pub arm: u32,
    /// Index of the kn point.
    pub point: u32,
    /// What it is made of.
    pub draw: Draw,
    /// Its value, low values being the rare ones; the largest number of one that stood to the end; `None` where none came out.
    pub value: Option<f64>,
}

/// The values of a study's draws.
pub struct Draws<'s> {
    study: &'s Study,
    keys: WallKeys,
    lines: Lines,
    kept: Mutex<Kept>,
}

#[derive(Default)]
struct Kept {
    /// Lines of the file, those of other studies included.
    lines: u64,
    /// Those of this study, in their order.
    walls: Vec<Evaluated>,
    /// Where among them each draw is.
    places: HashMap<String, usize>,
}

impl<'s> Draws<'s> {
    /// Opens those in an existing folder, or begins them. Lines that a kill has torn or a disk has damaged are left out; those of
    /// other walls than the study's stay in the file and are not used.
    ///
    /// # Errors
    /// [`RunError::File`] where they cannot be read or written.
    pub fn open(folder: &Path, study: &'s Study) -> Result<Draws<'s>, RunError> {
        Draws::of_file(folder.join(DRAWS), study)
    }

    /// The same of limit analysis of the study's walls, which this is the study of.
    ///
    /// # Errors
    /// As of [`Draws::open`].
    pub fn of_limit_analysis(folder: &Path, study: &'s Study) -> Result<Draws<'s>, RunError> {
        Draws::of_file(folder.join(DRAWS_OF_LIMIT), study)
    }

    fn of_file(path: PathBuf, study: &'s Study) -> Result<Draws<'s>, RunError> {
        let (lines, found) = Lines::open(path)?;
        let keys = WallKeys::of(&Manifest::of(study));
        let mut kept = Kept::default();
        for line in found {
            let number = kept.lines;
            kept.lines += 1;
            if let Some(own) = of_study(study, &keys, line, number) {
                kept.take(own);
            }
        }
        Ok(Draws { study, keys, lines, kept: Mutex::new(kept) })
    }

    /// The wall of a draw; `None` where it is not evaluated yet.
    pub fn evaluated(&self, arm: u32, point: u32, draw: &Draw) -> Option<Evaluated> {
        let kept = self.kept.lock().expect("nothing panics that holds it");
        kept.places.get(&place(arm, point, draw)).map(|place| kept.walls[*place].clone())
    }

    /// All walls of an arm at a kn point, in their order.
    pub fn all(&self, arm: u32, point: u32) -> Vec<Evaluated> {
        let kept = self.kept.lock().expect("nothing panics that holds it");
        kept.walls.iter().filter(|own| (own.arm, own.point) == (arm, point)).cloned().collect()
    }

    /// Keeps values; a fault of the disk is kept for [`Self::fault`].
    pub fn keep<'d>(&self, arm: u32, point: u32, all: impl Iterator<Item = (&'d Draw, &'d Option<f64>)>) {
        let mut lines = Vec::new();
        let mut kept = self.kept.lock().expect("nothing panics that holds it");
        let own = &self.study.arms[arm as usize];
        let kn_pa_per_m = own.kn_points[point as usize];
        for (draw, value) in all {
            let wall = self.keys.key(&own.name, kn_pa_per_m, draw.member).unwrap_or_default();
            let arm_name = own.name.clone();
            lines.push(Line { wall, arm: arm_name, kn_pa_per_m, draw: draw.clone(), value: *value });
            let number = kept.lines;
            kept.lines += 1;
            kept.take(Evaluated { number, arm, point, draw: draw.clone(), value: *value });
        }
        self.lines.add(lines.into_iter());
    }

    /// The first fault of the disk, if there was one: what was computed since is not kept.
    pub fn fault(&self) -> Option<RunError> {
        self.lines.fault()
    }

    /// The walls as a Parquet table; a high value is the rare one if `is_high`. A wall that stood to the end, or brought no value,
    /// has none there.
    ///
    /// # Errors
    /// [`RunError::Table`] where it cannot be encoded.
    pub fn table(&self, is_high: bool) -> Result<Vec<u8>, RunError> {
        let kept = self.kept.lock().expect("nothing panics that holds it");
        let walls = &kept.walls;
        let arm = |own: &Evaluated| &self.study.arms[own.arm as usize];
        let count = |name: &str, of: &dyn Fn(&Evaluated) -> u64| {
            Column::from(Series::new(name.into(), walls.iter().map(of).collect::<Vec<u64>>()))
        };
        let names: Vec<&str> = walls.iter().map(|own| arm(own).name.as_str()).collect();
        let kn: Vec<f64> = walls.iter().map(|own| arm(own).kn_points[own.point as usize]).collect();
        let stood = |own: &Evaluated| own.value == Some(f64::MAX);
        let value = |own: &Evaluated| {
            own.value.filter(|_| !stood(own)).map(|value| if is_high { -value } else { value })
        };
        let columns = vec![
            count("draw", &|own| own.number),
            Column::from(Series::new("arm".into(), names)),
            Column::from(Series::new("kn_pa_per_m".into(), kn)),
            count("run", &|own| own.draw.run()),
            count("moves", &|own| own.draw.moves.len() as u64),
            count("shifts", &|own| own.draw.shift.len() as u64),
            Column::from(Series::new("value".into(), walls.iter().map(value).collect::<Vec<_>>())),
            Column::from(Series::new("stood_to_the_end".into(), walls.iter().map(stood).collect::<Vec<_>>())),
        ];
        parquet("evaluations.parquet", walls.len(), columns)
    }
}

impl Kept {
    fn take(&mut self, own: Evaluated) {
        self.places.insert(place(own.arm, own.point, &own.draw), self.walls.len());
        self.walls.push(own);
    }
}

/// The wall of that number in a folder, as a wall of this study; `None` where there is none of that number, or it is of another one.
///
/// # Errors
/// [`RunError::File`] where the folder holds no draws, or they cannot be read.
pub fn drawn(folder: &Path, study: &Study, number: u64) -> Result<Option<Evaluated>, RunError> {
    let path = folder.join(DRAWS);
    let text = match fs::read(&path) {
        Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return Err(RunError::file("find", &path, error));
        }
        Err(error) => return Err(RunError::file("read", &path, error)),
    };
    let keys = WallKeys::of(&Manifest::of(study));
    Ok(Lines::read(&text).nth(number as usize).and_then(|line| of_study(study, &keys, line, number)))
}

/// A line as a wall of a study, if it is one.
fn of_study(study: &Study, keys: &WallKeys, line: Line, number: u64) -> Option<Evaluated> {
    let Line { wall, arm, kn_pa_per_m, draw, value } = line;
    let index = study.arms.iter().position(|own| own.name == arm)?;
    let point = study.arms[index].kn_points.iter().position(|kn| *kn == kn_pa_per_m)?;
    let key = keys.key(&arm, kn_pa_per_m, draw.member)?;
    (key == wall).then_some(Evaluated { number, arm: index as u32, point: point as u32, draw, value })
}

fn place(arm: u32, point: u32, draw: &Draw) -> String {
    let draw = serde_json::to_string(draw).expect("a draw has string keys and finite numbers only");
    format!("{arm} {point} {draw}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A study with an arm and two stiffnesses, by the name of its revision.
    fn study(revision: &str) -> Study {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/joint-arrangement");
        let mut study = Study::load(&folder, None).expect("a sound study").study;
        study.effective.insert("revision".to_owned(), revision.to_owned());
        study
    }

    #[test]
    fn draws_are_found_again_and_those_of_another_study_stay_aside() {
        let folder = std::env::temp_dir().join(format!("pirca-draws-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let wall = |member: u64| Draw {
            moves: vec![(7, 0.8, 1.0), (8, 0.1 + 0.2, 0.2)],
            shift: vec![("joint.phi_deg".to_owned(), -1.0 / 3.0)],
            ..Draw::of(member)
        };
        let (one, other) = (study("one"), study("other"));
        let draws = Draws::open(&folder, &one).expect("it is new");
        draws.keep(1, 0, [(&wall(3), &Some(1.0 / 3.0)), (&wall(4), &None)].into_iter());
        assert!(draws.fault().is_none());
        drop(draws);
        // A kill has torn the last line.
        let path = folder.join(DRAWS);
        let mut text = std::fs::read_to_string(&path).expect("text");
        let whole = text.clone();
        text.push_str(&whole[..40]);
        std::fs::write(&path, text).expect("written");
        let draws = Draws::open(&folder, &one).expect("the same study");
        let value = |draws: &Draws, arm, member| Some(draws.evaluated(arm, 0, &wall(member))?.value);
        assert_eq!(value(&draws, 1, 3), Some(Some(1.0 / 3.0)));
        assert_eq!((value(&draws, 1, 4), value(&draws, 1, 5)), (Some(None), None));
        assert_eq!(value(&draws, 0, 3), None);
        draws.keep(1, 0, std::iter::once((&wall(5), &Some(2.0))));
        drop(draws);
        let draws = Draws::open(&folder, &other).expect("another study");
        assert_eq!(value(&draws, 1, 5), None);
        draws.keep(1, 0, std::iter::once((&wall(5), &Some(4.0))));
        drop(draws);
        let draws = Draws::open(&folder, &one).expect("the same study");
        assert_eq!(value(&draws, 1, 5), Some(Some(2.0)));
        assert_eq!(draws.all(1, 0).iter().map(|own| own.number).collect::<Vec<_>>(), [0, 1, 2]);
        let found = |study, number| drawn(&folder, study, number).expect("it can be read");
        assert_eq!(found(&one, 2).map(|own| (own.arm, own.draw)), Some((1, wall(5))));
        assert_eq!((found(&one, 3), found(&one, 4)), (None, None));
        assert_eq!(found(&other, 3).and_then(|own| own.value), Some(4.0));
        std::fs::remove_dir_all(&folder).expect("it is the test's own");
        assert!(drawn(&folder, &one, 0).is_err());
    }
}
