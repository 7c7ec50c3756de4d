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

It writes verdict.json, figures as SVG and PNG (best-fit: the readings on the base model and on the best cause; one per family; \
residuals), with --report a page with all of it, report.html, and, for each \
cause of the verdict, the study extended by it: extended/<cause>. That is an ordinary study at the medians of what is not known, \
with draws from it as variants (run extended/<cause> --variant draw-07).

The walls it needs are simulated once for a design, which takes minutes to hours; see bank. What looks odd about the measurements \
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
    /// Points in the priors for each mechanism that the bank has.
    #[arg(long, value_name = "N", default_value_t = POINTS, value_parser = clap::value_parser!(u64).range(10..=100_000), help_heading = SOLUTION)]
    pub points: u64,
    /// Stop with the command to run, where there is no bank.
    #[arg(long, help_heading = SOLUTION)]
    pub no_build: bool,
    /// Do not measure what the extended model gains on readings held out: minutes on a large design.
    #[arg(long, help_heading = SOLUTION)]
    pub no_gain: bool,
    /// Where the verdict is unexplained, learn a free law of the joints from the readings: half an hour on the nine walls.
    #[arg(long, help_heading = SOLUTION)]
    pub law: bool,
    /// Output folder [default: runs/<study>-diagnosis, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the verdict on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
    /// Seed of the diagnosis instead of the study's; the bank keeps the study's.
    #[arg(long, value_name = "S", help_heading = STUDY)]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
}
