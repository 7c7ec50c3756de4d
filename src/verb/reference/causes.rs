//! `pirca reference causes`: the catalogue of what the base model leaves out.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;

use crate::study::{Described, described};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::reference::folder;

/// Of `reference causes`.
pub(super) const HELP: &str = concat!(
    "\
Example: pirca reference causes --json

A table [mechanism.creep] in a study, with its keys, switches creep on; [arm.mechanism.creep] does for one arm.

",
    codes!()
);

/// Arguments of `reference causes`.
#[derive(Args, Debug)]
pub(crate) struct Causes {
    /// Folder of the distributions, which holds the priors below `mechanism` [default: the nearest folder `distributions` here
    /// or further up, else what is built in].
    #[arg(long, value_name = "DIR")]
    pub distributions: Option<PathBuf>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long)]
    pub json: bool,
}

/// The catalogue.
pub(super) fn causes(arguments: &Causes) -> Result<Answer, Failure> {
    let distributions = folder(arguments.distributions.as_deref())?;
    let all = described(distributions).map_err(Failure::Input)?;
    let mut text = String::new();
    for mechanism in &all {
        describe(mechanism, &mut text);
    }
    Answer::of(text, &serde_json::json!({ "mechanisms": all }))
}

fn describe(mechanism: &Described, text: &mut String) {
    let _ = writeln!(text, "{}: {}", mechanism.name, mechanism.what);
    let _ = writeln!(text, "  would mean: {}", mechanism.means);
    let _ = writeln!(
        text,
        "  acts on: {}; when unloaded: {}; limit analysis: {}",
        mechanism.acts.words(),
        mechanism.unloading.words(),
        mechanism.limit_analysis.words()
    );
    let _ = writeln!(text, "  confounded with: {}", mechanism.confounded_with.join(", "));
    for p in &mechanism.parameters {
        let unit = if p.unit == "1" { String::new() } else { format!(" ({})", p.unit) };
        let default = p.default.map(|d| format!("; default {d}")).unwrap_or_default();
        let _ = writeln!(text, "  {}{unit}: {}{default}", p.key, p.meaning);
        let prior = serde_json::to_string(&p.prior).unwrap_or_default();
        let note = p.note.as_ref().map(|note| format!(" {note}")).unwrap_or_default();
        let _ = writeln!(text, "    prior ({}): {prior}; {}{note}", p.status, p.source);
        let search = serde_json::to_string(&p.search).unwrap_or_default();
        let _ = writeln!(text, "    a diagnosis searches: {search}");
    }
    text.push('\n');
}
