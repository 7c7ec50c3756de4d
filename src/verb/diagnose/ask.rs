//! Arguments and help of `diagnose`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::Args;

use crate::verb::arguments::{OUTPUT, SOLUTION, STUDY, Which};
use crate::verb::diagnose::bank::POINTS;

/// Of `diagnose`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca diagnose studies/tilting-table --measured my-tests.csv
         pirca diagnose studies/tilting-table --measured my-tests.csv --prepare

It writes verdict.json, figures as SVG and PNG (best-fit: the readings on the base model and on the best cause; one per family; \
residuals), with --report a page with all of it, report.html, and, for each \
cause of the verdict, the study extended by it: extended/<cause>. That is an ordinary study at the medians of what is not known, \
with draws from it as variants (run extended/<cause> --variant draw-07).

The walls it needs (the bank) are simulated once for a design, which takes minutes to hours; --prepare does that alone, and adds the \
self-test. They serve every measurement of one test programme. Every mechanism is simulated at many strengths, with joints that are known \
as badly as they are. A bank that was stopped goes on where it stood. More points later leave the first ones as they are, in another \
folder. The priors are in mechanism and nuisance of the distributions that the study takes.

What looks odd about the measurements \
(a value far beyond what is simulated, one specimen alone) is noted on standard error and judged all the same.

",
    codes!(),
    "\nEvery verdict (named, ambiguous, unexplained, nothing found) ends with 0."
);

/// Arguments of `diagnose`.
#[derive(Args, Debug)]
pub(crate) struct Diagnose {
    #[command(flatten)]
    pub which: Which,
    /// What was measured [default: the study's measured.csv].
    #[arg(long, value_name = "FILE", help_heading = STUDY)]
    pub measured: Option<PathBuf>,
    /// Folder of the bank [default: runs/<study>-bank, with -<variant> in it if one is named; else the bank beside the study].
    #[arg(long, value_name = "DIR", help_heading = SOLUTION)]
    pub bank: Option<PathBuf>,
    /// Points in the priors for each mechanism that the bank has; twice as many for the base model.
    #[arg(long, value_name = "N", default_value_t = POINTS, value_parser = clap::value_parser!(u64).range(10..=100_000), help_heading = SOLUTION)]
    pub points: u64,
    /// Simulate the walls of the bank and test it, and diagnose nothing.
    #[arg(long, conflicts_with_all = ["no_build", "no_gain", "law", "out", "report"], help_heading = SOLUTION)]
    pub prepare: bool,
    /// Simulated campaigns of each mechanism that the self-test of --prepare judges by all that a diagnosis does (seconds each), and five
    /// times as many with nothing hidden; 100 of each are judged by how they seem [default: 6].
    #[arg(long, value_name = "N", requires = "prepare", value_parser = clap::value_parser!(u64).range(0..=20), help_heading = SOLUTION)]
    pub judged: Option<u64>,
    /// Stop with the command to run, where there is no bank.
    #[arg(long, help_heading = SOLUTION)]
    pub no_build: bool,
    /// Do not measure what the extended model gains on readings held out: minutes on a large design.
    #[arg(long, help_heading = SOLUTION)]
    pub no_gain: bool,
    /// Learn a free law of the joints from the readings as well, whatever the verdict: minutes on the nine walls.
    #[arg(long, help_heading = SOLUTION)]
    pub law: bool,
    /// Output folder [default: runs/<study>-diagnosis, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the verdict on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
    /// Seed of the diagnosis or the self-test instead of the study's; the walls of the bank keep the study's.
    #[arg(long, value_name = "S", help_heading = STUDY)]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
}
