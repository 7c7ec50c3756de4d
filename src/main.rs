//! The `pirca` program: see [`pirca::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(pirca::cli::main(std::env::args_os()))
}
