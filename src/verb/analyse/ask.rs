//! The arguments of `analyse`, as clap reads them; their docstrings are the help.

use std::path::PathBuf;

use clap::{ArgGroup, Args, ValueEnum};

use crate::protocol::Direction;
use crate::solve::explicit::Rayleigh;
use crate::study::Tolerance;
use crate::verb::analyse::held::ask::Behind;
use crate::verb::analyse::known::Known;
use crate::verb::analyse::{known, numbers};
use crate::verb::arguments::{FILE, JOINTS, LOAD, OUTPUT, SOLUTION, SolverName, names};
use crate::verb::demand::DemandOptions;
use crate::verb::question;
use crate::verb::run::page::PAGE;
use crate::verb::wall::drawn::Measure;

/// Of `analyse`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca analyse wall.json --phi-deg 30
         pirca analyse arch.obj --unit mm --density-kg-per-m3 2300 --phi-deg 35
         pirca analyse wall.json --phi-deg 35 --solver explicit --kn 1e9 --json
         pirca analyse wall.json --phi-deg 35 --worst-direction --out seen
         pirca analyse wall.json --phi-deg 35 --load lateral --vertical 0.3 --dead-load 12=1500
         pirca analyse wall.json --phi-deg 35 --solver implicit --kn 1e9 --settle 0=0.01
         pirca analyse wall.json --phi-deg 35 --load fill --fill-density 1800 --fill-phi-deg 35 --wall-friction 0.67
         pirca analyse wall.json --phi-deg 35 --solver nonsmooth --fclib step.json --at-deg 5
         pirca analyse wall.json --phi-deg 30..38 --solver implicit --kn 5e7..5e8 --density normal(2200,80)
         pirca analyse wall.json --phi-deg 30..38 --study my-wall

Ranges: of --phi-deg, --kn and --density a number, LOW..HIGH, or uniform(low, high), triangular(low, mode, high), normal(mean, sd), \
lognormal(mean, sd), truncated_normal(mean, sd, low, high), truncated_lognormal(median, log_sd, low, high). The wall is then solved \
with the middle values, at the ends of each parameter (the 5 and 95 % points of a distribution), and over a design. With --out the \
evaluations are in uncertainty.csv, .svg and .png.

wall.json: {\"unit\": \"m\", \"blocks\": [{\"id\": 0, \"vertices\": [[x, y, z], ...], \"faces\": [[i, j, k, ...], ...], \
\"density\": 2400, \"fixed\": false, \"tag\": \"stone\", \"group\": \"keystone\"}, ...]}. Convex blocks; faces count their \
block's vertices from 0, counter-clockwise seen from outside; z up. unit: m (default), cm, mm. density in kg/m^3, not needed where \
fixed is true. fixed (default false): a support. tag: stone, header, wedge, base, end or a word of your own; may be left out. group: \
blocks of the same group are one rigid body: divide a concave stone into convex parts. May be left out.

OBJ: one object (o, or g without any o) per block, z up (or --up y). A name that comes again goes on with the same block, unless each \
piece is a closed solid. A block is fixed when a word of its name is base, end, fixed, ground or support (base_0, \
Left_support.001). Objects keystone.part1, keystone.part2, ... are one rigid body. A comment \"# density 2400 kg/m^3\" holds for the \
next object.

Meshes (.ply, .stl, .glb, .gltf; a folder with such a file, or an .obj file, for each stone): what is not convex touches as its hull and \
weighs as its mesh, or is divided by --parts. In glTF (.glb, .gltf) each node with a mesh is a stone, and y is up. Without fixed blocks the lowest stone lies on the plane z = 0.

3DEC (.3ddat, .dat): blocks by poly or block create brick, prism, polyhedron, tetrahedron, held by fix where its range says exactly which. What else makes \
or changes blocks (functions of FISH, jset, cut, call) is refused with its line.

Table (.csv, .xlsx): a row per stone of an elevation, with the columns x, z (left end, underside), length, height, and where known depth, dip (deg), \
density (kg/m3), name; units in the head, as \"Length (cm)\". The stones stand on the plane z = 0. --mend closes what was measured apart.

Drawing (.dxf, .svg, .geojson): a closed outline around each stone of an elevation; layers, groups or properties called ground or opening are that. \
It needs --thickness; --mend closes the joints.

Picture (.png, .tif, .jpg): an elevation with one colour per stone, or light stones and dark joints. It needs --thickness, and --pixel or --width; \
--mend closes the joints.

COMPAS: JSON of an assembly, a block for each node; --fixed says which are supports where the file does not.

In all, triangles of one plane are merged into faces; corners within 1e-4 of the block are one, also where each face has its own, \
and a corner may lie on the edge of another face. Joints have no tensile strength. Limits: 64 MiB, 50000 blocks, 2000 vertices and \
faces of a block in the file, 200 corners after merging; stones of 1 mm to 25 m; faces plane and convex to 1e-4 of the block (more \
with --flatness); overlaps up to 1 % of the smaller block, other than among the parts of a group.

",
    codes!(),
    "\nEvery way a wall can end (stable, collapsed, unstable at rest, not converged) ends with 0."
);

