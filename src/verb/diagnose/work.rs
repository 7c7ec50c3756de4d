//! `pirca diagnose`: what does the simulation get wrong, and which cause explains it?

use std::fs;
use std::path::{Path, PathBuf};

use crate::critic;
use crate::critic::{
    Analysis, BANK, Design, Extension, Judge, Relation, SEEDS, Step, Steps, Task, Verdict, World,
    base_curves, best_curves, cause_curves, data_notes_by_simulation, fitted_curves,
};
use crate::study::{Loaded, MEASURED, Nuisance, Study};
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::terminal::{output, threads};
use crate::verb::diagnose::advice::Advice;
use crate::verb::diagnose::answer::{
    DataEntry, DiagnosisPage, DiagnosisSummary, FamilyFigure, FitFigure, diagnosis_page, diagnosis_text,
    write_diagnosis,
};
use crate::verb::diagnose::ask::Diagnose;
use crate::verb::diagnose::bank::Prepared;
use crate::verb::diagnose::extended::{EXTENDED, Origin, extended_name, remove_extended, write_extended};
use crate::verb::diagnose::gain::GainSummary;
use crate::verb::diagnose::joint_law::{law_text, remove_law, write_law};
use crate::verb::diagnose::{bank, judge};
use crate::verb::locate;
use crate::verb::run::page;

/// Diagnoses the measurements of a study.
pub(crate) fn diagnose(arguments: &Diagnose) -> Result<Answer, Failure> {
    threads::on(arguments.threads, || {
        if arguments.prepare { bank::prepare(arguments) } else { judged(arguments) }
    })
}

fn judged(arguments: &Diagnose) -> Result<Answer, Failure> {
    let Loaded { study, stated, .. } = bank::measured(&arguments.which, arguments.measured.as_deref())?;
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, "diagnosis"));
    if out.exists() {
        // Before anything is computed: a file in its place is found at once.
        output::folder(&out)?;
    }
    let prepared = bank::prepared(&study, &arguments.which, arguments.points)?;
    let (walls, folder) = banked(&prepared, arguments, &study)?;
    let Prepared { mechanisms, nuisances, plan, mut notes } = prepared;
    let world = judge::world(&study, &mechanisms, &nuisances, &plan, &walls)?;
    let (design, measured) = Design::of(&study);
    // The bank keeps the study's own seed.
    let seed = arguments.seed.unwrap_or(study.seed);
    notes.extend(bank::noted(&data_notes_by_simulation(
        &world,
        &design,
        &measured,
        seed.wrapping_add(5 * SEEDS),
    )));
    let task =
        Task { world: &world, design: &design, measured: &measured, seed, with_gain: !arguments.no_gain };
    let kept = |judge: &Judge<'_>| judge::self_test(judge, &plan, seed, &folder);
    let analysis = critic::diagnose(&task, &OnStderr, kept).ok_or_else(judge::nothing_to_compare)?;
    let Analysis { diagnosis, residuals, self_test, extensions, gain, between, relation, offered, are_left } =
        analysis;
    notes.extend(bank::noted(relation.filter(Relation::is_odd).as_slice()));
    let mut summary = DiagnosisSummary::of(&world, seed, &plan.study.hash, &design, &diagnosis, &self_test)
        .beside(&study, &residuals);
    summary.notes = notes;
    let file = arguments.measured.as_deref().unwrap_or(Path::new(MEASURED));
    summary.measured = stated.measured().map(|(_, sha256)| DataEntry::of(file, sha256));
    summary.advice = Advice::of(&self_test, &offered, are_left, &mechanisms);
    summary.gain = gain.map(|gain| GainSummary::of(&gain, &between, &world, &design));
    let drawn = seed.wrapping_add(7 * SEEDS);
    let (base, causes, fitted, best) = doing("simulating the curves of the figures", |_| {
        let causes = cause_curves(&world, &design, &diagnosis, drawn);
        let fitted = fitted_curves(&world, &design, &measured, drawn);
        let best = best_curves(&world, &design, &diagnosis, &causes, drawn);
        (base_curves(&world, &design, drawn), causes, fitted, best)
    });
    let families = FamilyFigure::all(&study, &mechanisms, &residuals, &base, &causes);
    let in_verdict = !diagnosis.verdict.causes().is_empty();
    let fit = FitFigure::of(&study, &mechanisms, &residuals, &fitted, best.as_ref(), in_verdict);
    summary.extended = extensions.iter().map(|own| format!("{EXTENDED}/{}", named(own))).collect();
    output::folder(&out)?;
    let failed = |error: anyhow::Error| Failure::Run(format!("{error:#}"));
    let drawings = write_diagnosis(&summary, &families, &fit, &out).map_err(failed)?;
    let removed = if arguments.report { String::new() } else { page::without_page(&out)? };
    if arguments.report {
        page::beside(&out, (&arguments.which.study, arguments.threads), |origin| {
            let (fitted, drawings) = (drawings.fit.as_ref(), &drawings.others[..]);
            diagnosis_page(&DiagnosisPage {
                study: &study,
                summary: &summary,
                fit: &fit,
                fitted,
                drawings,
                origin,
            })
        })?;
    }
    let origin = Origin { study: &study, stated: &stated, seed, bank: &plan.study.hash };
    let extended = extended(&origin, &world, &extensions, &out)?;
    let is_unexplained = diagnosis.verdict == Verdict::Unexplained;
    let law = learnt(&origin, &nuisances, is_unexplained, arguments.law, &out)?;
    let text = diagnosis_text(&summary);
    let text = format!("{text}{law}\nwritten to {}\n{removed}{extended}", out.display());
    Ok(Answer::of(text, &summary)?.in_place(&out))
}

