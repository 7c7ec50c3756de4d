//! `pirca shards merge`: from shards to the files of a run.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};

use crate::critic;
use crate::critic::BANK;
use crate::ensemble::shard::{Merge, Work, array, merged_timing};
use crate::ensemble::{Row, Tables, replace_file};
use crate::study::Study;
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::terminal::threads;
use crate::verb::diagnose::bank::Prepared;
use crate::verb::run::answer::files::write_gathered;
use crate::verb::run::answer::gathered::Gathered;
use crate::verb::run::answer::table::terminal_table;
use crate::verb::run::origin::Origin;
use crate::verb::run::page;
use crate::verb::shards::ask::Merge as Arguments;
use crate::verb::shards::job::{Job, Made};

/// What came out, with what there is to say of the shards.
#[derive(Serialize)]
struct Object<'a> {
    #[serde(flatten)]
    found: Value,
    missing: String,
    processors: &'a BTreeMap<String, String>,
    warnings: &'a [String],
}

/// Writes what a run on one machine would have written, and says what came out.
pub(crate) fn merge(arguments: &Arguments) -> Result<Answer, Failure> {
    threads::on(arguments.threads, || merged(arguments))
}

fn merged(arguments: &Arguments) -> Result<Answer, Failure> {
    let out = &arguments.folder;
    let work = Work::read(out)?;
    let job = Job::of_work(out, &work, arguments.study.as_deref())?;
    let merge = Merge::of(job.walls(), &work, out, arguments.partial)?;
    let what = format!("putting {} evaluations together", work.evaluations);
    let (text, found) = doing(&what, |_| match &job.made {
        Made::Own => of_study(&merge, out),
        Made::Bank(bank) => of_bank(&job, bank, &merge, out),
        Made::Batch(..) => of_batch(&job, &merge, out),
    })?;
    let processors = merged_timing(&work, out)?;
    let mut warnings = Vec::new();
    if !merge.missing.is_empty() {
        warnings.push(format!(
            "shards {} of {} are missing: what follows is of the others",
            array(&merge.missing),
            work.of
        ));
    }
    if processors.len() > 1 {
        let kinds: Vec<String> =
            processors.iter().map(|(kind, shards)| format!("{kind}: shards {shards}")).collect();
        warnings.push(format!(
            "computed on several kinds of processors, where the last digits of a wall may differ ({})",
            kinds.join("; ")
        ));
    }
    let object =
        Object { found, missing: array(&merge.missing), processors: &processors, warnings: &warnings };
    let answer = Answer::of(text, &object)?;
    Origin::now(&job.place, arguments.threads).write(out)?;
    Ok(answer.in_place(out).with_warnings(warnings))
}

fn of_study(merge: &Merge<'_>, out: &Path) -> Result<(String, Value), Failure> {
    let study = merge.come_to()?;
    let mut gathered = Gathered::new(&study);
    tables(merge, &study, out, &mut |row| gathered.take(row))?;
    let summary =
        write_gathered(&study, gathered, out, None).map_err(|error| Failure::Run(format!("{error:#}")))?;
    let removed = page::without_page(out)?;
    let text = format!("{}\nwritten to {}\n{removed}", terminal_table(&summary).trim_end(), out.display());
    Ok((text, json!(summary)))
}

fn of_bank(job: &Job, bank: &Prepared, merge: &Merge<'_>, out: &Path) -> Result<(String, Value), Failure> {
    if !merge.missing.is_empty() {
        return Err(Failure::Usage(
            "--partial: a bank is of all its walls; compute the missing shards".to_owned(),
        ));
    }
    let mut rows = Vec::new();
    tables(merge, job.walls(), out, &mut |row| rows.push(row.clone()))?;
    let made = critic::Bank::of(&bank.plan, &rows);
    replace_file(&out.join(BANK), &made.table(&bank.plan)?)?;
    let walls = rows.len();
    let text = format!(
        "{walls} walls, written to {}; pirca diagnose --prepare with --bank of this folder adds the self-test\n",
        out.display()
    );
    Ok((text, json!({"walls": walls})))
}

/// The tables of a batch are for looking at it: its values are taken over by the command that waits for them.
fn of_batch(job: &Job, merge: &Merge<'_>, out: &Path) -> Result<(String, Value), Failure> {
    let mut walls = 0;
    tables(merge, job.walls(), out, &mut |_| walls += 1)?;
    let text = format!("{walls} walls of the batch {}; start the same pirca capacity again\n", out.display());
    Ok((text, json!({"walls": walls})))
}

/// Writes the tables of the walls, and lets each be seen on the way.
fn tables(merge: &Merge<'_>, study: &Study, out: &Path, see: &mut dyn FnMut(&Row)) -> Result<(), Failure> {
    let mut tables = Tables::begin(out, merge.added.clone())?;
    let members: Vec<u64> = study.arms.iter().map(|arm| arm.members).collect();
    merge.rows(&members, &mut |row| {
        tables.take(&row)?;
        see(&row);
        Ok(())
    })?;
    tables.end()?;
    Ok(merge.write_manifest()?)
}
