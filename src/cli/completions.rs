//! `pirca completions`: what a shell completes behind the name of the program.

use clap::CommandFactory;
use clap_complete::generate;
use serde_json::json;

use crate::cli::arguments::{Arguments, Completions};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;

/// Gives the script of a shell.
pub(crate) fn completions(arguments: &Completions) -> Result<Answer, Failure> {
    let mut command = Arguments::command();
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    generate(arguments.shell, &mut command, name, &mut script);
    let script = String::from_utf8_lossy(&script).into_owned();
    let object = json!({"shell": arguments.shell.to_string(), "script": script});
    Answer::verbatim(script, &object)
}
