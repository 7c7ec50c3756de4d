//! The arguments, as clap reads them; their docstrings are the help. What frames the help is in `help`.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

use crate::cli::help::{COMPLETIONS, MAN, WHOLE};
use crate::verb::{
    analyse, capacity, check, cite, compare, detectability, diagnose, homogenise, init, measured, mechanisms,
    plan_tests, readings, report, run, schema, sensitivity, shard, wall,
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
    /// Begin a study: a commented one that runs as it is, or a copy.
    ///
    /// Writes a new folder with study.toml and README.md; a copy brings published.toml, measured.csv and the distributions that it
    /// would not find in its new place.
    #[command(after_help = init::HELP)]
    Init(init::Init),
    /// List all faults of a study, or that it has none; runs nothing.
    #[command(after_help = check::HELP)]
    Check(check::Check),
    /// Write one wall of a study to a file: VTU, OBJ or JSON.
    #[command(after_help = wall::ask::GENERATE)]
    Generate(wall::ask::Generate),
    /// Draw how one wall of a study falls.
    ///
    /// Solves the wall first. Its joints are coloured by how far they open or slip, or by the pressure in them.
    #[command(after_help = wall::ask::PICTURE)]
    Picture(wall::ask::Picture),
    /// Build and solve all walls of a study: statistics, figures.
    ///
    /// A run that was stopped goes on where it stood.
    #[command(after_help = run::ask::HELP)]
    Run(run::ask::Run),
    /// Share a study out over a cluster (Slurm, Dask, any other).
    ///
    /// With --plan it says into how many shards the walls are best shared out and prints what starts them. With --index it computes one:
    /// as often as it is started, by any engine, on any machine that sees the output folder.
    #[command(after_help = shard::ask::SHARD)]
    Shard(shard::ask::Shard),
    /// Say which shards are complete, and which are missing.
    #[command(after_help = shard::ask::STATUS)]
    Status(shard::ask::Status),
    /// Put shards together: the files of a run on one machine.
    ///
    /// Tables, statistics and figures are those that `pirca run` writes, byte for byte.
    #[command(after_help = shard::ask::MERGE)]
    Merge(shard::ask::Merge),
    /// Put a run, a study or a wall on a page, with its sources.
    ///
    /// One HTML file that any browser opens without a network: question, answer, figures, every wall, the weakest, the median and the
    /// strongest one drawn, every input with its source, limits, provenance, and a paragraph for a paper.
    #[command(after_help = report::HELP)]
    Report(report::Report),
    /// Say how to cite a run: version, study, seed and hash.
    #[command(after_help = cite::HELP)]
    Cite(cite::Cite),
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
    /// Simulate beforehand the walls that diagnose compares with.
    ///
    /// `pirca diagnose` does it by itself where they are missing. They serve every measurement of one test programme.
    /// Every mechanism is simulated at many strengths, with joints that are known as badly as they are. A bank that was stopped
    /// goes on where it stood.
    #[command(after_help = diagnose::bank::HELP)]
    Bank(diagnose::bank::Bank),
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
    /// Write an empty table of measurements, or check a filled one.
    ///
    /// The table is for a spreadsheet. Of a filled one it says what is read from it and what looks odd; it simulates nothing.
    #[command(after_help = measured::HELP)]
    Measured(measured::Measured),
    /// Say which errors of the model the measurements could reveal.
    ///
    /// What each mechanism changes in every quantity of measured.csv, in units of the quantity's error. For studies on the
    /// tilting table.
    #[command(after_help = detectability::ask::HELP)]
    Detectability(detectability::ask::Detectability),
    /// List what the model leaves out (creep, rounded edges, ...).
    ///
    /// What each one is, where it acts, its parameters with their priors, whether its effect goes when the wall is unloaded,
    /// what it is confounded with, and whether limit analysis honours it.
    #[command(after_help = mechanisms::HELP)]
    Mechanisms(mechanisms::Mechanisms),
    /// Say at which tilt or horizontal load a wall in a file falls.
    ///
    /// The wall is a wall.json or an OBJ file that somebody else made.
    #[command(after_help = analyse::ask::HELP)]
    Analyse(Box<analyse::ask::Analyse>),
    /// Print the completions of a shell.
    ///
    /// Bash, zsh, fish, PowerShell and Elvish complete verbs, options and their values.
    #[command(after_help = COMPLETIONS)]
    Completions(Completions),
    /// Write the manual pages of all verbs, for man.
    #[command(after_help = MAN)]
    Man(Man),
    /// Print the JSON Schema of a study, for editors.
    ///
    /// An editor that knows it completes keys, shows what each means, and marks what is wrong while a study is written.
    #[command(after_help = schema::HELP)]
    Schema(schema::Schema),
}

/// Arguments of `completions`.
#[derive(Args, Debug)]
pub(crate) struct Completions {
    /// The shell.
    pub shell: Shell,
}

/// Arguments of `man`.
#[derive(Args, Debug)]
pub(crate) struct Man {
    /// Folder of the pages: pirca.1, pirca-run.1 and so on.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

impl Verb {
    /// Whether the answer is asked for as an object.
    pub fn is_json(&self) -> bool {
        match self {
            Verb::Init(asked) => asked.json,
            Verb::Cite(asked) => asked.json,
            Verb::Mechanisms(asked) => asked.json,
            Verb::Merge(asked) => asked.json,
            Verb::Status(asked) => asked.json,
            Verb::Readings(asked) => asked.json,
            Verb::Analyse(asked) => asked.json,
            // Of a wall it may stand among what is asked of the wall.
            Verb::Report(asked) => asked.json || asked.asked.iter().any(|word| word == "--json"),
            Verb::Check(check::Check { which, .. })
            | Verb::Generate(wall::ask::Generate { which, .. })
            | Verb::Picture(wall::ask::Picture { which, .. })
            | Verb::Run(run::ask::Run { which, .. })
            | Verb::Shard(shard::ask::Shard { which, .. })
            | Verb::Capacity(capacity::ask::Capacity { which, .. })
            | Verb::Sensitivity(sensitivity::ask::Sensitivity { which, .. })
            | Verb::Compare(compare::ask::Compare { which, .. })
            | Verb::Homogenise(homogenise::ask::Homogenise { which, .. })
            | Verb::Bank(diagnose::bank::Bank { which, .. })
            | Verb::Diagnose(diagnose::ask::Diagnose { which, .. })
            | Verb::PlanTests(plan_tests::ask::PlanTests { which, .. })
            | Verb::Measured(measured::Measured { which, .. })
            | Verb::Detectability(detectability::ask::Detectability { which, .. }) => which.json,
            // A text is all that they have.
            Verb::Completions(_) | Verb::Man(_) | Verb::Schema(_) => false,
        }
    }
}
