//! The arguments, as clap reads them; their docstrings are the help.

use std::num::NonZero;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

const CODES: &str = "Exit codes: 0 done; 1 the run or a file failed; 2 wrong arguments; 3 invalid study.";

/// Stochastic dry stone walls: generates them, solves them, and says how strong they are and how sure that is.
#[derive(Debug, Parser)]
#[command(name = "pirca", version, after_help = CODES)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Read a study and say everything that is wrong with it, without running it.
    #[command(after_help = format!("Example: pirca check studies/joint-arrangement\n\n{CODES}"))]
    Check(Check),
    /// Write the wall of one member to a file.
    #[command(after_help = format!(
        "Example: pirca generate studies/joint-arrangement --arm irregular --member 17 --out wall.vtu\n\n{CODES}\n\
         A member whose wall is an invalid geometry ends with 1 and the reason."
    ))]
    Generate(Generate),
    /// Generate and solve every wall of a study; write tables, statistics and figures. Resumes by itself.
    #[command(after_help = format!(
        "Example: pirca run studies/joint-arrangement --members 5 --out runs/first-try\n\n\
         Killed and started again with the same arguments, it goes on where it stood and ends with the same files.\n\
         A wall that falls or cannot be built is counted in the results; it is no error.\n\n{CODES}"
    ))]
    Run(Run),
}

/// Which study, in which reading.
#[derive(Args, Debug)]
pub(crate) struct Which {
    /// The study: its folder, or the study.toml in it.
    pub study: PathBuf,
    /// A named variant of the study.
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `check`.
#[derive(Args, Debug)]
pub(crate) struct Check {
    #[command(flatten)]
    pub which: Which,
    /// List every key that a study, its published.toml and a distribution may hold: what is allowed, default, meaning.
    #[arg(long, conflicts_with = "json")]
    pub keys: bool,
}

/// Arguments of `generate`.
#[derive(Args, Debug)]
pub(crate) struct Generate {
    #[command(flatten)]
    pub which: Which,
    /// Name of the arm; without it the first whose walls are random.
    #[arg(long, value_name = "ARM")]
    pub arm: Option<String>,
    /// Number of the kn point, from 0. The stones are the same at every point.
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub point: u32,
    /// Number of the member, from 0.
    #[arg(long, value_name = "M", default_value_t = 0)]
    pub member: u64,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Solve the wall as `run` does, and write the displacement of every stone's centroid (m) into the .vtu.
    #[arg(long)]
    pub solved: bool,
    /// File to write; its ending says the format: .vtu (ParaView), .obj or .json.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
}

/// Arguments of `run`.
#[derive(Args, Debug)]
pub(crate) struct Run {
    #[command(flatten)]
    pub which: Which,
    /// Output folder [default: runs/<study>, with -<variant> behind it if one is named].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of walls in every random arm, instead of the study's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub members: Option<u64>,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T")]
    pub threads: Option<NonZero<usize>>,
    /// Solver instead of the study's, with its defaults; the study's own settings if it is the study's own solver.
    #[arg(long, value_name = "NAME")]
    pub solver: Option<SolverName>,
}

/// The solvers by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SolverName {
    /// Central differences with local damping (DEM).
    Explicit,
    /// Newton's method from equilibrium to equilibrium.
    Implicit,
}
