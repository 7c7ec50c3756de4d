//! `pirca bank`: the walls that diagnoses of a study's measurements rest on.

use std::num::NonZero;
use std::path::{Path, PathBuf};

use crate::cli::arguments::{Bank, Which};
use crate::cli::failure::Failure;
use crate::cli::{locate, output, progress};
use crate::critic::{self, BANK, Plan};
use crate::ensemble::{Settings, replace_file, run_with};
use crate::protocol::Protocol;
use crate::study::{Described, Nuisance, Study, described, nuisances};

/// What a bank is made of.
pub(crate) struct Prepared {
    pub mechanisms: Vec<Described>,
    pub nuisances: [Nuisance; 3],
    pub plan: Plan,
}

/// Computes what the bank does not hold yet.
pub(crate) fn bank(arguments: &Bank) -> Result<(), Failure> {
    let study = measured(&arguments.which, arguments.measured.as_deref())?;
    let Prepared { plan, .. } = prepared(&study, &arguments.which, arguments.points)?;
    let out = arguments.out.clone().unwrap_or_else(|| default_folder(&plan));
    let bank = computed(&plan, &out, arguments.threads)?;
    let told = bank.paths.iter().flatten().count();
    let walls = bank.paths.len();
    output::print(&format!("{walls} walls, {told} with a path to their collapse, in {}\n", out.display()))
}

/// The study that the arguments name, with the measurements of another file if one is named.
pub(crate) fn measured(which: &Which, file: Option<&Path>) -> Result<Study, Failure> {
    let study = locate::study(which)?.study;
    match file {
        Some(file) => Ok(study.with_measured(file)?),
        None => Ok(study),
    }
}

/// The plan for what was measured, with the priors beside the folder of the studies.
pub(crate) fn prepared(study: &Study, which: &Which, points: u64) -> Result<Prepared, Failure> {
    if study.measured.is_empty() {
        return Err(Failure::Input(format!(
            "{}: nothing was measured; put a measured.csv into the study's folder, or name a file with --measured",
            study.name
        )));
    }
    let Protocol::Tilting(_) = study.protocol else {
        let text = "the study tilts no platform: diagnoses are of tilting tests";
        return Err(Failure::Input(format!("{}: {text}", study.name)));
    };
    let distributions = locate::distributions(which)?;
    let mechanisms = described(&distributions).map_err(Failure::Input)?;
    let nuisances = nuisances(&distributions).map_err(Failure::Input)?;
    let plan = Plan::new(study, &mechanisms, &nuisances, points)?;
    Ok(Prepared { mechanisms, nuisances, plan })
}

/// Where a bank is kept.
pub(crate) fn default_folder(plan: &Plan) -> PathBuf {
    PathBuf::from("runs").join(&plan.study.name)
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
