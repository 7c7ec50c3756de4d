//! The arguments, as clap reads them; their docstrings are the help.

use std::num::NonZero;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::cli::{analyse, sensitivity};

const CODES: &str =
    "Exit codes: 0 done; 1 the run or a file failed; 2 wrong arguments; 3 invalid study or wall.";

const WALLS: &str = "\
Example: pirca analyse wall.json --phi-deg 30
         pirca analyse arch.obj --unit mm --density-kg-per-m3 2300 --phi-deg 35 --solver explicit --kn 1e9 --json

wall.json: {\"unit\": \"m\", \"blocks\": [{\"id\": 0, \"vertices\": [[x, y, z], ...], \"faces\": [[i, j, k, ...], ...],
\"density\": 2400, \"fixed\": false, \"tag\": \"stone\", \"group\": \"keystone\"}, ...]}. Convex blocks; faces count their block's vertices
from 0, counter-clockwise seen from outside; z up. unit: m (default), cm, mm. density in kg/m^3, not needed where fixed is true.
fixed (default false): a support. tag: stone, header, wedge, base, end or a word of your own; may be left out.
group: blocks of the same group are one rigid body: divide a concave stone into convex parts. May be left out.
OBJ: one object (o, or g without any o) per block, z up (or --up y). A name that comes again goes on with the same block, unless each
piece is a closed solid. A block is fixed when a word of its name is base, end, fixed, ground or support (base_0, Left_support.001).
Objects keystone.part1, keystone.part2, ... are one rigid body. A comment \"# density 2400 kg/m^3\" holds for the next object.
In both, triangles of one plane are merged into faces; corners within 1e-4 of the block are one, also where each face has its own,
and a corner may lie on the edge of another face.
Joints have no tensile strength. Limits: 64 MiB, 50000 blocks, 2000 vertices and faces of a block in the file, 200 corners
after merging; stones of 1 mm to 25 m; faces plane and convex to 1e-4 of the block (more with --flatness);
overlaps up to 1 % of the smaller block, other than among the parts of a group.";

/// Stochastic dry stone walls: generates them, solves them, and says how strong they are and how sure that is.
#[derive(Debug, Parser)]
#[command(name = "pirca", version, after_help = CODES)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Read a study and say everything that is wrong with it, without running it.
    #[command(after_help = format!("Example: pirca check studies/joint-arrangement\n\n{CODES}"))]
    Check(Check),
    /// Write the wall of one member to a file.
    #[command(after_help = format!(
        "Example: pirca generate studies/joint-arrangement --arm irregular --member 17 --out wall.vtu\n\
         \x20        pirca generate studies/tilting-block --with-base --out wall.json   (for pirca analyse)\n\n{CODES}\n\
         A member whose wall is an invalid geometry ends with 1 and the reason."
    ))]
    Generate(Generate),
    /// Solve the wall of one member and draw how it falls, with its joints coloured by opening or slip.
    #[command(after_help = format!(
        "Example: pirca picture studies/tilting-table --arm sbl --member 0 --out wall.svg\n\n\
         The last state at rest is drawn in true size, the movement of the fall magnified; a wall that does not fall is drawn\n\
         at rest, with its displacements magnified. Every way a wall can end is drawn, and ends with 0.\n\n{CODES}\n\
         A member whose wall is an invalid geometry ends with 1 and the reason."
    ))]
    Picture(Picture),
    /// Generate and solve every wall of a study; write tables, statistics and figures. Resumes by itself.
    #[command(after_help = format!(
        "Example: pirca run studies/joint-arrangement --members 5 --out runs/first-try\n\
         \x20        pirca run studies/joint-arrangement --beside runs/joint-arrangement-explicit --out runs/both\n\n\
         Killed and started again with the same arguments, it goes on where it stood and ends with the same files.\n\
         A wall that falls or cannot be built is counted in the results; it is no error.\n\n{CODES}"
    ))]
    Run(Run),
    /// Simulate the walls that a diagnosis of a study's measurements rests on: every mechanism at many strengths, with joints that
    /// are known as badly as they are. Resumes by itself.
    #[command(after_help = format!(
        "Example: pirca bank studies/tilting-table --points 120\n\n\
         More points later leave the first ones as they are, in another folder. The priors are in mechanism and nuisance\n\
         of the nearest folder distributions above the study.\n\n{CODES}"
    ))]
    Bank(Bank),
    /// What does the simulation get wrong beyond errors and natural scatter, and which mechanism explains it, or which few, or none?
    #[command(after_help = format!(
        "Example: pirca diagnose studies/tilting-table --measured my-tests.csv\n\n\
         Writes verdict.html (a page with all of it), verdict.json, figures as SVG and PNG (one per family, and residuals) and, for\n\
         each cause of the verdict, the study extended by it: extended/<cause>, an ordinary study at the medians of what is not\n\
         known, with draws from it as variants (run extended/<cause> --variant draw-07).\n\
         The walls it needs are simulated once for a design, which takes minutes to hours; see bank. What looks odd about the\n\
         measurements (a value far beyond what is simulated, one specimen alone) is noted on standard error and judged all the\n\
         same.\n\n{CODES}\n\
         Every verdict (named, ambiguous, unexplained, nothing found) ends with 0."
    ))]
    Diagnose(Diagnose),
    /// Write an empty table of measurements for a spreadsheet, or say what is read from a filled one and what looks odd about it.
    #[command(after_help = format!(
        "Example: pirca measured studies/tilting-table --template --wide --out my-tests.csv\n\
         \x20        pirca measured studies/tilting-table my-tests.csv\n\n\
         Commas, semicolons or tabs; decimals with a point, or with a comma where it does not separate; a row per value, or a row\n\
         per tilt. `pirca check STUDY --keys` lists all columns and quantities. Every fault is told with its line.\n\n{CODES}"
    ))]
    Measured(Measured),
    /// Which mechanisms could the measured data see? What each of them changes in every quantity of measured.csv, in units of
    /// the quantity's error, for a study on the tilting table.
    #[command(after_help = format!(
        "Example: pirca sensitivity studies/tilting-table --members 3 --out runs/sensitivity\n\n\
         Writes sensitivity.csv, sensitivity.json, sensitivity.svg and sensitivity.png. The strength of each mechanism comes from\n\
         the priors in distributions/mechanism, the nearest above the study.\n\n{CODES}"
    ))]
    Sensitivity(Sensitivity),
    /// List the mechanisms that a study may switch on: what each is, where it acts, its parameters with their priors, whether its
    /// effect goes when the wall is unloaded, what it is confounded with, and whether limit analysis honours it.
    #[command(after_help = format!(
        "Example: pirca mechanisms --json\n\n\
         A table [mechanism.creep] in a study, with its keys, switches creep on; [arm.mechanism.creep] does for one arm.\n\n{CODES}"
    ))]
    Mechanisms(Mechanisms),
    /// Solve a wall that somebody else made, from a wall.json or an OBJ file: at which tilt or load does it fall?
    #[command(after_help = format!("{WALLS}\n\n{CODES}\nEvery way a wall can end (stable, collapsed, unstable at rest, not converged) ends with 0."))]
    Analyse(Analyse),
}

