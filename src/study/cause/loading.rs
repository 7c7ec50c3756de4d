//! What changes a wall while its platform tilts.

use crate::math::{degrees, radians};
use crate::model::Tag;
use crate::protocol::{Creep, Loss};
use crate::solve::Demand;
use crate::study::cause::POSITIVE_SHARE;
use crate::study::cause::entry::{Acts, Cause, Unloading, table, tilts};
use crate::study::keys::real;
use crate::study::schema::Presence::{Default, Required};
use crate::study::schema::{Interval, Key};

/// Why neither can act on a wall that is loaded otherwise.
const LEVEL: &str = "the platform does not tilt";

/// Wedges that are crushed or fall out. Each has a uniform of its own: a larger share takes more wedges, and the same.
pub static WEDGE_LOSS: Cause = Cause {
    name: "wedge_loss",
    title: "pinning stones that fall out",
    means: "pinning stones fall out as the wall tilts",
    acts: Acts::Loading,
    unloading: Unloading::Irreversible,
    confounded: &["creep", "contact_area", "size_scatter"],
    section: table(
        "[mechanism.wedge_loss]",
        "Wedges that crush or fall out beyond a tilt, drawn per wedge.",
        &[&[
            Key::new("share", real("1", POSITIVE_SHARE), Required, "Share of the wedges that are lost."),
            Key::new(
                "beyond_deg",
                real("deg", Interval::closed(0.0, 89.0)),
                Required,
                "Last tilt at which they are there.",
            ),
        ]],
    ),
    priors: priors!("wedge_loss": "share", "beyond_deg"),
    sketch: include_str!("sketch/wedge_loss.svg"),
    shows: "A small wedge props a stone at the face of the wall; it falls out, and the stone tips.",
    stronger_below: &["beyond_deg"],
    draws: true,
    needs: Some((
        |arm, protocol| arm.layout.wedges.is_some() && tilts(protocol),
        "an arm with wedges, and a platform that tilts",
    )),
    idle: |_, arm, protocol| match arm.layout.wedges.as_ref().is_some_and(|wedges| wedges.share > 0.0) {
        true => (!tilts(protocol)).then_some(LEVEL),
        false => Some("there are no wedges"),
    },
    demand: |_| Some((Demand::WedgeLoss, "wedge_loss")),
    changes: |[share, beyond, ..], changes, wall, streams| {
        let wedges = wall.blocks.iter().enumerate().filter(|(_, block)| block.tag == Tag::Wedge);
        let lost = |id: &usize| streams.of(&format!("wedge loss {id}")).uniform() < share;
        let blocks = wedges.map(|(id, _)| id).filter(lost).collect();
        changes.loss = Some(Loss { blocks, beyond: radians(beyond) });
    },
    ..Cause::NOTHING
};

/// Creep of the joints; see [`Creep`].
pub static CREEP: Cause = Cause {
    name: "creep",
    title: "joints that go on moving under load",
    means: "joints go on moving under load, and what they moved stays",
    acts: Acts::Loading,
    unloading: Unloading::Irreversible,
    confounded: &["joint.kn_over_ks", "gauge_offset", "friction", "wedge_loss"],
    section: table(
        "[mechanism.creep]",
        "Shear tractions that relax from state of rest to state of rest: the wall ratchets downhill.",
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
    ),
    priors: priors!("creep": "rate_per_deg", "hold_share", "hold_every_deg"),
    sketch: include_str!("sketch/creep.svg"),
    shows: "A stone under a constant load slips step by step down a sloping joint; its displacement u grows with time t.",
    needs: Some((|_, protocol| tilts(protocol), "a platform that tilts")),
    idle: |_, _, protocol| (!tilts(protocol)).then_some(LEVEL),
    demand: |_| Some((Demand::Creep, "creep")),
    changes: |[rate, hold_share, every, ..], changes, _, _| {
        changes.creep = Some(Creep { rate: degrees(rate), hold_share, hold_every: radians(every) });
    },
    ..Cause::NOTHING
};
