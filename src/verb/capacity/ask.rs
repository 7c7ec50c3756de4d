//! Arguments and help of `capacity`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::Args;

use crate::verb::arguments::{Ensemble, OUTPUT, SOLUTION, STUDY, Which};
use crate::verb::capacity::rare::Method;
use crate::verb::question::Asked;
use crate::verb::{demand, question};

/// Of `capacity`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca capacity studies/tilting-table --members 100
         pirca capacity studies/tilting-table --below-deg 12
         pirca capacity studies/tilting-table --quantile 0.05 --half-width 0.1
         pirca capacity studies/tilting-block --variant restrained-ends --below-deg 20 --walls 4000 --cov 0.2
         pirca wall studies/tilting-block --variant restrained-ends --draw 0 --out wall.vtu
         pirca capacity studies/tilting-table --measured --known-cov 0.1

Without a question it seeks the value that 5 % of walls lie below. It writes capacity.json, probability.svg, .png and .csv beside the \
files of the walls, and evaluations.parquet of walls drawn for a rare level. Intervals are at 95 %. A wall that brings no value is \
counted, and the \
interval that holds whatever it would have borne is given too. Characteristic and design values are those of EN 1990 Annex D, \
computed and not read from its tables; the design value is undercut with a probability of 0.1 %.

",
    codes!()
);

/// Arguments of `capacity`.
#[derive(Args, Debug)]
pub(crate) struct Capacity {
    #[command(flatten)]
    pub which: Which,
    #[command(flatten)]
    pub question: Asked,
    /// Take the collapse angles of the specimens in measured.csv alone, and simulate nothing.
    #[arg(long, conflicts_with_all = ["members", "seed", "threads", "above_m", "below_n"], help_heading = STUDY)]
    pub measured: bool,
    /// Where fewer than ten walls are on the worse side of a level, evaluate up to so many more in each arm, by the method that is
    /// expected to take the fewest. With --half-width: most walls of an arm [default there: 1000].
    #[arg(long, value_name = "N", conflicts_with = "measured", value_parser = clap::value_parser!(u64).range(100..=10_000_000), help_heading = STUDY)]
    pub walls: Option<u64>,
    /// Add walls, up to --walls, until the coefficient of variation of a probability is no larger: 0.2 is 20 %.
    #[arg(long, value_name = "C", requires = "walls", value_parser = question::relative, allow_negative_numbers = true, help_heading = STUDY)]
    pub cov: Option<f64>,
    /// How further walls are drawn and counted [default: the one that is expected to take the fewest walls].
    #[arg(long, value_name = "NAME", requires = "walls", conflicts_with = "quantile", help_heading = STUDY)]
    pub method: Option<Method>,
    /// Write the further walls down as batches for `pirca shards run`, one after the other, and evaluate none of them here.
    #[arg(long, requires = "walls", conflicts_with_all = ["measured", "quantile", "half_width"], help_heading = STUDY)]
    pub batches: bool,
    /// Add walls, up to --walls, until half the width of a quantile's interval is below this share of the quantile.
    #[arg(long, value_name = "H", conflicts_with_all = ["measured", "members", "demand", "below_deg", "above_m", "below_n"], value_parser = question::relative, allow_negative_numbers = true, help_heading = STUDY)]
    pub half_width: Option<f64>,
    /// Exit with 4 unless the demand is met: the interval of the probability that a wall fails ends at SHARE or below, in every arm.
    #[arg(long, value_name = "SHARE", value_parser = demand::share, num_args = 0..=1, default_missing_value = demand::MAY_FAIL, require_equals = true, requires = "demand", help_heading = OUTPUT)]
    pub assert: Option<f64>,
    /// Coefficient of variation of such walls, where more than these walls tell it: 0.1 is 10 %.
    #[arg(long, value_name = "V", value_parser = question::variation, allow_negative_numbers = true, help_heading = STUDY)]
    pub known_cov: Option<f64>,
    #[command(flatten)]
    pub ensemble: Ensemble,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
    /// Output folder [default: runs/<study>-capacity, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the answer on a page.
    #[arg(long, conflicts_with = "measured", help_heading = OUTPUT)]
    pub report: bool,
}