/// Which study, in which reading.
#[derive(Args, Debug)]
pub(crate) struct Which {
    /// The study: its folder, or the study.toml in it.
    pub study: PathBuf,
    /// A named variant of the study.
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `mechanisms`.
#[derive(Args, Debug)]
pub(crate) struct Mechanisms {
    /// Folder of the distributions, which holds the priors below `mechanism`.
    #[arg(long, value_name = "DIR", default_value = "distributions")]
    pub distributions: PathBuf,
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
    #[arg(long, conflicts_with = "json")]
    pub keys: bool,
}

/// Which wall of a study.
#[derive(Args, Debug)]
pub(crate) struct OneWall {
    /// Name of the arm; without it the first whose walls are random.
    #[arg(long, value_name = "ARM")]
    pub arm: Option<String>,
    /// Number of the kn point, from 0. The stones are the same at every point.
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub point: u32,
    /// Number of the member, from 0.
    #[arg(long, value_name = "M", default_value_t = 0)]
    pub member: u64,
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
    /// Solve the wall as `run` does, and write the displacement of every stone's centroid (m) into the .vtu.
    #[arg(long)]
    pub solved: bool,
    /// Add the ground: a fixed block under the wall, as `run` puts one there and `analyse` needs one.
    #[arg(long, conflicts_with = "solved")]
    pub with_base: bool,
    /// File to write; its ending says the format: .vtu (ParaView), .obj or .json.
    #[arg(long, value_name = "FILE")]
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
    #[arg(long, value_name = "NAME", default_value = "opening")]
    pub colour: Measure,
    /// Magnification of the movement, above 0 [default: so that the largest one is a tenth of the wall's height].
    #[arg(long, value_name = "X", value_parser = magnification, allow_negative_numbers = true)]
    pub magnify: Option<f64>,
    /// File to write, an .svg.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
}

/// What joints are coloured by.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Measure {
    /// How far they gape at their widest.
    Opening,
    /// How far they have slipped.
    Slip,
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
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of walls in every random arm, instead of the study's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub members: Option<u64>,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T")]
    pub threads: Option<NonZero<usize>>,
    /// Solver instead of the study's, with its defaults; the study's own settings if it is the study's own solver.
    #[arg(long, value_name = "NAME")]
    pub solver: Option<SolverName>,
    /// Output folder of an earlier run of the same study, whose means are drawn into the figure as hollow markers.
    #[arg(long, value_name = "DIR")]
    pub beside: Option<PathBuf>,
}

