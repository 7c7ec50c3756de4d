//! `pirca report`: the page of a run, of a study or of a wall, and the pages that other verbs write with `--report`.

use std::fs;
use std::num::NonZero;
use std::path::Path;

use clap::Parser;
use serde_json::json;

use crate::cli::analyse::Analyse;
use crate::cli::answer::Answer;
use crate::cli::arguments::{Measure, Report, Run, Which};
use crate::cli::doing::doing;
use crate::cli::drawn::ending;
use crate::cli::failure::Failure;
use crate::cli::one_wall::OneWall;
use crate::cli::origin::Origin;
use crate::cli::{locate, picture, run};
use crate::ensemble::{self, Row, replace_file};
use crate::report::{DrawnWall, PageOrigin, RunPage, chosen_walls, run_page};
use crate::study::{Loaded, Study};

/// Name of the page in the output folder.
pub(crate) const PAGE: &str = "report.html";

/// Writes the page of a run that has ended, of a study, or of a wall.
pub(crate) fn report(arguments: &Report) -> Result<Answer, Failure> {
    let of = &arguments.of;
    let is_wall =
        of.extension().is_some_and(|end| ["json", "obj"].iter().any(|own| end.eq_ignore_ascii_case(own)));
    if is_wall {
        return of_wall(arguments);
    }
    if !arguments.asked.is_empty() {
        return Err(Failure::Usage(format!(
            "what stands behind -- is for a wall from a file (.json or .obj), and {} is none; leave it out",
            of.display()
        )));
    }
    // The folder of a run holds no study.toml.
    let is_study = of.join("study.toml").is_file() || of.file_name().is_some_and(|name| name == "study.toml");
    if is_study { of_study(arguments) } else { of_run(arguments) }
}

/// The page of a wall from a file, as `analyse --report` writes it.
fn of_wall(arguments: &Report) -> Result<Answer, Failure> {
    #[derive(Parser)]
    #[command(name = "pirca report WALL --", no_binary_name = true)]
    struct Asked {
        #[command(flatten)]
        analyse: Analyse,
    }
    let words = std::iter::once(arguments.of.clone().into_os_string()).chain(arguments.asked.clone());
    let Asked { analyse } = Asked::try_parse_from(words).map_err(|error| {
        let said = error.to_string();
        Failure::Usage(said.trim_start_matches("error: ").trim_end().to_owned())
    })?;
    let json = analyse.json || arguments.json;
    crate::cli::analyse::analyse(&Analyse { report: true, page: arguments.out.clone(), json, ..analyse })
}

/// The page of a study: it is run as far as it has not been.
fn of_study(arguments: &Report) -> Result<Answer, Failure> {
    if arguments.study.is_some() {
        return Err(Failure::Usage(
            "--study is for the folder of a run; a study names itself: leave it out".to_owned(),
        ));
    }
    let which = Which { study: arguments.of.clone(), variant: None, json: arguments.json };
    run::with_page(&Run::on_a_page(which), arguments.out.clone())
}

/// The page of a run that has ended.
fn of_run(arguments: &Report) -> Result<Answer, Failure> {
    let folder = &arguments.of;
    let manifest = ensemble::identity(folder)?;
    let origin = Origin::read(folder).unwrap_or_default();
    let place = locate::again(arguments.study.as_deref(), &origin.study, &manifest, folder)?;
    let (loaded, study) = locate::as_run(&place, &manifest)?;
    let rows = ensemble::finished(&study, folder)?;
    let study = ensemble::come_to(study, &rows);
    let page = arguments.out.clone().unwrap_or_else(|| folder.join(PAGE));
    write(&page, (&study, &loaded), &rows, &origin)?;
    let object = json!({
        "study": study.name, "variant": study.variant, "seed": study.seed, "study_hash": study.hash,
        "evaluations": rows.len(), "page": page.display().to_string(),
    });
    Ok(Answer::of(format!("written to {}\n", page.display()), &object)?.in_place(&page))
}

/// Writes the page of a run of a study, as it was run and as its files state it.
pub(crate) fn write(
    page: &Path,
    (study, loaded): (&Study, &Loaded),
    rows: &[Row],
    origin: &Origin,
) -> Result<(), Failure> {
    locate::one_number(study)?;
    let mut drawn = Vec::new();
    for (which, task) in chosen_walls(study, rows) {
        let kn = study.arms[task.arm as usize].kn_points[task.point as usize];
        let wall = OneWall::at(study.clone(), task, kn)?;
        let (run, replay) =
            doing(&format!("drawing the {which} wall"), |doing| wall.replayed(&|level| doing.at(level)));
        let picture = picture::of_wall(&wall, &run, Measure::Opening, None);
        drawn.push(DrawnWall { which, task, picture, replay, ending: ending(&run) });
    }
    let text = run_page(&RunPage { study, loaded, rows, drawn: &drawn, origin: &origin.of_page() })
        .map_err(|error| Failure::Run(format!("{error:#}")))?;
    Ok(replace_file(page, text.as_bytes())?)
}

/// Writes the page of an answer beside its files, if it is asked for; else takes away that of an earlier answer, which would be taken
/// for this one's.
pub(crate) fn beside(
    out: &Path,
    (is_asked, which, threads): (bool, &Which, Option<NonZero<usize>>),
    page: impl FnOnce(&PageOrigin) -> anyhow::Result<String>,
) -> Result<(), Failure> {
    let file = out.join(PAGE);
    if !is_asked {
        return match fs::remove_file(&file) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(Failure::Run(format!("{}: {error}", file.display())))
            }
            _ => Ok(()),
        };
    }
    let origin = Origin::now(&locate::folder(&which.study)?, threads).of_page();
    let text = page(&origin).map_err(|error| Failure::Run(format!("{error:#}")))?;
    Ok(replace_file(&file, text.as_bytes())?)
}