/// What shows a wall: its folder, or its page alone.
const SEEN: &str = "seen";

/// Arguments of `analyse`.
#[derive(Clone, Args, Debug)]
#[command(group(ArgGroup::new(SEEN).args(["out", "report"]).multiple(true)))]
pub(crate) struct Analyse {
    /// The wall: a file (.json, .obj, .ply, .stl, .glb, .gltf, .3ddat), a drawing of its face (.dxf, .svg, .geojson), a picture (.png, .tif, .jpg), a table (.csv, .xlsx), or
    /// a folder with a mesh for each stone.
    pub wall: PathBuf,
    /// Solver. Limit analysis and contact dynamics take rigid blocks and need no stiffness. Several as limit,implicit,nonsmooth: the first
    /// answers, the others say what they find, and a sentence how they stand to each other.
    #[arg(long = "solver", value_name = "NAME,..", value_delimiter = ',', default_value = "limit", help_heading = SOLUTION)]
    pub solvers: Vec<SolverName>,
    /// Load: gravity turns towards the direction (to at most 89 deg); a multiple of the weight pushes there (to at most 10); the ground
    /// moves as --record says, for nonsmooth and explicit; fill or water rises behind the wall; a pressure on its back or a load on its crest grows
    /// (to at most 10 times).
    #[arg(long, value_name = "NAME", default_value = "tilt", help_heading = LOAD)]
    pub load: LoadName,
    /// Direction of the load: x+, x-, y+ or y-, or an angle in degrees from x+, counter-clockwise seen from above (90 is y+).
    #[arg(
        long,
        value_name = "NAME|DEG",
        default_value = "y+",
        value_parser = numbers::direction,
        allow_negative_numbers = true,
        help_heading = LOAD
    )]
    pub direction: Direction,
    /// Look for the horizontal direction in which the wall bears least, and answer for that one.
    #[arg(long, conflicts_with = "direction", help_heading = LOAD)]
    pub worst_direction: bool,
    /// Record of the ground's motion, for --load base-motion: PEER .AT2, ESM, ITACA or K-NET ASCII, COSMOS or CSMIP V2,
    /// or CSV whose heads state their units (t_s, a_g, ax_m_per_s2, ...). Its y axis, or its only component, is turned to --direction.
    /// For several records, several times: a table.
    #[arg(long = "record", value_name = "FILE", help_heading = LOAD)]
    pub records: Vec<PathBuf>,
    /// Factor on the records, or several as 0.5,1,1.5: each record at each of them [default: 1].
    #[arg(long = "scale", value_name = "X,..", value_parser = numbers::scale, value_delimiter = ',', requires = "records", help_heading = LOAD)]
    pub scales: Vec<f64>,
    /// Restitution of contact dynamics under a base motion: the share of the closing speed with which joints part again, 0 to 1. With many
    /// contacts at once it may gain energy [default: 0].
    #[arg(long, value_name = "E", value_parser = numbers::restitution, requires = "records", allow_negative_numbers = true, help_heading = LOAD)]
    pub restitution: Option<f64>,
    /// Lean of the ground under a base motion (deg), the wall with it: a plane that is lower towards --lean-direction. Records stay level
    /// [default: 0].
    #[arg(long, value_name = "DEG", value_parser = numbers::lean, requires = "records", allow_negative_numbers = true, help_heading = LOAD)]
    pub lean_deg: Option<f64>,
    /// The side towards which the leaning ground is lower, as --direction [default: that of --direction].
    #[arg(
        long,
        value_name = "NAME|DEG",
        value_parser = numbers::direction,
        requires = "lean_deg",
        allow_negative_numbers = true,
        help_heading = LOAD
    )]
    pub lean_direction: Option<Direction>,
    /// Follow a wall under a base motion once. Without it a second run, started 1e-9 m/s off rest, tells what chance decides.
    #[arg(long, requires = "records", help_heading = LOAD)]
    pub once: bool,
    /// Rayleigh damping of the explicit solver: a share of critical at two frequencies (Hz), as 0.05,1,10. Its part in proportion to mass slows
    /// toppling; 0,1,10 is none [default: half of critical where a stone swings in its joints, in proportion to stiffness alone].
    #[arg(long, value_name = "RATIO,HZ,HZ", value_parser = numbers::rayleigh, requires = "records", help_heading = LOAD)]
    pub rayleigh: Option<Rayleigh>,
    /// Time step of contact dynamics under a base motion (s) [default: 0.002].
    #[arg(long, value_name = "S", value_parser = numbers::time_step, requires = "records", help_heading = LOAD)]
    pub time_step: Option<f64>,
    /// Vertical share of --load lateral: a multiplier x pushes with V x times the weight upwards besides, which lightens the wall;
    /// downwards where V is below 0. A number from -2 to 2 [default: 0].
    #[arg(long, value_name = "V", value_parser = numbers::vertical, allow_negative_numbers = true, help_heading = LOAD)]
    pub vertical: Option<f64>,
    /// A weight (N) that rests on a block that moves, at its centroid, as of a roof or a floor: it turns and pushes with the load
    /// as the block's own weight does. For several blocks, several times.
    #[arg(
        long = "dead-load",
        value_name = "ID=N",
        value_parser = numbers::dead_load,
        allow_negative_numbers = true,
        help_heading = LOAD
    )]
    pub dead_loads: Vec<(u64, f64)>,
    /// A fixed block that goes down by so many metres, gradually, under the wall at rest before the load grows; for implicit and
    /// explicit. For several supports, several times: they go down together.
    #[arg(
        long = "settle",
        value_name = "ID=M",
        value_parser = numbers::settlement,
        allow_negative_numbers = true,
        help_heading = LOAD
    )]
    pub settlements: Vec<(u64, f64)>,
    #[command(flatten)]
    pub demanded: DemandOptions,
    /// Check the mechanism under a horizontal load towards --direction as a code asks for it, by acceleration and by displacement, against
    /// the ground and the place that this file states (`pirca reference keys`, site.toml).
    #[arg(long, value_name = "SITE.toml", help_heading = "Demand")]
    pub verify: Option<PathBuf>,
    #[command(flatten)]
    pub behind: Behind,
    /// Friction angle of the joints (deg), 0 to 89: a number, a range 30..38, or a distribution as normal(34,2). The default is the range of published
    /// joints of stone (distributions/joint/friction.toml).
    #[arg(long, value_name = "F|LOW..HIGH", default_value = known::USUAL_FRICTION, value_parser = known::friction_angle, allow_negative_numbers = true, help_heading = JOINTS)]
    pub phi_deg: Known,
    /// Normal stiffness of the joints per area (Pa/m), for implicit and explicit: a number, a range 5e7..5e8 (even in the logarithm), or a
    /// distribution as lognormal(1e8,3e7) [default for implicit: 5e7..1e9, the range of published joints, distributions/joint/stiffness.toml].
    #[arg(long, value_name = "PA_PER_M", value_parser = known::stiffness, allow_negative_numbers = true, help_heading = JOINTS)]
    pub kn: Option<Known>,
    /// Shear stiffness of the joints per area (Pa/m) [default: kn / 2].
    #[arg(long, value_name = "PA_PER_M", value_parser = numbers::stiffness, allow_negative_numbers = true, help_heading = JOINTS)]
    pub ks: Option<f64>,
    /// Cohesion of the joints (Pa).
    #[arg(long, value_name = "PA", default_value = "0", value_parser = numbers::cohesion, allow_negative_numbers = true, help_heading = JOINTS)]
    pub cohesion: f64,
    /// Whether joints dilate when they slide, for limit analysis [default: associative, an upper bound].
    #[arg(long, value_name = "NAME", help_heading = SOLUTION)]
    pub flow: Option<FlowName>,
    /// Step of the tilt (deg), but for limit [default: 0.5]; with --load lateral its tangent is the step.
    #[arg(long, value_name = "F", value_parser = numbers::step, allow_negative_numbers = true, help_heading = LOAD)]
    pub step_deg: Option<f64>,
    /// Blocks closer than this touch, for all solvers: a length with its unit (2mm, 0.5cm, 0.002 m; at most a tenth of a stone), or a
    /// share of the size of what moves, corner to corner (1e-12 to 0.001). Wider gaps carry nothing until they close. Deeper overlaps are
    /// told, and wider gaps up to a tenth of a stone.
    #[arg(long, value_name = "LENGTH", default_value = "1e-6", value_parser = numbers::tolerance, allow_negative_numbers = true, help_heading = FILE)]
    pub touch_tolerance: Tolerance,
    /// Make faces plane whose corners lie up to this length off their plane (2mm), or 1/20 of their block if that is less; how far
    /// corners were moved is told [default: 1e-4 of a block is allowed, and nothing is moved].
    #[arg(long, value_name = "LENGTH", value_parser = numbers::length, allow_negative_numbers = true, help_heading = FILE)]
    pub flatness: Option<f64>,
    /// Mend a wall whose corners are off by up to some length (3mm): faces that belong together and are up to this length apart, or overlap by as
    /// much, become one plane, as every joint of the solvers is. No face moves further; what was done is told stone by stone. Joints of a drawing
    /// or a picture are closed where they are up to this wide, each half to one of its stones [default of a picture: 3 pixels].
    #[arg(long, value_name = "LENGTH", value_parser = numbers::length, allow_negative_numbers = true, help_heading = FILE)]
    pub mend: Option<f64>,
    /// How deep the stones of an elevation are: of a drawing, of a picture, of a table that says nothing of it (45cm).
    #[arg(long, value_name = "LENGTH", value_parser = numbers::size, allow_negative_numbers = true, help_heading = FILE)]
    pub thickness: Option<f64>,
    /// Size of a pixel of a picture (2mm).
    #[arg(long, value_name = "LENGTH", value_parser = numbers::length, allow_negative_numbers = true, conflicts_with = "width", help_heading = FILE)]
    pub pixel: Option<f64>,
    /// Length of all stones of a drawing or a picture together (3.2m).
    #[arg(long, value_name = "LENGTH", value_parser = numbers::size, allow_negative_numbers = true, help_heading = FILE)]
    pub width: Option<f64>,
    /// The drawing or the picture shows the wall in section, its front to the right: a slice as long as --thickness says [default: 1m].
    #[arg(long, help_heading = FILE)]
    pub section: bool,
    /// Divide concave blocks into convex parts of one stone, which fill it exactly [default: they are refused].
    #[arg(long, help_heading = FILE)]
    pub parts: bool,
    /// Fix these blocks besides those that the file fixes, by their ids: as 0,3.
    #[arg(long, value_name = "ID,..", value_delimiter = ',', help_heading = FILE)]
    pub fixed: Vec<u64>,
    /// Take the objects of an OBJ file for scans of stones: each touches others as its convex hull, and weighs as its scan. A rough
    /// underside bears up to this length above its lowest point (5mm). Without fixed blocks the stones stand on the plane z = 0.
    #[arg(long, value_name = "LENGTH", value_parser = numbers::length, allow_negative_numbers = true, help_heading = FILE)]
    pub scan_bearing: Option<f64>,
    /// Axis of a file of meshes (.obj, .ply, .stl, .glb) that points up [default: z; of glTF y]. With y, its x, y, z become x, z, -y: its -z is out of plane, to the
    /// front. With x, they become z, x, y.
    #[arg(long, value_name = "NAME", help_heading = FILE)]
    pub up: Option<UpName>,
    /// Unit of the coordinates of a file that states none: a mesh, a drawing, a table [default: m].
    #[arg(long, value_name = "NAME", help_heading = FILE)]
    pub unit: Option<UnitName>,
    /// Density (kg/m^3) of the objects of an OBJ file that have no density comment [default: 2400, with a warning].
    #[arg(long, value_name = "F", value_parser = numbers::density, allow_negative_numbers = true, help_heading = FILE)]
    pub density_kg_per_m3: Option<f64>,
    /// Mean density (kg/m^3) of the blocks that move, in the place of the file's: all are made as much heavier or lighter. A number, a
    /// range 2000..2400, or a distribution as normal(2200,80).
    #[arg(long, value_name = "F|LOW..HIGH", value_parser = known::density, allow_negative_numbers = true, help_heading = FILE)]
    pub density: Option<Known>,
    /// Walls that are solved over ranges and distributions: a multiple of 16 from 32 [default: 64].
    #[arg(long, value_name = "N", value_parser = question::points, help_heading = SOLUTION)]
    pub walls: Option<u64>,
    /// Seed of the design over ranges and distributions [default: 1].
    #[arg(long, value_name = "N", help_heading = SOLUTION)]
    pub seed: Option<u64>,
    /// Folder for a page of it all (report.html), a picture of the mechanism, the way from rest through the collapse for ParaView (.pvd,
    /// .vtu), as animation (.glb) and as .obj, and tables of blocks and joints (.csv, .json).
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub out: Option<PathBuf>,
    /// Write the page of it all without its folder, as <wall>-report.html here. With --out it is in that folder anyway.
    #[arg(long, help_heading = OUTPUT)]
    pub report: bool,
    /// Where the page goes without its folder, if not here.
    #[arg(skip)]
    pub page: Option<PathBuf>,
    /// Write the contact problem of one step of contact dynamics, 2 ms from rest in the wall as built, as JSON: masses M, H, f, w and
    /// friction mu of an FCLib global problem, M v = H r + f and u = H^T v + w, as triplets in SI units, with a solution v, u, r and
    /// its residual. For dry joints. FCLib keeps such problems in HDF5, which this program does not write: it would need a library
    /// of the system.
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    pub fclib: Option<PathBuf>,
    /// Tilt (deg) at which --fclib writes it [default: the last that the wall bears]; with --load lateral its tangent is the multiplier.
    #[arg(
        long,
        value_name = "F",
        value_parser = numbers::tilt,
        requires = "fclib",
        allow_negative_numbers = true,
        help_heading = OUTPUT
    )]
    pub at_deg: Option<f64>,
    /// Folder for the same question as a study, with a copy of the wall: run, capacity, sensitivity, compare and shard then take it. Ranges
    /// become distributions of [uncertain], and --walls its number of walls. For a tilt.
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    pub study: Option<PathBuf>,
    /// What joints are coloured by in the picture.
    #[arg(long, value_name = "NAME", default_value = "opening", requires = SEEN, help_heading = OUTPUT)]
    pub colour: Measure,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

