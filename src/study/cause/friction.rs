//! What keeps stones from sliding on each other: friction, cohesion, the interlock near the ends.

use crate::law::Weakening;
use crate::solve::Demand;
use crate::study::cause::entry::{Acts, Cause, OnPlate, Unloading, table};
use crate::study::cause::{FACTOR, POSITIVE_SHARE};
use crate::study::keys::{SHARE, SIZE, real};
use crate::study::schema::Presence::{Default, Required};
use crate::study::schema::{Interval, Key};

/// Another friction of the stones' joints; see [`Weakening`].
pub static FRICTION: Cause = Cause {
    name: "friction",
    title: "joints with another friction than stated",
    means: "joints are smoother or rougher than stated, or lose friction as they slip",
    acts: Acts::Joints,
    unloading: Unloading::Irreversible,
    confounded: &["joint.phi_deg", "cohesion", "end_release", "creep"],
    section: table(
        "[mechanism.friction]",
        "Another friction angle, and friction that weakens with slip.",
        &[&[
            Key::new("factor", real("1", FACTOR), Required, "Factor on tan(phi) of the stones' joints."),
            Key::new("residual_share", real("1", SHARE), Default("1"), "Share of tan(phi) left after slip."),
            Key::new(
                "slip_distance_m",
                real("m", SIZE),
                Default("0.002"),
                "Slip over which it falls to that.",
            ),
        ]],
    ),
    priors: priors!("friction": "factor", "residual_share", "slip_distance_m"),
    sketch: include_str!("sketch/friction.svg"),
    shows: "A stone slides on a smooth slope below the stated friction angle; another holds on a rough slope steeper than that angle.",
    stronger_below: &["factor", "residual_share", "slip_distance_m"],
    either_way: &["factor"],
    demand: |[_, residual, ..]| {
        (residual < 1.0).then_some((Demand::Weakening, "mechanism.friction.residual_share"))
    },
    law: |[factor, residual, distance, ..], law, _| {
        law.tan_phi *= factor;
        law.weakening = (residual < 1.0).then_some(Weakening { residual, distance });
    },
    ..Cause::NOTHING
};

/// Cohesion added to that of the joints.
pub static COHESION: Cause = Cause {
    name: "cohesion",
    title: "something that holds the stones together",
    means: "something holds the stones together, as earth in the joints or suction does",
    acts: Acts::Joints,
    confounded: &["friction", "density"],
    section: table(
        "[mechanism.cohesion]",
        "Joints that interlock or stick.",
        &[&[Key::new(
            "added_pa",
            real("Pa", Interval::above(0.0, 1e9)),
            Required,
            "Cohesion added to that of the joints.",
        )]],
    ),
    priors: priors!("cohesion": "added_pa"),
    sketch: include_str!("sketch/cohesion.svg"),
    shows: "A pulled stone lifts freely off a dry joint; earth in the joint holds it to the stone below.",
    plate: |_| OnPlate::Bonded,
    law: |[added, ..], law, _| law.cohesion += added,
    ..Cause::NOTHING
};

/// Less interlocked ends.
pub static END_RELEASE: Cause = Cause {
    name: "end_release",
    title: "end stones that are held less",
    means: "the stones near the ends are held less than the others",
    acts: Acts::Joints,
    unloading: Unloading::Irreversible,
    confounded: &["rope_slack", "friction", "platform_friction"],
    section: table(
        "[mechanism.end_release]",
        "End panels that are less interlocked than the middle.",
        &[&[
            Key::new("within_m", real("m", SIZE), Required, "Distance from the ends."),
            Key::new(
                "friction_share",
                real("1", SHARE),
                Required,
                "Share of tan(phi) that joints there have.",
            ),
            Key::new(
                "stiffness_share",
                real("1", POSITIVE_SHARE),
                Required,
                "Share of the shear stiffness that joints there have.",
            ),
        ]],
    ),
    priors: priors!("end_release": "within_m", "friction_share", "stiffness_share"),
    sketch: include_str!("sketch/end_release.svg"),
    shows: "The stacked stones at both ends of a wall slide out of its face; the interlocked middle stays.",
    stronger_below: &["friction_share", "stiffness_share"],
    law: |[within, friction, stiffness, ..], law, site| {
        if site.to_end() < within {
            law.tan_phi *= friction;
            law.ks *= stiffness;
        }
    },
    ..Cause::NOTHING
};
