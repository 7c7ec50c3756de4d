//! `pirca cite`: how to cite a run.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::ensemble;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::arguments::OUTPUT;
use crate::verb::run::answer::page::citation_of_run;

/// Of `cite`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca cite runs/tilting-block
         pirca cite runs/tilting-block --bibtex >> references.bib

Whoever runs that version on a study of that hash with that seed gets the same walls. The run must be of this version of pirca.

",
    codes!()
);

/// Arguments of `cite`.
#[derive(Args, Debug)]
pub(crate) struct Cite {
    /// The output folder of the run.
    pub run: PathBuf,
    /// Print an entry for BibTeX.
    #[arg(long, help_heading = OUTPUT)]
    pub bibtex: bool,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT, conflicts_with = "bibtex")]
    pub json: bool,
}

/// Says the reference.
pub(crate) fn cite(arguments: &Cite) -> Result<Answer, Failure> {
    let run = ensemble::identity(&arguments.run)?;
    let citation = citation_of_run(&run);
    let object = json!({
        "version": run.version, "study": run.study, "variant": run.variant, "seed": run.seed, "study_hash": run.study_hash,
        "text": citation.words, "bibtex": citation.bibtex,
    });
    let text = if arguments.bibtex { citation.bibtex } else { citation.words };
    Answer::verbatim(format!("{text}\n"), &object)
}
