//! `pirca readings`: which variants of a study, alone or together, explain what was published?

use std::collections::BTreeMap;
use std::path::Path;

use rayon::prelude::*;

use crate::ensemble::{Progress, Row, Task, evaluate, plan};
use crate::study::{Study, reading_name, readings as readings_of};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::progress::Tenths;
use crate::terminal::{output, threads};
use crate::verb::locate;
use crate::verb::readings::answer::{Extent, ReadingEntry, ReadingsSummary, readings_document};
use crate::verb::readings::ask::Readings;
use crate::verb::run::page::{Place, told};

/// What the folder and the lines on standard error are named by.
const READINGS: &str = "readings";
/// So many walls of each arm are evaluated first, at the lowest and the highest kn.
const FIRST_WALLS: u64 = 6;
/// A reading that refutes more statements with them is dropped: all but one of the statements are asked for.
const MOST_REFUTED: usize = 1;

/// Searches the readings, writes what each of them gives, and prints those that explain most.
pub(crate) fn readings(arguments: &Readings) -> Result<Answer, Failure> {
    let folder = locate::folder(&arguments.study)?;
    let loaded = Study::load(&folder, None)?;
    loaded.warnings.iter().for_each(locate::warn);
    let base = locate::with_ensemble(loaded.study.clone(), &arguments.ensemble)?;
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
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&base, READINGS));
    output::folder(&out)?;
    threads::on(arguments.threads, || {
        let entries = searched(&folder, &named, arguments)?;
        let summary = ReadingsSummary::of(&base, arguments.departures, FIRST_WALLS, entries);
        let place = Place {
            out: &out,
            name: READINGS,
            study: (&base, &loaded),
            of: &arguments.study,
            threads: arguments.threads,
            report: arguments.report,
        };
        told(&readings_document(&summary), &summary, &place)
    })
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
            Ok(loaded) => Ok(locate::with_ensemble(loaded.study, &arguments.ensemble)?),
            Err(faults) => Err(faults.to_string()),
        });
    }
    let progress = Tenths::of(READINGS);
    let mut rows: Vec<BTreeMap<Task, Row>> = vec![BTreeMap::new(); studies.len()];
    let judged = |k: usize, extent, study: &Study, rows: &[BTreeMap<Task, Row>]| {
        ReadingEntry::judged(&named[k], extent, study, &rows[k].values().cloned().collect::<Vec<_>>())
    };
    let sound = || studies.iter().enumerate().filter_map(|(k, study)| Some((k, study.as_ref().ok()?)));
    let of = |(k, study)| plan(study).into_iter().map(move |task| (k, study, task));
    output::note(&format!("{READINGS}: {} to be tried with their first walls", sound().count()));
    let first = sound().flat_map(of).filter(|(_, study, task)| is_first(study, *task));
    evaluated(first.collect(), &mut rows, &progress);
    let mut entries: Vec<ReadingEntry> = studies
        .iter()
        .enumerate()
        .map(|(k, study)| match study {
            Ok(study) => judged(k, Extent::FirstWalls, study, &rows),
            Err(why) => ReadingEntry::refused(&named[k], why),
        })
        .collect();
    let passes = |k: usize| named[k].is_empty() || entries[k].refuted <= MOST_REFUTED;
    let passes: Vec<(usize, &Study)> = sound().filter(|(k, _)| passes(*k)).collect();
    output::note(&format!("{READINGS}: {} to be evaluated in full", passes.len()));
    let rest = passes.iter().copied().flat_map(of).filter(|(k, _, task)| !rows[*k].contains_key(task));
    let rest = rest.collect();
    evaluated(rest, &mut rows, &progress);
    for (k, study) in passes {
        entries[k] = judged(k, Extent::Full, study, &rows);
    }
    Ok(entries)
}

/// Whether a task is among the first walls at one of the ends of kn.
fn is_first(study: &Study, task: Task) -> bool {
    let last = study.arms[task.arm as usize].kn_points.len() - 1;
    task.member < FIRST_WALLS && (task.point == 0 || task.point as usize == last)
}

/// Evaluates tasks of readings in parallel and puts the rows to the others.
fn evaluated(tasks: Vec<(usize, &Study, Task)>, rows: &mut [BTreeMap<Task, Row>], progress: &dyn Progress) {
    progress.begin(tasks.len(), &[]);
    let one = |(k, study, task): (usize, &Study, Task)| {
        let row = evaluate(study, task);
        progress.finished(&row);
        (k, task, row)
    };
    let evaluated: Vec<_> = tasks.into_par_iter().with_max_len(1).map(one).collect();
    progress.end();
    for (k, task, row) in evaluated {
        rows[k].insert(task, row);
    }
}
