//! `pirca run` of a study of element types.

use std::path::{Path, PathBuf};

use crate::ensemble;
use crate::ensemble::Settings;
use crate::study::ElementStudy;
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::verb::locate;
use crate::verb::run::answer::element_table::{element_document, write_elements};
use crate::verb::run::answer::page::element_page;
use crate::verb::run::ask::Run;
use crate::verb::run::origin::Origin;
use crate::verb::run::page;

/// Runs the study and answers with its table; its page is written to `file`, or into the output folder if it is asked for.
pub(crate) fn run(folder: &Path, arguments: &Run, file: Option<PathBuf>) -> Result<Answer, Failure> {
    let refused = [
        (arguments.which.variant.is_some(), "--variant: it has no variants"),
        (arguments.solver.is_some(), "--solver: spheres and polyhedra each have their own explicit one"),
        (arguments.beside.is_some(), "--beside: it draws no figure"),
        (arguments.csv, "--csv: elements.csv is what it writes anyway"),
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
    let summary = write_elements(&study, &rows, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
    let document = element_document(&study, &rows);
    let is_beside = arguments.report && file.is_none();
    let removed = if is_beside { String::new() } else { page::without_page(&out)? };
    let file = file.or_else(|| arguments.report.then(|| out.join(page::PAGE)));
    if let Some(file) = &file {
        let origin = Origin::now(folder, arguments.threads).of_page();
        let text =
            element_page(&document, &study, &origin).map_err(|error| Failure::Run(format!("{error:#}")))?;
        ensemble::replace_file(file, text.as_bytes())?;
    }
    let page = file.map(|file| format!(", with a page: {}", file.display())).unwrap_or_default();
    let text = format!("{}written to {}{page}\n{removed}", document.text(), out.display());
    Ok(Answer::of(text, &summary)?.in_place(&out))
}
