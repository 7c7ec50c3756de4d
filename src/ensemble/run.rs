//! The loop over realisations: evaluate what is missing in parallel, record each as it ends, gather in order.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use rayon::prelude::*;

use crate::ensemble::design::plan_of;
use crate::ensemble::enough::{first_looks, next_looks};
use crate::ensemble::journal::{Entry, Journal, Place, Recorded, Timing};
use crate::ensemble::shard;
use crate::ensemble::table::{TIMING, TIMING_HEADS};
use crate::ensemble::walls::WallKeys;
use crate::ensemble::{
    AddedColumns, Grown, Manifest, MemberFault, Progress, Row, RunError, Tables, Task, evaluate, files,
    machine, plan, table,
};
use crate::interrupt::{self, Stopped};
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
/// `steps.parquet`, what their columns hold, `manifest.json` and `timing.csv` there. Gives all rows in the order arm, point, member. Where an arm may have enough
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
    let mut evaluations = Evaluations::begin(study, settings, progress)?;
    let mut members = first_looks(study);
    loop {
        evaluations.of(&plan_of(study, &members), progress, evaluate)?;
        match next_looks(study, &members, &|task| evaluations.row(task)) {
            Some(more) => members = more,
            None => {
                progress.writes(evaluations.asked.len());
                return evaluations.end();
            }
        }
    }
}

/// With so many runs of a wall for each thread, the last ones of a wall leave few threads idle.
const RUNS_A_THREAD: usize = 8;

/// The evaluations of a study in an output folder, where those that were recorded before are not done again. What is to be evaluated next
/// may depend on what was found before.
pub struct Evaluations<'s> {
    study: &'s Study,
    manifest: Manifest,
    keys: WallKeys,
    out: PathBuf,
    pool: rayon::ThreadPool,
    journal: Journal,
    /// What is recorded of walls that were not asked for yet, by the hash of what decides each.
    recorded: BTreeMap<String, Entry>,
    entries: BTreeMap<Task, Entry>,
    asked: BTreeSet<Task>,
}

