//! Every key of study.toml, published.toml and the files below `distributions`: name, kind, unit, range, default, meaning.
//! What is done to a wall, and by which solver, is in `run`; statements of others are in `published`.

mod arm;
mod base_motion;
mod elements;
mod published;
mod run;
mod site;
mod uncertain;

pub use arm::ARM;
pub use elements::{ELEMENT, ELEMENT_STUDY, ELEMENTS_PUBLISHED, REPORTED};
pub use published::{CLAIM, PUBLISHED};
pub use run::SOLVER;
pub use site::{MODE, SITE};
pub use uncertain::UNCERTAIN;

use crate::law::{MOST_KNOTS, MOST_SEATS};
use crate::study::angle::Angle;
use crate::study::cause::MECHANISM;
use crate::study::keys::run::{LOAD, RESTRAINT};
use crate::study::schema::Presence::{Default, Optional, Required};
use crate::study::schema::{Interval, Key, Kind, Section};
use crate::study::survey::MOST_ROWS;

/// A length above 0 (m); a kilometre is a slip of the unit.
pub(super) const SIZE: Interval = Interval::above(0.0, 1000.0);
pub(super) const SHARE: Interval = Interval::closed(0.0, 1.0);
const POSITIVE: Interval = Interval::open(0.0, f64::INFINITY);

pub(super) const fn real(unit: &'static str, within: Interval) -> Kind {
    Kind::Real { unit, within }
}

const fn quantity(unit: &'static str, within: Interval) -> Kind {
    Kind::Quantity { unit, within }
}

/// study.toml as a whole.
pub static STUDY: Section = Section {
    title: "study.toml",
    doc: "What is asked, of which walls, under which load, with which solver.",
    chooser: None,
    keys: &[&[
        Key::new("study", Kind::Table(&QUESTION), Required, "The question and the seed."),
        Key::new(
            "wall",
            Kind::Table(&WALL),
            Optional,
            "The outer shape of every arm that has no [arm.wall]. It must be there, unless all arms are files.",
        ),
        Key::new(
            "block",
            Kind::Table(&BLOCK),
            Optional,
            "The stones' material. It must be there, unless all arms are files.",
        ),
        Key::new("joint", Kind::Table(&JOINT), Required, "The joints' properties."),
        Key::new("load", Kind::Table(&LOAD), Required, "What is done to each wall."),
        Key::new("restraint", Kind::Table(&RESTRAINT), Required, "How base and ends are held."),
        Key::new(
            "mechanism",
            Kind::Table(&MECHANISM),
            Optional,
            "Mechanisms that the base model leaves out.",
        ),
        Key::new(
            "uncertain",
            Kind::Table(&UNCERTAIN),
            Optional,
            "What nobody knows exactly of a wall as a whole, drawn once per wall.",
        ),
        Key::new("solver", Kind::Table(&SOLVER), Default("{}"), "Which solver, with its settings."),
        Key::new("arm", Kind::Tables(&ARM), Required, "The populations of walls that are compared."),
        Key::new(
            "sweep",
            Kind::Settings,
            Optional,
            "Paths of keys with lists of values, as \"joint.phi_deg\" = [25, 30, 35]: every arm is evaluated at each of them; several keys are \
             crossed.",
        ),
        Key::new("variant", Kind::Tables(&VARIANT), Optional, "Other readings of the study, chosen by name."),
    ]],
};

static QUESTION: Section = Section {
    title: "[study]",
    doc: "The question and the seed.",
    chooser: None,
    keys: &[&[
        Key::new("question", Kind::Text, Required, "What the study asks, in words."),
        Key::new("seed", Kind::Whole { low: 0, high: u64::MAX }, Required, "Seed of all random streams."),
        Key::new("arms", Kind::Names, Optional, "The arms that are evaluated; without it all of them."),
        Key::new(
            "design",
            Kind::Choice(&["plain", "latin_hypercube", "sobol"]),
            Optional,
            "How what is drawn once per wall covers its space, in 16 independent randomisations; without it plain: every wall by itself.",
        ),
    ]],
};

static WALL: Section = Section {
    title: "[wall]",
    doc: "A straight wall with trapezoidal section.",
    chooser: None,
    keys: &[&[
        Key::new("height_m", real("m", SIZE), Required, "Height."),
        Key::new("length_m", real("m", SIZE), Required, "Length along the wall."),
        Key::new("base_thickness_m", real("m", SIZE), Required, "Thickness at the base."),
        Key::new(
            "top_thickness_m",
            real("m", SIZE),
            Required,
            "Thickness at the top, at most that of the base.",
        ),
        Key::new(
            "battered_face",
            Kind::Choice(&["front", "back", "both"]),
            Required,
            "Which face leans; front is downhill, back is where the load presses.",
        ),
        Key::new(
            "turned",
            Kind::Flag,
            Optional,
            "Whether the wall as built, lean included, is turned round on the platform by half a turn; without it it is not.",
        ),
        Key::new("wythes", Kind::Whole { low: 1, high: 10 }, Default("1"), "Stones through the thickness."),
        Key::new("header_share", real("1", SHARE), Default("0"), "Share of stones that span all wythes."),
        Key::new(
            "head_joint_gap_m",
            real("m", Interval::closed(0.0, 0.1)),
            Default("0"),
            "Open gap in every head joint; it carries nothing until it has closed.",
        ),
    ]],
};

