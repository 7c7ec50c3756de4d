//! Where the faces of a joint touch.

use crate::law::{PATCHES_ALONG, Sampling};
use crate::random::Stream;
use crate::solve::Demand;
use crate::study::bearing::Bearing;
use crate::study::cause::POSITIVE_SHARE;
use crate::study::cause::entry::{Acts, Beside, Cause, Clash, table};
use crate::study::checked::Arm;
use crate::study::keys::{BEARING, real};
use crate::study::schema::Presence::Required;
use crate::study::schema::{Interval, Key};

/// Patches along each side of a joint, see [`Sampling::Patches`], and parts of four patches each.
const SIDE: u32 = PATCHES_ALONG;
const PARTS: usize = (SIDE * SIDE / 4) as usize;

/// Rounded arrises.
pub static CONTACT_INSET: Cause = Cause {
    name: "contact_inset",
    title: "rounded arrises: joints that begin behind the faces",
    means: "joints begin behind the stated faces; rounded arrises, a soft bed that may open and a wall thinner than stated look the same",
    acts: Acts::Joints,
    confounded: &[
        "joint.kn_pa_per_m",
        "restraint.strip_height_m",
        "lean",
        "contact_area",
        "bearing_points",
        "worn_bearing",
    ],
    section: table(
        "[mechanism.contact_inset]",
        "Rounded or chipped arrises.",
        &[&[Key::new(
            "radius_m",
            real("m", Interval::above(0.0, 0.5)),
            Required,
            "Distance from a stone's edges within which joints do not touch.",
        )]],
    ),
    priors: priors!("contact_inset": "radius_m"),
    sketch: include_str!("sketch/contact_inset.svg"),
    shows: "Two stones whose edges are rounded touch only along a line that begins a distance r behind their faces.",
    contacts: |[radius, ..], contacts| contacts.inset = radius,
    ..Cause::NOTHING
};

/// Patches in contact, drawn per joint.
pub static CONTACT_AREA: Cause = Cause {
    name: "contact_area",
    title: "stones that touch on a part of their faces",
    means: "stones touch on a part of their faces only",
    acts: Acts::Joints,
    confounded: &[
        "joint.kn_pa_per_m",
        "contact_inset",
        "joint_closure",
        "size_scatter",
        "specimen_scatter",
        "wedge_loss",
        "bearing_points",
    ],
    section: table(
        "[mechanism.contact_area]",
        "Joints that touch in patches only, drawn per joint; the stiffness per area in contact stays.",
        &[&[Key::new(
            "share",
            real("1", POSITIVE_SHARE),
            Required,
            "Share of each joint in contact, in 64ths: so many patches of an 8 x 8 grid.",
        )]],
    ),
    priors: priors!("contact_area": "share"),
    sketch: include_str!("sketch/contact_area.svg"),
    shows: "The bed face of a stone touches its neighbour on all its area on the left, on scattered patches only on the right.",
    stronger_below: &["share"],
    instead_of: &["bearing_points"],
    draws: true,
    idle: |_, arm, _| otherwise_touching(arm, "bearing_points"),
    clashes: |_, beside| clashes(beside, None),
    demand: |_| Some((Demand::ContactArea, "contact_area")),
    law: |[share, ..], law, site| {
        let [a, b] = site.blocks;
        let mut stream = site.streams.of(&format!("joint contact_area {a}-{b}"));
        law.sampling = Sampling::Patches(patches(share, &mut stream));
    },
    ..Cause::NOTHING
};

/// A few points of each bed; see [`Bearing`].
pub static BEARING_POINTS: Cause = Cause {
    name: "bearing_points",
    title: "stones that bear on few points of their beds",
    means: "stones bear on few points of their beds; many points look like partial contact, points at the edge like rounded arrises",
    acts: Acts::Joints,
    confounded: &[
        "joint.kn_pa_per_m",
        "contact_area",
        "contact_inset",
        "joint_closure",
        "size_scatter",
        "specimen_scatter",
        "worn_bearing",
    ],
    section: table(
        "[mechanism.bearing_points]",
        "Bed joints that bear on few points in place of the whole face, drawn per joint; the stiffness per area in contact stays.",
        BEARING.keys,
    ),
    priors: priors!("bearing_points": "points", "relief_m", "share"),
    sketch: include_str!("sketch/bearing_points.svg"),
    shows: "The bed face of a stone touches its neighbour on all its area on the left, on three small patches only on the right.",
    stronger_below: &["points", "share"],
    instead_of: &["contact_area"],
    draws: true,
    idle: |_, arm, _| otherwise_touching(arm, "contact_area"),
    clashes: |_, beside| clashes(beside, Some("contact_area")),
    law: |[points, relief, share, ..], law, site| {
        let [a, b] = site.blocks;
        law.sampling = Sampling::Seats(Bearing { points, relief, share }.seating(site.streams, a, b));
    },
    ..Cause::NOTHING
};

