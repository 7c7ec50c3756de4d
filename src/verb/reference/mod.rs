//! `pirca reference`: what is looked up and needs no study: keys, columns, causes, and files for editors and shells.

mod causes;
mod completions;
mod man;
mod priors;
mod schema;

use std::path::Path;

use clap::{Args, Command, Subcommand};
use serde_json::json;

use crate::ensemble::column_reference;
use crate::study::{Distributions, key_reference};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;

/// Of `reference`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca reference keys
         pirca reference causes --json
         pirca reference schema --out study.schema.json
         pirca reference completions bash > ~/.local/share/bash-completion/completions/pirca

`pirca reference WHAT --help` explains each.

",
    codes!()
);

/// Of `reference keys` and `reference columns`.
const LIST: &str = concat!("Example: pirca reference keys\n         pirca reference columns\n\n", codes!());

/// Arguments of `reference`.
#[derive(Args, Debug)]
#[command(subcommand_value_name = "WHAT", subcommand_help_heading = "What", disable_help_subcommand = true)]
pub(crate) struct Reference {
    /// What is looked up.
    #[command(subcommand)]
    pub what: What,
}

/// What may be looked up.
#[derive(Debug, Subcommand)]
pub(crate) enum What {
    /// List every key of a study, its published.toml and its distributions: what it may be, default, meaning.
    #[command(after_help = LIST)]
    Keys,
    /// List every column of the tables of a run: name, unit, meaning.
    #[command(after_help = LIST)]
    Columns,
    /// List the causes that a diagnosis looks for: what the model leaves out (creep, rounded edges, ...).
    ///
    /// What each one is, where it acts, its parameters with their priors, whether its effect goes when the wall is unloaded,
    /// what it is confounded with, and whether limit analysis honours it.
    #[command(after_help = causes::HELP)]
    Causes(causes::Causes),
    /// List what is known of stones and joints: friction, stiffness, density, sizes, with their sources.
    #[command(after_help = priors::HELP)]
    Priors(priors::Priors),
    /// Print the JSON Schema of a study, for editors.
    ///
    /// An editor that knows it completes keys, shows what each means, and marks what is wrong while a study is written.
    #[command(after_help = schema::HELP)]
    Schema(schema::Schema),
    /// Print the completions of a shell.
    ///
    /// Bash, zsh, fish, PowerShell and Elvish complete verbs, options and their values.
    #[command(after_help = completions::HELP)]
    Completions(completions::Completions),
    /// Write the manual pages of all verbs, for man.
    #[command(after_help = man::HELP)]
    Man(man::Man),
}

impl What {
    /// Whether the answer is asked for as an object.
    pub fn is_json(&self) -> bool {
        match self {
            What::Causes(asked) => asked.json,
            What::Priors(asked) => asked.json,
            _ => false,
        }
    }
}

/// Gives what is looked up; the command is that of the whole program.
pub(crate) fn reference(arguments: &Reference, command: Command) -> Result<Answer, Failure> {
    match &arguments.what {
        What::Keys => listed(key_reference()),
        What::Columns => listed(column_reference()),
        What::Causes(asked) => causes::causes(asked),
        What::Priors(asked) => priors::priors(asked),
        What::Schema(asked) => schema::schema(asked),
        What::Completions(asked) => completions::completions(asked, command),
        What::Man(asked) => man::man(asked, command),
    }
}

/// The distributions in a folder, or the nearest ones.
fn folder(asked: Option<&Path>) -> Result<Distributions, Failure> {
    match asked {
        Some(folder) if !folder.is_dir() => Err(Failure::Input(format!(
            "--distributions {}: there is no such folder; leave it out for those of the nearest folder `distributions`, or else for \
             those that are built in",
            folder.display()
        ))),
        Some(folder) => Ok(Distributions::only_in(folder)),
        None => Ok(Distributions::of_study(Path::new("."))),
    }
}

fn listed(text: String) -> Result<Answer, Failure> {
    let object = json!({ "text": &text });
    Answer::verbatim(text, &object)
}