static BLOCK: Section = Section {
    title: "[block]",
    doc: "The stones' material; stones are rigid.",
    chooser: None,
    keys: &[&[Key::new(
        "density_kg_per_m3",
        quantity("kg/m3", POSITIVE),
        Required,
        "Density, drawn per stone.",
    )
    .usual(Interval::closed(500.0, 8000.0))]],
};

const TABLE: &[&str] = &["table"];

static JOINT: Section = Section {
    title: "[joint]",
    doc: "The joints' properties, per area of joint. A distribution is drawn once per joint: over the many joints of a wall it averages out. What \
          is one number of a wall, and not known, stands here as a number and in [uncertain] as a distribution.",
    chooser: Some("normal_law"),
    keys: &[&[
        Key::new(
            "kn_pa_per_m",
            Kind::Reals { unit: "Pa/m", within: POSITIVE, at_most: 50, ascending: true },
            Required,
            "Normal stiffnesses: the points at which every arm is evaluated. Where normal_law is a table they give the shear stiffness alone.",
        )
        .usual(Interval::closed(1e6, 1e12)),
        Key::new("kn_factor", quantity("1", POSITIVE), Default("1"), "Factor on kn, drawn per joint; joint.kn_pa_per_m in [uncertain] is drawn per wall."),
        Key::new("kn_over_ks", real("1", POSITIVE), Required, "Normal over shear stiffness."),
        Key::new(
            "phi_deg",
            quantity("deg", Interval::closed(0.0, 85.0)),
            Required,
            "Friction angle; a distribution is drawn per joint.",
        )
        .angle(Angle::Friction),
        Key::new(
            "cohesion_pa",
            quantity("Pa", Interval::below(0.0, f64::INFINITY)),
            Required,
            "Cohesion; a distribution is drawn per joint.",
        ),
        Key::new(
            "tension_pa",
            real("Pa", Interval::below(0.0, f64::INFINITY)),
            Default("0"),
            "Tensile strength.",
        ),
        Key::new(
            "compressive_strength_pa",
            real("Pa", POSITIVE),
            Optional,
            "Stress at which a joint is crushed: it closes on and bears no more; without it it bears any pressure.",
        )
        .usual(Interval::closed(1e4, 1e9)),
        Key::new(
            "cohesion_after_slip",
            Kind::Choice(&["kept", "lost"]),
            Default("\"kept\""),
            "What happens to the cohesion of a sub-contact once it has slipped.",
        ),
        Key::new(
            "normal_law",
            Kind::Choice(&["linear", "table"]),
            Default("\"linear\""),
            "Stress as a function of closure: kn times it, or through the knots of a table.",
        ),
        Key::new(
            "table_closure_m",
            Kind::Reals { unit: "m", within: Interval::above(0.0, 0.1), at_most: MOST_KNOTS, ascending: true },
            Required,
            "Closures of the knots, two at least; the law begins at 0. Between knots a monotone cubic, beyond the last one straight on.",
        )
        .only(TABLE),
        Key::new(
            "table_stress_pa",
            Kind::Reals { unit: "Pa", within: POSITIVE, at_most: MOST_KNOTS, ascending: true },
            Required,
            "Stresses of the knots, as many.",
        )
        .only(TABLE)
        .usual(Interval::closed(1.0, 1e9)),
        Key::new(
            "sampling",
            Kind::Choice(&["area", "vertices"]),
            Default("\"area\""),
            "Stress integrated over the compressed area, or at the joint's corners only.",
        ),
        Key::new(
            "sub_contacts",
            Kind::Pair { low: 1, high: 32 },
            Default("[2, 2]"),
            "Sub-contacts of a joint along its two in-plane axes.",
        ),
        Key::new(
            "bearing",
            Kind::Table(&BEARING),
            Optional,
            "Stones that bear on few points of their beds, drawn per joint; without it they bear on the whole face.",
        ),
    ]],
};

