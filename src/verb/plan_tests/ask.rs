//! Arguments and help of `plan-tests`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::Args;

use crate::verb::arguments::{Ensemble, OUTPUT, SOLUTION, STUDY, Which};
use crate::verb::question;

/// Of `plan-tests`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca plan-tests studies/tilting-table --specimens 3
         pirca plan-tests studies/tilting-table --specimens 3 --cov 0.052 --error-deg 0.25

The walls of each arm are simulated as `run` does. Real specimens scatter by what simulated walls do and by the error of the reading; \
--cov states another scatter. A difference is seen by Student's test of two groups of specimens built of different stones. Where the same \
stones are laid twice, the pairs correlate as simulated walls do, and fewer suffice. It writes plan-tests.json and plan-tests.csv.

",
    codes!()
);

/// Arguments of `plan-tests`.
#[derive(Args, Debug)]
pub(crate) struct PlanTests {
    #[command(flatten)]
    pub which: Which,
    /// Specimens of each arm that might be tested.
    #[arg(long, value_name = "N", value_parser = question::specimens, allow_negative_numbers = true, help_heading = "Tests")]
    pub specimens: usize,
    /// Coefficient of variation of real specimens, instead of that of simulated ones: 0.05 is 5 %.
    #[arg(long, value_name = "V", value_parser = question::variation, allow_negative_numbers = true, help_heading = "Tests")]
    pub cov: Option<f64>,
    /// Standard deviation of the error of an angle that is read (deg).
    #[arg(long, value_name = "DEG", default_value = "0.25", value_parser = question::level, allow_negative_numbers = true, help_heading = "Tests")]
    pub error_deg: f64,
    /// Standard deviation of the error of a displacement that is read (m).
    #[arg(long, value_name = "M", default_value = "0.0001", value_parser = question::level, allow_negative_numbers = true, help_heading = "Tests")]
    pub error_m: f64,
    /// Probability with which a difference is to be seen.
    #[arg(long, value_name = "P", default_value = "0.8", value_parser = question::confidence, allow_negative_numbers = true, help_heading = "Tests")]
    pub power: f64,
    /// Probability with which arms that are the same are not called different.
    #[arg(long, value_name = "P", default_value = "0.95", value_parser = question::confidence, allow_negative_numbers = true, help_heading = "Tests")]
    pub confidence: f64,
    /// Share of the true 5 % fractile that the characteristic value (EN 1990 D7.2) may lose in the mean.
    #[arg(long, value_name = "P", default_value = "0.05", value_parser = question::probability, allow_negative_numbers = true, help_heading = "Tests")]
    pub loss: f64,
    #[command(flatten)]
    pub ensemble: Ensemble,
    /// Number of the kn point at which walls are simulated, from 0.
    #[arg(long, value_name = "K", default_value_t = 0, help_heading = STUDY)]
    pub point: u32,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
    /// Output folder [default: runs/<study>-plan-tests, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the answer on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
}