/// Arguments of `sensitivity`.
#[derive(Args, Debug)]
pub(crate) struct Sensitivity {
    #[command(flatten)]
    pub which: Which,
    /// Output folder [default: runs/<study>-sensitivity, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of walls in every arm that was measured.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub members: u64,
    /// Quantile of the priors, counted from the end at which a mechanism is weak; 0.5 is the median.
    #[arg(long, value_name = "Q", default_value = "0.84", value_parser = sensitivity::quantile, allow_negative_numbers = true)]
    pub quantile: f64,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T")]
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
    #[arg(long, value_name = "FILE")]
    pub measured: Option<PathBuf>,
    /// Folder of the bank [default: runs/<study>-bank, with -<variant> in it if one is named; else the bank beside the study].
    #[arg(long, value_name = "DIR")]
    pub bank: Option<PathBuf>,
    /// Points in the priors for each mechanism that the bank has.
    #[arg(long, value_name = "N", default_value_t = 120, value_parser = clap::value_parser!(u64).range(10..=100_000))]
    pub points: u64,
    /// Stop with the command to run, where there is no bank.
    #[arg(long)]
    pub no_build: bool,
    /// Do not measure what the extended model gains on readings held out: minutes on a large design.
    #[arg(long)]
    pub no_gain: bool,
    /// Output folder [default: runs/<study>-diagnosis, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Seed of the diagnosis instead of the study's; the bank keeps the study's.
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T")]
    pub threads: Option<NonZero<usize>>,
}

/// Arguments of `bank`.
#[derive(Args, Debug)]
pub(crate) struct Bank {
    #[command(flatten)]
    pub which: Which,
    /// What was measured [default: the study's measured.csv]; only the families in it matter.
    #[arg(long, value_name = "FILE")]
    pub measured: Option<PathBuf>,
    /// Output folder [default: runs/<study>-bank, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Points in the priors for each mechanism; twice as many for the base model.
    #[arg(long, value_name = "N", default_value_t = 120, value_parser = clap::value_parser!(u64).range(10..=100_000))]
    pub points: u64,
    /// Simulated campaigns of each mechanism that the self-test judges by all that a diagnosis does (seconds each), and five times as
    /// many with nothing hidden; 100 of each are judged by how they seem.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u64).range(0..=20))]
    pub judged: u64,
    /// Seed of the self-test instead of the study's: that of the diagnoses which it is kept for. The walls keep the study's.
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T")]
    pub threads: Option<NonZero<usize>>,
}

/// The solvers by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SolverName {
    /// Central differences with local damping (DEM).
    Explicit,
    /// Newton's method from equilibrium to equilibrium.
    Implicit,
    /// Limit analysis of rigid blocks: the collapse load alone.
    Limit,
}