pub static BEARING: Section = Section {
    title: "[joint.bearing]",
    doc: "Points of a bed joint on which a stone bears, in place of the whole face. They are uniform over the face, and hold its middle: stones \
          are turned or shimmed as they are laid, until they do not rock. Head joints touch over their whole face.",
    chooser: None,
    keys: &[&[
        Key::new(
            "points",
            real("1", Interval::closed(1.0, MOST_SEATS as f64)),
            Required,
            "Points of a joint; between two whole numbers joints have one or the other, so that this is their mean.",
        ),
        Key::new(
            "relief_m",
            real("m", Interval::closed(0.0, 0.1)),
            Default("0"),
            "Largest difference of the heights of a joint's points. The three on which a rigid stone rests touch from the start; each other one has \
             the gap that is left there.",
        ),
        Key::new(
            "share",
            real("1", Interval::above(0.0, 1.0)),
            Required,
            "Share of the face that the patches about all points of a joint have together.",
        ),
    ]],
};

/// One named variant.
pub static VARIANT: Section = Section {
    title: "[[variant]]",
    doc: "Another reading: key paths set to other values before anything is checked.",
    chooser: None,
    keys: &[&[
        Key::new("name", Kind::Name, Required, "Name of the variant."),
        Key::new("why", Kind::Text, Required, "Why somebody would read it so."),
        Key::new(
            "set",
            Kind::Settings,
            Required,
            "Key paths and their values; an arm is addressed by its name.",
        ),
        Key::new(
            "unset",
            Kind::Paths,
            Optional,
            "Key paths that are taken away, as they mean nothing in the variant.",
        ),
    ]],
};

const FAMILY_KEYS: &[Key] = &[
    Key::new(
        "family",
        Kind::Choice(&[
            "constant",
            "uniform",
            "normal",
            "truncated_normal",
            "lognormal",
            "truncated_lognormal",
            "triangular",
            "empirical",
        ]),
        Required,
        "Family of the distribution.",
    ),
    Key::new("value", real("", Interval::any()), Required, "The value.").only(&["constant"]),
    Key::new(
        "mean",
        real("", Interval::any()),
        Required,
        "Mean; of the parent where the family is truncated.",
    )
    .only(&["normal", "truncated_normal", "lognormal"]),
    Key::new(
        "sd",
        real("", Interval::any()),
        Required,
        "Standard deviation; of the parent where the family is truncated.",
    )
    .only(&["normal", "truncated_normal", "lognormal"]),
    Key::new("median", real("", Interval::any()), Required, "Median of the parent.")
        .only(&["truncated_lognormal"]),
    Key::new("log_sd", real("", Interval::any()), Required, "Standard deviation of the parent's logarithm.")
        .only(&["truncated_lognormal"]),
    Key::new("low", real("", Interval::any()), Required, "Smallest value.").only(&[
        "uniform",
        "truncated_normal",
        "truncated_lognormal",
        "triangular",
    ]),
    Key::new("mode", real("", Interval::any()), Required, "Most frequent value.").only(&["triangular"]),
    Key::new("high", real("", Interval::any()), Required, "Largest value.").only(&[
        "uniform",
        "truncated_normal",
        "truncated_lognormal",
        "triangular",
    ]),
    Key::new(
        "values",
        Kind::Values { at_most: MOST_ROWS },
        Required,
        "The values, each as likely; of a survey the column of its table, whose name ends in the unit of the key.",
    )
    .only(&["empirical"]),
];

/// A distribution written into a study.
pub static FAMILY: Section = Section {
    title: "{ family = ... }",
    doc: "A distribution, in the unit of the key that takes it.",
    chooser: Some("family"),
    keys: &[FAMILY_KEYS],
};

/// The head of a file below `distributions`; every other key is an entry.
pub static HEAD: Section = Section {
    title: "distributions/*/*.toml",
    doc: "One quantity; every table is an entry.",
    chooser: None,
    keys: &[&[
        Key::new("quantity", Kind::Text, Required, "The quantity, in words."),
        Key::new("symbol", Kind::Text, Required, "Its symbol."),
        Key::new(
            "unit",
            Kind::Choice(&["1", "m", "deg", "1/deg", "Pa", "Pa/m", "N/m", "N m/rad", "kg/m3"]),
            Required,
            "Its unit.",
        ),
    ]],
};

/// An entry of a file below `distributions`.
pub static ENTRY: Section = Section {
    title: "[entry]",
    doc: "A distribution with its provenance.",
    chooser: Some("family"),
    keys: &[
        FAMILY_KEYS,
        &[
            Key::new(
                "status",
                Kind::Choice(&["measured", "literature", "calibrated", "assumed"]),
                Required,
                "Where the numbers come from.",
            ),
            Key::new("source", Kind::Text, Required, "Paper and table, or who assumed it and why."),
            Key::new("n", Kind::Whole { low: 1, high: 1_000_000_000 }, Optional, "Number of observations."),
            Key::new("note", Kind::Text, Optional, "What a user should know."),
        ],
    ],
};
