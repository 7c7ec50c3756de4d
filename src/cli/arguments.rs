//! The arguments, as clap reads them; their docstrings are the help. What frames the help is in `help`.

use std::ffi::OsString;
use std::num::NonZero;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::cli::analyse::Analyse;
use crate::cli::bank::POINTS;
use crate::cli::help::{
    ANALYSE, BANK, CAPACITY, CHECK, CITE, COMPARE, COMPLETIONS, DIAGNOSE, GENERATE, HOMOGENISE, INFLUENCE,
    INIT, MAN, MEASURED, MECHANISMS, MERGE, PICTURE, PLAN_TESTS, READINGS, REPORT, RUN, SCHEMA, SENSITIVITY,
    SHARD, STATUS, WHOLE,
};
use crate::cli::homogenise::Homogenise;
use crate::cli::rare::Method;
use crate::cli::shard::arguments::{Merge, Shard, Status};
use crate::cli::{influence, question, sensitivity};

/// Headings of the options that several verbs share.
const STUDY: &str = "Study";
const WALL: &str = "Wall";
pub(super) const SOLUTION: &str = "Solution";
pub(super) const OUTPUT: &str = "Output";
pub(super) const JOINTS: &str = "Joints";
pub(super) const LOAD: &str = "Load";
pub(super) const FILE: &str = "File";

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
    #[command(after_help = INIT)]
    Init(Init),
    /// List all faults of a study, or say that it has none; runs nothing.
    #[command(after_help = CHECK)]
    Check(Check),
    /// Write one wall of a study to a file: VTU (ParaView), OBJ or JSON.
    #[command(after_help = GENERATE)]
    Generate(Generate),
    /// Draw how one wall of a study falls.
    ///
    /// Solves the wall first. Its joints are coloured by how far they open or slip, or by the pressure in them.
    #[command(after_help = PICTURE)]
    Picture(Picture),
    /// Build and solve all walls of a study: tables, statistics, figures.
    ///
    /// A run that was stopped goes on where it stood.
    #[command(after_help = RUN)]
    Run(Run),
    /// Compute a part of a study's walls, for many machines.
    ///
    /// With --plan it says into how many shards the walls are best shared out and prints what starts them. With --index it computes one:
    /// as often as it is started, by any engine, on any machine that sees the output folder.
    #[command(after_help = SHARD)]
    Shard(Shard),
    /// Say which shards are complete, and which are missing.
    #[command(after_help = STATUS)]
    Status(Status),
    /// Put shards together: the files of a run on one machine.
    ///
    /// Tables, statistics and figures are those that `pirca run` writes, byte for byte.
    #[command(after_help = MERGE)]
    Merge(Merge),
    /// Put a run, a study or a wall on a page: answer, figures, sources.
    ///
    /// One HTML file that any browser opens without a network: question, answer, figures, every wall, the weakest, the median and the
    /// strongest one drawn, every input with its source, limits, provenance, and a paragraph for a paper.
    #[command(after_help = REPORT)]
    Report(Report),
    /// Say how to cite a run: version, study, seed and hash.
    #[command(after_help = CITE)]
    Cite(Cite),
    /// Say what walls may be counted on to bear.
    ///
    /// The probability of a failure below some load, a low quantile, characteristic and design values: from simulated walls, or with --measured from tested specimens alone.
    #[command(after_help = CAPACITY)]
    Capacity(Capacity),
    /// Say where the scatter of walls comes from.
    ///
    /// Shares of the variance by source: each parameter that is drawn once per wall, the layout of the stones as a whole, and what the
    /// layout consists of.
    #[command(after_help = INFLUENCE)]
    Influence(Influence),
    /// Say which arm of a study is the best, and how sure that is.
    ///
    /// Evaluates walls until every other arm is shown to be worse than the best one, or the same. Arms share the random numbers of a member;
    /// those that are near to the best one get the walls.
    #[command(after_help = COMPARE)]
    Compare(Compare),
    /// Say what a study's masonry is as a plate: stiffness, strength.
    ///
    /// Builds random cells of every arm, which repeat themselves without end, and gives their moduli between their bounds and the stresses
    /// that they bear, with mean, sigma and COV, and what both do as cells grow.
    #[command(after_help = HOMOGENISE)]
    Homogenise(Homogenise),
    /// Say which readings of a study explain what was published.
    ///
    /// Where a source does not say all that it did, its statements may tell which of the possible readings is meant: the study's
    /// variants are searched, alone and together.
    #[command(after_help = READINGS)]
    Readings(Readings),
    /// Simulate the walls that a diagnosis rests on, once for its design.
    ///
    /// Every mechanism is simulated at many strengths, with joints that are known as badly as they are. A bank that was stopped
    /// goes on where it stood.
    #[command(after_help = BANK)]
    Bank(Bank),
    /// Say what the simulation gets wrong and what explains it.
    ///
    /// Sets the measurements beside what the simulation could have shown, given the instruments' errors, the scatter of stones
    /// and joints that nobody knows exactly. What is left is explained by a mechanism, by a few, or by none.
    #[command(after_help = DIAGNOSE)]
    Diagnose(Diagnose),
    /// Say how many specimens to test, and what to read.
    ///
    /// How many real walls of each arm show a difference, by which reading, and how many carry a characteristic value.
    #[command(after_help = PLAN_TESTS)]
    PlanTests(PlanTests),
    /// Write an empty table of measurements, or check a filled one.
    ///
    /// The table is for a spreadsheet. Of a filled one it says what is read from it and what looks odd; it simulates nothing.
    #[command(after_help = MEASURED)]
    Measured(Measured),
    /// Say which mechanisms the measurements of a study could show.
    ///
    /// What each mechanism changes in every quantity of measured.csv, in units of the quantity's error. For studies on the
    /// tilting table.
    #[command(after_help = SENSITIVITY)]
    Sensitivity(Sensitivity),
    /// List the mechanisms that a study may switch on, with their priors.
    ///
    /// What each one is, where it acts, its parameters with their priors, whether its effect goes when the wall is unloaded,
    /// what it is confounded with, and whether limit analysis honours it.
    #[command(after_help = MECHANISMS)]
    Mechanisms(Mechanisms),
    /// Say at which tilt or horizontal load a wall from a file falls.
    ///
    /// The wall is a wall.json or an OBJ file that somebody else made.
    #[command(after_help = ANALYSE)]
    Analyse(Box<Analyse>),
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
    #[command(after_help = SCHEMA)]
    Schema(Schema),
}

