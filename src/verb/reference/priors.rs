//! `pirca reference priors`: what is known of stones and joints where nobody measured them, with its sources.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;

use crate::study::{DistributionFile, read_distributions};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::reference::folder;

/// Of `reference priors`.
pub(super) const HELP: &str = concat!(
    "\
Example: pirca reference priors
         pirca reference priors joint --json

A study takes an entry by its name: phi_deg = \"joint/friction:limestone\". Where nothing is stated, analyse takes the range of all \
entries.

",
    codes!()
);

/// Arguments of `reference priors`.
#[derive(Args, Debug)]
pub(crate) struct Priors {
    /// Files whose names begin so: joint, block/density [default: joint and block].
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// Folder of the distributions [default: the nearest folder `distributions` here or further up, else what is built in].
    #[arg(long, value_name = "DIR")]
    pub distributions: Option<PathBuf>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long)]
    pub json: bool,
}

/// Files that are listed where none is named: of what walls are made of.
const LISTED: [&str; 2] = ["joint", "block"];

/// The distributions.
pub(super) fn priors(arguments: &Priors) -> Result<Answer, Failure> {
    let distributions = folder(arguments.distributions.as_deref())?;
    let usual = LISTED.map(str::to_owned);
    let asked = if arguments.names.is_empty() { &usual[..] } else { &arguments.names[..] };
    let all = distributions.names();
    let is_of = |name: &String, asked: &String| name == asked || name.starts_with(&format!("{asked}/"));
    if let Some(nothing) = asked.iter().find(|asked| !all.iter().any(|name| is_of(name, asked))) {
        let allowed = all.join(", ");
        return Err(Failure::Usage(format!(
            "{nothing}: there are no such distributions; allowed is {allowed}"
        )));
    }
    let names: Vec<&String> =
        all.iter().filter(|name| asked.iter().any(|asked| is_of(name, asked))).collect();
    let files = read_distributions(&distributions, &names)?;
    let mut text = String::new();
    for (name, file) in &files {
        describe(name, file, &mut text);
    }
    Answer::of(text, &object(&files))
}

fn describe(name: &str, file: &DistributionFile, text: &mut String) {
    let unit = if file.unit == "1" { String::new() } else { format!(" ({})", file.unit) };
    let _ = writeln!(text, "{name}: {}, {}{unit}", file.quantity, file.symbol);
    for (entry, own) in &file.entries {
        let _ = writeln!(text, "  {entry}: {}; {}, {}", own.words(), own.status, own.source);
        if let Some(note) = &own.note {
            let _ = writeln!(text, "    {note}");
        }
    }
    text.push('\n');
}

fn object(files: &BTreeMap<String, DistributionFile>) -> serde_json::Value {
    let file = |file: &DistributionFile| {
        let entries = file.entries.iter().map(|(name, own)| {
            let entry = serde_json::json!({
                "family": own.family,
                "status": own.status,
                "source": own.source,
                "n": own.n,
                "note": own.note,
            });
            (name.clone(), entry)
        });
        let entries: serde_json::Map<String, serde_json::Value> = entries.collect();
        serde_json::json!({ "quantity": file.quantity, "symbol": file.symbol, "unit": file.unit, "entries": entries })
    };
    let files: serde_json::Map<String, serde_json::Value> =
        files.iter().map(|(name, own)| (name.clone(), file(own))).collect();
    serde_json::json!({ "priors": files })
}
