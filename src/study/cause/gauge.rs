//! What is wrong with the gauges: it changes readings alone.

use crate::study::cause::FACTOR;
use crate::study::cause::entry::{Acts, Cause, Unloading, shaken, sheared, table};
use crate::study::keys::real;
use crate::study::schema::Presence::Required;
use crate::study::schema::{Interval, Key};

/// Why neither can act on a wall whose base moves.
const NOT_TILTED: &str = "no displacement is read on a platform that tilts";
/// Why neither can act on a wall that is sheared.
const NOT_READ: &str = "no displacement out of plane is read";

/// Added to every displacement read after the zero reading.
pub static GAUGE_OFFSET: Cause = Cause {
    name: "gauge_offset",
    title: "a gauge that moved, or a wrong zero",
    means: "the gauges moved, or their zero is wrong",
    acts: Acts::Readings,
    unloading: Unloading::Irreversible,
    no_bearing: true,
    confounded: &["creep", "joint_closure"],
    section: table(
        "[mechanism.gauge_offset]",
        "A gauge that has moved since its zero reading.",
        &[&[Key::new(
            "offset_m",
            real("m", Interval::closed(-1.0, 1.0)),
            Required,
            "Added to every displacement read after the zero reading.",
        )]],
    ),
    priors: priors!("gauge_offset": "offset_m"),
    sketch: include_str!("sketch/gauge_offset.svg"),
    shows: "The wall stands still, but its dial gauge has shifted towards it, and the needle no longer points to zero.",
    either_way: &["offset_m"],
    idle: |_, _, protocol| sheared(protocol, NOT_READ).or(shaken(protocol, NOT_TILTED)),
    reading: |[offset, ..], displacement| displacement + offset,
    ..Cause::NOTHING
};

/// Factor on every displacement read. A gauge that moved is off by what it shows: its scale comes first.
pub static GAUGE_SCALE: Cause = Cause {
    name: "gauge_scale",
    title: "a gauge with a wrong scale",
    means: "the gauges show too much or too little by a factor",
    acts: Acts::Readings,
    unloading: Unloading::Reversible,
    no_bearing: true,
    confounded: &["joint.kn_pa_per_m", "joint_closure", "base_compliance"],
    section: table(
        "[mechanism.gauge_scale]",
        "A gauge that reads too much or too little.",
        &[&[Key::new("factor", real("1", FACTOR), Required, "Factor on every displacement read.")]],
    ),
    priors: priors!("gauge_scale": "factor"),
    sketch: include_str!("sketch/gauge_scale.svg"),
    shows: "A stone has moved by three divisions of a true ruler; the gauge's ruler, with finer divisions, shows five.",
    either_way: &["factor"],
    first: true,
    idle: |_, _, protocol| sheared(protocol, NOT_READ).or(shaken(protocol, NOT_TILTED)),
    reading: |[factor, ..], displacement| factor * displacement,
    ..Cause::NOTHING
};
