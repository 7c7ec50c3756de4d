//! The loop over realisations: evaluate what is missing in parallel, record each as it ends, gather in order.

use std::collections::BTreeMap;
use std::fs;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use rayon::prelude::*;

use crate::ensemble::design::plan_of;
use crate::ensemble::enough::{first_looks, next_looks};
use crate::ensemble::journal::{Entry, Journal, Recorded};
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{
    Grown, Manifest, MemberFault, Progress, Row, RunError, Task, evaluate, files, plan, table,
};
use crate::study::Study;

/// Where a run writes and how many threads it uses; no result depends on either.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Output folder; made if it is not there.
    pub out: PathBuf,
    /// Worker threads; `None` for one per processor.
    pub threads: Option<NonZero<usize>>,
}

/// Evaluates every member of a study that the output folder does not hold yet, and writes `members.parquet`,
/// `steps.parquet`, `manifest.json` and `timing.csv` there. Gives all rows in the order arm, point, member. Where an arm may have enough
/// walls before it has all, its walls are evaluated from look to look; [`come_to`](crate::ensemble::come_to) says how many they were.
///
/// A folder that holds another run is gone on from where walls of that run are walls of this one as well: their rows are taken over.
/// Walls of other inputs stay in the journal and in no result.
///
/// # Errors
/// See [`RunError`]; whatever was evaluated until then is in the journal.
pub fn run(study: &Study, settings: &Settings, progress: &dyn Progress) -> Result<Vec<Row>, RunError> {
    run_with(study, settings, progress, &evaluate)
}

/// [`run`] with another way to evaluate a member, which must be a pure function of its arguments.
///
/// # Errors
/// As [`run`].
pub fn run_with(
    study: &Study,
    settings: &Settings,
    progress: &dyn Progress,
    evaluate: &(dyn Fn(&Study, Task) -> Row + Sync),
) -> Result<Vec<Row>, RunError> {
    let manifest = Manifest::of(study);
    let out = &settings.out;
    fs::create_dir_all(out).map_err(|e| RunError::file("create the folder", out, e))?;
    let (journal, recorded) = Journal::open(out)?;
    let keys = WallKeys::of(&manifest);
    let mut entries = taken_over(study, &manifest, &keys, &journal, recorded, settings, progress)?;

    let threads =
        settings.threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZero::get);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let realisation = Realisation {
        study,
        evaluate,
        journal: &journal,
        keys: &keys,
        progress,
        threads: threads as u32,
        host: host(),
        stop: AtomicBool::new(false),
    };
    let mut members = first_looks(study);
    let tasks = loop {
        let tasks = plan_of(study, &members);
        let (known, missing): (Vec<Task>, Vec<Task>) =
            tasks.iter().partition(|&task| entries.contains_key(task));
        progress.begin(tasks.len(), &known.iter().map(|task| &entries[task].row).collect::<Vec<_>>());
        let results: Vec<Result<Entry, Missed>> =
            pool.install(|| missing.par_iter().with_max_len(1).map(|&task| realisation.of(task)).collect());
        progress.end();
        gather(&missing, results, &mut entries)?;
        match next_looks(study, &members, &|task| Some(&entries.get(&task)?.row)) {
            Some(more) => members = more,
            None => break tasks,
        }
    };

    let entries: Vec<Entry> = tasks.iter().filter_map(|task| entries.remove(task)).collect();
    files::replace_file(&out.join("timing.csv"), table::timing(&entries).as_bytes())?;
    let rows: Vec<Row> = entries.into_iter().map(|entry| entry.row).collect();
    files::replace_file(&out.join("members.parquet"), &table::members(&rows)?)?;
    files::replace_file(&out.join("steps.parquet"), &table::steps(&rows)?)?;
    let json = serde_json::to_string_pretty(&manifest).expect("a manifest has string keys only");
    files::replace_file(&out.join("manifest.json"), format!("{json}\n").as_bytes())?;
    Ok(rows)
}

