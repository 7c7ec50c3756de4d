//! Arguments and help of `sensitivity`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::Args;

use crate::ensemble::shard::Share;
use crate::verb::arguments::{OUTPUT, SOLUTION, STUDY, WALL, Which};
use crate::verb::question::points;
use crate::verb::share;

/// Of `sensitivity`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca sensitivity studies/tilting-block --points 64
         pirca sensitivity studies/tilting-table --arm sbl --points 128 --json

First order: the share of the variance that would go if the source were known. Total: the share that would be left if all others \
were known. They differ by interactions. Sources are independent of each other, as a study cannot state a correlation; so Shapley's \
shares lie between the two and are not given. Intervals are at 95 %, over 16 independent randomisations.

Walls without a value are counted; a base point that lacks one is left out of the shares that need it. It writes sensitivity.json, \
sensitivity.csv, sensitivity.parquet (every evaluation), sensitivity.svg and sensitivity.png. Stopped and started again, it goes on \
where it stood, with more --points as well unless the design is a Latin hypercube.

",
    codes!()
);

/// Arguments of `sensitivity`.
#[derive(Args, Debug)]
pub(crate) struct Sensitivity {
    #[command(flatten)]
    pub which: Which,
    /// Name of the arm; without it the first whose walls are random.
    #[arg(long, value_name = "ARM", help_heading = WALL)]
    pub arm: Option<String>,
    /// Number of the kn point, from 0.
    #[arg(long, value_name = "K", default_value_t = 0, help_heading = WALL)]
    pub point: u32,
    /// Base points, a multiple of 16; each costs two walls and one more for every source.
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = points, help_heading = STUDY)]
    pub points: u64,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S", help_heading = STUDY)]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
    /// Output folder [default: runs/<study>-sensitivity, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Evaluate the walls of one shard alone, I of N with I from 0, into a file of its own in the output folder: 3/64. When all have ended, the
    /// same command without --shard takes up their walls and answers.
    #[arg(long, value_name = "I/N", value_parser = share::parsed, conflicts_with = "report", help_heading = SOLUTION)]
    pub shard: Option<Share>,
    /// Write report.html into the output folder as well: the answer on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
}
