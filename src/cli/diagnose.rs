//! `pirca diagnose`: what does the simulation get wrong, and which cause explains it?

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::arguments::Diagnose;
use crate::cli::bank::{self, Prepared};
use crate::cli::failure::Failure;
use crate::cli::output;
use crate::critic::{self, BANK, Design, Effort, Judge, Limits, Measuring, Plan, Truth, Verdict, World};
use crate::report::{self, Advice, DiagnosisSummary, GainSummary};

/// Seeds that a part of a diagnosis may use from its own on.
const SEEDS: u64 = 1000;
/// Campaigns of each cause in the self-test.
const TESTED: u64 = 100;

/// Diagnoses the measurements of a study.
pub(crate) fn diagnose(arguments: &Diagnose) -> Result<(), Failure> {
    let study = bank::measured(&arguments.which, arguments.measured.as_deref())?;
    let Prepared { mechanisms, nuisances, plan } =
        bank::prepared(&study, &arguments.which, arguments.points)?;
    let folder = arguments.bank.clone().unwrap_or_else(|| bank::default_folder(&plan));
    let walls = banked(&plan, &folder, arguments)?;
    let Some(world) = World::new(&study, &mechanisms, &nuisances, &plan, &walls) else {
        let text = "the bank holds too few walls that fell: ask for more --points, or for a load path that ends later";
        return Err(Failure::Run(text.to_string()));
    };
    let (design, measured) = Design::of(&study);
    // The bank keeps the study's own seed.
    let seed = arguments.seed.unwrap_or(study.seed);
    let Some(judge) = Judge::trained(&world, &design, Effort::default(), seed) else {
        return Err(Failure::Input("none of the measurements can be set against a simulation".to_string()));
    };
    let limits = Limits::default();
    let diagnosis = judge.diagnosed(&measured, &limits, seed.wrapping_add(SEEDS));
    let test = judge.self_test(&limits, TESTED, seed.wrapping_add(2 * SEEDS));
    let mut summary =
        DiagnosisSummary::of(&study, seed, &plan.study.hash, &mechanisms, &design, &diagnosis, &test);
    let possible: Vec<(f64, Vec<Truth>)> = diagnosis.possible();
    let offered = critic::offers(&judge, &possible, seed.wrapping_add(4 * SEEDS));
    summary.advice = Advice::of(&test, &offered, &mechanisms);
    if diagnosis.verdict != Verdict::NothingFound && !arguments.no_gain {
        let gain = critic::gain(&judge, &measured, &Measuring::default(), seed.wrapping_add(3 * SEEDS));
        summary.gain = gain.map(|gain| GainSummary::of(&gain, &design, &mechanisms));
    }
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("runs").join(format!("{}-diagnosis", study.name)));
    output::folder(&out)?;
    report::write_diagnosis(&summary, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
    if arguments.which.json {
        return output::print_json(&summary);
    }
    output::print(&format!("{}\nwritten to {}\n", report::diagnosis_text(&summary), out.display()))
}

/// The bank of a plan: read, or computed where it is not there.
fn banked(plan: &Plan, folder: &Path, arguments: &Diagnose) -> Result<critic::Bank, Failure> {
    let path = folder.join(BANK);
    if let Ok(bytes) = fs::read(&path) {
        return critic::Bank::read(&bytes, plan).map_err(|why| {
            Failure::Input(format!("{}: {why}; name another folder with --bank", path.display()))
        });
    }
    let walls = plan.places.len();
    if arguments.no_build {
        let study = arguments.which.study.display();
        let points = arguments.points;
        let measured = arguments.measured.as_ref();
        let measured = measured.map_or(String::new(), |file| format!(" --measured {}", file.display()));
        return Err(Failure::Input(format!(
            "there is no {}: {walls} walls are to be simulated first, by\n  pirca bank {study}{measured} --points {points} --out {}",
            path.display(),
            folder.display()
        )));
    }
    output::note(&format!(
        "{walls} walls are simulated first, once for this design, into {}",
        folder.display()
    ));
    bank::computed(plan, folder, arguments.threads)
}
