//! What a base that moves, or a stone that rocks on it, has beside the base model.

use crate::math::radians;
use crate::protocol::Protocol;
use crate::solve::Demand;
use crate::study::cause::FACTOR;
use crate::study::cause::entry::{Acts, Cause, Clash, Unloading, table};
use crate::study::keys::real;
use crate::study::schema::Presence::{Default, Required};
use crate::study::schema::{Interval, Key};

/// How a wall meets a motion of its base; by default as the study states it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Factor on the motion.
    pub factor: f64,
    /// By how much the motion is turned in plan (rad), positive from x to y.
    pub turn: f64,
    /// Distance (m) from their outlines within which faces bear no more.
    pub inset: f64,
    /// Restitution of impacts; `None` as the solver's settings say.
    pub restitution: Option<f64>,
}

impl Meeting {
    /// As the study states it.
    pub(super) const STATED: Meeting = Meeting { factor: 1.0, turn: 0.0, inset: 0.0, restitution: None };
}

/// Why none of these can act on a wall whose base does not move.
fn still(protocol: &Protocol) -> Option<&'static str> {
    (!shakes(protocol)).then_some("the base does not move")
}

fn shakes(protocol: &Protocol) -> bool {
    matches!(protocol, Protocol::BaseMotion(_))
}

/// What all of them act on.
const NEEDS: &str = "a base that moves";

/// Faces that bear on a part of their area that shrinks.
pub static WORN_BEARING: Cause = Cause {
    name: "worn_bearing",
    title: "edges that do not bear, and wear from test to test",
    means: "stones bear further inside their outlines than drawn, and the edges that they rock on break away from test to test",
    acts: Acts::Joints,
    unloading: Unloading::Irreversible,
    confounded: &["contact_inset", "bearing_points", "lean", "heading", "motion_scale", "restitution"],
    section: table(
        "[mechanism.worn_bearing]",
        "Faces that begin to bear at a distance from their outlines, which grows with every motion that the wall meets.",
        &[&[
            Key::new(
                "at_first_m",
                real("m", Interval::closed(0.0, 100.0)),
                Required,
                "Distance from a face's outline within which it does not bear under the first motion.",
            ),
            Key::new(
                "per_test_m",
                real("m", Interval::closed(0.0, 0.1)),
                Default("0"),
                "What each motion adds to it.",
            ),
        ]],
    ),
    priors: priors!("worn_bearing": "at_first_m", "per_test_m"),
    sketch: include_str!("sketch/worn_bearing.svg"),
    shows: "A boulder stands on a table; its lower edges are broken off, so that it bears on a narrower strip than its underside is wide.",
    needs: Some((|_, protocol| shakes(protocol), NEEDS)),
    idle: |_, _, protocol| still(protocol),
    clashes: |_, beside| {
        let clash = |other: &str| Clash {
            what: format!("does not go with mechanism.{other}"),
            allowed: "one distance from the outlines",
            fix: "remove one of the two",
        };
        beside.mechanisms.has("contact_inset").then(|| clash("contact_inset")).into_iter().collect()
    },
    instead_of: &["contact_inset"],
    shaking: |[at_first, per_test, ..], nth, meeting| meeting.inset += at_first + per_test * f64::from(nth),
    ..Cause::NOTHING
};

/// A base that moves along another direction than stated.
pub static HEADING: Cause = Cause {
    name: "heading",
    title: "a wall that faces the motion otherwise",
    means: "the wall faced the motion at another angle than stated",
    acts: Acts::Loading,
    confounded: &["worn_bearing", "motion_scale"],
    section: table(
        "[mechanism.heading]",
        "A motion along another direction in plan than stated.",
        &[&[Key::new(
            "turn_deg",
            real("deg", Interval::closed(-180.0, 180.0)),
            Required,
            "By how much the motion is turned in plan, counter-clockwise seen from above.",
        )]],
    ),
    priors: priors!("heading": "turn_deg"),
    sketch: include_str!("sketch/heading.svg"),
    shows: "Seen from above, a stone on a table; the arrow of the table's motion does not go the way of the stone's own arrow.",
    either_way: &["turn_deg"],
    needs: Some((|_, protocol| shakes(protocol), NEEDS)),
    idle: |_, _, protocol| still(protocol),
    shaking: |[turn, ..], _, meeting| meeting.turn += radians(turn),
    ..Cause::NOTHING
};

/// A base that moves more, or less, than was recorded.
pub static MOTION_SCALE: Cause = Cause {
    name: "motion_scale",
    title: "a base that moved more, or less, than recorded",
    means: "the base moved more or less than was recorded: a wrong scale of its sensor, or a table that rocks as it moves",
    acts: Acts::Loading,
    confounded: &["worn_bearing", "lean", "heading", "restitution"],
    section: table(
        "[mechanism.motion_scale]",
        "A motion that is stronger or weaker than its record.",
        &[&[Key::new("factor", real("1", FACTOR), Required, "Factor on the recorded motion.")]],
    ),
    priors: priors!("motion_scale": "factor"),
    sketch: include_str!("sketch/motion_scale.svg"),
    shows: "Two traces of the same motion over time, the true one larger than the recorded one.",
    either_way: &["factor"],
    needs: Some((|_, protocol| shakes(protocol), NEEDS)),
    idle: |_, _, protocol| still(protocol),
    shaking: |[factor, ..], _, meeting| meeting.factor *= factor,
    ..Cause::NOTHING
};

/// Impacts that give back a part of the speed.
pub static RESTITUTION: Cause = Cause {
    name: "restitution",
    title: "impacts that throw stones back",
    means: "stones bounce where they hit, so that impacts take less energy",
    acts: Acts::Loading,
    unloading: Unloading::Irreversible,
    confounded: &["worn_bearing", "motion_scale"],
    section: table(
        "[mechanism.restitution]",
        "Impacts after which joints open again: Newton's restitution.",
        &[&[Key::new(
            "coefficient",
            real("1", Interval::closed(0.0, 1.0)),
            Required,
            "Share of the closing speed with which a joint opens after an impact.",
        )]],
    ),
    priors: priors!("restitution": "coefficient"),
    sketch: include_str!("sketch/restitution.svg"),
    shows: "A stone that has rocked over to one edge hits its table and bounces.",
    needs: Some((|_, protocol| shakes(protocol), NEEDS)),
    idle: |_, _, protocol| still(protocol),
    demand: |_| Some((Demand::Restitution, "restitution")),
    shaking: |[coefficient, ..], _, meeting| meeting.restitution = Some(coefficient),
    ..Cause::NOTHING
};
