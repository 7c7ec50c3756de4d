//! Keys of a study that compares types of elements instead of walls, and of its published.toml.

use crate::study::angle::Angle;
use crate::study::keys::{POSITIVE, SHARE, SIZE, quantity, real};
use crate::study::schema::Presence::{Default, Required};
use crate::study::schema::{Interval, Key, Kind, Section};

const CLOUD: &[&str] = &["sphere_cloud"];
const ROUGH: &[&str] = &["rough_stones"];
const BLOCKS_OF_SPHERES: &[&str] = &["mesh_clumps", "compact_clumps"];
const IN_A_GRID: &[&str] = &["aligned_spheres", "mesh_clumps", "compact_clumps", "blocks"];
const COUNTED: &[&str] = &["sphere_cloud", "rough_stones", "random_polyhedra"];
const DRAWN: &[&str] = &["sphere_cloud", "random_polyhedra"];
const CELLS: &[&str] = &["random_polyhedra"];

/// Number of elements along an axis, or in all.
const COUNT: Kind = Kind::Whole { low: 1, high: 10_000 };
const DENSITY: Key =
    Key::new("density_kg_per_m3", real("kg/m3", POSITIVE), Required, "Density of what the elements fill.");
const PHI: Key = Key::new("phi_deg", real("deg", Interval::closed(0.0, 85.0)), Required, "Friction angle.")
    .angle(Angle::Friction);

/// study.toml of a study of element types.
pub static ELEMENT_STUDY: Section = Section {
    title: "study.toml of element types",
    doc: "A cube filled with one type of element after another: gravity, then a horizontal acceleration.",
    chooser: None,
    keys: &[&[
        Key::new("study", Kind::Table(&QUESTION), Required, "The question and the seed."),
        Key::new("cube", Kind::Table(&CUBE), Required, "What the elements fill."),
        Key::new("spheres", Kind::Table(&FRICTIONAL), Required, "What spheres and clumps are made of."),
        Key::new("polyhedra", Kind::Table(&JOINTED), Required, "What polyhedra are made of."),
        Key::new("shove", Kind::Table(&SHOVE), Required, "What is done to the elements."),
        Key::new("solver", Kind::Table(&STEPS), Default("{}"), "How time is stepped."),
        Key::new("element", Kind::Tables(&ELEMENT), Required, "The types of elements that are compared."),
    ]],
};

static QUESTION: Section = Section {
    title: "[study] of element types",
    doc: "The question and the seed.",
    chooser: None,
    keys: &[&[
        Key::new("question", Kind::Text, Required, "What the study asks, in words."),
        Key::new("seed", Kind::Whole { low: 0, high: u64::MAX }, Required, "Seed of all random streams."),
    ]],
};

static CUBE: Section = Section {
    title: "[cube]",
    doc: "A cube on the ground; nothing stands around it.",
    chooser: None,
    keys: &[&[Key::new("side_m", real("m", SIZE), Required, "Its side.")]],
};

static FRICTIONAL: Section = Section {
    title: "[spheres]",
    doc: "Material of spheres, clumps and the ground under them (YADE's FrictMat). Two spheres of radii r1, r2 have kn = 2 E r1 r2 / (r1 + r2) in N/m.",
    chooser: None,
    keys: &[&[
        Key::new("young_pa", real("Pa", POSITIVE), Required, "Contact modulus E.")
            .usual(Interval::closed(1e5, 1e12)),
        Key::new("ks_over_kn", real("1", SHARE), Required, "Shear over normal stiffness of a contact."),
        PHI,
        DENSITY,
    ]],
};

static JOINTED: Section = Section {
    title: "[polyhedra]",
    doc: "Material of polyhedra and the joints between them and with the ground, without cohesion.",
    chooser: None,
    keys: &[&[
        Key::new("kn_pa_per_m", real("Pa/m", POSITIVE), Required, "Normal stiffness per area of joint.")
            .usual(Interval::closed(1e6, 1e12)),
        Key::new("kn_over_ks", real("1", POSITIVE), Required, "Normal over shear stiffness."),
        PHI,
        DENSITY,
        Key::new(
            "sub_contacts",
            Kind::Pair { low: 1, high: 8 },
            Default("[2, 2]"),
            "Sub-contacts along the two in-plane axes of a joint.",
        ),
    ]],
};

static SHOVE: Section = Section {
    title: "[shove]",
    doc: "Gravity at once, then a horizontal acceleration along y at once. Each is held until the elements are at rest, one has moved away, or the steps are spent.",
    chooser: None,
    keys: &[&[
        Key::new("acceleration_m_per_s2", real("m/s2", POSITIVE), Required, "The horizontal acceleration."),
        Key::new(
            "coarse_ratio",
            real("1", Interval::open(0.0, 1.0)),
            Required,
            "Unbalanced force ratio whose first undershooting is counted.",
        ),
        Key::new(
            "fine_ratio",
            real("1", Interval::open(0.0, 1.0)),
            Required,
            "Unbalanced force ratio below which the elements are at rest, at most coarse_ratio.",
        ),
        Key::new(
            "runaway_share",
            real("1", Interval::open(0.0, 1.0)),
            Required,
            "Way of an element in the plane, as a share of the cube's side, at which the assembly has fallen.",
        ),
    ]],
};

