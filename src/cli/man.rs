//! `pirca man`: the pages of the program and of its verbs for the command `man`.

use clap::CommandFactory;
use clap_mangen::generate_to;
use serde_json::json;

use crate::cli::arguments::{Arguments, Man};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::output;

/// Writes the pages.
pub(crate) fn man(arguments: &Man) -> Result<Answer, Failure> {
    let folder = &arguments.out;
    output::folder(folder)?;
    let command = Arguments::command();
    let pages = 1 + command.get_subcommands().count();
    generate_to(command, folder)
        .map_err(|error| Failure::Run(format!("cannot write the pages to {}: {error}", folder.display())))?;
    let text = format!("{pages} pages written to {0}: man {0}/pirca.1\n", folder.display());
    Ok(Answer::of(text, &json!({"pages": pages}))?.in_place(folder))
}
