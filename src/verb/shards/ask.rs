//! The arguments of `shards`, as clap reads them; their docstrings are the help.

use std::num::NonZero;
use std::path::PathBuf;

use clap::{Args, Subcommand};

use crate::verb::arguments::{Ensemble, OUTPUT, SOLUTION, SolverName, Which};
use crate::verb::question;
use crate::verb::shards::Engine;

/// Of `shards`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca shards plan studies/arrangements --out runs/shared
         pirca shards run studies/arrangements --index 3 --of 64 --out runs/shared
         pirca shards status runs/shared
         pirca shards merge runs/shared

`pirca shards STEP --help` explains a step. Tables, statistics and figures are those that `pirca run` writes on one machine, byte for byte.

",
    codes!()
);

/// Of `shards plan`.
const PLAN: &str = concat!(
    "\
Example: pirca shards plan studies/arrangements --out runs/shared
         pirca shards plan studies/arrangements --script slurm --out runs/shared > shards.sh

",
    codes!()
);

/// Of `shards run`.
const RUN: &str = concat!(
    "\
Example: pirca shards run studies/arrangements --index 3 --of 64 --out runs/shared
         pirca shards run studies/tilting-table --bank --index 3 --of 64 --out runs/bank

Shard I of N has the walls whose place in the order of the results leaves I when divided by N. A shard that is complete is not computed \
again, a damaged one is; of one that was stopped the walls that had ended are taken over. Shards of another study, seed, version \
or N are never mixed: that is an error, and nothing is changed. A wall that fails is a row of the results and no error; an exit code \
other than 0 means that the shard is not complete.

",
    codes!()
);

/// Of `shards status`.
const STATUS: &str = concat!(
    "\
Example: pirca shards status runs/shared

What is missing is written as Slurm takes it: sbatch --array=$(pirca shards status runs/shared --json | jq -r .missing)

",
    codes!()
);

/// Of `shards merge`.
const MERGE: &str = concat!(
    "\
Example: pirca shards merge runs/shared
         pirca shards merge runs/shared --partial

Every line of every shard is checked on the way. Shards that are missing end it with their numbers, unless --partial says that some \
are enough. Memory does not grow with the load steps of the walls, unless the study compares with measurements or shears its walls.

",
    codes!()
);

/// Headings of options.
const SHARES: &str = "Shards";
const BANKS: &str = "Bank";

/// Arguments of `shards`.
#[derive(Args, Debug)]
#[command(subcommand_value_name = "STEP", subcommand_help_heading = "Steps", disable_help_subcommand = true)]
pub(crate) struct Shards {
    /// Which step.
    #[command(subcommand)]
    pub step: Step,
}

/// The steps, in their order.
#[derive(Debug, Subcommand)]
pub(crate) enum Step {
    /// Say how many shards are best, by timing some walls; or print the script that starts them.
    #[command(after_help = PLAN)]
    Plan(Plan),
    /// Compute one shard: any engine starts it, on any machine that sees the output folder.
    #[command(after_help = RUN)]
    Run(Run),
    /// Say which shards are complete, and which are missing.
    #[command(after_help = STATUS)]
    Status(Status),
    /// Put shards together: the files of a run on one machine.
    #[command(after_help = MERGE)]
    Merge(Merge),
}

impl Step {
    /// Whether the answer is asked for as an object.
    pub fn is_json(&self) -> bool {
        match self {
            Step::Plan(Plan { walls, .. }) | Step::Run(Run { walls, .. }) => walls.which.json,
            Step::Status(asked) => asked.json,
            Step::Merge(asked) => asked.json,
        }
    }
}

/// Arguments of `shards plan`.
#[derive(Args, Debug)]
pub(crate) struct Plan {
    #[command(flatten)]
    pub walls: Walls,
    /// Print the script of an engine, which starts the shards and puts them together.
    #[arg(long, value_name = "ENGINE", help_heading = SHARES)]
    pub script: Option<Engine>,
    /// Minutes that a shard takes on one processor.
    #[arg(long, value_name = "MIN", default_value_t = 20.0, value_parser = question::minutes, help_heading = SHARES)]
    pub minutes: f64,
    /// The number of shards, instead of the best one.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000), help_heading = SHARES)]
    pub of: Option<u32>,
}

/// Arguments of `shards run`.
#[derive(Args, Debug)]
pub(crate) struct Run {
    #[command(flatten)]
    pub walls: Walls,
    /// The number of the shard, from 0.
    #[arg(long, value_name = "I", help_heading = SHARES)]
    pub index: u32,
    /// The number of shards.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000), help_heading = SHARES)]
    pub of: u32,
}

/// Which walls are shared out, and where the shards lie.
#[derive(Args, Debug)]
pub(crate) struct Walls {
    #[command(flatten)]
    pub which: Which,
    /// Output folder, the same one for all shards, on a file system that all machines see; that of a batch is its own.
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub ensemble: Ensemble,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
    /// Solver instead of the study's, with its defaults; the study's own settings if it is the study's own solver.
    #[arg(long, value_name = "NAME", help_heading = SOLUTION)]
    pub solver: Option<SolverName>,
    /// The walls of `pirca diagnose --prepare`, in the place of the study's own.
    #[arg(long, help_heading = BANKS)]
    pub bank: bool,
    /// What was measured [default: the study's measured.csv].
    #[arg(long, value_name = "FILE", help_heading = BANKS)]
    pub measured: Option<PathBuf>,
    /// Points in the priors for each mechanism [default: 60].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(10..=100_000), help_heading = BANKS)]
    pub points: Option<u64>,
}

/// Arguments of `shards status`.
#[derive(Args, Debug)]
pub(crate) struct Status {
    /// The output folder of the shards.
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// Arguments of `shards merge`.
#[derive(Args, Debug)]
pub(crate) struct Merge {
    /// The output folder of the shards.
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Take the shards that are there; the summary says of how many walls it is.
    #[arg(long)]
    pub partial: bool,
    /// Folder of the study, where it is not where the first shard found it.
    #[arg(long, value_name = "STUDY")]
    pub study: Option<PathBuf>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}
