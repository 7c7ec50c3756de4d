//! The walls that diagnoses of a study's measurements rest on: `pirca diagnose --prepare` alone simulates them.

use std::fs;
use std::num::NonZero;
use std::path::Path;

use serde::Serialize;
use serde_json::json;

use crate::critic;
use crate::critic::{BANK, DataNote, Design, MOST_SOUGHT, NotThisBank, Plan, World, data_notes};
use crate::ensemble::{Settings, replace_file, run_with};
use crate::protocol::Protocol;
use crate::solve::Solver;
use crate::study::{Described, Loaded, Nuisance, Study, described, nuisances};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::{output, progress};
use crate::verb::arguments::Which;
use crate::verb::diagnose::ask::Diagnose;
use crate::verb::diagnose::judge;
use crate::verb::locate;

/// Points in the priors for each mechanism, unless others are asked for.
pub(crate) const POINTS: u64 = 60;

/// Simulated campaigns of each mechanism that a self-test judges by the whole diagnosis, unless others are asked for.
const JUDGED: u64 = 6;

/// What a bank is made of.
pub(crate) struct Prepared {
    pub mechanisms: Vec<Described>,
    pub nuisances: [Nuisance; 3],
    pub plan: Plan,
    /// What was said on standard error of the measurements.
    pub notes: Vec<String>,
}

/// Computes what the bank does not hold yet, and its self-test.
pub(crate) fn prepare(arguments: &Diagnose) -> Result<Answer, Failure> {
    let study = measured(&arguments.which, arguments.measured.as_deref())?.study;
    let Prepared { mechanisms, nuisances, plan, .. } = prepared(&study, &arguments.which, arguments.points)?;
    let out = arguments.bank.clone().unwrap_or_else(|| output::default_folder(&study, "bank"));
    // A table that came without its journal is as good as one that was computed here.
    let present = fs::read(out.join(BANK)).ok().and_then(|bytes| critic::Bank::read(&bytes, &plan).ok());
    let bank = present.map_or_else(|| computed(&plan, &out, arguments.threads), Ok)?;
    let told = bank.paths.iter().flatten().count();
    let walls = bank.paths.len();
    let way = match study.protocol {
        Protocol::Shear(_) => "a curve of pushes",
        _ => "a path to their collapse",
    };
    let mut said = format!("{walls} walls, {told} with {way}, in {}\n", out.display());
    let mut known = Vec::new();
    // Few points make a bank that may grow, and nothing to judge by.
    let seed = arguments.seed.unwrap_or(study.seed);
    if let Ok(world) = judge::world(&study, &mechanisms, &nuisances, &plan, &bank)
        && let Ok(judge) = judge::judge(&world, &Design::of(&study).0, seed)
    {
        judge::keep_self_test(&judge, &plan, seed, &out, arguments.judged.unwrap_or(JUDGED))?;
        known = explained(&world);
        said.push_str(&in_words(&known));
    }
    let object = json!({
        "study": study.name, "variant": study.variant, "seed": seed, "walls": walls, "walls_with_path": told,
        "explained": known, "out": out.display().to_string(),
    });
    Ok(Answer::of(said, &object)?.in_place(&out))
}

/// How much of what walls of a family do the emulators know beforehand: shares of the variance, by what is predicted.
#[derive(Serialize)]
struct Explained {
    family: String,
    shares: Vec<Share>,
}

/// Of what is predicted, which share of its variance is known.
#[derive(Serialize)]
struct Share {
    of: &'static str,
    share: f64,
}

