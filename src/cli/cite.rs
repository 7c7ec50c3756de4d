//! `pirca cite`: how to cite a run.

use serde_json::json;

use crate::cli::arguments::Cite;
use crate::cli::failure::Failure;
use crate::cli::output;
use crate::ensemble;
use crate::report::citation_of_run;

/// Prints the reference.
pub(crate) fn cite(arguments: &Cite) -> Result<(), Failure> {
    let run = ensemble::identity(&arguments.run)?;
    let citation = citation_of_run(&run);
    if arguments.json {
        return output::print_json(&json!({
            "version": run.version, "study": run.study, "variant": run.variant, "seed": run.seed, "study_hash": run.study_hash,
            "text": citation.words, "bibtex": citation.bibtex,
        }));
    }
    let text = if arguments.bibtex { citation.bibtex } else { citation.words };
    output::print_as_it_is(&format!("{text}\n"))
}
