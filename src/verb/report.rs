//! `pirca report`: the page of a run, of a study or of a wall, and how to cite a run.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{Args, Parser};
use serde_json::json;

use crate::ensemble;
use crate::exchange::Format;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::analyse::Analyse;
use crate::verb::arguments::{OUTPUT, STUDY, Which};
use crate::verb::locate;
use crate::verb::run::answer::page::citation_of_run;
use crate::verb::run::ask::Run;
use crate::verb::run::origin::Origin;
use crate::verb::run::{page, work as run};

/// Of `report`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca run studies/tilting-block --out runs/first
         pirca report runs/first
         pirca report runs/first --out for-a-colleague.html
         pirca report runs/first --bibtex >> references.bib
         pirca report studies/tilting-block
         pirca report wall.json -- --phi-deg 35

Walls of a study that are not solved yet are solved first. For a finished run the study must be unchanged. The walls that are drawn are \
solved again; no other wall is. `pirca run --report` writes the same page at the end of a run.

--cite says how to cite a run: whoever runs that version on a study of that hash with that seed gets the same walls. The run must be of \
this version of pirca.

",
    codes!()
);

/// Heading of the options that give a citation.
const CITATION: &str = "Citation";

/// Arguments of `report`.
#[derive(Args, Debug)]
pub(crate) struct Report {
    /// The output folder of a run, a study (its folder or its study.toml, which is run as far as it has not been), or a wall from a file.
    #[arg(value_name = "RUN|STUDY|WALL")]
    pub of: PathBuf,
    /// Folder of the study that was run [default: where it was run from, else studies/<study>].
    #[arg(long, value_name = "STUDY", help_heading = STUDY)]
    pub study: Option<PathBuf>,
    /// File to write [default: report.html in the folder of the run; of a wall <wall>-report.html here].
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write no page: say how to cite the run (version, study, seed and hash).
    #[arg(long, conflicts_with_all = ["study", "out", "asked"], help_heading = CITATION)]
    pub cite: bool,
    /// Write no page: print an entry for BibTeX.
    #[arg(long, conflicts_with_all = ["cite", "study", "out", "asked", "json"], help_heading = CITATION)]
    pub bibtex: bool,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
    /// Of a wall, behind --: what is asked of it, as of analyse, for example -- --phi-deg 35.
    #[arg(last = true, value_name = "OPTIONS OF ANALYSE")]
    pub asked: Vec<OsString>,
}

/// Writes the page of a run that has ended, of a study, or of a wall.
pub(crate) fn report(arguments: &Report) -> Result<Answer, Failure> {
    let of = &arguments.of;
    not_of_elements(of)?;
    if arguments.cite || arguments.bibtex {
        return cite(arguments);
    }
    if Format::of(&of.display().to_string()).is_some() {
        return of_wall(arguments);
    }
    if !arguments.asked.is_empty() {
        return Err(Failure::Usage(format!(
            "what stands behind -- is for a wall from a file, and {} is none; leave it out",
            of.display()
        )));
    }
    // The folder of a run holds no study.toml.
    let is_study = of.join("study.toml").is_file() || of.file_name().is_some_and(|name| name == "study.toml");
    if is_study { of_study(arguments) } else { of_run(arguments) }
}

/// A run of element types has its page from its study, which goes on from what is there; it has no manifest to cite.
fn not_of_elements(folder: &Path) -> Result<(), Failure> {
    if !folder.join(ensemble::ELEMENTS_CSV).is_file() {
        return Ok(());
    }
    let why = "holds a run of element types; give its study: pirca report STUDY writes the page and shoves no assembly again";
    Err(Failure::Input(format!("{}: {why}", folder.display())))
}

/// The reference of a run.
fn cite(arguments: &Report) -> Result<Answer, Failure> {
    let run = ensemble::identity(&arguments.of)?;
    let citation = citation_of_run(&run);
    let object = json!({
        "version": run.version, "study": run.study, "variant": run.variant, "seed": run.seed, "study_hash": run.study_hash,
        "text": citation.words, "bibtex": citation.bibtex,
    });
    let text = if arguments.bibtex { citation.bibtex } else { citation.words };
    Answer::verbatim(format!("{text}\n"), &object)
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
    crate::verb::analyse::analyse(&Analyse { report: true, page: arguments.out.clone(), json, ..analyse })
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
    let file = arguments.out.clone().unwrap_or_else(|| folder.join(page::PAGE));
    page::write(&file, (&study, &loaded), &rows, &origin)?;
    let object = json!({
        "study": study.name, "variant": study.variant, "seed": study.seed, "study_hash": study.hash,
        "evaluations": rows.len(), "page": file.display().to_string(),
    });
    Ok(Answer::of(format!("written to {}\n", file.display()), &object)?.in_place(&file))
}
