//! Dry walls on the ground, free at their sides.

use super::*;
use crate::homogenise::plate::PlateFault;

#[test]
fn a_free_wall_overturns_about_the_edge_of_its_foot() {
    let facets = [beds(0.0), heads()].concat();
    for mesh in [[1, 1], [3, 2], [6, 4]] {
        // Weight times t/2 against weight times lambda H/2.
        near(solved(&wall(mesh), &facets).multiplier, THICKNESS / 2.0);
    }
}

#[test]
fn a_load_that_is_greater_at_the_foot_overturns_a_wall_by_its_own_lever() {
    for ratio in [0.0, 0.5, 2.0, 5.0] {
        for mesh in [[1, 1], [3, 2]] {
            let pressed = Plate { base_over_top: ratio, ..wall(mesh) };
            // A trapezoid's centre of gravity over the foot.
            let lever = 2.0 / 3.0 * (ratio + 2.0) / (ratio + 1.0);
            near(solved(&pressed, &beds(0.0)).multiplier, THICKNESS / 2.0 / lever);
        }
    }
}

#[test]
fn the_foot_of_a_wall_that_overturns_opens_by_half_the_thickness_times_its_turn() {
    let collapse = solved(&wall([3, 2]), &[beds(0.0), heads()].concat());
    let foot = collapse.sections.iter().filter(|s| s.at[1] == 0.0 && s.normal == Some([0.0, -1.0]));
    let mut ends = 0;
    for section in foot {
        let [.., e22, _, _, chi22, _] = section.rate;
        // Towards +y, by one radian per second over the power of a wall of 4 m x 2 m that turns so.
        near(chi22, 1.0 / (WEIGHT * 4.0 * 2.0));
        near(e22, THICKNESS / 2.0 * chi22);
        ends += 1;
    }
    assert_eq!(ends, 6);
    let top =
        collapse.mechanism.nodes.iter().zip(&collapse.mechanism.deflection).filter(|(n, _)| n[1] == 2.0);
    top.for_each(|(_, &w)| near(w, 2.0 / (WEIGHT * 4.0 * 2.0)));
}

#[test]
fn the_section_at_the_foot_bears_the_weight_at_its_edge() {
    let collapse = solved(&wall([3, 2]), &[beds(0.0), heads()].concat());
    let foot = || collapse.sections.iter().filter(|s| s.at[1] == 0.0 && s.normal == Some([0.0, -1.0]));
    let sum = |c: usize| foot().map(|s| s.size * s.stress[c]).sum::<f64>();
    let weight = WEIGHT * 4.0 * 2.0;
    near(sum(1), -weight);
    near(sum(4), weight * THICKNESS / 2.0);
}

#[test]
fn a_wall_tilted_the_other_way_overturns_alike() {
    let mut back = wall([3, 2]);
    back.live[1] = -WEIGHT;
    near(solved(&back, &beds(0.0)).multiplier, THICKNESS / 2.0);
}

#[test]
fn a_wall_in_one_piece_tilted_along_itself_overturns_about_its_corner() {
    let mut along = wall([4, 2]);
    along.live = [WEIGHT, 0.0, 0.0];
    near(solved(&along, &beds(0.0)).multiplier, 4.0 / 2.0);
    // Corners of the mesh are where the facets hold, so it may be as coarse as can be.
    along.mesh = [1, 1];
    near(solved(&along, &beds(0.0)).multiplier, 4.0 / 2.0);
}

#[test]
fn a_wall_tilted_along_itself_slides_where_friction_is_low() {
    let mut along = wall([4, 2]);
    along.live = [WEIGHT, 0.0, 0.0];
    near(solved(&along, &[beds(0.0), sliding(0.3)].concat()).multiplier, 0.3);
}

#[test]
fn sliding_out_of_plane_is_told_apart() {
    let facets = beds(0.0);
    let mut slippery = wall([2, 1]);
    assert_eq!(solved(&slippery, &facets).sliding, None);
    slippery.base_friction = Some(0.1);
    assert_eq!(solved(&slippery, &facets).sliding, Some(0.1));
    // A live load that also lifts: 0.1 (W - lambda W/2) = lambda W.
    slippery.live = [0.0, WEIGHT, WEIGHT / 2.0];
    near(solved(&slippery, &facets).sliding.unwrap(), 0.1 / 1.05);
    slippery.edges.left = Edge::Propped;
    assert_eq!(solved(&slippery, &facets).sliding, None);
}

#[test]
fn ropes_keep_a_wall_from_sliding_out_but_not_back() {
    let mut roped = Plate { base_friction: Some(0.1), ropes: vec![[1.0, 1.0]], ..wall([2, 2]) };
    assert_eq!(solved(&roped, &beds(0.0)).sliding, None);
    roped.live[1] = -WEIGHT;
    assert_eq!(solved(&roped, &beds(0.0)).sliding, Some(0.1));
}

#[test]
fn a_wall_in_mid_air_falls_at_rest_and_one_without_facets_never_does() {
    let mut floating = wall([2, 1]);
    floating.edges.bottom = Edge::Free;
    assert_eq!(floating.collapse(&beds(0.0)), Err(PlateFault::FallsAtRest));
    assert_eq!(wall([2, 1]).collapse(&[]), Err(PlateFault::Unbounded));
}

#[test]
fn a_wall_that_its_dead_load_upsets_has_a_multiplier_below_zero() {
    // It pulls at its foot, by its weight, unless the live load presses twice as much.
    let mut hanging = wall([2, 1]);
    hanging.edges = Edges { bottom: Edge::Free, top: Edge::Held, ..Edges::RESTING };
    hanging.live = [0.0, 0.0, -WEIGHT];
    near(solved(&hanging, &beds(0.0)).multiplier, -1.0);
}

#[test]
fn what_makes_no_sense_is_named() {
    let facets = beds(0.0);
    let fault = |change: &dyn Fn(&mut Plate)| {
        let mut plate = wall([1, 1]);
        change(&mut plate);
        plate.collapse(&facets).unwrap_err()
    };
    assert_eq!(fault(&|p| p.length = 0.0), PlateFault::Size(0.0, 2.0));
    assert_eq!(fault(&|p| p.mesh = [3, 0]), PlateFault::Mesh(3, 0));
    assert_eq!(fault(&|p| p.live = [0.0; 3]), PlateFault::Load);
    assert_eq!(fault(&|p| p.base_over_top = -1.0), PlateFault::Load);
    assert_eq!(fault(&|p| p.weight = -1.0), PlateFault::Load);
    assert_eq!(fault(&|p| p.base_friction = Some(-0.1)), PlateFault::Friction(-0.1));
    assert_eq!(fault(&|p| p.ropes = vec![[1.0, 1.0], [1.0, 2.1]]), PlateFault::Rope(1));
    let flat = [facets[0], Facet { normal: [0.0; 6], bound: 1.0 }];
    assert_eq!(wall([1, 1]).collapse(&flat), Err(PlateFault::Facet(1)));
}
