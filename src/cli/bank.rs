//! `pirca bank`: the walls that diagnoses of a study's measurements rest on.

use std::path::PathBuf;

use crate::cli::arguments::Bank;
use crate::cli::failure::Failure;
use crate::cli::{locate, output, progress};
use crate::critic::{self, BANK, Plan};
use crate::ensemble::{Settings, replace_file, run_with};
use crate::study::{described, nuisances};

/// Computes what the bank does not hold yet.
pub(crate) fn bank(arguments: &Bank) -> Result<(), Failure> {
    let study = locate::study(&arguments.which)?.study;
    if study.measured.is_empty() {
        return Err(Failure::Input(format!(
            "{}: nothing was measured; a bank is made for the families of a measured.csv",
            study.name
        )));
    }
    let distributions = locate::folder(&arguments.which.study)?.join("../../distributions");
    let mechanisms = described(&distributions).map_err(Failure::Input)?;
    let nuisances = nuisances(&distributions).map_err(Failure::Input)?;
    let plan = Plan::new(&study, &mechanisms, &nuisances, arguments.points)
        .map_err(|faults| Failure::Input(faults.to_string()))?;
    let out = arguments.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&plan.study.name));
    let settings = Settings { out: out.clone(), threads: arguments.threads };
    let rows = run_with(&plan.study, &settings, progress::on_stderr(&plan.study).as_ref(), &|_, task| {
        plan.evaluate(task)
    })?;
    let bank = critic::Bank::of(&rows);
    replace_file(&out.join(BANK), &bank.table(&plan)?)?;
    let told = bank.paths.iter().flatten().count();
    output::print(&format!(
        "{} walls, {told} with a path to their collapse, in {}\n",
        rows.len(),
        out.display()
    ))
}
