//! The arguments, as clap reads them; their docstrings are the help. What frames the help is in `help`.

use clap::{Parser, Subcommand};

use crate::cli::help::WHOLE;
use crate::verb::{
    analyse, capacity, check, compare, detectability, diagnose, homogenise, init, plan_tests, readings,
    reference, report, run, sensitivity, shards, wall,
};

/// How strong is a dry stone wall whose every stone is different, and how sure is that?
#[derive(Debug, Parser)]
#[command(name = "pirca", version, subcommand_value_name = "VERB", after_help = WHOLE)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
    /// Write neither progress nor warnings to standard error; errors stay.
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

/// The verbs. The first line of each is its line in the list of verbs, where `help` groups them.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Begin a study (template, copy) or an empty measurements table.
    ///
    /// Writes a new folder with study.toml and README.md; a copy brings published.toml, measured.csv and the distributions that it
    /// would not find in its new place.
    #[command(after_help = init::HELP)]
    Init(init::Init),
    /// List all faults of a study, or of a table of measurements.
    ///
    /// It runs nothing.
    #[command(after_help = check::HELP)]
    Check(check::Check),
    /// Draw one wall of a study, as it falls; or write it to a file.
    ///
    /// A picture shows the wall solved, its joints coloured by how far they open or slip, or by the pressure in them. A file is for
    /// ParaView or another program.
    #[command(after_help = wall::ask::HELP)]
    Wall(wall::ask::Wall),
    /// Build and solve all walls of a study: statistics, figures.
    ///
    /// A run that was stopped goes on where it stood.
    #[command(after_help = run::ask::HELP)]
    Run(run::ask::Run),
    /// Share a study over a cluster (Slurm, Dask, any); merge results.
    ///
    /// Plan how many shards there are, run them, look which are missing, and put them together.
    #[command(after_help = shards::ask::HELP)]
    Shards(shards::ask::Shards),
    /// Put a run, a study or a wall on a page; say how to cite a run.
    ///
    /// One HTML file that any browser opens without a network: question, answer, figures, every wall, the weakest, the median and the
    /// strongest one drawn, every input with its source, limits, provenance, and a paragraph for a paper.
    #[command(after_help = report::HELP)]
    Report(report::Report),
    /// Say which load 95 % of walls reach, and how sure that is.
    ///
    /// The probability of a failure below some load, a low quantile, characteristic and design values: from simulated walls, or with --measured from tested specimens alone.
    #[command(after_help = capacity::ask::HELP)]
    Capacity(capacity::ask::Capacity),
    /// Say where the scatter of walls comes from.
    ///
    /// Shares of the variance by source: each parameter that is drawn once per wall, the layout of the stones as a whole, and what the
    /// layout consists of.
    #[command(after_help = sensitivity::ask::HELP)]
    Sensitivity(sensitivity::ask::Sensitivity),
    /// Say which way of building (arm) is the best, and how sure.
    ///
    /// Evaluates walls until every other arm is shown to be worse than the best one, or the same. Arms share the random numbers of a member;
    /// those that are near to the best one get the walls.
    #[command(after_help = compare::ask::HELP)]
    Compare(compare::ask::Compare),
    /// Say what a study's masonry is as a plate: stiffness, strength.
    ///
    /// Builds random cells of every arm, which repeat themselves without end, and gives their moduli between their bounds and the stresses
    /// that they bear, with mean, sigma and COV, and what both do as cells grow.
    #[command(after_help = homogenise::ask::HELP)]
    Homogenise(homogenise::ask::Homogenise),
    /// Say which interpretation of a paper fits what it reports.
    ///
    /// Where a source does not say all that it did, its statements may tell which of the possible readings is meant: the study's
    /// variants are searched, alone and together.
    #[command(after_help = readings::ask::HELP)]
    Readings(readings::ask::Readings),
    /// Say what the simulation gets wrong and what explains it.
    ///
    /// Sets the measurements beside what the simulation could have shown, given the instruments' errors, the scatter of stones
    /// and joints that nobody knows exactly. What is left is explained by a mechanism, by a few, or by none.
    #[command(after_help = diagnose::ask::HELP)]
    Diagnose(diagnose::ask::Diagnose),
    /// Say how many specimens to test, and what to read.
    ///
    /// How many real walls of each arm show a difference, by which reading, and how many carry a characteristic value.
    #[command(after_help = plan_tests::ask::HELP)]
    PlanTests(plan_tests::ask::PlanTests),
    /// Say which errors of the model the measurements could reveal.
    ///
    /// What each mechanism changes in every quantity of measured.csv, in units of the quantity's error. For studies on the
    /// tilting table.
    #[command(after_help = detectability::ask::HELP)]
    Detectability(detectability::ask::Detectability),
    /// Say at which tilt or horizontal load a wall in a file falls.
    ///
    /// The wall is a wall.json or an OBJ file that somebody else made.
    #[command(after_help = analyse::ask::HELP)]
    Analyse(Box<analyse::ask::Analyse>),
    /// List keys of study.toml, columns, causes; schemas, completions.
    #[command(after_help = reference::HELP)]
    Reference(reference::Reference),
}

impl Verb {
    /// Whether the answer is asked for as an object.
    pub fn is_json(&self) -> bool {
        match self {
            Verb::Init(asked) => asked.json,
            Verb::Readings(asked) => asked.json,
            Verb::Analyse(asked) => asked.json,
            // Of a wall it may stand among what is asked of the wall.
            Verb::Report(asked) => asked.json || asked.asked.iter().any(|word| word == "--json"),
            Verb::Shards(asked) => asked.step.is_json(),
            Verb::Reference(asked) => asked.what.is_json(),
            Verb::Check(check::Check { which, .. })
            | Verb::Wall(wall::ask::Wall { which, .. })
            | Verb::Run(run::ask::Run { which, .. })
            | Verb::Capacity(capacity::ask::Capacity { which, .. })
            | Verb::Sensitivity(sensitivity::ask::Sensitivity { which, .. })
            | Verb::Compare(compare::ask::Compare { which, .. })
            | Verb::Homogenise(homogenise::ask::Homogenise { which, .. })
            | Verb::Diagnose(diagnose::ask::Diagnose { which, .. })
            | Verb::PlanTests(plan_tests::ask::PlanTests { which, .. })
            | Verb::Detectability(detectability::ask::Detectability { which, .. }) => which.json,
        }
    }
}
