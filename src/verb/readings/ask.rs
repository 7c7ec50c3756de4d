//! Arguments and help of `readings`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::Args;

use crate::verb::arguments::{Ensemble, OUTPUT, SOLUTION, STUDY};

/// Of `readings`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca readings studies/joint-arrangement
         pirca run studies/joint-arrangement --variant mean-size-varies+unequal-courses

A reading is the study with some of its variants, which must change different keys; variants of the solver are left out. Every \
reading is judged by the statements in published.toml. One that refutes two of them with its first walls at the ends of kn is \
dropped; the others are evaluated in full. It writes readings.csv, readings.json, readings.svg and readings.png.

",
    codes!()
);

/// Arguments of `readings`.
#[derive(Args, Debug)]
pub(crate) struct Readings {
    /// The study: its folder, or the study.toml in it.
    pub study: PathBuf,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
    /// Output folder [default: runs/<study>-readings].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the answer on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
    /// Most variants that are read together.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u64).range(1..=6), help_heading = STUDY)]
    pub departures: u64,
    #[command(flatten)]
    pub ensemble: Ensemble,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
}
