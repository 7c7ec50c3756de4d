//! Arguments and help of `detectability`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::Args;

use crate::verb::arguments::{OUTPUT, SOLUTION, STUDY, Which};
use crate::verb::detectability::work::quantile;

/// Of `detectability`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca detectability studies/tilting-table --members 3 --out runs/detectability

It writes detectability.csv, detectability.json, detectability.svg and detectability.png. The strength of each mechanism comes from the \
priors in mechanism of the distributions that the study takes.

",
    codes!()
);

/// Arguments of `detectability`.
#[derive(Args, Debug)]
pub(crate) struct Detectability {
    #[command(flatten)]
    pub which: Which,
    /// Output folder [default: runs/<study>-detectability, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the answer on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
    /// Number of walls in every arm that was measured.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u64).range(1..=10_000), help_heading = STUDY)]
    pub members: u64,
    /// Quantile of the priors, counted from the end at which a mechanism is weak; 0.5 is the median.
    #[arg(long, value_name = "Q", default_value = "0.84", value_parser = quantile, allow_negative_numbers = true, help_heading = STUDY)]
    pub quantile: f64,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
}
