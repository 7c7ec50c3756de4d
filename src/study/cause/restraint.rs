//! What holds a wall: its platform and its ropes.

use crate::math::{radians, tan};
use crate::protocol::{Compliance, Ends};
use crate::solve::Demand;
use crate::study::angle::Angle;
use crate::study::cause::entry::{Acts, Cause, Unloading, sheared, table};
use crate::study::cause::{POSITIVE_SHARE, STIFFNESS};
use crate::study::checked::Arm;
use crate::study::keys::{SIZE, real};
use crate::study::schema::Presence::Required;
use crate::study::schema::{Interval, Key};

/// Springs under the platform.
pub static BASE_COMPLIANCE: Cause = Cause {
    name: "base_compliance",
    title: "a base that gives way",
    means: "what carries the wall gives way, the platform or the ground under it",
    acts: Acts::Restraint,
    unloading: Unloading::Reversible,
    confounded: &["joint.kn_pa_per_m", "joint_closure", "bedding", "lean", "gauge_scale"],
    section: table(
        "[mechanism.base_compliance]",
        "A platform that settles and turns elastically, with the strip and the end blocks on it.",
        &[&[
            Key::new("settlement_n_per_m", real("N/m", STIFFNESS), Required, "Stiffness against settling."),
            Key::new(
                "rotation_n_m_per_rad",
                real("N m/rad", STIFFNESS),
                Required,
                "Stiffness against turning out of plane about its centre line.",
            ),
        ]],
    ),
    priors: priors!("base_compliance": "settlement_n_per_m", "rotation_n_m_per_rad"),
    sketch: include_str!("sketch/base_compliance.svg"),
    shows: "A platform on firm ground stays level; on springs it settles and turns, and the wall on it leans.",
    stronger_below: &["settlement_n_per_m", "rotation_n_m_per_rad"],
    idle: |_, _, protocol| {
        sheared(protocol, "the platform settles and turns out of plane, and the push is in plane")
    },
    demand: |_| Some((Demand::BaseCompliance, "base_compliance")),
    restraint: |[settlement, rotation, ..], restraint| {
        restraint.base.compliance = Some(Compliance { settlement, rotation });
    },
    ..Cause::NOTHING
};

/// Softer joints between the lowest course and what carries it.
pub static BEDDING: Cause = Cause {
    name: "bedding",
    title: "a lowest course that is bedded softly",
    means: "the lowest course lies on a softer bed than the stones on each other: boards, sand, small stones",
    acts: Acts::Joints,
    unloading: Unloading::Reversible,
    confounded: &["joint.kn_pa_per_m", "joint_closure", "base_compliance", "lean"],
    section: table(
        "[mechanism.bedding]",
        "A softer bed under the lowest course than between the stones.",
        &[&[Key::new(
            "stiffness_share",
            real("1", POSITIVE_SHARE),
            Required,
            "Share of kn and ks that the joints under the lowest course have.",
        )]],
    ),
    priors: priors!("bedding": "stiffness_share"),
    sketch: include_str!("sketch/bedding.svg"),
    shows: "On a firm plate the lowest course stays level; on a bed of sand it sinks in on one side, and the wall on it leans.",
    stronger_below: &["stiffness_share"],
    demand: |_| Some((Demand::Closure, "bedding")),
    law: |[share, ..], law, site| {
        if site.is_under_the_wall() {
            law.ks *= share;
            law.normal = law.normal.scaled(share);
        }
    },
    ..Cause::NOTHING
};

/// Slack added to that of the ropes.
pub static ROPE_SLACK: Cause = Cause {
    name: "rope_slack",
    title: "ropes that hold late",
    means: "the ropes let the wall move before they hold",
    acts: Acts::Restraint,
    unloading: Unloading::Reversible,
    no_bearing: true,
    confounded: &["restraint.rope.stiffness_n_per_m", "end_release"],
    section: table(
        "[mechanism.rope_slack]",
        "Ropes that hold later than assumed.",
        &[&[Key::new("added_m", real("m", SIZE), Required, "Slack added to that of the ropes.")]],
    ),
    priors: priors!("rope_slack": "added_m"),
    sketch: include_str!("sketch/rope_slack.svg"),
    shows: "A tight rope holds the stones at once; a slack rope bows out, and the stones move before it holds.",
    needs: Some((|arm, _| is_roped(arm), "an arm whose ends are ropes")),
    idle: |_, arm, _| (!is_roped(arm)).then_some("there are no ropes"),
    restraint: |[added, ..], restraint| {
        if let Ends::Ropes(rope) = &mut restraint.ends {
            rope.slack += added;
        }
    },
    ..Cause::NOTHING
};

/// Friction on platform and strip.
pub static PLATFORM_FRICTION: Cause = Cause {
    name: "platform_friction",
    title: "a wall that slides on its platform",
    means: "the wall slides on its platform",
    acts: Acts::Restraint,
    unloading: Unloading::Irreversible,
    confounded: &["restraint.platform_phi_deg", "restraint.strip_height_m", "end_release", "lean"],
    section: table(
        "[mechanism.platform_friction]",
        "A platform that the wall slides on more easily, or less, than on itself.",
        &[&[Key::new(
            "phi_deg",
            real("deg", Interval::closed(0.0, 85.0)),
            Required,
            "Friction angle of the joint with platform and strip, instead of what the restraint says.",
        )
        .angle(Angle::Friction)]],
    ),
    priors: priors!("platform_friction": "phi_deg"),
    sketch: include_str!("sketch/platform_friction.svg"),
    shows: "A whole wall, its own joints intact, slides down its sloping platform from where it stood.",
    stronger_below: &["phi_deg"],
    restraint: |[phi, ..], restraint| restraint.base.tan_phi = Some(tan(radians(phi))),
    ..Cause::NOTHING
};

fn is_roped(arm: &Arm) -> bool {
    matches!(arm.restraint.ends, Ends::Ropes(_))
}
