//! `pirca reference man`: the pages of the program and of its verbs for the command `man`.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_mangen::generate_to;
use serde_json::json;

use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::output;

/// Of `reference man`.
pub(super) const HELP: &str = concat!(
    "\
Example: pirca reference man --out ~/.local/share/man/man1
         man pirca-run

",
    codes!()
);

/// Arguments of `reference man`.
#[derive(Args, Debug)]
pub(crate) struct Man {
    /// Folder of the pages: pirca.1, pirca-run.1, pirca-shards-plan.1 and so on.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Writes the pages.
pub(super) fn man(arguments: &Man, command: Command) -> Result<Answer, Failure> {
    let folder = &arguments.out;
    output::folder(folder)?;
    let pages = count(&command);
    generate_to(command, folder)
        .map_err(|error| Failure::Run(format!("cannot write the pages to {}: {error}", folder.display())))?;
    let text = format!("{pages} pages written to {0}: man {0}/pirca.1\n", folder.display());
    Ok(Answer::of(text, &json!({"pages": pages}))?.in_place(folder))
}

/// Pages of a command and of all below it.
fn count(command: &Command) -> usize {
    1 + command.get_subcommands().map(count).sum::<usize>()
}