/// Says on standard error which step is being done.
struct OnStderr;

impl Steps for OnStderr {
    fn during<T>(&self, step: Step, work: impl FnOnce() -> T) -> T {
        let what = match step {
            Step::Simulate => judge::LEARNING,
            Step::Compare => "setting the readings beside the simulation",
            Step::RankAndCheck => "weighing the causes",
            Step::Predict => "measuring what the extended model gains",
            Step::Advise => "looking for the next test worth making",
        };
        doing(what, |_| work())
    }
}

/// Learns a law of the joints where that is asked for, writes it, and says what it is; where no cause explains the readings, that it can be
/// asked for.
fn learnt(
    origin: &Origin<'_>,
    nuisances: &[Nuisance; 3],
    is_unexplained: bool,
    is_asked: bool,
    out: &Path,
) -> Result<String, Failure> {
    remove_law(out);
    if !is_asked {
        if !is_unexplained || !origin.study.drifts().is_empty() {
            return Ok(String::new());
        }
        return Ok("\nA free law of the joints may say more: add --law to learn it.\n".to_owned());
    }
    match doing("learning a law of the joints", |_| critic::learnt_law(origin.study, nuisances)) {
        Err(why) => Ok(format!("\nNo law of the joints was learnt: {why}.\n")),
        Ok(law) => {
            let written = write_law(origin, &law, out);
            let summary = written.map_err(|error| Failure::Run(format!("{error:#}")))?;
            Ok(format!("\n{}", law_text(&summary)))
        }
    }
}

/// Writes the study that each cause of the verdict, or its pair, extends, in the place of those of an earlier verdict; says so in
/// a line for each.
fn extended(
    origin: &Origin<'_>,
    world: &World<'_>,
    extensions: &[Extension],
    out: &Path,
) -> Result<String, Failure> {
    remove_extended(world.mechanisms(), out);
    let mut said = String::new();
    for extension in extensions {
        let folder = out.join(EXTENDED).join(named(extension));
        write_extended(origin, extension, &folder)
            .map_err(|error| Failure::Run(format!("{}: {error:#}", folder.display())))?;
        let causes = acting(extension).join(" and ");
        said.push_str(&format!("the study extended by {causes}: {}\n", folder.display()));
    }
    Ok(said)
}

/// The mechanisms of an extension.
fn acting(extension: &Extension) -> Vec<&'static str> {
    let mut names: Vec<&str> = extension.median.acting.iter().map(|own| own.mechanism).collect();
    names.dedup();
    names
}

/// Name of an extension's folder.
fn named(extension: &Extension) -> String {
    extended_name(&acting(extension))
}

/// The bank of a plan and its folder: read, or computed where it is not there. Where no folder is named, a study may come with one,
/// which serves if the default folder has none that does.
fn banked(
    prepared: &Prepared,
    arguments: &Diagnose,
    study: &Study,
) -> Result<(critic::Bank, PathBuf), Failure> {
    let folder = arguments.bank.clone().unwrap_or_else(|| output::default_folder(study, "bank"));
    let path = folder.join(BANK);
    let here = fs::read(&path).ok().map(|bytes| prepared.bank(&bytes, study));
    if let Some(Ok(bank)) = here {
        return Ok((bank, folder));
    }
    if arguments.bank.is_none() {
        let own = locate::folder(&arguments.which.study)?;
        let bank = fs::read(own.join(BANK)).ok().and_then(|bytes| prepared.bank(&bytes, study).ok());
        if let Some(bank) = bank {
            return Ok((bank, own));
        }
    }
    if let Some(Err(why)) = here {
        let fix = "name another folder with --bank";
        return Err(Failure::Input(format!("{}: {why}; {fix}", path.display())));
    }
    let plan = &prepared.plan;
    let walls = plan.places.len();
    if arguments.no_build {
        let study = arguments.which.study.display();
        let points = arguments.points;
        let measured = arguments.measured.as_ref();
        let measured = measured.map_or(String::new(), |file| format!(" --measured {}", file.display()));
        let variant =
            arguments.which.variant.as_ref().map_or(String::new(), |name| format!(" --variant {name}"));
        return Err(Failure::Input(format!(
            "there is no {}: {walls} walls are to be simulated first, by\n  pirca diagnose {study}{variant}{measured} --prepare --points {points} --bank {}",
            path.display(),
            folder.display()
        )));
    }
    output::note(&format!(
        "{walls} walls are simulated first, once for this design, into {}",
        folder.display()
    ));
    let bank = bank::computed(plan, &folder, arguments.threads)?;
    Ok((bank, folder))
}
