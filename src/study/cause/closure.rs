//! Joints that close along another law: one of these at most can be on, and none beside a table.

use crate::law::{NormalLaw, Stiffening};
use crate::solve::Demand;
use crate::study::cause::STIFFNESS;
use crate::study::cause::entry::{Acts, Beside, Cause, Clash, Unloading, table};
use crate::study::checked::{Arm, StatedLaw};
use crate::study::keys::real;
use crate::study::schema::Presence::{Default, Required};
use crate::study::schema::{Interval, Key};

/// Ratios of two of these are still numbers when they are taken to the power of ten.
const POWER_STIFFNESS: Interval = Interval::closed(1e3, 1e15);

/// Hyperbolic closure in series with kn; see [`NormalLaw::Hyperbolic`].
pub static JOINT_CLOSURE: Cause = Cause {
    name: "joint_closure",
    title: "joints that are soft until they close",
    means: "joints touch by rough points and are soft until they have closed",
    acts: Acts::Joints,
    unloading: Unloading::Reversible,
    confounded: &[
        "joint.kn_pa_per_m",
        "stress_stiffening",
        "contact_area",
        "bearing_points",
        "base_compliance",
        "bedding",
        "gauge_scale",
        "gauge_offset",
    ],
    section: table(
        "[mechanism.joint_closure]",
        "Joints that close along a hyperbola in series with kn: soft where little presses.",
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
    ),
    priors: priors!("joint_closure": "initial_pa_per_m", "closure_m"),
    sketch: include_str!("sketch/joint_closure.svg"),
    shows: "Two rough faces touch at two points; the stress-closure curve is soft at first, then as steep as the straight line of the base model.",
    stronger_below: &["initial_pa_per_m"],
    instead_of: &["stress_stiffening"],
    idle: |_, arm, _| otherwise_closed(arm, "stress_stiffening"),
    clashes: |_, beside| beside_table(beside).into_iter().collect(),
    demand: |_| Some((Demand::Closure, "joint_closure")),
    law: |[initial, closure, ..], law, _| {
        law.normal = NormalLaw::Hyperbolic { kn: law.normal.largest_stiffness(), initial, closure };
    },
    ..Cause::NOTHING
};

/// Stiffness that grows as a power of the stress, between a floor and kn; see [`Stiffening`].
pub static STRESS_STIFFENING: Cause = Cause {
    name: "stress_stiffening",
    title: "joints that stiffen as they are pressed",
    means: "joints become stiffer as they are pressed together",
    acts: Acts::Joints,
    unloading: Unloading::Reversible,
    confounded: &["joint.kn_pa_per_m", "joint_closure"],
    section: table(
        "[mechanism.stress_stiffening]",
        "Joints whose stiffness grows with the stress as k1 (stress / 1 MPa)^m, between a floor and kn.",
        &[&[
            Key::new(
                "at_1_mpa_pa_per_m",
                real("Pa/m", POWER_STIFFNESS),
                Required,
                "Stiffness k1 that the power law has at a stress of 1 MPa.",
            ),
            Key::new(
                "exponent",
                real("1", Interval::closed(0.1, 1.0)),
                Required,
                "Exponent m of the stress.",
            ),
            Key::new(
                "floor_pa_per_m",
                real("Pa/m", POWER_STIFFNESS),
                Default("1e6"),
                "Smallest stiffness, in tension as well.",
            ),
        ]],
    ),
    priors: priors!("stress_stiffening": "at_1_mpa_pa_per_m", "exponent", "floor_pa_per_m"),
    sketch: include_str!("sketch/stress_stiffening.svg"),
    shows: "A spring between two stones is thin under a small force and thick under a large one; stiffness rises with stress towards kn.",
    stronger_below: &["at_1_mpa_pa_per_m", "floor_pa_per_m"],
    instead_of: &["joint_closure"],
    idle: |_, arm, _| otherwise_closed(arm, "joint_closure"),
    clashes: |_, beside| {
        let both = beside.mechanisms.has("joint_closure");
        let both = both.then(|| one_law("does not go with mechanism.joint_closure"));
        both.into_iter().chain(beside_table(beside)).collect()
    },
    demand: |_| Some((Demand::StressStiffening, "stress_stiffening")),
    law: |[at_1_mpa, exponent, floor, ..], law, _| {
        let kn = law.normal.largest_stiffness();
        law.normal = NormalLaw::Stiffening(Stiffening::new(kn, at_1_mpa, exponent, floor));
    },
    ..Cause::NOTHING
};

/// Why an arm closes in another way already.
fn otherwise_closed(arm: &Arm, other: &str) -> Option<&'static str> {
    match &arm.joint.normal_law {
        _ if arm.mechanisms.has(other) => Some("its joints close along another law"),
        StatedLaw::Table(_) => Some("its joints close along a table"),
        StatedLaw::Linear => None,
    }
}

fn beside_table(beside: &Beside<'_>) -> Option<Clash> {
    let is_table = matches!(beside.joint.normal_law, StatedLaw::Table(_));
    is_table.then(|| one_law("does not go with joint.normal_law = \"table\""))
}

fn one_law(what: &str) -> Clash {
    Clash {
        what: what.to_owned(),
        allowed: "one law for the closure of a joint",
        fix: "remove one of the two",
    }
}
