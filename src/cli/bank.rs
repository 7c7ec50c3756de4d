//! `pirca bank`: the walls that diagnoses of a study's measurements rest on.

use std::num::NonZero;
use std::path::{Path, PathBuf};

use crate::cli::arguments::Bank;
use crate::cli::failure::Failure;
use crate::cli::{locate, output, progress};
use crate::critic::{self, BANK, Plan};
use crate::ensemble::{Settings, replace_file, run_with};
use crate::protocol::Protocol;
use crate::study::{Study, described, nuisances};

/// Computes what the bank does not hold yet.
pub(crate) fn bank(arguments: &Bank) -> Result<(), Failure> {
    let study = locate::study(&arguments.which)?.study;
    if study.measured.is_empty() {
        let text = "nothing was measured; a bank is made for the families of a measured.csv";
        return Err(Failure::Input(format!("{}: {text}", study.name)));
    }
    check(&study)?;
    let distributions = locate::folder(&arguments.which.study)?.join("../../distributions");
    let mechanisms = described(&distributions).map_err(Failure::Input)?;
    let nuisances = nuisances(&distributions).map_err(Failure::Input)?;
    let plan = Plan::new(&study, &mechanisms, &nuisances, arguments.points)?;
    let out = arguments.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&plan.study.name));
    let bank = computed(&plan, &out, arguments.threads)?;
    let told = bank.paths.iter().flatten().count();
    let walls = bank.paths.len();
    output::print(&format!("{walls} walls, {told} with a path to their collapse, in {}\n", out.display()))
}

/// A bank holds walls on their way to collapse on a tilting table.
pub(crate) fn check(study: &Study) -> Result<(), Failure> {
    match study.protocol {
        Protocol::Tilting(_) => Ok(()),
        _ => Err(Failure::Input(format!(
            "{}: the study tilts no platform: diagnoses are of tilting tests",
            study.name
        ))),
    }
}

/// Simulates what a folder does not hold yet of a plan's walls, and writes their table there.
pub(crate) fn computed(
    plan: &Plan,
    folder: &Path,
    threads: Option<NonZero<usize>>,
) -> Result<critic::Bank, Failure> {
    let settings = Settings { out: folder.to_path_buf(), threads };
    let progress = progress::on_stderr(&plan.study);
    let rows = run_with(&plan.study, &settings, progress.as_ref(), &|_, task| plan.evaluate(task))?;
    let bank = critic::Bank::of(&rows);
    replace_file(&folder.join(BANK), &bank.table(plan)?)?;
    Ok(bank)
}