impl Analyse {
    /// The solver that answers.
    pub fn solver(&self) -> SolverName {
        self.solvers.first().copied().unwrap_or(SolverName::Limit)
    }

    /// What grows until the wall falls. Under a base motion nothing does, and nobody asks.
    pub fn growing(&self) -> Growing {
        match self.load {
            LoadName::Tilt | LoadName::BaseMotion => Growing::Tilt,
            LoadName::Lateral => Growing::Lateral,
            LoadName::Fill | LoadName::Water => Growing::Height,
            LoadName::Pressure | LoadName::Point => Growing::Factor,
        }
    }

    /// Where its page is written without its folder, if it is.
    pub fn page_alone(&self) -> Option<PathBuf> {
        let stem = self.wall.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let here = || PathBuf::from(format!("{stem}-{PAGE}"));
        (self.report && self.out.is_none()).then(|| self.page.clone().unwrap_or_else(here))
    }

    /// What the wall is called: the name of its file.
    pub fn title(&self) -> String {
        self.wall.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    }
}

names! {
    /// What the wall is under.
    LoadName {
        /// Gravity turns towards the direction.
        Tilt = "tilt",
        /// A multiple of the weight pushes in the direction.
        Lateral = "lateral",
        /// The ground moves as a record says.
        BaseMotion = "base-motion",
        /// Soil rises behind the wall.
        Fill = "fill",
        /// Water rises behind the wall.
        Water = "water",
        /// A pressure on its back grows.
        Pressure = "pressure",
        /// A force on its crest grows.
        Point = "point",
    }
}

/// What grows until the wall falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Growing {
    /// The tilt of gravity.
    Tilt,
    /// The multiple of the weight.
    Lateral,
    /// The height of what is behind the wall.
    Height,
    /// The factor on a pressure or a force.
    Factor,
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
        /// The first one.
        X = "x",
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
