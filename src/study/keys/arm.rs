//! Keys of `[[arm]]`: how many walls, how their stones are laid or which file holds them, wedges, limits of stones.

use crate::study::angle::Angle;
use crate::study::cause::MECHANISM;
use crate::study::keys::run::RESTRAINT;
use crate::study::keys::{BLOCK, JOINT, SHARE, SIZE, UNCERTAIN, WALL, quantity, real};
use crate::study::schema::Presence::{Default, Optional, Required, Unless};
use crate::study::schema::{Interval, Key, Kind, Section};
use crate::study::survey::MOST_ROWS;

const COURSED: &[&str] = &["coursed"];
const CUT: &[&str] = &["cut"];
const REGULAR: &[&str] = &["continuous", "discontinuous"];
const RUNNING: &[&str] = &["discontinuous"];
const RANDOM: &[&str] = &["coursed", "cut"];
/// Arrangements that are drawn, and the one that is not.
const DRAWN: &[&str] = &["continuous", "discontinuous", "coursed", "cut"];
const FROM_FILE: &[&str] = &["file"];

static UNTIL: Section = Section {
    title: "{ until = ... }",
    doc: "Walls are added until a statistic of the quantity is known well enough, at every stiffness. The walls are looked at a few \
          times, and the 95 % interval allows for that.",
    chooser: None,
    keys: &[&[
        Key::new(
            "until",
            Kind::Choice(&["half_width"]),
            Required,
            "What is to fall below a bound: half the width of the 95 % interval over the statistic.",
        ),
        Key::new("of", Kind::Statistic, Required, "The statistic."),
        Key::new("below", real("1", Interval::open(0.0, 1.0)), Required, "The bound: 0.05 is 5 %."),
        Key::new("at_most", Kind::Whole { low: 2, high: 1_000_000 }, Required, "Most walls, come what may."),
    ]],
};

