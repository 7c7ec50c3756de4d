//! Arguments that several verbs share: which study, another ensemble than its own, the headings of options.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// Headings of the options that several verbs share.
pub(crate) const STUDY: &str = "Study";
pub(crate) const WALL: &str = "Wall";
pub(crate) const SOLUTION: &str = "Solution";
pub(crate) const OUTPUT: &str = "Output";
pub(crate) const JOINTS: &str = "Joints";
pub(crate) const LOAD: &str = "Load";
pub(crate) const FILE: &str = "File";

/// Which study, in which reading.
#[derive(Args, Debug)]
pub(crate) struct Which {
    /// The study: its folder, or the study.toml in it.
    pub study: PathBuf,
    /// A named variant of the study (`pirca check` lists them), or a key with another value: joint.phi_deg=32, arm.random.members=5.
    /// Several are joined by +.
    #[arg(long, value_name = "NAME", help_heading = STUDY)]
    pub variant: Option<String>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// Another ensemble than the study's.
#[derive(Args, Debug)]
pub(crate) struct Ensemble {
    /// Number of walls in every random arm, instead of the study's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000), help_heading = STUDY)]
    pub members: Option<u64>,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S", help_heading = STUDY)]
    pub seed: Option<u64>,
}

/// The solvers by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SolverName {
    /// Central differences with local damping (DEM).
    Explicit,
    /// Newton's method from equilibrium to equilibrium.
    Implicit,
    /// Contact dynamics of rigid blocks with Coulomb friction.
    Nonsmooth,
    /// Limit analysis of rigid blocks: the collapse load alone.
    Limit,
}

impl SolverName {
    /// Its name in studies.
    pub fn name(self) -> &'static str {
        match self {
            SolverName::Explicit => "explicit",
            SolverName::Implicit => "implicit",
            SolverName::Nonsmooth => "nonsmooth",
            SolverName::Limit => "limit",
        }
    }
}

/// An argument as a shell takes it.
pub(crate) fn quoted(argument: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=+,:".contains(c);
    match !argument.is_empty() && argument.chars().all(plain) {
        true => argument.to_owned(),
        false => format!("'{}'", argument.replace('\'', "'\\''")),
    }
}
