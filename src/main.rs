//! The `pirca` program: see [`pirca::cli`].

fn main() -> std::process::ExitCode {
    pirca::cli::main()
}
