//! `pirca reference completions`: what a shell completes behind the name of the program.

use clap::{Args, Command};
use clap_complete::{Shell, generate};
use serde_json::json;

use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;

/// Of `reference completions`.
pub(super) const HELP: &str = concat!(
    "\
Example: pirca reference completions bash > ~/.local/share/bash-completion/completions/pirca
         pirca reference completions zsh > ~/.zfunc/_pirca
         pirca reference completions fish > ~/.config/fish/completions/pirca.fish

Zsh reads ~/.zfunc if ~/.zshrc has the line fpath+=~/.zfunc before compinit. New shells know the completions.

",
    codes!()
);

/// Arguments of `reference completions`.
#[derive(Args, Debug)]
pub(crate) struct Completions {
    /// The shell.
    pub shell: Shell,
}

/// Gives the script of a shell.
pub(super) fn completions(arguments: &Completions, mut command: Command) -> Result<Answer, Failure> {
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    generate(arguments.shell, &mut command, name, &mut script);
    let script = String::from_utf8_lossy(&script).into_owned();
    let object = json!({"shell": arguments.shell.to_string(), "script": script});
    Answer::verbatim(script, &object)
}
