//! Surfaces found plane by plane.

use super::slabs::{STRENGTH, all, isotropic, slab};
use super::*;
use crate::homogenise::plate::{Cuts, Ending, PlateFault, Section};
use crate::math;

const CUTS: Cuts = Cuts { tolerance: 1e-7, rounds: 30, asked: usize::MAX };

/// The plane of Johansen's slab across the principal moment that exceeds most.
fn johansen(section: &Section) -> Option<Facet> {
    let [.., m11, m22, m12] = section.stress;
    let angle = math::atan2(2.0 * m12, m11 - m22) / 2.0;
    let plane = |angle: f64, sign: f64| {
        let (c, s) = (math::cos(angle), math::sin(angle));
        Facet { normal: [0.0, 0.0, 0.0, c * c, s * s, 2.0 * c * s].map(|n| sign * n), bound: STRENGTH }
    };
    let planes = [(0.0, 1.0), (0.0, -1.0), (0.5, 1.0), (0.5, -1.0)]
        .map(|(turn, sign)| plane(angle + turn * std::f64::consts::PI, sign));
    planes.into_iter().max_by(|a, b| a.excess(&section.stress).total_cmp(&b.excess(&section.stress)))
}

/// Facets about that slab, far from it for twisting.
fn loose() -> Vec<Facet> {
    let mut facets = isotropic(2);
    facets.extend(pair([0.0, 0.0, 0.0, 0.0, 0.0, 1.0], &[5], 3.0 * STRENGTH));
    facets
}

#[test]
fn cuts_find_the_slab_that_the_facets_only_surround() {
    let plate = slab([2, 2], all(Edge::Propped));
    let refined = plate.collapse_by_cuts(loose(), &mut johansen, &CUTS).unwrap();
    let factors: Vec<f64> = refined.multipliers.iter().map(|m| m * 9.0 / STRENGTH).collect();
    assert!(factors[0] > 30.0, "{factors:?}");
    assert!(factors.is_sorted_by(|before, after| *after < before * (1.0 + 1e-6)), "{factors:?}");
    assert!((factors.last().unwrap() - 24.0).abs() < 1e-4, "{factors:?}");
    assert_ne!(refined.ending, Ending::RoundsSpent);
    // Planes are put to the sections that they cut: at all others they would change nothing.
    let everywhere = plate.collapse(&refined.facets).unwrap();
    assert!((everywhere.multiplier / refined.collapse.multiplier - 1.0).abs() < 1e-5);
}

#[test]
fn a_cone_is_cut_where_the_stress_is_outside() {
    let twice_as_thick = pair([0.0, 1.0, 0.0, 0.0, 1.0 / THICKNESS, 0.0], &[4], 0.0).to_vec();
    let mut asked = 0;
    let mut support = |section: &Section| {
        asked += 1;
        beds(0.0).into_iter().find(|f| f.excess(&section.stress) > 0.0)
    };
    let refined = wall([2, 2]).collapse_by_cuts(twice_as_thick, &mut support, &CUTS).unwrap();
    near(refined.multipliers[0], THICKNESS);
    near(refined.collapse.multiplier, THICKNESS / 2.0);
    assert_eq!(refined.ending, Ending::Exact);
    assert_eq!(refined.asked, asked);
    // The one cut is at the face that it turns about.
    assert_eq!(refined.facets.len(), 3, "{:?}", refined.facets);
}

#[test]
fn rounds_and_questions_are_limited() {
    let plate = slab([2, 2], all(Edge::Propped));
    let mut asked = 0;
    let mut support = |section: &Section| {
        asked += 1;
        johansen(section)
    };
    let limits = Cuts { rounds: 2, asked: 1, ..CUTS };
    let refined = plate.collapse_by_cuts(loose(), &mut support, &limits).unwrap();
    assert_eq!((refined.ending, refined.multipliers.len(), asked), (Ending::RoundsSpent, 2, 2));
    // A support that knows of no plane, for one section asked about of many.
    let none = plate.collapse_by_cuts(loose(), &mut |_| None, &limits).unwrap();
    assert_eq!((none.ending, none.multipliers.len(), none.asked), (Ending::Settled, 1, 1));
}

#[test]
fn cuts_that_leave_the_weight_nothing_make_the_wall_fall_at_rest() {
    let mut support = |_: &Section| Some(Facet { normal: [0.0, -1.0, 0.0, 0.0, 0.0, 0.0], bound: 0.0 });
    let found = wall([1, 1]).collapse_by_cuts(beds(0.0), &mut support, &CUTS);
    assert_eq!(found, Err(PlateFault::FallsAtRest));
}
