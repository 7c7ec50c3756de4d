//! Keys of the mechanisms that the base model leaves out: each is off unless its table is there.

use crate::study::angle::Angle;
use crate::study::keys::{SHARE, SIZE, real};
use crate::study::schema::Presence::{Default, Optional, Required};
use crate::study::schema::{Interval, Key, Kind, Section};

const FACTOR: Interval = Interval::above(0.0, 100.0);
const POSITIVE_SHARE: Interval = Interval::above(0.0, 1.0);
const STIFFNESS: Interval = Interval::above(0.0, 1e15);
/// Ratios of two of these are still numbers when they are taken to the power of ten.
const POWER_STIFFNESS: Interval = Interval::closed(1e3, 1e15);

const fn switched(name: &'static str, section: &'static Section) -> Key {
    Key::new(name, Kind::Table(section), Optional, section.doc)
}

const fn mechanism(title: &'static str, keys: &'static [&'static [Key]], doc: &'static str) -> Section {
    Section { title, doc, chooser: None, keys }
}

/// All mechanisms.
pub static MECHANISM: Section = Section {
    title: "[mechanism]",
    doc: "What the base model leaves out: each mechanism is off unless its table is there. `pirca reference causes` says where each \
          acts, its prior, and what it is confounded with.",
    chooser: None,
    keys: &[&[
        switched("contact_inset", &CONTACT_INSET),
        switched("joint_closure", &JOINT_CLOSURE),
        switched("stress_stiffening", &STRESS_STIFFENING),
        switched("contact_area", &CONTACT_AREA),
        switched("friction", &FRICTION),
        switched("cohesion", &COHESION),
        switched("lean", &LEAN),
        switched("base_compliance", &BASE_COMPLIANCE),
        switched("wedge_loss", &WEDGE_LOSS),
        switched("rope_slack", &ROPE_SLACK),
        switched("size_scatter", &SIZE_SCATTER),
        switched("density", &DENSITY),
        switched("gauge_offset", &GAUGE_OFFSET),
        switched("gauge_scale", &GAUGE_SCALE),
        switched("creep", &CREEP),
        switched("specimen_scatter", &SPECIMEN_SCATTER),
        switched("end_release", &END_RELEASE),
        switched("platform_friction", &PLATFORM_FRICTION),
    ]],
};

static CONTACT_INSET: Section = mechanism(
    "[mechanism.contact_inset]",
    &[&[Key::new(
        "radius_m",
        real("m", Interval::above(0.0, 0.5)),
        Required,
        "Distance from a stone's edges within which joints do not touch.",
    )]],
    "Rounded or chipped arrises.",
);

static JOINT_CLOSURE: Section = mechanism(
    "[mechanism.joint_closure]",
    &[&[
        Key::new(
            "initial_pa_per_m",
            real("Pa/m", STIFFNESS),
            Required,
            "Initial stiffness of the hyperbola.",
        ),
        Key::new(
            "closure_m",
            real("m", Interval::closed(0.0, 0.1)),
            Required,
            "Maximum closure of the hyperbola.",
        ),
    ]],
    "Joints that close along a hyperbola in series with kn: soft where little presses.",
);

static STRESS_STIFFENING: Section = mechanism(
    "[mechanism.stress_stiffening]",
    &[&[
        Key::new(
            "at_1_mpa_pa_per_m",
            real("Pa/m", POWER_STIFFNESS),
            Required,
            "Stiffness k1 that the power law has at a stress of 1 MPa.",
        ),
        Key::new("exponent", real("1", Interval::closed(0.1, 1.0)), Required, "Exponent m of the stress."),
        Key::new(
            "floor_pa_per_m",
            real("Pa/m", POWER_STIFFNESS),
            Default("1e6"),
            "Smallest stiffness, in tension as well.",
        ),
    ]],
    "Joints whose stiffness grows with the stress as k1 (stress / 1 MPa)^m, between a floor and kn.",
);

static CONTACT_AREA: Section = mechanism(
    "[mechanism.contact_area]",
    &[&[Key::new(
        "share",
        real("1", POSITIVE_SHARE),
        Required,
        "Share of each joint in contact, in 64ths: so many patches of an 8 x 8 grid.",
    )]],
    "Joints that touch in patches only, drawn per joint; the stiffness per area in contact stays.",
);

static FRICTION: Section = mechanism(
    "[mechanism.friction]",
    &[&[
        Key::new("factor", real("1", FACTOR), Required, "Factor on tan(phi) of the stones' joints."),
        Key::new("residual_share", real("1", SHARE), Default("1"), "Share of tan(phi) left after slip."),
        Key::new("slip_distance_m", real("m", SIZE), Default("0.002"), "Slip over which it falls to that."),
    ]],
    "Another friction angle, and friction that weakens with slip.",
);

static COHESION: Section = mechanism(
    "[mechanism.cohesion]",
    &[&[Key::new(
        "added_pa",
        real("Pa", Interval::above(0.0, 1e9)),
        Required,
        "Cohesion added to that of the joints.",
    )]],
    "Joints that interlock or stick.",
);

static LEAN: Section = mechanism(
    "[mechanism.lean]",
    &[&[Key::new(
        "angle_deg",
        real("deg", Interval::closed(-20.0, 20.0)),
        Required,
        "Out-of-plumb towards downhill; beds stay level.",
    )]],
    "A wall that was built, or moved, out of plumb.",
);

static BASE_COMPLIANCE: Section = mechanism(
    "[mechanism.base_compliance]",
    &[&[
        Key::new("settlement_n_per_m", real("N/m", STIFFNESS), Required, "Stiffness against settling."),
        Key::new(
            "rotation_n_m_per_rad",
            real("N m/rad", STIFFNESS),
            Required,
            "Stiffness against turning out of plane about its centre line.",
        ),
    ]],
    "A platform that settles and turns elastically, with the strip and the end blocks on it.",
);

static WEDGE_LOSS: Section = mechanism(
    "[mechanism.wedge_loss]",
    &[&[
        Key::new("share", real("1", POSITIVE_SHARE), Required, "Share of the wedges that are lost."),
        Key::new(
            "beyond_deg",
            real("deg", Interval::closed(0.0, 89.0)),
            Required,
            "Last tilt at which they are there.",
        ),
    ]],
    "Wedges that crush or fall out beyond a tilt, drawn per wedge.",
);

static ROPE_SLACK: Section = mechanism(
    "[mechanism.rope_slack]",
    &[&[Key::new("added_m", real("m", SIZE), Required, "Slack added to that of the ropes.")]],
    "Ropes that hold later than assumed.",
);

static SIZE_SCATTER: Section = mechanism(
    "[mechanism.size_scatter]",
    &[&[Key::new(
        "factor",
        real("1", FACTOR),
        Required,
        "Factor on the deviation of lengths and heights from their means.",
    )]],
    "Stones that vary more in size than assumed.",
);

static DENSITY: Section = mechanism(
    "[mechanism.density]",
    &[&[Key::new("factor", real("1", FACTOR), Required, "Factor on the density.")]],
    "Heavier or lighter stones.",
);

static GAUGE_OFFSET: Section = mechanism(
    "[mechanism.gauge_offset]",
    &[&[Key::new(
        "offset_m",
        real("m", Interval::closed(-1.0, 1.0)),
        Required,
        "Added to every displacement read after the zero reading.",
    )]],
    "A gauge that has moved since its zero reading.",
);

static GAUGE_SCALE: Section = mechanism(
    "[mechanism.gauge_scale]",
    &[&[Key::new("factor", real("1", FACTOR), Required, "Factor on every displacement read.")]],
    "A gauge that reads too much or too little.",
);

static CREEP: Section = mechanism(
    "[mechanism.creep]",
    &[&[
        Key::new(
            "rate_per_deg",
            real("1/deg", Interval::closed(0.0, 100.0)),
            Required,
            "Rate at which shear tractions relax per degree of tilt.",
        ),
        Key::new(
            "hold_share",
            real("1", Interval::below(0.0, 1.0)),
            Default("0"),
            "Share of the shear tractions that is lost at each hold.",
        ),
        Key::new(
            "hold_every_deg",
            real("deg", Interval::above(0.0, 89.0)),
            Default("5"),
            "The platform is held for a reading at every multiple of this tilt.",
        ),
    ]],
    "Shear tractions that relax from state of rest to state of rest: the wall ratchets downhill.",
);

static SPECIMEN_SCATTER: Section = mechanism(
    "[mechanism.specimen_scatter]",
    &[&[
        Key::new("kn_cov", real("1", Interval::closed(0.0, 10.0)), Required, "COV of a factor on kn and ks."),
        Key::new(
            "friction_cov",
            real("1", Interval::closed(0.0, 10.0)),
            Required,
            "COV of a factor on tan(phi) of the stones' joints.",
        ),
    ]],
    "Joint properties that vary from specimen to specimen: lognormal factors of mean 1, drawn once per wall.",
);

static END_RELEASE: Section = mechanism(
    "[mechanism.end_release]",
    &[&[
        Key::new("within_m", real("m", SIZE), Required, "Distance from the ends."),
        Key::new("friction_share", real("1", SHARE), Required, "Share of tan(phi) that joints there have."),
        Key::new(
            "stiffness_share",
            real("1", POSITIVE_SHARE),
            Required,
            "Share of the shear stiffness that joints there have.",
        ),
    ]],
    "End panels that are less interlocked than the middle.",
);

static PLATFORM_FRICTION: Section = mechanism(
    "[mechanism.platform_friction]",
    &[&[Key::new(
        "phi_deg",
        real("deg", Interval::closed(0.0, 85.0)),
        Required,
        "Friction angle of the joint with platform and strip, instead of what the restraint says.",
    )
    .angle(Angle::Friction)]],
    "A platform that the wall slides on more easily, or less, than on itself.",
);
