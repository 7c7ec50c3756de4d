//! Arguments and help of `compare`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::Args;

use crate::verb::arguments::{OUTPUT, SOLUTION, STUDY, Which};
use crate::verb::question;
use crate::verb::question::Asked;

/// Of `compare`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca compare studies/arrangements
         pirca compare studies/arrangements --arms continuous,irregular --same-within-deg 0.1 --walls 2000
         pirca compare studies/tilting-table --arms sbl,sbr --below-deg 14

Without a question it compares means. It writes compare.json, compare.csv, a figure of the differences (compare.svg, compare.png), the \
distributions (distributions.csv, .svg, .png) and the files of the walls. Intervals hold together and at every number of walls, so \
that looking early costs nothing. Stopped and started again it goes on where it stood; with more --walls it goes on from there.

",
    codes!(),
    "\nAn answer, \"the same\" and \"not decided\" all end with 0."
);

/// Arguments of `compare`.
#[derive(Args, Debug)]
pub(crate) struct Compare {
    #[command(flatten)]
    pub which: Which,
    #[command(flatten)]
    pub question: Asked,
    /// The arms to compare, with commas between them [default: all].
    #[arg(long, value_name = "ARMS", value_delimiter = ',', help_heading = STUDY)]
    pub arms: Vec<String>,
    /// Number of the kn point at which they are compared, from 0.
    #[arg(long, value_name = "K", default_value_t = 0, help_heading = STUDY)]
    pub point: u32,
    /// Probability with which all that is said of differences holds together.
    #[arg(long, value_name = "P", default_value = "0.95", value_parser = question::confidence, allow_negative_numbers = true, help_heading = "Answer")]
    pub confidence: f64,
    /// Most walls that are evaluated, in all arms together.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(20..=10_000_000), help_heading = "Answer")]
    pub walls: u64,
    #[command(flatten)]
    pub same_within: SameWithin,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S", help_heading = STUDY)]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
    /// Output folder [default: runs/<study>-compare, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the comparison on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
}

/// Which differences do not matter.
#[derive(Args, Debug)]
#[group(multiple = false)]
#[command(next_help_heading = "Answer")]
pub(crate) struct SameWithin {
    /// Collapse angles that differ by less are the same (deg) [default: 0.25].
    #[arg(long, value_name = "DEG", value_parser = question::level, allow_negative_numbers = true)]
    pub same_within_deg: Option<f64>,
    /// Displacements that differ by less are the same (m) [default: 0.0001].
    #[arg(long, value_name = "M", value_parser = question::level, allow_negative_numbers = true)]
    pub same_within_m: Option<f64>,
    /// Shear capacities that differ by less are the same (N) [default: 1000].
    #[arg(long, value_name = "N", value_parser = question::level, allow_negative_numbers = true)]
    pub same_within_n: Option<f64>,
    /// Probabilities that differ by less are the same, where a level is asked for [default: 0.05].
    #[arg(long, value_name = "P", value_parser = question::probability, allow_negative_numbers = true)]
    pub same_within_share: Option<f64>,
}
