//! `pirca readings`: which variants of a study, alone or together, explain what was published?

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::cli::arguments::Readings;
use crate::cli::failure::Failure;
use crate::cli::{locate, output, threads};
use crate::ensemble::{Row, Task, evaluate, plan};
use crate::report::{
    Extent, ReadingEntry, ReadingsSummary, readings_text, refuted, summarise, write_readings,
};
use crate::study::{Study, reading_name, readings as readings_of};

/// So many walls of each arm are evaluated first, at the lowest and the highest kn.
const FIRST_WALLS: u64 = 6;
/// A reading that refutes more statements with them is dropped: all but one of the statements are asked for.
const MOST_REFUTED: usize = 1;

/// Searches the readings, writes what each of them gives, and prints those that explain most.
pub(crate) fn readings(arguments: &Readings) -> Result<(), Failure> {
    let folder = locate::folder(&arguments.study)?;
    let loaded = Study::load(&folder, None)?;
    loaded.warnings.iter().for_each(locate::warn);
    let base = asked(loaded.study, arguments)?;
    if base.published.is_empty() {
        return Err(Failure::Input(format!("{} has no published.toml: nothing to search for", base.name)));
    }
    let named = readings_of(&loaded.variants, arguments.departures as usize);
    if named.len() == 1 {
        return Err(Failure::Input(format!(
            "{} has no variant that could be read instead; add [[variant]] to study.toml",
            base.name
        )));
    }
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("runs").join(format!("{}-readings", base.name)));
    output::folder(&out)?;
    threads::on(arguments.threads, || {
        let entries = searched(&folder, &named, arguments)?;
        let summary = ReadingsSummary::of(&base, arguments.departures, FIRST_WALLS, entries);
        write_readings(&summary, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
        if arguments.json {
            return output::print_json(&summary);
        }
        output::print(&format!("{}\nwritten to {}\n", readings_text(&summary), out.display()))
    })
}

/// A study with the seed and the number of walls that are asked for.
fn asked(study: Study, arguments: &Readings) -> Result<Study, Failure> {
    let study = match arguments.seed {
        Some(seed) => study.with_seed(seed),
        None => study,
    };
    match arguments.members {
        Some(members) => locate::with_members(study, members),
        None => Ok(study),
    }
}

/// What every reading gives: the base and those that pass with their first walls on all of them.
fn searched(
    folder: &Path,
    named: &[Vec<String>],
    arguments: &Readings,
) -> Result<Vec<ReadingEntry>, Failure> {
    let mut studies = Vec::with_capacity(named.len());
    for reading in named {
        studies.push(match Study::load(folder, reading_name(reading).as_deref()) {
            Ok(loaded) => Ok(asked(loaded.study, arguments)?),
            Err(faults) => Err(faults.to_string()),
        });
    }
    let sound = || studies.iter().enumerate().filter_map(|(k, study)| Some((k, study.as_ref().ok()?)));
    output::note(&format!("readings: {} to be tried with their first walls", sound().count()));
    let mut rows: Vec<BTreeMap<Task, Row>> = vec![BTreeMap::new(); studies.len()];
    let first = sound().flat_map(|(k, study)| {
        plan(study).into_iter().filter(|task| is_first(study, *task)).map(move |task| (k, study, task))
    });
    evaluated(first.collect(), &mut rows);
    let judged = |k: usize, study: &Study, rows: &[BTreeMap<Task, Row>]| {
        summarise(study, &rows[k].values().cloned().collect::<Vec<_>>()).published
    };
    let passes: Vec<(usize, &Study)> = sound()
        .filter(|&(k, study)| named[k].is_empty() || refuted(&judged(k, study, &rows)) <= MOST_REFUTED)
        .collect();
    output::note(&format!("readings: {} to be evaluated in full", passes.len()));
    let rest = passes.iter().flat_map(|&(k, study)| {
        let missing = |task: &Task| !rows[k].contains_key(task);
        plan(study).into_iter().filter(missing).map(move |task| (k, study, task)).collect::<Vec<_>>()
    });
    let rest = rest.collect();
    evaluated(rest, &mut rows);
    Ok(studies
        .iter()
        .enumerate()
        .map(|(k, study)| match study {
            Err(why) => ReadingEntry::refused(&named[k], why),
            Ok(study) => {
                let in_full = passes.iter().any(|(passed, _)| *passed == k);
                let extent = if in_full { Extent::Full } else { Extent::FirstWalls };
                ReadingEntry::of(&named[k], extent, judged(k, study, &rows))
            }
        })
        .collect())
}

/// Whether a task is among the first walls at one of the ends of kn.
fn is_first(study: &Study, task: Task) -> bool {
    let last = study.arms[task.arm as usize].kn_points.len() - 1;
    task.member < FIRST_WALLS && (task.point == 0 || task.point as usize == last)
}

/// Evaluates tasks of readings in parallel and puts the rows to the others; says on standard error how far it is.
fn evaluated(tasks: Vec<(usize, &Study, Task)>, rows: &mut [BTreeMap<Task, Row>]) {
    let (total, done) = (tasks.len(), AtomicUsize::new(0));
    let evaluated: Vec<(usize, Task, Row)> = tasks
        .into_par_iter()
        .with_max_len(1)
        .map(|(k, study, task)| {
            let row = evaluate(study, task);
            let done = done.fetch_add(1, Ordering::Relaxed);
            if 10 * (done + 1) / total > 10 * done / total {
                output::note(&format!("readings: {}/{total} walls done", done + 1));
            }
            (k, task, row)
        })
        .collect();
    for (k, task, row) in evaluated {
        rows[k].insert(task, row);
    }
}
