//! Sketches of the causes: what each one is of a wall or of a test, at a glance.

use crate::render::document::Drawing;

/// The sketches by the name of the mechanism, with a description for those who do not see them.
const SKETCHES: [(&str, &str, &str); 18] = [
    (
        "contact_inset",
        "Two stones whose edges are rounded touch only along a line that begins a distance r behind their faces.",
        include_str!("sketch/contact_inset.svg"),
    ),
    (
        "joint_closure",
        "Two rough faces touch at two points; the stress-closure curve is soft at first, then as steep as the straight line of the base model.",
        include_str!("sketch/joint_closure.svg"),
    ),
    (
        "stress_stiffening",
        "A spring between two stones is thin under a small force and thick under a large one; stiffness rises with stress towards kn.",
        include_str!("sketch/stress_stiffening.svg"),
    ),
    (
        "contact_area",
        "The bed face of a stone touches its neighbour on all its area on the left, on scattered patches only on the right.",
        include_str!("sketch/contact_area.svg"),
    ),
    (
        "friction",
        "A stone slides on a smooth slope below the stated friction angle; another holds on a rough slope steeper than that angle.",
        include_str!("sketch/friction.svg"),
    ),
    (
        "cohesion",
        "A pulled stone lifts freely off a dry joint; earth in the joint holds it to the stone below.",
        include_str!("sketch/cohesion.svg"),
    ),
    (
        "lean",
        "A plumb line shows that a wall leans; a spirit level shows that a platform under an upright stack slopes.",
        include_str!("sketch/lean.svg"),
    ),
    (
        "base_compliance",
        "A platform on firm ground stays level; on springs it settles and turns, and the wall on it leans.",
        include_str!("sketch/base_compliance.svg"),
    ),
    (
        "wedge_loss",
        "A small wedge props a stone at the face of the wall; it falls out, and the stone tips.",
        include_str!("sketch/wedge_loss.svg"),
    ),
    (
        "rope_slack",
        "A tight rope holds the stones at once; a slack rope bows out, and the stones move before it holds.",
        include_str!("sketch/rope_slack.svg"),
    ),
    (
        "size_scatter",
        "A wall of similar stones with a narrow size curve, beside a wall of very uneven stones with a wide one.",
        include_str!("sketch/size_scatter.svg"),
    ),
    (
        "density",
        "On a balance, a stone of the same size as another weighs more; a dashed beam shows the opposite case.",
        include_str!("sketch/density.svg"),
    ),
    (
        "gauge_offset",
        "The wall stands still, but its dial gauge has shifted towards it, and the needle no longer points to zero.",
        include_str!("sketch/gauge_offset.svg"),
    ),
    (
        "gauge_scale",
        "A stone has moved by three divisions of a true ruler; the gauge's ruler, with finer divisions, shows five.",
        include_str!("sketch/gauge_scale.svg"),
    ),
    (
        "creep",
        "A stone under a constant load slips step by step down a sloping joint; its displacement u grows with time t.",
        include_str!("sketch/creep.svg"),
    ),
    (
        "specimen_scatter",
        "Three walls of the same stones, numbered 1 to 3, have smooth, wavy and rough bed joints.",
        include_str!("sketch/specimen_scatter.svg"),
    ),
    (
        "end_release",
        "The stacked stones at both ends of a wall slide out of its face; the interlocked middle stays.",
        include_str!("sketch/end_release.svg"),
    ),
    (
        "platform_friction",
        "A whole wall, its own joints intact, slides down its sloping platform from where it stood.",
        include_str!("sketch/platform_friction.svg"),
    ),
];

/// The sketch of a cause.
pub fn sketch(name: &str, title: &str) -> Drawing {
    let own = SKETCHES.iter().find(|(own, ..)| *own == name);
    crate::check!(own.is_some(), "no sketch of {name}");
    let (svg, described) = own
        .map_or(("<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>", title), |(_, described, svg)| {
            (*svg, *described)
        });
    Drawing::described(&format!("sketch-{name}"), title, described, svg)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::INVENTORY;

    #[test]
    fn every_mechanism_has_a_sketch_and_a_description() {
        for entry in &INVENTORY {
            let own = SKETCHES.iter().find(|(name, ..)| *name == entry.name);
            let (_, described, svg) = own.unwrap_or_else(|| panic!("{} has no sketch", entry.name));
            assert!(described.ends_with('.') && described.len() > 20, "{}: {described}", entry.name);
            assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"), "{}", entry.name);
        }
        assert_eq!(SKETCHES.len(), INVENTORY.len());
    }
}
