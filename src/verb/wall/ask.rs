//! Arguments and help of `wall`: which wall of a study, and what of it is written.

use std::path::PathBuf;

use clap::Args;

use crate::verb::arguments::{OUTPUT, WALL, Which};
use crate::verb::wall::drawn::Measure;

/// Of `wall`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca wall studies/tilting-table --arm sbl --out wall.svg
         pirca wall studies/tilting-table --arm sbl --out wall.svg --series fall --frames fall/frames
         pirca wall studies/joint-arrangement --arm irregular --member 17 --out wall.vtu
         pirca wall studies/tilting-block --with-base --out wall.json   (for pirca analyse)

A picture shows the wall as it falls: the last state at rest in true size, the movement of the fall magnified. A wall that does not \
fall is drawn at rest, with its displacements magnified. Every way a wall can end is drawn, and ends with 0. \
The other formats hold its stones as built.

--frames and --series show the wall in at most 100 states: those at rest as the load grows, and where it falls up to 40 more in which \
the explicit solver lets it fall from the last one at rest, until a stone has gone 0.3 of the wall's height. Limit analysis has the \
mechanism further and further instead. A fall is in true size unless --magnify says otherwise.

",
    codes!(),
    "\nA wall whose geometry is invalid ends with 1 and the reason."
);

/// Headings of the options that belong to one kind of file.
const PICTURE: &str = "Picture (.svg)";
const GEOMETRY: &str = "Geometry (.vtu, .obj, .json)";

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

/// Arguments of `wall`.
#[derive(Args, Debug)]
pub(crate) struct Wall {
    #[command(flatten)]
    pub which: Which,
    #[command(flatten)]
    pub wall: OneWall,
    /// File to write; its ending says what: .svg is a picture, .vtu is for ParaView, .obj and .json are for other programs.
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    pub out: PathBuf,
    /// What joints are coloured by [default: opening].
    #[arg(long, value_name = "NAME", help_heading = PICTURE)]
    pub colour: Option<Measure>,
    /// Magnification of the movement, above 0 [default: so that the largest one is a tenth of the wall's height].
    #[arg(long, value_name = "X", value_parser = magnification, allow_negative_numbers = true, help_heading = PICTURE)]
    pub magnify: Option<f64>,
    /// Folder for pictures of the wall in every state from rest through the collapse: frame-000.svg, frame-001.svg, ...
    #[arg(long, value_name = "DIR", help_heading = PICTURE)]
    pub frames: Option<PathBuf>,
    /// Folder for the same states in three dimensions: series for ParaView (wall.pvd, joints.pvd), an animation (wall.glb), and the wall
    /// at rest and at the end as OBJ.
    #[arg(long, value_name = "DIR", help_heading = PICTURE)]
    pub series: Option<PathBuf>,
    /// Solve the wall as `run` does, and write the displacements (m) of all corners and of every stone's centroid into the .vtu.
    #[arg(long, help_heading = GEOMETRY)]
    pub solved: bool,
    /// Add the ground: a fixed block under the wall, as `run` puts one there and `analyse` needs one.
    #[arg(long, conflicts_with = "solved", help_heading = GEOMETRY)]
    pub with_base: bool,
}

/// A magnification: above 0, and no more than anything could need.
fn magnification(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 1e6 => Ok(x),
        _ => Err("allowed is a number above 0, up to 1000000".to_string()),
    }
}
