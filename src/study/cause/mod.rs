//! Causes, which the code calls mechanisms as well: what the base model leaves out. A file holds all that is said of one, or of a
//! few that act on the same; what is asked of those that are on is in `mechanisms`.

mod described;
mod entry;
mod mechanisms;

/// The files of the priors of a cause.
macro_rules! priors {
    ($cause:literal: $($key:literal),+) => {
        &[$((
            concat!("distributions/mechanism/", $cause, "/", $key, ".toml"),
            include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"), "/distributions/mechanism/", $cause, "/", $key, ".toml"
            )),
        )),+]
    };
}

mod closure;
mod contact;
mod friction;
mod gauge;
mod loading;
mod restraint;
mod shaking;
mod specimen;
mod wall;

pub use described::{Described, Parameter, Stronger, WIDER, described, in_plain_words};
pub use entry::{Acts, Cause, InLimitAnalysis, OnPlate, Unloading};
pub(super) use entry::{Beside, Clash};
pub use mechanisms::Mechanisms;
pub use shaking::Meeting;

use crate::study::cause::entry::MOST_KEYS;
use crate::study::schema::Presence::Optional;
use crate::study::schema::{Interval, Key, Kind, Section};

/// All causes, in the order of their keys.
pub static CAUSES: [&Cause; 24] = [
    &contact::CONTACT_INSET,
    &closure::JOINT_CLOSURE,
    &closure::STRESS_STIFFENING,
    &contact::CONTACT_AREA,
    &friction::FRICTION,
    &friction::COHESION,
    &wall::LEAN,
    &restraint::BASE_COMPLIANCE,
    &loading::WEDGE_LOSS,
    &restraint::ROPE_SLACK,
    &wall::SIZE_SCATTER,
    &wall::DENSITY,
    &gauge::GAUGE_OFFSET,
    &gauge::GAUGE_SCALE,
    &loading::CREEP,
    &specimen::SPECIMEN_SCATTER,
    &friction::END_RELEASE,
    &restraint::PLATFORM_FRICTION,
    &contact::BEARING_POINTS,
    &restraint::BEDDING,
    &shaking::WORN_BEARING,
    &shaking::HEADING,
    &shaking::MOTION_SCALE,
    &shaking::RESTITUTION,
];

/// Keys of the causes: each is off unless its table is there.
pub static MECHANISM: Section = Section {
    title: "[mechanism]",
    doc: "What the base model leaves out: each mechanism is off unless its table is there. `pirca reference causes` says where each \
          acts, its prior, and what it is confounded with.",
    chooser: None,
    keys: &[&KEYS],
};

static KEYS: [Key; CAUSES.len()] = {
    let mut keys = [Key::new("", Kind::Flag, Optional, ""); CAUSES.len()];
    let mut at = 0;
    while at < keys.len() {
        let section = &CAUSES[at].section;
        assert!(section.keys[0].len() <= MOST_KEYS, "a cause has more keys than `Values` has places");
        keys[at] = Key::new(CAUSES[at].name, Kind::Table(section), Optional, section.doc);
        at += 1;
    }
    keys
};

/// Factors, shares and stiffnesses that several causes have.
const FACTOR: Interval = Interval::above(0.0, 100.0);
const POSITIVE_SHARE: Interval = Interval::above(0.0, 1.0);
const STIFFNESS: Interval = Interval::above(0.0, 1e15);

impl Cause {
    /// The cause of that name.
    pub fn named(name: &str) -> Option<&'static Cause> {
        CAUSES.iter().copied().find(|cause| cause.name == name)
    }
}