/// Arguments of `cite`.
#[derive(Args, Debug)]
pub(crate) struct Cite {
    /// The output folder of the run.
    pub run: PathBuf,
    /// Print an entry for BibTeX.
    #[arg(long, help_heading = OUTPUT)]
    pub bibtex: bool,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT, conflicts_with = "bibtex")]
    pub json: bool,
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

/// Arguments of `schema`.
#[derive(Args, Debug)]
pub(crate) struct Schema {
    /// Which file it describes.
    #[arg(long, value_name = "FILE", default_value = "study")]
    pub of: Described,
    /// Write it to this file instead of standard output.
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
}

/// Files that have a schema.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Described {
    /// study.toml of walls.
    Study,
    /// study.toml of types of elements.
    ElementStudy,
    /// published.toml beside a study of walls.
    Published,
}

impl Verb {
    /// Whether the answer is asked for as an object.
    pub fn is_json(&self) -> bool {
        match self {
            Verb::Init(Init { json, .. })
            | Verb::Cite(Cite { json, .. })
            | Verb::Mechanisms(Mechanisms { json, .. })
            | Verb::Merge(Merge { json, .. })
            | Verb::Status(Status { json, .. })
            | Verb::Readings(Readings { json, .. }) => *json,
            Verb::Analyse(own) => own.json,
            // Of a wall it may stand among what is asked of the wall.
            Verb::Report(own) => own.json || own.asked.iter().any(|word| word == "--json"),
            Verb::Check(Check { which, .. })
            | Verb::Generate(Generate { which, .. })
            | Verb::Picture(Picture { which, .. })
            | Verb::Run(Run { which, .. })
            | Verb::Shard(Shard { which, .. })
            | Verb::Capacity(Capacity { which, .. })
            | Verb::Influence(Influence { which, .. })
            | Verb::Compare(Compare { which, .. })
            | Verb::Homogenise(Homogenise { which, .. })
            | Verb::Bank(Bank { which, .. })
            | Verb::Diagnose(Diagnose { which, .. })
            | Verb::PlanTests(PlanTests { which, .. })
            | Verb::Measured(Measured { which, .. })
            | Verb::Sensitivity(Sensitivity { which, .. }) => which.json,
            // A text is all that they have.
            Verb::Completions(_) | Verb::Man(_) | Verb::Schema(_) => false,
        }
    }
}

