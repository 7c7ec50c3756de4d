//! `pirca run` and `pirca check` of a study of element types.

use std::path::{Path, PathBuf};

use serde_json::json;

use crate::cli::answer::Answer;
use crate::cli::arguments::{Check, Run};
use crate::cli::doing::doing;
use crate::cli::failure::Failure;
use crate::cli::{check, locate};
use crate::ensemble::{self, Settings};
use crate::report;
use crate::study::{ElementStudy, key_reference};

/// Runs the study and answers with its table.
pub(super) fn run(folder: &Path, arguments: &Run) -> Result<Answer, Failure> {
    let refused = [
        (arguments.which.variant.is_some(), "--variant: it has no variants"),
        (arguments.solver.is_some(), "--solver: spheres and polyhedra each have their own explicit one"),
        (arguments.beside.is_some(), "--beside: it draws no figure"),
        (arguments.csv, "--csv: elements.csv is what it writes anyway"),
        (arguments.report, "--report: its results are one table and have no page"),
    ];
    if let Some((_, why)) = refused.iter().find(|(given, _)| *given) {
        return Err(Failure::Usage(format!("{} compares types of elements; {why}", folder.display())));
    }
    let mut study = ElementStudy::load(folder)?;
    study.warnings.iter().for_each(locate::warn);
    if let Some(seed) = arguments.ensemble.seed {
        study = study.with_seed(seed);
    }
    if let Some(members) = arguments.ensemble.members {
        if members > 1 && study.arms.iter().all(|arm| arm.elements.is_fixed()) {
            let text =
                "nothing in the study is random, so that all assemblies would be the same: leave it out";
            return Err(Failure::Usage(format!("--members {members}: {text}")));
        }
        study = study.with_members(members);
    }
    let out = arguments.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&study.name));
    let settings = Settings { out: out.clone(), threads: arguments.threads };
    let rows = doing(&format!("{}: filling and shoving", study.name), |doing| {
        let told = |done, all| doing.say(format!("{done} of {all} assemblies done"));
        ensemble::run_elements(&study, &settings, &told)
    })?;
    let summary =
        report::write_elements(&study, &rows, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
    let text = format!("{}written to {}\n", report::element_table(&study, &rows), out.display());
    Ok(Answer::of(text, &summary)?.in_place(&out))
}

/// Says whether the study is valid and what it would run.
pub(super) fn check(folder: &Path, arguments: &Check) -> Result<Answer, Failure> {
    let study = ElementStudy::load(folder).map_err(|faults| check::refused(faults, arguments.which.json))?;
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
        check::origins(&study.used)
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
