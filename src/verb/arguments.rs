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

/// Declares a closed set of names for an argument: the value, its name, what it is.
macro_rules! names {
    ($(#[$about:meta])* $set:ident { $($(#[$what:meta])* $value:ident = $name:literal,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
        pub(crate) enum $set {
            $($(#[$what])* #[value(name = $name)] $value,)+
        }

        impl $set {
            /// The name as the user writes it.
            pub fn name(&self) -> &'static str {
                match self { $($set::$value => $name,)+ }
            }
        }
    };
}

pub(crate) use names;

names! {
    /// The solvers by name.
    SolverName {
        /// Limit analysis of rigid blocks.
        Limit = "limit",
        /// Elastic joints, equilibrium by Newton's method.
        Implicit = "implicit",
        /// Elastic joints, steps in time with damping (DEM).
        Explicit = "explicit",
        /// Rigid blocks, steps in time with Coulomb friction (contact dynamics).
        Nonsmooth = "nonsmooth",
    }
}

impl SolverName {
    /// What it is called in a sentence.
    pub fn method(self) -> &'static str {
        match self {
            SolverName::Limit => "limit analysis",
            SolverName::Implicit => "the implicit solver",
            SolverName::Explicit => "the explicit solver",
            SolverName::Nonsmooth => "contact dynamics",
        }
    }

    /// Whether joints have a stiffness.
    pub fn is_elastic(self) -> bool {
        match self {
            SolverName::Implicit | SolverName::Explicit => true,
            SolverName::Limit | SolverName::Nonsmooth => false,
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