static STEPS: Section = Section {
    title: "[solver] of element types",
    doc: "Central differences in true time, for spheres and polyhedra alike.",
    chooser: None,
    keys: &[&[
        Key::new(
            "damping",
            real("1", Interval::below(0.0, 1.0)),
            Default("0.8"),
            "Local damping coefficient.",
        ),
        Key::new(
            "step_safety",
            real("1", Interval::above(0.0, 1.0)),
            Default("0.5"),
            "Share of the critical time step.",
        ),
        Key::new(
            "skin_share",
            real("1", Interval::open(0.0, 2.0)),
            Default("0.2"),
            "How far beyond touching spheres are listed, in radii of the smallest.",
        ),
        Key::new(
            "longest_step_s",
            real("s", POSITIVE),
            Default("1e-4"),
            "Longest time step, for polyhedra that touch nothing.",
        ),
        Key::new(
            "max_steps",
            Kind::Whole { low: 1, high: 1_000_000_000_000 },
            Default("5_000_000"),
            "Steps under each load before the elements count as still moving.",
        ),
    ]],
};

/// One type of element.
pub static ELEMENT: Section = Section {
    title: "[[element]]",
    doc: "One type of element.",
    chooser: Some("arrangement"),
    keys: &[&[
        Key::new("name", Kind::Name, Required, "Its name, for tables and files."),
        Key::new(
            "arrangement",
            Kind::Choice(&[
                "aligned_spheres",
                "sphere_cloud",
                "rough_stones",
                "mesh_clumps",
                "compact_clumps",
                "blocks",
                "random_polyhedra",
            ]),
            Required,
            "Which elements, and how they are arranged.",
        ),
        Key::new("members", COUNT, Default("1"), "Assemblies, each with random numbers of its own."),
        Key::new("along_x", COUNT, Required, "Elements along x.").only(IN_A_GRID),
        Key::new("along_y", COUNT, Required, "Elements along y.").only(IN_A_GRID),
        Key::new("along_z", COUNT, Required, "Elements along z.").only(IN_A_GRID),
        Key::new("across", COUNT, Required, "Spheres across the width (y) of a block.")
            .only(BLOCKS_OF_SPHERES),
        Key::new("count", COUNT, Required, "Number of elements.").only(COUNTED),
        Key::new("radius_m", quantity("m", SIZE), Required, "Radius of a sphere.").only(CLOUD),
        Key::new(
            "per_layer",
            Kind::Pair { low: 1, high: 1000 },
            Required,
            "Stones of a layer along x and y.",
        )
        .only(ROUGH),
        Key::new(
            "core_share",
            real("1", SHARE),
            Required,
            "Radius of a stone's middle ball over half its smallest side.",
        )
        .only(ROUGH),
        Key::new(
            "corner_share",
            quantity("1", Interval::above(0.0, 1.0)),
            Required,
            "Radius of a stone's corner ball over half its smallest side.",
        )
        .only(ROUGH),
        Key::new(
            "least_distance_share",
            real("1", Interval::closed(0.0, 1.0)),
            Required,
            "Least distance of the points of two polyhedra, over the side of a cube of their mean volume.",
        )
        .only(CELLS),
        Key::new("gap_m", real("m", Interval::closed(0.0, 0.1)), Required, "Gap between polyhedra.")
            .only(CELLS),
        Key::new("max_draws", COUNT, Default("1000"), "Draws of a place before the assembly is given up.")
            .only(DRAWN),
    ]],
};

/// published.toml of a study of element types.
pub static ELEMENTS_PUBLISHED: Section = Section {
    title: "published.toml of element types",
    doc: "What others report for the same types of elements.",
    chooser: None,
    keys: &[&[Key::new("element", Kind::Tables(&REPORTED), Required, "A row of their table.")]],
};

/// A row of somebody else's table.
pub static REPORTED: Section = Section {
    title: "[[element]] in published.toml",
    doc: "One type of element in somebody else's table.",
    chooser: None,
    keys: &[&[
        Key::new("name", Kind::Name, Required, "The element of study.toml that it is compared with."),
        Key::new("source", Kind::Text, Required, "Where it stands."),
        Key::new("elements", COUNT, Required, "Number of elements."),
        Key::new("time_step_s", real("s", POSITIVE), Required, "Time step."),
        Key::new("cycles_per_s", real("1/s", POSITIVE), Required, "Cycles per second of computation."),
        Key::new("cycles", real("1", POSITIVE), Required, "Number of cycles."),
        Key::new("time_s", real("s", POSITIVE), Required, "Time of computation."),
        Key::new(
            "ends",
            Kind::Choice(&["stands", "falls_under_gravity", "falls_sideways", "not_said"]),
            Required,
            "What became of the assembly.",
        ),
        Key::new("note", Kind::Text, Default("\"-\""), "What a reader should know."),
    ]],
};
