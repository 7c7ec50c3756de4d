//! `pirca diagnose`: what does the simulation get wrong, and which cause explains it?

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::arguments::Diagnose;
use crate::cli::bank::{self, Prepared};
use crate::cli::failure::Failure;
use crate::cli::output;
use crate::critic::{
    self, BANK, Baseline, Design, Limits, Plan, Ranking, Reference, World, base_curves, cause_curves,
    diagnosed,
};
use crate::report::{self, DiagnosisSummary, FamilyFigure};

/// Campaigns of the base model that say how far off they are by chance.
const REFERENCE: u64 = 2000;
/// Campaigns of each cause that the ranking learns from.
const TRAINING: u64 = 1200;
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
    let Some(reference) = Reference::new(&world, &design, REFERENCE, seed) else {
        return Err(Failure::Input("none of the measurements can be set against a simulation".to_string()));
    };
    let ranking = Ranking::trained(&world, &design, &reference, TRAINING, seed.wrapping_add(1));
    let limits = Limits::default();
    let diagnosis =
        diagnosed(&world, &design, (&reference, &ranking), &measured, &limits, seed.wrapping_add(2));
    let test = ranking.self_test(&world, &design, &reference, &limits, TESTED, seed.wrapping_add(3));
    let residuals = Baseline::new(&world, &design, seed.wrapping_add(4)).residuals(&measured);
    let summary =
        DiagnosisSummary::of(&study, seed, &plan.study.hash, &mechanisms, &design, &diagnosis, &test)
            .beside(&study, &residuals);
    let base = base_curves(&world, &design, seed.wrapping_add(5));
    let causes = cause_curves(&world, &design, &diagnosis, seed.wrapping_add(5));
    let families = FamilyFigure::all(&study, &mechanisms, &residuals, &base, &causes);
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("runs").join(format!("{}-diagnosis", study.name)));
    output::folder(&out)?;
    report::write_diagnosis(&summary, &families, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
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
