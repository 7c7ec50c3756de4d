//! `pirca check`: everything that is wrong with a study, without running it.

mod measured;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use crate::ensemble;
use crate::study::{Arm, ElementStudy, Faults, Loaded, Study, Used};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::arguments::{STUDY, Which};
use crate::verb::locate;

/// Of `check`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca check studies/joint-arrangement
         pirca check studies/tilting-table --measured my-tests.csv

--measured says what is read from a table of measurements and what looks odd about it; it simulates nothing. The table has commas, \
semicolons or tabs; decimals with a point, or with a comma where it does not separate; a row per value, or a row per tilt. \
`pirca init FILE --measured STUDY` writes an empty one, `pirca reference keys` lists all columns and quantities. Every fault comes with \
its line.

",
    codes!()
);

/// Arguments of `check`.
#[derive(Args, Debug)]
pub(crate) struct Check {
    #[command(flatten)]
    pub which: Which,
    /// Say what is read from this table of measurements [default: the study's measured.csv].
    #[arg(long, value_name = "FILE", num_args = 0..=1, help_heading = STUDY)]
    pub measured: Option<Option<PathBuf>>,
}

/// Reads the study and says what it found.
pub(crate) fn check(arguments: &Check) -> Result<Answer, Failure> {
    let which = &arguments.which;
    if let Some(file) = &arguments.measured {
        return measured::check(which, file.as_deref());
    }
    let folder = locate::folder(&which.study).map_err(|failure| not_there(failure, which.json))?;
    if ElementStudy::is_in(&folder) {
        return elements(&folder, which.json);
    }
    let loaded =
        Study::load(&folder, which.variant.as_deref()).map_err(|faults| refused(faults, which.json))?;
    let text = summary(&loaded);
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
fn elements(folder: &Path, as_json: bool) -> Result<Answer, Failure> {
    let study = ElementStudy::load(folder).map_err(|faults| refused(faults, as_json))?;
    let names: Vec<String> = study.arms.iter().map(|arm| format!("{} ({})", arm.name, arm.members)).collect();
    let text = format!(
        "{}: valid\n  question: {}\n  elements (assemblies): {}\n  seed: {}\n{}",
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
