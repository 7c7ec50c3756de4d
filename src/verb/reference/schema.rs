//! `pirca reference schema`: the JSON Schema of an input file, for editors.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::Value;

use crate::ensemble::replace_file;
use crate::study;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::arguments::OUTPUT;

/// Of `reference schema`.
pub(super) const HELP: &str = concat!(
    "\
Example: pirca reference schema --out study.schema.json
         pirca reference schema --of published --out published.schema.json

Editors with taplo (in VS Code: Even Better TOML) take it from the first line of a study: #:schema ./study.schema.json. \
`pirca init` writes both. The schema is made from the table of keys that `pirca check` goes by; what needs more than one key, and the \
references to distributions, `check` alone sees.

",
    codes!()
);

/// Arguments of `reference schema`.
#[derive(Args, Debug)]
pub(crate) struct Schema {
    /// Which file it describes.
    #[arg(long, value_name = "FILE", default_value = "study")]
    pub of: Described,
    /// Write it to this file instead of standard output.
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
}

/// Files that have a schema.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Described {
    /// study.toml of walls.
    Study,
    /// study.toml of types of elements.
    ElementStudy,
    /// published.toml beside a study of walls.
    Published,
}

/// Gives the schema, or writes it to a file. The object of the answer is the schema.
pub(super) fn schema(arguments: &Schema) -> Result<Answer, Failure> {
    let schema = match arguments.of {
        Described::Study => study::Schema::Study,
        Described::ElementStudy => study::Schema::ElementStudy,
        Described::Published => study::Schema::Published,
    };
    let text = schema.text();
    let object = serde_json::from_str::<Value>(&text)
        .map_err(|error| Failure::Run(format!("the schema is no JSON: {error}")))?;
    let Some(path) = &arguments.out else { return Answer::verbatim(text, &object) };
    replace_file(path, text.as_bytes())?;
    Ok(Answer::of(format!("written to {}\n", path.display()), &object)?.in_place(path))
}
