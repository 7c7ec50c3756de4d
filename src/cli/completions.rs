//! `pirca completions`: what a shell completes behind the name of the program.

use clap::CommandFactory;
use clap_complete::generate;

use crate::cli::arguments::{Arguments, Completions};
use crate::terminal::failure::Failure;
use crate::terminal::output;

/// Prints the script of a shell.
pub(crate) fn completions(arguments: &Completions) -> Result<(), Failure> {
    let mut command = Arguments::command();
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    generate(arguments.shell, &mut command, name, &mut script);
    output::print_as_it_is(&String::from_utf8_lossy(&script))
}
