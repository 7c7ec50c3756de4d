//! Arguments and help of `run`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::Args;

use crate::verb::arguments::{Ensemble, OUTPUT, SOLUTION, SolverName, Which};
use crate::verb::demand::DemandOptions;

/// Of `run`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca run studies/joint-arrangement --members 5 --out runs/first-try
         pirca run studies/joint-arrangement --beside runs/explicit --out runs/both
         pirca run studies/tilting-table --demand 0.15g

Stopped and started again with the same arguments, it goes on where it stood and ends with the same files. With more members, \
another stiffness or another arm in the same folder it computes only what is new, and says what it takes over. A wall that falls or \
cannot be built is counted in the results; it is no error.

",
    codes!()
);

/// Arguments of `run`.
#[derive(Args, Debug)]
pub(crate) struct Run {
    #[command(flatten)]
    pub which: Which,
    /// Output folder [default: runs/<study>, with -<variant> behind it if one is named].
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
    /// Output folder of an earlier run of the same study, whose means are drawn into the figure as hollow markers.
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub beside: Option<PathBuf>,
    #[command(flatten)]
    pub demanded: DemandOptions,
    /// Write report.html into the output folder as well: the run on a page, as `report` does.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
    /// Write members.csv and steps.csv into the output folder as well: the tables for a spreadsheet.
    #[arg(long, help_heading = OUTPUT)]
    pub csv: bool,
}

impl Run {
    /// A study as it is, with nothing asked for in the place of its own, and its page.
    pub fn on_a_page(which: Which) -> Run {
        let ensemble = Ensemble { members: None, seed: None };
        Run {
            which,
            out: None,
            ensemble,
            threads: None,
            solver: None,
            beside: None,
            demanded: DemandOptions::default(),
            csv: false,
            report: true,
        }
    }
}