/// Why the faces of an arm touch in another way already.
fn otherwise_touching(arm: &Arm, other: &str) -> Option<&'static str> {
    match arm.joint.bearing {
        _ if arm.mechanisms.has(other) => Some("another part of each face touches"),
        Some(_) => Some("stones bear on stated points of their beds"),
        None => (arm.joint.sampling == Sampling::Vertices).then_some("joints are sampled at their corners"),
    }
}

/// What of a study says otherwise where the faces of a joint touch; `other` is a cause that does.
fn clashes(beside: &Beside<'_>, other: Option<&str>) -> Vec<Clash> {
    let part = "one part of each face that touches";
    let others =
        other.filter(|other| beside.mechanisms.has(other)).map(|other| (format!("mechanism.{other}"), part));
    let corners = (beside.joint.sampling == Sampling::Vertices)
        .then(|| ("joint.sampling = \"vertices\"".to_owned(), "joints that are sampled over their area"));
    let seated = beside.joint.bearing.map(|_| ("joint.bearing".to_owned(), part));
    let clash = |(with, allowed): (String, &'static str)| Clash {
        what: format!("does not go with {with}"),
        allowed,
        fix: "remove one of the two",
    };
    others.into_iter().chain(corners).chain(seated).map(clash).collect()
}

/// A mask of the patches nearest to a share, at least one. A stone settles until it is carried on all sides, so the parts of
/// a joint, four patches each, take turns: in each of four rounds each has one more of its patches, in random order.
fn patches(share: f64, stream: &mut Stream) -> u64 {
    let count = ((f64::from(SIDE * SIDE) * share).round() as usize).clamp(1, 4 * PARTS);
    let within: [[usize; 4]; PARTS] = std::array::from_fn(|_| shuffled(stream));
    // The uniforms of the first patches do not depend on how many there are: a larger share adds to a smaller one.
    let order = (0..4).flat_map(|round| shuffled::<PARTS>(stream).map(|part| (part, within[part][round])));
    order.take(count).fold(0, |mask, (part, patch)| {
        let side = SIDE as usize;
        let (row, column) = (2 * (part / (side / 2)) + patch / 2, 2 * (part % (side / 2)) + patch % 2);
        mask | 1 << (side * row + column)
    })
}

/// The first numbers in random order.
fn shuffled<const N: usize>(stream: &mut Stream) -> [usize; N] {
    let mut order = std::array::from_fn(|k| k);
    (0..N).for_each(|k| order.swap(k, k + stream.below(N - k)));
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Streams;

    #[test]
    fn patches_are_as_many_as_asked_for_and_grow_with_the_share() {
        let of = |share: f64, name: &str| patches(share, &mut Streams::new(3, 1).of(name));
        for (share, count) in [(0.001, 1), (0.25, 16), (0.5, 32), (0.53, 34), (0.9, 58), (1.0, 64)] {
            assert_eq!(of(share, "a").count_ones(), count, "{share}");
        }
        assert_eq!(of(0.25, "a") & of(0.75, "a"), of(0.25, "a"));
        assert_ne!(of(0.5, "a"), of(0.5, "b"));
        // A quarter is one patch in each part: bits 0, 1, 8, 9 are the first.
        for k in 0..100 {
            let mask = of(0.25, &format!("{k}"));
            for part in [0, 2, 16, 34, 54] {
                assert_eq!((mask >> part & 0x0303).count_ones(), 1, "{mask:064b}");
            }
        }
        // Every patch comes up as often: 16 x 1000 draws of a quarter, 4000 +- 5 sigma of a binomial of 3/4 x 1/4.
        let mut seen = [0u32; 64];
        for k in 0..16_000 {
            let mask = of(0.25, &k.to_string());
            (0..64).for_each(|bit| seen[bit] += u32::from(mask >> bit & 1 == 1));
        }
        assert!(seen.iter().all(|n| n.abs_diff(4000) < 274), "{seen:?}");
    }
}