/// The recorded walls that are walls of this study, each in its place there; the journal is then open for those that are missing.
///
/// # Errors
/// [`RunError::OtherRun`] where another run was recorded and none of its walls is one of this study, and faults of the disk.
fn taken_over(
    study: &Study,
    manifest: &Manifest,
    keys: &WallKeys,
    journal: &Journal,
    recorded: Recorded,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<BTreeMap<Task, Entry>, RunError> {
    let Recorded { head, mut walls, .. } = recorded;
    let mut entries = BTreeMap::new();
    for task in plan(study) {
        if let Some(entry) = key_of(study, keys, task).and_then(|key| walls.remove(&key)) {
            let row = Row { arm_index: task.arm, point: task.point, ..entry.row };
            entries.insert(task, Entry { row, ..entry });
        }
    }
    let differences = head.as_ref().map_or_else(Vec::new, |head| head.differences(manifest));
    if !differences.is_empty() {
        if entries.is_empty() {
            return Err(RunError::OtherRun { folder: settings.out.clone(), differences });
        }
        progress.grown(&Grown::of(study, differences, entries.keys(), walls.len()));
    }
    let is_new = head.as_ref().is_none_or(|head| !head.differences(manifest).is_empty());
    journal.go_on(is_new.then_some(manifest))?;
    Ok(entries)
}

/// The hash of what decides a task's row.
fn key_of(study: &Study, keys: &WallKeys, task: Task) -> Option<String> {
    let arm = &study.arms[task.arm as usize];
    keys.key(&arm.name, arm.kn_points[task.point as usize], task.member)
}

/// What every worker shares.
struct Realisation<'a> {
    study: &'a Study,
    evaluate: &'a (dyn Fn(&Study, Task) -> Row + Sync),
    journal: &'a Journal,
    keys: &'a WallKeys,
    progress: &'a dyn Progress,
    threads: u32,
    host: String,
    /// Set when the journal cannot be written: what is not recorded would be lost, so nothing more is begun.
    stop: AtomicBool,
}

/// Why a task has no entry.
enum Missed {
    NotBegun,
    Broken(MemberFault),
    NotRecorded(RunError),
}

impl Realisation<'_> {
    /// Evaluates and records one task.
    fn of(&self, task: Task) -> Result<Entry, Missed> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(Missed::NotBegun);
        }
        // A panic is a fault of ours in one member; the others are computed and recorded before it is reported.
        let attempt = catch_unwind(AssertUnwindSafe(|| {
            let begun = Instant::now();
            let row = (self.evaluate)(self.study, task);
            let seconds = begun.elapsed().as_secs_f64();
            let wall = key_of(self.study, self.keys, task);
            let entry = Entry { wall, seconds, threads: self.threads, host: self.host.clone(), row };
            let line = entry.line();
            (entry, line)
        }));
        let (entry, line) = attempt.map_err(|cause| {
            self.progress.broken(task);
            Missed::Broken(self.fault(task, cause.as_ref()))
        })?;
        if let Err(error) = self.journal.append(&line) {
            self.stop.store(true, Ordering::Relaxed);
            return Err(Missed::NotRecorded(error));
        }
        self.progress.finished(&entry.row);
        Ok(entry)
    }

    fn fault(&self, task: Task, cause: &(dyn std::any::Any + Send)) -> MemberFault {
        let text = cause.downcast_ref::<String>().map(String::as_str);
        let message =
            text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("a panic without words");
        let arm = &self.study.arms[task.arm as usize];
        let kn_pa_per_m = arm.kn_points[task.point as usize];
        MemberFault { task, arm: arm.name.clone(), kn_pa_per_m, message: message.to_string() }
    }
}

/// Puts the new entries to the old ones, or says why some are missing.
fn gather(
    missing: &[Task],
    results: Vec<Result<Entry, Missed>>,
    entries: &mut BTreeMap<Task, Entry>,
) -> Result<(), RunError> {
    let (mut faults, mut not_recorded) = (Vec::new(), None);
    for (&task, result) in missing.iter().zip(results) {
        match result {
            Ok(entry) => drop(entries.insert(task, entry)),
            Err(Missed::Broken(fault)) => faults.push(fault),
            Err(Missed::NotRecorded(error)) => not_recorded = not_recorded.or(Some(error)),
            Err(Missed::NotBegun) => {}
        }
    }
    match not_recorded {
        Some(error) => Err(error),
        None if faults.is_empty() => Ok(()),
        None => Err(RunError::Broken { faults }),
    }
}

/// The machine's name, for the timing file only.
fn host() -> String {
    let named =
        fs::read_to_string("/proc/sys/kernel/hostname").ok().or_else(|| std::env::var("HOSTNAME").ok());
    named
        .map(|name| name.trim().to_string())
        .filter(|name| !name.is_empty())
        .unwrap_or_else(|| "unknown".to_string())
}