fn explained(world: &World<'_>) -> Vec<Explained> {
    let of = |(family, shares): (usize, [(&'static str, f64); 2])| Explained {
        family: world.study().arms[family].name.clone(),
        shares: shares.into_iter().map(|(of, share)| Share { of, share: share.max(0.0) }).collect(),
    };
    world.explained().into_iter().map(of).collect()
}

fn in_words(known: &[Explained]) -> String {
    let mut text = "Told beforehand of walls that were left out, of the variance in a family (the rest is stones and emulator, and \
                    is reckoned with)\n"
        .to_string();
    for Explained { family, shares } in known {
        let shares: Vec<String> =
            shares.iter().map(|Share { of, share }| format!("{of} {:.0} %", 100.0 * share)).collect();
        text.push_str(&format!("  {family}: {}\n", shares.join(", ")));
    }
    text
}

/// The study that the arguments name, with the measurements of another file if one is named.
pub(crate) fn measured(which: &Which, file: Option<&Path>) -> Result<Loaded, Failure> {
    let loaded = locate::any_study(which)?;
    match file {
        Some(file) => {
            let loaded = loaded.with_measured(file)?;
            let own = file.display().to_string();
            loaded.warnings.iter().filter(|warning| warning.file == own).for_each(locate::warn);
            Ok(loaded)
        }
        None => Ok(loaded),
    }
}

/// The plan for what was measured, with the priors beside the folder of the studies.
pub(crate) fn prepared(study: &Study, which: &Which, points: u64) -> Result<Prepared, Failure> {
    locate::without_uncertain(study)?;
    if study.measured.is_empty() {
        return Err(Failure::Input(format!(
            "{}: nothing was measured; put a measured.csv into the study's folder, or name a file with --measured",
            study.name
        )));
    }
    let (done, needed) = match study.protocol {
        Protocol::Tilting(_) => ("tilted", "collapse angles or displacements"),
        Protocol::Shear(_) => ("sheared", "readings of force_at_drift"),
        Protocol::BaseMotion(_) => ("shaken", "outcomes of motions of the base"),
        Protocol::Lateral(_) | Protocol::Retaining(_) => {
            let text = "the study neither tilts, shears nor shakes its walls: diagnoses are of such tests (load.protocol)";
            return Err(Failure::Input(format!("{}: {text}", study.name)));
        }
    };
    if let (Protocol::Shear(_), Solver::Limit(_)) = (&study.protocol, &study.solver) {
        let text = "limit analysis knows no drift: diagnose with solver.name = \"implicit\"";
        return Err(Failure::Input(format!("{}: {text}", study.name)));
    }
    let sought =
        study.clone().seeking_what_was_measured().earthquakes.map_or(0, |shaken| shaken.sought.len());
    if sought > MOST_SOUGHT {
        let text = format!(
            "outcomes and displacements under {sought} motions: allowed are {MOST_SOUGHT}; take out the motions that all specimens outlive by far"
        );
        return Err(Failure::Input(format!("{}: {text}", study.name)));
    }
    let (design, _) = Design::of(study);
    if design.specimens.is_empty() {
        let arms: Vec<&str> = study.arms.iter().map(|arm| arm.name.as_str()).collect();
        return Err(Failure::Input(format!(
            "{}: no specimen was {done}: a diagnosis needs {needed} of a wall of {}; weights, tests on joints alone and other arms \
             say nothing of these",
            study.name,
            arms.join(", ")
        )));
    }
    let mut notes = noted(&data_notes(study, &design));
    let distributions = locate::distributions(which)?;
    let mut mechanisms = described(&distributions).map_err(Failure::Input)?;
    if let Protocol::Shear(_) | Protocol::BaseMotion(_) = study.protocol {
        let idle = set_aside(study, &mut mechanisms)?;
        notes.extend(noted(&[idle]));
    }
    let nuisances = nuisances(&distributions).map_err(Failure::Input)?;
    let plan = Plan::new(study, &mechanisms, &nuisances, points)?;
    Ok(Prepared { mechanisms, nuisances, plan, notes })
}

/// Takes those mechanisms out that cannot act on any wall that was measured, and says so.
fn set_aside(study: &Study, mechanisms: &mut Vec<Described>) -> Result<DataNote, Failure> {
    let families = study.measured_arms();
    let (mut acting, mut idle) = (Vec::new(), Vec::new());
    for mechanism in mechanisms.drain(..) {
        match study.cannot_act(&mechanism, &families)? {
            Some(why) => idle.push((mechanism.name, why)),
            None => acting.push(mechanism),
        }
    }
    *mechanisms = acting;
    Ok(DataNote::CannotAct { mechanisms: idle })
}

/// Prints notes on the data on standard error, and gives their words.
pub(crate) fn noted(notes: &[impl ToString]) -> Vec<String> {
    let words: Vec<String> = notes.iter().map(ToString::to_string).collect();
    words.iter().for_each(|words| output::note(&format!("note: {words}")));
    words
}

impl Prepared {
    /// The walls of its plan in a table that was made for it, or for more families.
    pub fn bank(&self, bytes: &[u8], study: &Study) -> Result<critic::Bank, NotThisBank> {
        match critic::Bank::read(bytes, &self.plan) {
            Err(other @ NotThisBank::Design { .. }) => self.part(bytes, study).ok_or(other),
            own => own,
        }
    }

    fn part(&self, bytes: &[u8], study: &Study) -> Option<critic::Bank> {
        let held = critic::Bank::held(bytes).ok()?;
        let families = study.arms.iter().enumerate().filter(|(_, arm)| held.families.contains(&arm.name));
        let families: Vec<usize> = families.map(|(family, _)| family).collect();
        let Prepared { mechanisms, nuisances, plan, .. } = self;
        let own = Plan::of_families(study, &families, mechanisms, nuisances, held.points).ok()?;
        critic::Bank::read(bytes, &own).ok()?.part(&own, plan)
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
    let bank = critic::Bank::of(plan, &rows);
    replace_file(&folder.join(BANK), &bank.table(plan)?)?;
    Ok(bank)
}