impl<'s> Evaluations<'s> {
    /// Opens the record in the output folder, or begins one. Of another run those walls are taken over that are walls of this one as well.
    ///
    /// # Errors
    /// [`RunError::OtherRun`] where another run was recorded and none of its walls is one of this study, and those of a folder that cannot
    /// be used.
    pub fn begin(
        study: &'s Study,
        settings: &Settings,
        progress: &dyn Progress,
    ) -> Result<Evaluations<'s>, RunError> {
        let out = settings.out.clone();
        fs::create_dir_all(&out).map_err(|e| RunError::file("create the folder", &out, e))?;
        let (journal, Recorded { head, mut walls, .. }) = Journal::open(&out)?;
        let is_begun = head.is_some();
        // Walls in shards are as good as those in the journal.
        let shared = shard::recorded(&out)?.unwrap_or_default();
        walls.extend(shared.walls);
        let head = head.or(shared.head);
        let mut evaluations = Evaluations::recorded_in(journal, walls, study, settings)?;
        evaluations.take_over(&plan(study));
        let differences = head.as_ref().map_or_else(Vec::new, |head| head.differences(&evaluations.manifest));
        if !differences.is_empty() {
            if evaluations.entries.is_empty() {
                return Err(RunError::OtherRun { folder: evaluations.out, differences });
            }
            let left = evaluations.recorded.len();
            progress.grown(&Grown::of(study, differences.clone(), evaluations.entries.keys(), left));
        }
        let is_new = !is_begun || !differences.is_empty();
        evaluations.journal.go_on(is_new.then_some(&evaluations.manifest))?;
        Ok(evaluations)
    }

    /// With a journal of its own that is open for more walls, and what is known of walls.
    pub(super) fn recorded_in(
        journal: Journal,
        recorded: BTreeMap<String, Entry>,
        study: &'s Study,
        settings: &Settings,
    ) -> Result<Evaluations<'s>, RunError> {
        let manifest = Manifest::of(study);
        let threads =
            settings.threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZero::get);
        Ok(Evaluations {
            study,
            keys: WallKeys::of(&manifest),
            manifest,
            out: settings.out.clone(),
            pool: rayon::ThreadPoolBuilder::new().num_threads(threads).build()?,
            journal,
            recorded,
            entries: BTreeMap::new(),
            asked: BTreeSet::new(),
        })
    }

    /// Finds tasks among what is recorded.
    fn take_over(&mut self, tasks: &[Task]) {
        for task in tasks {
            if let Some(entry) = taken(self.study, &self.keys, &mut self.recorded, *task) {
                self.entries.insert(*task, entry);
            }
        }
    }

    /// Evaluates tasks as far as they are not recorded, in parallel.
    ///
    /// # Errors
    /// See [`RunError`]; whatever was evaluated until then is in the record.
    pub fn of(
        &mut self,
        tasks: &[Task],
        progress: &dyn Progress,
        evaluate: &(dyn Fn(&Study, Task) -> Row + Sync),
    ) -> Result<(), RunError> {
        self.asked.extend(tasks);
        self.take_over(tasks);
        let recorded: Vec<&Row> = tasks.iter().filter_map(|task| self.row(*task)).collect();
        progress.begin(tasks.len(), &recorded);
        let missing: Vec<Task> =
            tasks.iter().copied().filter(|task| !self.entries.contains_key(task)).collect();
        let realisation = Realisation {
            study: self.study,
            evaluate,
            journal: &self.journal,
            keys: &self.keys,
            progress,
            place: Place {
                threads: self.pool.current_num_threads() as u32,
                host: machine::host(),
                processor: machine::processor(),
            },
            stop: AtomicBool::new(false),
        };
        let results: Vec<Result<Entry, Missed>> = self.pool.install(|| {
            if self.one_wall_is_enough() {
                return missing.iter().map(|&task| realisation.of(task)).collect();
            }
            missing.par_iter().with_max_len(1).map(|&task| realisation.of(task)).collect()
        });
        progress.end();
        // On a worker a panic is a fault of its member; here it stops the run.
        interrupt::look();
        gather(&missing, results, &mut self.entries)
    }

    /// Whether the runs of one wall that is shaken keep all threads at work. Walls then come one after the other: side by side they would be
    /// recorded late, and all of them lost when the run is stopped.
    fn one_wall_is_enough(&self) -> bool {
        let runs = self.study.earthquakes.as_ref().map_or(0, |own| own.records.len() * own.intensities.len());
        runs >= RUNS_A_THREAD * self.pool.current_num_threads()
    }

    /// What was asked for, in the order arm, point, member.
    pub(super) fn entries(self) -> BTreeMap<Task, Entry> {
        let Evaluations { asked, mut entries, .. } = self;
        entries.retain(|task, _| asked.contains(task));
        entries
    }

    /// The row of a task, if it is recorded.
    pub fn row(&self, task: Task) -> Option<&Row> {
        self.entries.get(&task).map(|entry| &entry.row)
    }

    /// Writes `members.parquet`, `steps.parquet`, their schemas, `manifest.json` and `timing.csv`, and gives the rows that were asked for in the order arm,
    /// point, member.
    ///
    /// # Errors
    /// [`RunError::File`] and [`RunError::Table`].
    pub fn end(self) -> Result<Vec<Row>, RunError> {
        let (out, manifest) = (self.out.clone(), self.manifest.clone());
        let entries: Vec<Entry> = self.entries().into_values().collect();
        let timing = TIMING_HEADS.to_owned() + &table::timing(entries.iter());
        files::replace_file(&out.join(TIMING), timing.as_bytes())?;
        let rows: Vec<Row> = entries.into_iter().map(|entry| entry.row).collect();
        let mut tables = Tables::begin(&out, AddedColumns::of(&rows))?;
        rows.iter().try_for_each(|row| tables.take(row))?;
        tables.end()?;
        manifest.write(&out)?;
        Ok(rows)
    }
}

/// Takes a task out of what is recorded, if it is there.
pub(super) fn taken(
    study: &Study,
    keys: &WallKeys,
    recorded: &mut BTreeMap<String, Entry>,
    task: Task,
) -> Option<Entry> {
    let entry = recorded.remove(&key_of(study, keys, task)?)?;
    let row = Row { arm_index: task.arm, point: task.point, ..entry.row };
    Some(Entry { row, ..entry })
}

/// The hash of what decides a task's row.
pub(super) fn key_of(study: &Study, keys: &WallKeys, task: Task) -> Option<String> {
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
    place: Place,
    /// Set when the journal cannot be written, as what is not recorded would be lost, and when the run is told to stop: nothing more is
    /// begun.
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
            let timing = Some(Timing { seconds, place: self.place.clone() });
            let entry = Entry { wall, timing, row };
            let line = entry.line();
            (entry, line)
        }));
        let (entry, line) = attempt.map_err(|cause| {
            if cause.is::<Stopped>() {
                self.stop.store(true, Ordering::Relaxed);
                return Missed::NotBegun;
            }
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
