//! The method of its own beside the general solver.

use super::*;
use crate::homogenise::plate::{PlateFault, interior};

/// A cone with as many facets, across directions in a fixed disorder: tangent to an ellipsoid of N11, N12, M11, M22 and M12 at a
/// pressure of one on the beds.
fn cone(count: usize) -> Vec<Facet> {
    let (centre, axes) =
        ([-5.0, 0.0, 0.0, 0.0, 0.0], [5.3, 0.6, 0.6 * THICKNESS, 0.5 * THICKNESS, 0.3 * THICKNESS]);
    let facet = |k: usize| {
        // Multiples of irrational numbers fill the cube evenly.
        let part = |root: f64| ((k + 1) as f64 * root.sqrt()).fract() - 0.5;
        let direction = [2.0, 3.0, 5.0, 7.0, 11.0].map(part);
        let length = direction.iter().map(|d| d * d).sum::<f64>().sqrt();
        let normal: [f64; 5] = std::array::from_fn(|c| direction[c] / axes[c]);
        let reach = length + normal.iter().zip(centre).map(|(n, c)| n * c).sum::<f64>();
        Facet { normal: [normal[0], reach, normal[1], normal[2], normal[3], normal[4]], bound: 0.0 }
    };
    beds(0.0).into_iter().chain((0..count).map(facet)).collect()
}

fn propped(mesh: [usize; 2]) -> Plate {
    let edges = Edges { left: Edge::Propped, right: Edge::Propped, ..Edges::RESTING };
    Plate { edges, ropes: vec![[1.3, 1.9], [2.0, 2.0]], ..wall(mesh) }
}

#[test]
fn both_solvers_agree() {
    let facets = cone(40);
    let plate = propped([3, 2]);
    let own = plate.collapse_by(&facets, |p| interior::solve(p).ok_or(PlateFault::Unbounded)).unwrap();
    let whole = plate.collapse_by(&facets, |p| p.solve_whole()).unwrap();
    near(own.multiplier, whole.multiplier);
    // Where they may differ, in states and mechanisms that bear and cost as much, both are in balance.
    for collapse in [&own, &whole] {
        let stress =
            collapse.sections.iter().flat_map(|s| &s.stress[..3]).fold(0.0, |a: f64, n| a.max(n.abs()));
        for section in &collapse.sections {
            let excess = facets.iter().map(|f| f.excess(&section.stress)).fold(0.0, f64::max);
            assert!(excess <= 1e-5 * stress, "{excess} of {stress}");
        }
        let power = |s: &crate::homogenise::plate::Section| {
            s.size * s.rate.iter().zip(&s.stress).map(|(r, n)| r * n).sum::<f64>()
        };
        // The weight's power is what the live load's is not: all facets go through zero.
        let inner: f64 = collapse.sections.iter().map(power).sum();
        assert!(inner.abs() < 1e-5, "{inner}");
    }
}

#[test]
fn edges_fold_and_part_across_themselves_only() {
    let collapse = propped([3, 2]).collapse(&cone(40)).unwrap();
    let most = collapse.sections.iter().flat_map(|s| s.rate).fold(0.0, |a: f64, r| a.max(r.abs()));
    let mut oblique = 0;
    for section in &collapse.sections {
        let Some([n1, n2]) = section.normal else { continue };
        let [e11, e22, e12, chi11, chi22, chi12] = section.rate;
        // Strain along the edge, then what is left of the curvature beside that across it.
        let along = e11 * n2 * n2 + e22 * n1 * n1 - e12 * n1 * n2;
        let fold = chi11 + chi22;
        let rest = [chi11 - fold * n1 * n1, chi22 - fold * n2 * n2, chi12 - 2.0 * fold * n1 * n2];
        assert!([along, rest[0], rest[1], rest[2]].iter().all(|x| x.abs() < 1e-9 * most), "{along} {rest:?}");
        oblique += usize::from((fold * n1 * n2).abs() > 1e-3 * most);
    }
    assert!(oblique > 0, "no fold of this mechanism is oblique");
}

#[test]
fn the_same_plate_collapses_to_the_same_bits() {
    let facets = cone(20);
    let collapses = [0, 1].map(|_| propped([2, 2]).collapse(&facets).unwrap());
    assert_eq!(collapses[0], collapses[1]);
}

#[test]
fn a_program_without_solution_is_left_to_the_general_solver() {
    let own = |plate: &Plate, facets: &[Facet]| {
        plate.collapse_by(facets, |p| interior::solve(p).ok_or_else(|| PlateFault::NotSolved(String::new())))
    };
    let mut floating = wall([2, 1]);
    floating.edges.bottom = Edge::Free;
    assert!(matches!(own(&floating, &beds(0.0)), Err(PlateFault::NotSolved(_))));
    assert!(own(&wall([2, 1]), &beds(0.0)).is_ok());
}