/// Arguments of `init`.
#[derive(Args, Debug)]
pub(crate) struct Init {
    /// The new folder, or one that is empty: a name here, or a path. Its last part is the study's name.
    pub name: PathBuf,
    /// Copy this study: the folder of one, or one that is built in.
    #[arg(long, value_name = "STUDY", help_heading = STUDY)]
    pub from: Option<PathBuf>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

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

/// Arguments of `mechanisms`.
#[derive(Args, Debug)]
pub(crate) struct Mechanisms {
    /// Folder of the distributions, which holds the priors below `mechanism` [default: the nearest folder `distributions` here
    /// or further up, else what is built in].
    #[arg(long, value_name = "DIR")]
    pub distributions: Option<PathBuf>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `check`.
#[derive(Args, Debug)]
pub(crate) struct Check {
    #[command(flatten)]
    pub which: Which,
    /// List every key that a study, its published.toml and a distribution may hold: what is allowed, default, meaning.
    #[arg(long, conflicts_with = "json", help_heading = OUTPUT)]
    pub keys: bool,
    /// List every column of the tables of a run: name, unit, meaning.
    #[arg(long, conflicts_with = "json", help_heading = OUTPUT)]
    pub columns: bool,
}

/// Which wall of a study.
#[derive(Args, Debug)]
#[command(next_help_heading = WALL)]
pub(crate) struct OneWall {
    /// Name of the arm; without it the first whose walls are random.
    #[arg(long, value_name = "ARM")]
    pub arm: Option<String>,
    /// Number of the kn point, from 0. The stones are the same at every point.
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub point: u32,
    /// Number of the wall in its arm, from 0.
    #[arg(long, value_name = "M", default_value_t = 0)]
    pub member: u64,
    /// Number of a wall that `capacity --walls` drew and moved (draw in evaluations.parquet), instead of an arm's.
    #[arg(long, value_name = "K", conflicts_with_all = ["arm", "point", "member", "members"])]
    pub draw: Option<u64>,
    /// Folder that holds it [default: runs/<study>-capacity, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", requires = "draw")]
    pub draws: Option<PathBuf>,
    /// Number of walls in every random arm, instead of the study's, as in `run`.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub members: Option<u64>,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
}

/// Arguments of `generate`.
#[derive(Args, Debug)]
pub(crate) struct Generate {
    #[command(flatten)]
    pub which: Which,
    #[command(flatten)]
    pub wall: OneWall,
    /// Solve the wall as `run` does, and write the displacements (m) of all corners and of every stone's centroid into the .vtu.
    #[arg(long, help_heading = SOLUTION)]
    pub solved: bool,
    /// Add the ground: a fixed block under the wall, as `run` puts one there and `analyse` needs one.
    #[arg(long, conflicts_with = "solved", help_heading = OUTPUT)]
    pub with_base: bool,
    /// File to write; its ending says the format: .vtu (ParaView), .obj or .json.
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    pub out: PathBuf,
}

/// Arguments of `picture`.
#[derive(Args, Debug)]
pub(crate) struct Picture {
    #[command(flatten)]
    pub which: Which,
    #[command(flatten)]
    pub wall: OneWall,
    /// What joints are coloured by.
    #[arg(long, value_name = "NAME", default_value = "opening", help_heading = OUTPUT)]
    pub colour: Measure,
    /// Magnification of the movement, above 0 [default: so that the largest one is a tenth of the wall's height].
    #[arg(long, value_name = "X", value_parser = magnification, allow_negative_numbers = true, help_heading = OUTPUT)]
    pub magnify: Option<f64>,
    /// File to write, an .svg.
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    pub out: PathBuf,
    /// Folder for pictures of the wall in every state from rest through the collapse: frame-000.svg, frame-001.svg, ...
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub frames: Option<PathBuf>,
    /// Folder for the same states in three dimensions: series for ParaView (wall.pvd, joints.pvd), an animation (wall.glb), and the wall
    /// at rest and at the end as OBJ.
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub series: Option<PathBuf>,
}

/// What joints are coloured by.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Measure {
    /// How far they gape at their widest.
    Opening,
    /// How far they have slipped.
    Slip,
    /// How hard the blocks press on each other, over the whole area of the joint.
    Stress,
}

/// A magnification: above 0, and no more than anything could need.
fn magnification(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 1e6 => Ok(x),
        _ => Err("allowed is a number above 0, up to 1000000".to_string()),
    }
}

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
            csv: false,
            report: true,
        }
    }
}