/// One population of walls.
pub static ARM: Section = Section {
    title: "[[arm]]",
    doc: "One population of walls.",
    chooser: Some("arrangement"),
    keys: &[&[
        Key::new("name", Kind::Name, Required, "Name of the arm."),
        Key::new(
            "members",
            Kind::WholeOr { low: 1, high: 1_000_000, rule: &UNTIL },
            Required,
            "Number of walls, or when there are enough.",
        ),
        Key::new(
            "curve",
            Kind::Name,
            Optional,
            "Arms with the same one are drawn as a curve: drift against length over height.",
        ),
        Key::new(
            "arrangement",
            Kind::Choice(&["continuous", "discontinuous", "coursed", "cut", "file"]),
            Required,
            "Stack bond; running bond; random courses; recursive random cuts; the stones of a file.",
        ),
        Key::new(
            "file",
            Kind::WallFile,
            Required,
            "The stones, as `pirca analyse` reads them. Fixed blocks of the file hold the wall in the place of the platform; without any it \
             stands on the platform, the plane z = 0.",
        )
        .only(FROM_FILE),
        Key::new(
            "unit",
            Kind::Choice(&["m", "cm", "mm"]),
            Optional,
            "Unit of the coordinates of an OBJ file; without it m.",
        )
        .only(FROM_FILE),
        Key::new(
            "up_axis",
            Kind::Choice(&["x", "y", "z"]),
            Optional,
            "Axis of a file of meshes (.obj, .ply, .stl, .glb) that points up; without it z, of glTF y. With y, its x, y, z become x, z, -y; with x, they become z, x, y.",
        )
        .only(FROM_FILE),
        Key::new(
            "unstated_density_kg_per_m3",
            real("kg/m3", Interval::closed(10.0, 23_000.0)),
            Optional,
            "Density of the objects of an OBJ file that state none; without it 2400, with a warning.",
        )
        .only(FROM_FILE),
        Key::new(
            "flatness_m",
            real("m", Interval::above(0.0, 1.0)),
            Optional,
            "Faces whose corners lie up to this far off their plane are made plane; without it 1e-4 of a block is allowed, and nothing moves.",
        )
        .only(FROM_FILE),
        Key::new(
            "thickness_m",
            real("m", Interval::above(0.0, 25.0)),
            Optional,
            "How deep the stones of an elevation are: of a drawing, of a picture, of a table that says nothing of it.",
        )
        .only(FROM_FILE),
        Key::new(
            "pixel_m",
            real("m", Interval::above(0.0, 1.0)),
            Optional,
            "Size of a pixel of a picture.",
        )
        .only(FROM_FILE),
        Key::new(
            "width_m",
            real("m", Interval::above(0.0, 1000.0)),
            Optional,
            "Length of all stones of a drawing or a picture together.",
        )
        .only(FROM_FILE),
        Key::new(
            "section",
            Kind::Flag,
            Optional,
            "Whether a drawing or a picture shows the wall in section, its front to the right: a slice as long as thickness_m, or 1 m.",
        )
        .only(FROM_FILE),
        Key::new(
            "parts",
            Kind::Flag,
            Optional,
            "Whether concave blocks are divided into convex parts of one stone, which fill it exactly; without it they are refused.",
        )
        .only(FROM_FILE),
        Key::new(
            "fixed",
            Kind::Reals { unit: "1", within: Interval::closed(0.0, 1e15), at_most: 1000, ascending: true },
            Optional,
            "Ids of blocks that are fixed besides those that the file fixes.",
        )
        .only(FROM_FILE),
        Key::new(
            "mend_m",
            real("m", Interval::above(0.0, 1.0)),
            Optional,
            "Faces of neighbours that belong together and are up to this far apart, or overlap by as much, become one plane; what was done is told. Joints \
             of a drawing or a picture are closed where they are up to this wide.",
        )
        .only(FROM_FILE),
        Key::new(
            "scan_bearing_m",
            real("m", Interval::above(0.0, 1.0)),
            Optional,
            "The objects of an OBJ file are scans of stones: each touches others as its hull, weighs as its scan, and bears up to this far above its \
             lowest point.",
        )
        .only(FROM_FILE),
        Key::new(
            "turn_deg",
            real("deg", Interval::closed(-360.0, 360.0)),
            Optional,
            "Turns the whole file about its z axis, counter-clockwise seen from above.",
        )
        .only(FROM_FILE),
        Key::new(
            "touch_tolerance_m",
            real("m", Interval::above(0.0, 1.0)),
            Optional,
            "Blocks closer than this touch, at most a tenth of a stone; without it 1e-6 of the size of what moves, corner to corner.",
        )
        .only(FROM_FILE),
        Key::new("block_length_m", real("m", SIZE), Required, "Stone length.").only(REGULAR),
        Key::new("course_height_m", real("m", SIZE), Required, "Course height.").only(REGULAR),
        Key::new(
            "overlap",
            real("1", Interval::open(0.0, 1.0)),
            Required,
            "Shift of every other course as a share of the stone length.",
        )
        .only(RUNNING),
        Key::new(
            "length_m",
            quantity("m", SIZE),
            Unless("stones"),
            "Stone length, drawn per stone or cut.",
        )
        .only(RANDOM),
        Key::new("height_m", quantity("m", SIZE), Unless("stones"), "Height, drawn per course or cut.")
            .only(RANDOM),
        Key::new(
            "stones",
            Kind::Stones { within: SIZE, at_most: MOST_ROWS },
            Optional,
            "Stones of a survey, length and height drawn together, in the place of length_m and height_m. Each cut takes both from \
             one stone; each course takes its height from one, and its lengths from stones of like height.",
        )
        .only(RANDOM),
        Key::new(
            "wall_size_factor",
            quantity("1", Interval::above(0.0, 100.0)),
            Default("1"),
            "Factor on all sizes of one wall, drawn once per wall.",
        )
        .only(RANDOM),
        Key::new(
            "dip_deg",
            quantity("deg", Interval::closed(-45.0, 45.0)),
            Default("{ family = \"uniform\", low = -20, high = 20 }"),
            "Dip of the bed joints, drawn per bed or cut.",
        )
        .only(RANDOM)
        .angle(Angle::Dip),
        Key::new(
            "least_overlap",
            real("1", Interval::below(0.0, 0.5)),
            Default("0.2"),
            "Head joints of neighbouring courses closer than this share of the mean stone length are redrawn; of stones of a survey it is the \
             mean of the course with the shorter ones.",
        )
        .only(COURSED),
        Key::new(
            "dip_about",
            Kind::Choice(&["long_axis", "thickness_axis", "both"]),
            Required,
            "About which axis the bed planes dip.",
        )
        .only(CUT),
        Key::new(
            "vertical_load_n",
            real("N", Interval::above(0.0, 1e9)),
            Optional,
            "Vertical load of this arm's walls instead of load.vertical_load_n, where they are sheared.",
        ),
        Key::new("wall", Kind::Table(&WALL), Optional, "What this arm says otherwise than [wall].").only(DRAWN),
        Key::new(
            "block",
            Kind::Table(&BLOCK),
            Optional,
            "What this arm says otherwise than [block]. Of a file, the mean density of its stones, which keep their ratios; without it the \
             file's.",
        ),
        Key::new("joint", Kind::Table(&JOINT), Optional, "What this arm says otherwise than [joint]."),
        Key::new(
            "restraint",
            Kind::Table(&RESTRAINT),
            Optional,
            "What this arm says otherwise than [restraint].",
        ),
        Key::new(
            "mechanism",
            Kind::Table(&MECHANISM),
            Optional,
            "What this arm says otherwise than [mechanism].",
        ),
        Key::new(
            "uncertain",
            Kind::Table(&UNCERTAIN),
            Optional,
            "What this arm says otherwise than [uncertain].",
        ),
        Key::new(
            "unseen",
            Kind::Table(&UNSEEN),
            Optional,
            "What the face of a wall does not show, drawn for each wall: for drawings, pictures and tables of a face.",
        )
        .only(FROM_FILE),
        Key::new("wedges", Kind::Table(&WEDGES), Optional, "Wedge stones cut into bed joints.").only(DRAWN),
        Key::new("limits", Kind::Table(&LIMITS), Default("{}"), "What a stone must at least be.").only(DRAWN),
    ]],
};

