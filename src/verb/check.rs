//! `pirca check`: everything that is wrong with a study, without running it.

use std::collections::BTreeSet;
use std::path::Path;

use clap::Args;
use serde_json::json;

use crate::ensemble;
use crate::study::{Arm, ElementStudy, Faults, Loaded, Study, Used, key_reference};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::arguments::{OUTPUT, Which};
use crate::verb::locate;

/// Of `check`.
pub(crate) const HELP: &str = concat!(
    "Example: pirca check studies/joint-arrangement\n         pirca check studies/joint-arrangement --keys\n         pirca check studies/joint-arrangement --columns\n\n",
    codes!()
);

/// Arguments of `check`.
#[derive(Args, Debug)]
pub(crate) struct Check {
    #[command(flatten)]
    pub which: Which,
    /// List every key that a study, its published.toml and a distribution may hold: what is allowed, default, meaning.
    #[arg(long, conflicts_with = "json", help_heading = OUTPUT)]
    pub keys: bool,
    /// List every column of the tables of a run: name, unit, meaning.
    #[arg(long, conflicts_with = "json", help_heading = OUTPUT)]
    pub columns: bool,
}

/// Reads the study and says what it found.
pub(crate) fn check(arguments: &Check) -> Result<Answer, Failure> {
    let which = &arguments.which;
    let folder = locate::folder(&which.study).map_err(|failure| not_there(failure, which.json))?;
    if ElementStudy::is_in(&folder) {
        return elements(&folder, arguments);
    }
    let loaded =
        Study::load(&folder, which.variant.as_deref()).map_err(|faults| refused(faults, which.json))?;
    let mut text = summary(&loaded);
    if arguments.keys {
        text += &format!("\n{}", key_reference());
    }
    if arguments.columns {
        text += &format!("\n{}", ensemble::column_reference());
    }
    let Loaded { study, warnings, variants, used, .. } = &loaded;
    let object = json!({
        "valid": true,
        "study": study.name,
        "variant": study.variant,
        "seed": study.seed,
        "study_hash": study.hash,
        "arms": study.arms.iter().map(|arm| json!({
            "arm": arm.name,
            "members": arm.members,
            "until": arm.until.map(|until| json!({
                "half_width_of": until.of.name(), "below": until.below, "at_most": until.at_most,
            })),
            "random": ensemble::is_random(arm),
            "kn_pa_per_m": arm.kn_points,
        })).collect::<Vec<_>>(),
        "evaluations": ensemble::plan(study).len(),
        "measured": study.measured.len(),
        "specimens": specimens(study).len(),
        "variants": variants,
        "distributions": used,
        "faults": [],
        "warnings": warnings,
    });
    let answer = Answer::of(text, &object)?;
    Ok(answer.with_warnings(warnings.iter().map(ToString::to_string).collect()))
}

/// A study with faults, in words or as the object that a program reads.
pub(crate) fn refused(faults: Faults, as_json: bool) -> Failure {
    match as_json {
        true => Failure::Said(json!({"valid": false, "faults": faults.faults, "warnings": []})),
        false => faults.into(),
    }
}

/// The same of a study that is not there.
fn not_there(failure: Failure, as_json: bool) -> Failure {
    match as_json {
        true => {
            Failure::Said(json!({"valid": false, "error": failure.message(), "faults": [], "warnings": []}))
        }
        false => failure,
    }
}

/// A number of things, in words.
fn counted(n: usize, name: &str) -> String {
    if n == 1 { format!("1 {name}") } else { format!("{n} {name}s") }
}

/// Names of the specimens measured.
fn specimens(study: &Study) -> BTreeSet<&str> {
    study.measured.iter().map(|measurement| measurement.specimen.as_str()).collect()
}

fn summary(loaded: &Loaded) -> String {
    let study = &loaded.study;
    let variant = study.variant.as_ref().map(|name| format!(", variant {name}")).unwrap_or_default();
    let arm = |arm: &Arm| {
        let most = if arm.until.is_some() { "at most " } else { "" };
        format!("{} ({most}{} x {} kn)", arm.name, arm.members, arm.kn_points.len())
    };
    let arms: Vec<_> = study.arms.iter().map(arm).collect();
    let mut text = format!(
        "{}{variant}: valid\n  question: {}\n  arms (walls x points): {}\n  evaluations: {}\n  seed: {}\n",
        study.name,
        study.question,
        arms.join(", "),
        ensemble::plan(study).len(),
        study.seed
    );
    if !study.measured.is_empty() {
        let (values, specimens) = (study.measured.len(), specimens(study).len());
        text.push_str(&format!(
            "  measured: {} on {}\n",
            counted(values, "value"),
            counted(specimens, "specimen")
        ));
    }
    for variant in &loaded.variants {
        text.push_str(&format!("  variant {}: {}\n", variant.name, variant.why));
    }
    text.push_str(&origins(&loaded.used));
    for used in loaded.used.iter().filter(|used| used.status == "assumed") {
        text.push_str(&format!("  assumed: {} = {} ({})\n", used.key, used.reference, used.source));
    }
    text
}

/// A line for each file of distributions that was taken: where it lies.
pub(crate) fn origins(used: &[Used]) -> String {
    let here = std::env::current_dir().unwrap_or_default();
    let line = |used: &Used| {
        let file = used.reference.split(':').next().unwrap_or(&used.reference);
        let from = Path::new(&used.from);
        format!("  distribution: {file} from {}\n", from.strip_prefix(&here).unwrap_or(from).display())
    };
    used.iter().map(line).collect::<BTreeSet<_>>().into_iter().collect()
}

/// Says whether a study of element types is valid and what it would run.
fn elements(folder: &Path, arguments: &Check) -> Result<Answer, Failure> {
    let study = ElementStudy::load(folder).map_err(|faults| refused(faults, arguments.which.json))?;
    if arguments.columns {
        return Err(Failure::Usage(format!(
            "{} compares types of elements; --columns: the table of its results is elements.csv, whose columns are named after what they hold",
            folder.display()
        )));
    }
    let names: Vec<String> = study.arms.iter().map(|arm| format!("{} ({})", arm.name, arm.members)).collect();
    let keys = if arguments.keys { format!("\n{}", key_reference()) } else { String::new() };
    let text = format!(
        "{}: valid\n  question: {}\n  elements (assemblies): {}\n  seed: {}\n{}{keys}",
        study.name,
        study.question,
        names.join(", "),
        study.seed,
        origins(&study.used)
    );
    let object = json!({
        "valid": true,
        "study": study.name,
        "seed": study.seed,
        "study_hash": study.hash,
        "elements": study.arms.iter()
            .map(|arm| json!({"element": arm.name, "members": arm.members, "random": !arm.elements.is_fixed()}))
            .collect::<Vec<_>>(),
        "distributions": study.used,
        "faults": [],
        "warnings": study.warnings,
    });
    Ok(Answer::of(text, &object)?.with_warnings(study.warnings.iter().map(ToString::to_string).collect()))
}
