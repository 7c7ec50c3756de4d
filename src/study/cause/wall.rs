//! The wall as it is built: how it stands, and its stones.

use crate::generate::{Arrangement, Layout};
use crate::math::{radians, tan};
use crate::protocol::Protocol;
use crate::study::cause::FACTOR;
use crate::study::cause::entry::{Acts, Cause, Clash, OnPlate, sheared, table};
use crate::study::keys::real;
use crate::study::schema::Presence::Required;
use crate::study::schema::{Interval, Key, Short};

/// Out-of-plumb towards downhill.
pub static LEAN: Cause = Cause {
    name: "lean",
    title: "a wall or a platform out of plumb",
    means: "the wall leaned before the test, or the platform was not level",
    acts: Acts::Wall,
    confounded: &[
        "wall.battered_face",
        "contact_inset",
        "base_compliance",
        "bedding",
        "platform_friction",
        "worn_bearing",
        "motion_scale",
    ],
    section: table(
        "[mechanism.lean]",
        "A wall that was built, or moved, out of plumb.",
        &[&[Key::new(
            "angle_deg",
            real("deg", Interval::closed(-20.0, 20.0)),
            Required,
            "Out-of-plumb towards downhill; beds stay level.",
        )]],
    ),
    priors: priors!("lean": "angle_deg"),
    sketch: include_str!("sketch/lean.svg"),
    shows: "A plumb line shows that a wall leans; a spirit level shows that a platform under an upright stack slopes.",
    either_way: &["angle_deg"],
    idle: |_, _, protocol| sheared(protocol, "the beam on the wall is guided in its plane"),
    plate: |[angle, ..]| if angle == 0.0 { OnPlate::Fits } else { OnPlate::Placed },
    built: |[angle, ..], wall, protocol| match protocol {
        Protocol::Tilting(tilting) if tilting.towards.is_backwards() => wall.leaning(-tan(radians(angle))),
        _ => wall.leaning(tan(radians(angle))),
    },
    ..Cause::NOTHING
};

/// Factor on the deviation of stone sizes from their means.
pub static SIZE_SCATTER: Cause = Cause {
    name: "size_scatter",
    title: "stones that differ more in size",
    means: "stones differ in size more than stated",
    acts: Acts::Wall,
    confounded: &["specimen_scatter", "wedge_loss", "contact_area", "bearing_points"],
    section: table(
        "[mechanism.size_scatter]",
        "Stones that vary more in size than assumed.",
        &[&[Key::new(
            "factor",
            real("1", FACTOR),
            Required,
            "Factor on the deviation of lengths and heights from their means.",
        )]],
    ),
    priors: priors!("size_scatter": "factor"),
    sketch: include_str!("sketch/size_scatter.svg"),
    shows: "A wall of similar stones with a narrow size curve, beside a wall of very uneven stones with a wide one.",
    either_way: &["factor"],
    needs: Some((|arm, _| arm.layout.draws_sizes(), "an arm that draws its stones' sizes")),
    idle: |[factor, ..], arm, _| match arm.layout.draws_sizes() {
        true => least(&arm.layout, factor)
            .iter()
            .any(|least| *least < 0.0)
            .then_some("sizes that scatter so much would be below 0"),
        false => Some("the stones' sizes are not drawn"),
    },
    clashes: |[factor, ..], beside| {
        let least = least(beside.layout, factor).into_iter().zip(["lengths", "heights"]);
        let clash = |(least, sizes)| Clash {
            what: format!("widens {sizes} to {}", Short(least)),
            allowed: "sizes above 0",
            fix: "reduce the factor",
        };
        least.filter(|(least, _)| *least < 0.0).map(clash).collect()
    },
    layout: |[factor, ..], layout| *layout = layout.clone().widened(factor),
    ..Cause::NOTHING
};

/// Factor on the density.
pub static DENSITY: Cause = Cause {
    name: "density",
    title: "stones of another weight",
    means: "stones are heavier or lighter than stated",
    acts: Acts::Wall,
    confounded: &["joint.kn_pa_per_m", "cohesion"],
    section: table(
        "[mechanism.density]",
        "Heavier or lighter stones.",
        &[&[Key::new("factor", real("1", FACTOR), Required, "Factor on the density.")]],
    ),
    priors: priors!("density": "factor"),
    sketch: include_str!("sketch/density.svg"),
    shows: "On a balance, a stone of the same size as another weighs more; a dashed beam shows the opposite case.",
    either_way: &["factor"],
    layout: |[factor, ..], layout| layout.density = layout.density.clone().scaled(factor),
    ..Cause::NOTHING
};

/// Smallest length and smallest height (m) of stones whose sizes deviate so many times as much, where sizes are drawn.
fn least(layout: &Layout, factor: f64) -> Vec<f64> {
    match layout.clone().widened(factor).arrangement {
        Arrangement::Coursed { sizes, .. } | Arrangement::Cut { sizes, .. } => sizes.least().to_vec(),
        _ => Vec::new(),
    }
}