static UNSEEN: Section = Section {
    title: "[arm.unseen]",
    doc: "What the face of a wall does not show, drawn for each wall. The face stays as the file shows it; the pattern of a stone is the same in front and behind.",
    chooser: None,
    keys: &[&[
        Key::new(
            "through_share",
            quantity("1", Interval::closed(0.0, 1.0)),
            Default("{ family = \"uniform\", low = 0, high = 0.3 }"),
            "Share of the stones that go through the wall, drawn once per wall; stones that the file marks as headers do in every wall. The default is a judgement: from a wall without throughs to one with \
             a through in every square metre of small stones.",
        ),
        Key::new(
            "depth_share",
            quantity("1", Interval::closed(0.05, 0.95)),
            Default("{ family = \"uniform\", low = 0.35, high = 0.65 }"),
            "Depth of the other stones as a share of the thickness without the core, drawn per stone; a stone behind each has the rest. The default is a \
             judgement: two leaves that interlock.",
        ),
        Key::new(
            "core_share",
            quantity("1", Interval::closed(0.0, 0.8)),
            Default("0"),
            "Thickness of the core as a share of the wall's, drawn once per wall. It lies between the stones that do not go through and counts as empty: \
             a loose core bears nothing, and its weight is left out.",
        ),
        Key::new(
            "dip_deg",
            quantity("deg", Interval::closed(-20.0, 20.0)),
            Default("0"),
            "Dip of all beds through the wall, drawn once per wall: above 0 they rise away from the face.",
        )
        .angle(Angle::Dip),
    ]],
};

static WEDGES: Section = Section {
    title: "[arm.wedges]",
    doc: "Wedge stones cut into bed joints from a face of the wall.",
    chooser: None,
    keys: &[&[
        Key::new(
            "share",
            real("1", SHARE),
            Required,
            "Share of stones above the first course that get a wedge.",
        ),
        Key::new("height_m", quantity("m", SIZE), Required, "Height of a wedge at the face."),
        Key::new("depth_m", quantity("m", SIZE), Required, "Depth of a wedge into the wall."),
    ]],
};

static LIMITS: Section = Section {
    title: "[arm.limits]",
    doc: "What a stone must at least be, and how often a member may try.",
    chooser: None,
    keys: &[&[
        Key::new(
            "min_size_m",
            real("m", SIZE),
            Default("0.02"),
            "Smallest width of a stone over its face normals.",
        ),
        Key::new(
            "max_aspect",
            real("1", Interval::closed(1.0, 1000.0)),
            Default("40"),
            "Largest ratio of a stone's diameter to its smallest width.",
        ),
        Key::new(
            "min_volume_m3",
            real("m3", Interval::above(0.0, 1.0)),
            Default("1e-6"),
            "Smallest volume of a stone or wedge.",
        ),
        Key::new(
            "max_redraws",
            Kind::Whole { low: 1, high: 100_000 },
            Default("200"),
            "Redraws of a bed, a length, a cut or a wedge before the whole wall starts again.",
        ),
        Key::new(
            "max_attempts",
            Kind::Whole { low: 1, high: 100_000 },
            Default("50"),
            "Fresh starts of the whole wall before it is an invalid geometry.",
        ),
    ]],
};
