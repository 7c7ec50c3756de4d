//! A finished run, read back from its folder. Nothing is evaluated or written.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::ensemble::design::plan_of;
use crate::ensemble::enough::{first_looks, next_looks};
use crate::ensemble::journal::{JOURNAL, Journal};
use crate::ensemble::manifest::MANIFEST;
use crate::ensemble::run::taken;
use crate::ensemble::shard;
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{Manifest, Row, RunError, Task};
use crate::study::Study;

const ANOTHER_FOLDER: &str = "give the folder that pirca run wrote to, by default runs/<study>";
const RUN_AGAIN: &str = "start the same pirca run again: it goes on where it stood";

/// Which run a folder holds.
///
/// # Errors
/// [`RunError::NotARun`] of a folder that holds none, one that was stopped, or one of another version of the program.
pub fn identity(folder: &Path) -> Result<Manifest, RunError> {
    let path = folder.join(MANIFEST);
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(_) if !folder.exists() => {
            return refused(folder, "there is no such folder".to_owned(), ANOTHER_FOLDER);
        }
        Err(_) if folder.join(JOURNAL).is_file() => {
            return refused(
                folder,
                format!("the run was stopped before its {MANIFEST} was written"),
                RUN_AGAIN,
            );
        }
        Err(_) => return refused(folder, format!("holds no run: it has no {MANIFEST}"), ANOTHER_FOLDER),
    };
    let own = env!("CARGO_PKG_VERSION");
    let whole: Result<serde_json::Value, _> = serde_json::from_str(&text);
    // Before all else: another version may write another manifest.
    if let Some(version) = whole.as_ref().ok().and_then(|whole| whole["version"].as_str())
        && version != own
    {
        let fix = "use that version, or run the study again in another folder";
        return refused(folder, format!("the run is of pirca {version}, and this is pirca {own}"), fix);
    }
    whole.and_then(serde_json::from_value).or_else(|error| {
        refused(folder, format!("its {MANIFEST} is not that of a run: {error}"), ANOTHER_FOLDER)
    })
}

/// All rows of a finished run of this study, in the order arm, point, member.
///
/// # Errors
/// [`RunError::NotARun`] where the folder holds another run or not all walls, [`RunError::Busy`] while one is going on, and
/// [`RunError::File`] where the journal cannot be read.
pub fn finished(study: &Study, folder: &Path) -> Result<Vec<Row>, RunError> {
    let manifest = Manifest::of(study);
    let differences = identity(folder)?.differences(&manifest);
    if !differences.is_empty() {
        let found = format!("the study is another one than was run ({})", differences.join("; "));
        return refused(folder, found, "give the study as it was with --study, or run it again");
    }
    let shared = shard::recorded(folder)?;
    let is_shared = shared.is_some();
    let mut walls = shared.unwrap_or_default().walls;
    if folder.join(JOURNAL).is_file() {
        walls.extend(Journal::open(folder)?.1.walls);
    } else if !is_shared {
        return refused(
            folder,
            format!("its {JOURNAL} is gone, which holds the walls"),
            "run the study again",
        );
    }
    let keys = WallKeys::of(&manifest);
    let mut rows: BTreeMap<Task, Row> = BTreeMap::new();
    let mut members = first_looks(study);
    loop {
        let tasks = plan_of(study, &members);
        for task in &tasks {
            if let Some(entry) = taken(study, &keys, &mut walls, *task) {
                rows.insert(*task, entry.row);
            }
        }
        let missing = tasks.iter().filter(|task| !rows.contains_key(task)).count();
        if missing > 0 {
            return refused(
                folder,
                format!("{missing} of {} walls are not evaluated yet", tasks.len()),
                RUN_AGAIN,
            );
        }
        match next_looks(study, &members, &|task| rows.get(&task)) {
            Some(more) => members = more,
            None => return Ok(rows.into_values().collect()),
        }
    }
}

/// Why a folder is not taken, and what to do about it.
fn refused<T>(folder: &Path, found: String, fix: &str) -> Result<T, RunError> {
    Err(RunError::NotARun { folder: folder.to_path_buf(), found, fix: fix.to_owned() })
}