/// Arguments of `analyse`.
#[derive(Args, Debug)]
pub(crate) struct Analyse {
    /// The wall: a .json or .obj file.
    pub wall: PathBuf,
    /// Solver. Limit analysis takes rigid blocks and needs no stiffness.
    #[arg(long, value_name = "NAME", default_value = "limit")]
    pub solver: MethodName,
    /// Load: gravity turns towards the direction (to at most 89 deg), or a multiple of the weight pushes there (to at most 10).
    #[arg(long, value_name = "NAME", default_value = "tilt")]
    pub load: LoadName,
    /// Direction of the load.
    #[arg(long, value_name = "NAME", default_value = "y+")]
    pub direction: DirectionName,
    /// Friction angle of the joints (deg), 0 to 89.
    #[arg(long, value_name = "F", value_parser = analyse::friction_angle, allow_negative_numbers = true)]
    pub phi_deg: f64,
    /// Normal stiffness of the joints per area (Pa/m); required for implicit and explicit.
    #[arg(long, value_name = "PA_PER_M", value_parser = analyse::stiffness, allow_negative_numbers = true)]
    pub kn: Option<f64>,
    /// Shear stiffness of the joints per area (Pa/m) [default: kn / 2].
    #[arg(long, value_name = "PA_PER_M", value_parser = analyse::stiffness, allow_negative_numbers = true)]
    pub ks: Option<f64>,
    /// Cohesion of the joints (Pa).
    #[arg(long, value_name = "PA", default_value = "0", value_parser = analyse::cohesion, allow_negative_numbers = true)]
    pub cohesion: f64,
    /// Whether joints dilate when they slide, for limit analysis [default: associative, an upper bound].
    #[arg(long, value_name = "NAME")]
    pub flow: Option<FlowName>,
    /// Step of the tilt (deg) for implicit and explicit [default: 0.5]; with --load lateral its tangent is the step.
    #[arg(long, value_name = "F", value_parser = analyse::step, allow_negative_numbers = true)]
    pub step_deg: Option<f64>,
    /// Blocks closer than this touch: a length with its unit (2mm, 0.5cm, 0.002 m; at most a tenth of a stone), or a share of the
    /// size of what moves, corner to corner (1e-12 to 0.001). Deeper overlaps are told, and wider gaps up to a tenth of a stone.
    #[arg(long, value_name = "LENGTH", default_value = "1e-6", value_parser = analyse::tolerance, allow_negative_numbers = true)]
    pub touch_tolerance: analyse::Tolerance,
    /// Make faces plane whose corners lie up to this length off their plane (2mm), or 1/20 of their block if that is less; how far
    /// corners were moved is told [default: 1e-4 of a block is allowed, and nothing is moved].
    #[arg(long, value_name = "LENGTH", value_parser = analyse::length, allow_negative_numbers = true)]
    pub flatness: Option<f64>,
    /// Axis of an OBJ file that points up [default: z]. With y, its x, y, z become x, z, -y: its -z is out of plane, to the front.
    #[arg(long, value_name = "NAME")]
    pub up: Option<UpName>,
    /// Unit of the coordinates of an OBJ file [default: m].
    #[arg(long, value_name = "NAME")]
    pub unit: Option<UnitName>,
    /// Density (kg/m^3) of the objects of an OBJ file that have no density comment [default: 2400, with a warning].
    #[arg(long, value_name = "F", value_parser = analyse::density, allow_negative_numbers = true)]
    pub density_kg_per_m3: Option<f64>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long)]
    pub json: bool,
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

names! {
    /// How a wall from elsewhere is solved.
    MethodName {
        /// Limit analysis of rigid blocks.
        Limit = "limit",
        /// Elastic joints, equilibrium by Newton's method.
        Implicit = "implicit",
        /// Elastic joints, steps in time with damping (DEM).
        Explicit = "explicit",
    }
}

names! {
    /// What grows until the wall falls.
    LoadName {
        /// Gravity turns towards the direction.
        Tilt = "tilt",
        /// A multiple of the weight pushes in the direction.
        Lateral = "lateral",
    }
}

names! {
    /// Horizontal directions.
    DirectionName {
        /// Along the wall.
        XPlus = "x+",
        /// Along the wall, backwards.
        XMinus = "x-",
        /// Out of plane, to the front.
        YPlus = "y+",
        /// Out of plane, to the back.
        YMinus = "y-",
    }
}

names! {
    /// Flow rules of limit analysis.
    FlowName {
        /// Sliding dilates by the friction angle: an upper bound.
        Associative = "associative",
        /// Sliding does not dilate: neither a bound nor unique.
        NonAssociative = "non-associative",
    }
}

names! {
    /// Axes that may point up.
    UpName {
        /// The second one, as programs for pictures have it.
        Y = "y",
        /// The third one.
        Z = "z",
    }
}

names! {
    /// Units of length.
    UnitName {
        /// Metres.
        Metre = "m",
        /// Centimetres.
        Centimetre = "cm",
        /// Millimetres.
        Millimetre = "mm",
    }
}
