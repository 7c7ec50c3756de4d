//! The arguments of `homogenise`.

use std::num::NonZero;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::ensemble::shard::Share;
use crate::homogenise::{Direction, IN_PLANE, Method, out_of_plane};
use crate::verb::arguments::{OUTPUT, SOLUTION, Which};
use crate::verb::share;

/// Of `homogenise`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca homogenise studies/homogenisation
         pirca homogenise studies/homogenisation --arms random-heads --stones 4,8,16 --cells 100
         pirca homogenise studies/homogenisation --method associative,elastic --directions in-plane
         pirca homogenise studies/homogenisation --variant led --walls 200 --directions none

A cell repeats itself without end, and the image of a stone moves as the stone does and with the plate's strain. It writes \
homogenised.json, a line per cell (cells.csv), a line per point of its surface (surface.csv), sections of the surface (surface.svg, .png) and \
the COV against the size of the cells (scatter.svg, .png); with --walls a line per wall and plate (walls.csv) and how long each took \
(timing.csv). A mean has converged where it changes by less than its standard error as cells \
grow and sigma falls as 1/n; a mean that goes on changing is reported as an effect of size. Stopped and started again, or with more \
--cells and --walls, it goes on where it stood (cells.jsonl, walls.jsonl).

",
    codes!()
);

const CELLS: &str = "Cells";
const WALLS: &str = "Walls";

/// Arguments of `homogenise`.
#[derive(Args, Debug)]
pub(crate) struct Homogenise {
    #[command(flatten)]
    pub which: Which,
    /// Stones along a side of the cells, or along the wall x courses: 8, or 8x6. Several sizes, from small to large, show what a cell's
    /// size does; the answer is that of the largest.
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "2,4,8", value_parser = stones, help_heading = CELLS)]
    pub stones: Vec<[u32; 2]>,
    /// Random cells of each size and arm. Arms in which nothing is drawn have one.
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = clap::value_parser!(u64).range(2..=100_000), help_heading = CELLS)]
    pub cells: u64,
    /// Random walls of each arm, by limit analysis of all their stones, to compare plates with; under the study's tilt or lateral load.
    /// With --method non-associative they are analysed without dilatancy as well.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u64).range(..=100_000), help_heading = WALLS)]
    pub walls: u64,
    /// Plates of each arm, each with the strength of one of the largest cells [default: 10, or all cells if these are fewer].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000), requires = "walls", help_heading = WALLS)]
    pub plates: Option<u64>,
    /// The arms [default: all].
    #[arg(long, value_name = "ARM", value_delimiter = ',', help_heading = CELLS)]
    pub arms: Vec<String>,
    /// Number of the kn point, from 0.
    #[arg(long, value_name = "K", default_value_t = 0, help_heading = CELLS)]
    pub point: u32,
    /// Seed instead of the study's.
    #[arg(long, value_name = "S", help_heading = CELLS)]
    pub seed: Option<u64>,
    /// Stresses in which directions: the 8 of N11 and N12, the 26 of M11, M22 and M12, or none for stiffness alone.
    #[arg(long, value_name = "SET", value_delimiter = ',', default_value = "in-plane,out-of-plane", help_heading = SOLUTION)]
    pub directions: Vec<Directions>,
    /// How strength is found; several for a comparison. The other two take some ten times as long as the first.
    #[arg(long, value_name = "METHOD", value_delimiter = ',', default_value = "associative", help_heading = SOLUTION)]
    pub method: Vec<MethodName>,
    /// Vertical stress (Pa) [default: that of the stones' weight at half the wall's height]. Of dry joints with linear stiffness no
    /// result depends on it.
    #[arg(long, value_name = "PA", value_parser = crate::verb::question::level, allow_negative_numbers = true, help_heading = SOLUTION)]
    pub pressure_pa: Option<f64>,
    /// Worker threads [default: one per processor]. No result depends on their number.
    #[arg(long, value_name = "T", help_heading = SOLUTION)]
    pub threads: Option<NonZero<usize>>,
    /// Evaluate the cells and walls of one shard alone, I of N with I from 0, into a file of its own in the output folder: 3/64. When all have
    /// ended, the same command without --shard takes up what they found and answers.
    #[arg(long, value_name = "I/N", value_parser = share::parsed, help_heading = SOLUTION)]
    pub shard: Option<Share>,
    /// Output folder [default: runs/<study>-homogenised, with -<variant> in it if one is named].
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write report.html into the output folder as well: the answer on a page.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
}

/// Sets of directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Directions {
    /// Pull, push and shear in the wall's plane.
    InPlane,
    /// Bending and torsion.
    OutOfPlane,
    /// No strength.
    None,
}

impl Directions {
    /// The directions of the set.
    pub fn all(self) -> Vec<Direction> {
        match self {
            Directions::InPlane => IN_PLANE.to_vec(),
            Directions::OutOfPlane => out_of_plane(),
            Directions::None => Vec::new(),
        }
    }
}

/// Methods by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodName {
    /// Limit analysis, sliding dilates: an upper bound.
    Associative,
    /// Limit analysis, it does not: neither a bound nor unique.
    NonAssociative,
    /// The cell strained from its elastic state, without dilatancy.
    Elastic,
}

impl From<MethodName> for Method {
    fn from(name: MethodName) -> Method {
        match name {
            MethodName::Associative => Method::Associative,
            MethodName::NonAssociative => Method::NonAssociative,
            MethodName::Elastic => Method::Elastic,
        }
    }
}

/// `8` or `8x6`.
fn stones(text: &str) -> Result<[u32; 2], String> {
    let allowed = || "allowed is a whole number from 1 to 200, or two as in 8x6".to_owned();
    let count = |text: &str| text.parse().ok().filter(|n| (1..=200).contains(n)).ok_or_else(allowed);
    match text.split_once('x') {
        Some((along, courses)) => Ok([count(along)?, count(courses)?]),
        None => count(text).map(|n| [n, n]),
    }
}
