//! The arguments of `shard`, `status` and `merge`, as clap reads them; their docstrings are the help.

use std::num::NonZero;
use std::path::PathBuf;

use clap::{ArgGroup, Args};

use crate::verb::arguments::{Ensemble, OUTPUT, SOLUTION, SolverName, Which};
use crate::verb::question;
use crate::verb::shard::Engine;

/// Of `shard`.
pub(crate) const SHARD: &str = concat!(
    "\
Example: pirca shard studies/arrangements --plan --out runs/shared
         pirca shard studies/arrangements --plan slurm --out runs/shared > shards.sh
         pirca shard studies/arrangements --index 3 --of 64 --out runs/shared
         pirca shard studies/tilting-table --bank --index 3 --of 64 --out runs/bank

Shard I of N has the walls whose place in the order of the results leaves I when divided by N. A shard that is complete is not computed \
again, a damaged one is; of one that was stopped the walls that had ended are taken over. Shards of another study, seed, version \
or N are never mixed: that is an error, and nothing is changed. A wall that fails is a row of the results and no error; an exit code \
other than 0 means that the shard is not complete.

",
    codes!()
);

/// Of `status`.
pub(crate) const STATUS: &str = concat!(
    "\
Example: pirca status runs/shared

What is missing is written as Slurm takes it: sbatch --array=$(pirca status runs/shared --json | jq -r .missing)

",
    codes!()
);

/// Of `merge`.
pub(crate) const MERGE: &str = concat!(
    "\
Example: pirca merge runs/shared
         pirca merge runs/shared --partial

Every line of every shard is checked on the way. Shards that are missing end it with their numbers, unless --partial says that some \
are enough. Memory does not grow with the load steps of the walls, unless the study compares with measurements or shears its walls.

",
    codes!()
);

/// Headings of options.
const SHARES: &str = "Shards";
const BANKS: &str = "Bank";

/// Arguments of `shard`.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("what").required(true).args(["plan", "index"]))]
pub(crate) struct Shard {
    #[command(flatten)]
    pub which: Which,
    /// Say how many shards there are best and what they take, by timing some walls; or print the script of an engine.
    #[arg(long, value_name = "ENGINE", num_args = 0..=1, help_heading = SHARES)]
    pub plan: Option<Option<Engine>>,
    /// Minutes that a shard of a plan takes on one processor.
    #[arg(long, value_name = "MIN", default_value_t = 20.0, value_parser = question::minutes, conflicts_with = "index", help_heading = SHARES)]
    pub minutes: f64,
    /// Compute the shard of this number, from 0.
    #[arg(long, value_name = "I", requires = "of", help_heading = SHARES)]
    pub index: Option<u32>,
    /// The number of shards.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000), help_heading = SHARES)]
    pub of: Option<u32>,
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
    /// The walls of `pirca bank`, in the place of the study's own.
    #[arg(long, help_heading = BANKS)]
    pub bank: bool,
    /// What was measured [default: the study's measured.csv].
    #[arg(long, value_name = "FILE", help_heading = BANKS)]
    pub measured: Option<PathBuf>,
    /// Points in the priors for each mechanism [default: 60].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(10..=100_000), help_heading = BANKS)]
    pub points: Option<u64>,
}

/// Arguments of `status`.
#[derive(Args, Debug)]
pub(crate) struct Status {
    /// The output folder of the shards.
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// Arguments of `merge`.
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