/// Arguments of `report`.
#[derive(Args, Debug)]
pub(crate) struct Report {
    /// The output folder of a run, a study (its folder or its study.toml, which is run as far as it has not been), or a wall (.json, .obj).
    #[arg(value_name = "RUN|STUDY|WALL")]
    pub of: PathBuf,
    /// Folder of the study that was run [default: where it was run from, else studies/<study>].
    #[arg(long, value_name = "STUDY", help_heading = STUDY)]
    pub study: Option<PathBuf>,
    /// File to write [default: report.html in the folder of the run; of a wall <wall>-report.html here].
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
    /// Of a wall, behind --: what is asked of it, as of analyse, for example -- --phi-deg 35.
    #[arg(last = true, value_name = "OPTIONS OF ANALYSE")]
    pub asked: Vec<OsString>,
}

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
    /// Write the further walls down as batches for `pirca shard`, one after the other, and evaluate none of them here.
    #[arg(long, requires = "walls", conflicts_with_all = ["measured", "quantile", "half_width"], help_heading = STUDY)]
    pub batches: bool,
    /// Add walls, up to --walls, until half the width of a quantile's interval is below this share of the quantile.
    #[arg(long, value_name = "H", conflicts_with_all = ["measured", "members", "below_deg", "above_m", "below_n"], value_parser = question::relative, allow_negative_numbers = true, help_heading = STUDY)]
    pub half_width: Option<f64>,
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

/// Arguments of `influence`.
#[derive(Args, Debug)]
pub(crate) struct Influence {
    #[command(flatten)]
    pub which: Which,
    /// Name of the arm; without it the first whose walls are random.
    #[arg(long, value_name = "ARM", help_heading = WALL)]
    pub arm: Option<String>,
    /// Number of the kn point, from 0.
    #[arg(long, value_name = "K", default_value_t = 0, help_heading = WALL)]
    pub point: u32,
    /// Base points, a multiple of 16; each costs two walls and one more for every source.
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = influence::points, help_heading = STUDY)]
    pub points: u64,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S", help_heading = STUDY)]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
    /// Output folder [default: runs/<study>-influence, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the answer on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
}

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

/// What is asked of walls: one question, or none.
#[derive(Args, Debug)]
#[group(multiple = false)]
#[command(next_help_heading = "Question")]
pub(crate) struct Asked {
    /// Which share of walls lie below the value sought.
    #[arg(long, value_name = "P", value_parser = question::probability, allow_negative_numbers = true)]
    pub quantile: Option<f64>,
    /// How probable is a collapse before this tilt (deg)?
    #[arg(long, value_name = "DEG", value_parser = question::level, allow_negative_numbers = true)]
    pub below_deg: Option<f64>,
    /// How probable is a displacement beyond this (m)?
    #[arg(long, value_name = "M", value_parser = question::level, allow_negative_numbers = true)]
    pub above_m: Option<f64>,
    /// How probable is a shear capacity below this (N)?
    #[arg(long, value_name = "N", value_parser = question::level, allow_negative_numbers = true)]
    pub below_n: Option<f64>,
}

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
    /// Most variants that are read together.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u64).range(1..=6), help_heading = STUDY)]
    pub departures: u64,
    #[command(flatten)]
    pub ensemble: Ensemble,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
}

