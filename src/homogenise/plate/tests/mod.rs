//! Plates whose multiplier is known in closed form. The solver stops at a relative gap of 1e-7, or 1e-6 where rounding ends it.

mod cuts;
mod dry;
mod held;
mod slabs;
mod solvers;

use super::{Collapse, Edge, Edges, Facet, Plate};

/// Weight per area (N/m^2) of the walls.
const WEIGHT: f64 = 5000.0;
/// Thickness (m) of the walls.
const THICKNESS: f64 = 0.4;

/// A wall 4 m long and 2 m high on the ground, tilted out of plane.
fn wall(mesh: [usize; 2]) -> Plate {
    Plate {
        length: 4.0,
        height: 2.0,
        mesh,
        weight: WEIGHT,
        live: [0.0, WEIGHT, 0.0],
        base_over_top: 1.0,
        edges: Edges::RESTING,
        ropes: Vec::new(),
        base_friction: None,
    }
}

/// A facet and its mirror image, with the components of these places turned.
fn pair(normal: [f64; 6], turned: &[usize], bound: f64) -> [Facet; 2] {
    let mut mirrored = normal;
    turned.iter().for_each(|&c| mirrored[c] = -mirrored[c]);
    [Facet { normal, bound }, Facet { normal: mirrored, bound }]
}

/// Bed joints of rigid stones without tension, which turn about an edge of the face; `bond` (N/m) is added to what they bear.
fn beds(bond: f64) -> Vec<Facet> {
    pair([0.0, 1.0, 0.0, 0.0, 2.0 / THICKNESS, 0.0], &[4], bond).to_vec()
}

/// The same for upright joints.
fn heads() -> Vec<Facet> {
    pair([1.0, 0.0, 0.0, 2.0 / THICKNESS, 0.0, 0.0], &[3], 0.0).to_vec()
}

/// Sliding along the beds, up to a share of the pressure on them.
fn sliding(friction: f64) -> Vec<Facet> {
    pair([0.0, friction, 1.0, 0.0, 0.0, 0.0], &[2], 0.0).to_vec()
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-6 * expected.abs(), "{found} instead of {expected}");
}

fn solved(plate: &Plate, facets: &[Facet]) -> Collapse {
    let collapse = plate.collapse(facets).expect("it collapses");
    assert!(collapse.gap.abs() <= 1e-6 * collapse.multiplier.abs(), "gap {}", collapse.gap);
    collapse
}
