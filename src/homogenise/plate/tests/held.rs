//! Walls that ropes or end blocks hold.

use super::*;
use crate::homogenise::plate::PlateFault;

/// The wall with ropes along its top, at all nodes there.
fn roped(mesh: [usize; 2]) -> Plate {
    let mut plate = wall(mesh);
    let points = 2 * mesh[0];
    plate.ropes = (0..=points).map(|k| [plate.length * k as f64 / points as f64, plate.height]).collect();
    plate
}

#[test]
fn ropes_along_the_top_double_what_a_dry_wall_bears() {
    // A hinge at the foot by the turn 1, one at h, and the top held: the lower part rises by t/2, the upper one by t/2 (2 + h/(H-h)),
    // so that lambda = 2 t/h; the least is at the very top, where what is above the hinge is light but turns fast. From below: a rope
    // that pulls W t/2 over the height leaves |M| <= N t/2 at every depth.
    let least = 2.0 * THICKNESS / 2.0;
    let multipliers = [2, 4, 8].map(|up| {
        let found = solved(&roped([1, up]), &beds(0.0)).multiplier;
        let lowest_line = least / (1.0 - 1.0 / up as f64);
        assert!(
            found > least * (1.0 - 1e-6) && found < lowest_line,
            "{found} outside {least}..{lowest_line}"
        );
        found
    });
    assert!(multipliers.is_sorted_by(|coarse, fine| fine < coarse), "{multipliers:?}");
}

#[test]
fn ropes_along_the_top_of_a_wall_with_bond_leave_a_hinge_below_it() {
    // With a bond c on every hinge, lambda(h) = 2 (W t H + c (1 + H/(H-h))) / (q H h); it is least at h = 3H/4 where W t H = 7 c:
    // 32 c / (q H^2). Every bond c is the work per turn, the facet's bound times t/2.
    let bond = WEIGHT * THICKNESS * 2.0 / 7.0;
    let facets = beds(bond / (THICKNESS / 2.0));
    let collapse = solved(&roped([1, 4]), &facets);
    near(collapse.multiplier, 32.0 * bond / (WEIGHT * 4.0));
    // The ropes' moment about the foot is what the live load's is beyond that of weight and bond.
    let pull: f64 = collapse.ropes.iter().sum();
    let live = collapse.multiplier * WEIGHT * 4.0 * 2.0 * 1.0;
    near(pull * 2.0, live - WEIGHT * 4.0 * 2.0 * THICKNESS / 2.0 - bond * 4.0);
}

#[test]
fn a_rope_halfway_up_leaves_the_upper_half_to_overturn() {
    let mut plate = wall([2, 2]);
    plate.ropes = vec![[1.0, 1.0]];
    near(solved(&plate, &beds(0.0)).multiplier, THICKNESS / 1.0);
}

#[test]
fn ropes_do_not_hold_a_wall_that_goes_back() {
    let mut back = roped([2, 2]);
    back.live[1] = -WEIGHT;
    let collapse = solved(&back, &beds(0.0));
    near(collapse.multiplier, THICKNESS / 2.0);
    assert!(collapse.ropes.iter().all(|pull| pull.abs() < 1e-3), "{:?}", collapse.ropes);
}

#[test]
fn a_wall_without_tension_arches_between_end_blocks() {
    let mut between = wall([4, 2]);
    between.edges = Edges::BETWEEN_END_BLOCKS;
    assert_eq!(between.collapse(&[beds(0.0), heads()].concat()), Err(PlateFault::Unbounded));
}