/// Arguments of `sensitivity`.
#[derive(Args, Debug)]
pub(crate) struct Sensitivity {
    #[command(flatten)]
    pub which: Which,
    /// Output folder [default: runs/<study>-sensitivity, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Number of walls in every arm that was measured.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u64).range(1..=10_000), help_heading = STUDY)]
    pub members: u64,
    /// Quantile of the priors, counted from the end at which a mechanism is weak; 0.5 is the median.
    #[arg(long, value_name = "Q", default_value = "0.84", value_parser = sensitivity::quantile, allow_negative_numbers = true, help_heading = STUDY)]
    pub quantile: f64,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
}

/// Arguments of `measured`.
#[derive(Args, Debug)]
pub(crate) struct Measured {
    #[command(flatten)]
    pub which: Which,
    /// The table to check [default: the study's measured.csv].
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Write an empty table for the arms, the specimens and the tilts of the study instead.
    #[arg(long, conflicts_with_all = ["file", "json"])]
    pub template: bool,
    /// A row per specimen and tilt, with a column per quantity, instead of a row per value.
    #[arg(long, requires = "template")]
    pub wide: bool,
    /// Specimens of each arm in the empty table [default: 3].
    #[arg(long, value_name = "N", requires = "template", default_value_t = 3, hide_default_value = true, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub specimens: u32,
    /// File to write the empty table to, which must not be there [default: standard output].
    #[arg(long, value_name = "FILE", requires = "template")]
    pub out: Option<PathBuf>,
}

/// Arguments of `diagnose`.
#[derive(Args, Debug)]
pub(crate) struct Diagnose {
    #[command(flatten)]
    pub which: Which,
    /// What was measured [default: the study's measured.csv].
    #[arg(long, value_name = "FILE", help_heading = STUDY)]
    pub measured: Option<PathBuf>,
    /// Folder of the bank [default: runs/<study>-bank, with -<variant> in it if one is named; else the bank beside the study].
    #[arg(long, value_name = "DIR", help_heading = SOLUTION)]
    pub bank: Option<PathBuf>,
    /// Points in the priors for each mechanism that the bank has.
    #[arg(long, value_name = "N", default_value_t = POINTS, value_parser = clap::value_parser!(u64).range(10..=100_000), help_heading = SOLUTION)]
    pub points: u64,
    /// Stop with the command to run, where there is no bank.
    #[arg(long, help_heading = SOLUTION)]
    pub no_build: bool,
    /// Do not measure what the extended model gains on readings held out: minutes on a large design.
    #[arg(long, help_heading = SOLUTION)]
    pub no_gain: bool,
    /// Where the verdict is unexplained, learn a free law of the joints from the readings: half an hour on the nine walls.
    #[arg(long, help_heading = SOLUTION)]
    pub law: bool,
    /// Output folder [default: runs/<study>-diagnosis, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the verdict on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
    /// Seed of the diagnosis instead of the study's; the bank keeps the study's.
    #[arg(long, value_name = "S", help_heading = STUDY)]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
}

/// Arguments of `bank`.
#[derive(Args, Debug)]
pub(crate) struct Bank {
    #[command(flatten)]
    pub which: Which,
    /// What was measured [default: the study's measured.csv]; only the families in it matter.
    #[arg(long, value_name = "FILE", help_heading = STUDY)]
    pub measured: Option<PathBuf>,
    /// Output folder [default: runs/<study>-bank, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Points in the priors for each mechanism; twice as many for the base model.
    #[arg(long, value_name = "N", default_value_t = POINTS, value_parser = clap::value_parser!(u64).range(10..=100_000), help_heading = SOLUTION)]
    pub points: u64,
    /// Simulated campaigns of each mechanism that the self-test judges by all that a diagnosis does (seconds each), and five times as
    /// many with nothing hidden; 100 of each are judged by how they seem.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u64).range(0..=20), help_heading = SOLUTION)]
    pub judged: u64,
    /// Seed of the self-test instead of the study's: that of the diagnoses which it is kept for. The walls keep the study's.
    #[arg(long, value_name = "S", help_heading = STUDY)]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
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
