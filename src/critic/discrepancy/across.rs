//! What is off across families, by what they differ in: how their ends are held, and how large their stones are.

use std::collections::BTreeMap;

use crate::critic::discrepancy::features::{Contrast, Feature};
use crate::critic::simulate::World;
use crate::math::ln;
use crate::stats;

/// The contrasts across families.
const CONTRASTS: [Contrast; 4] = [Contrast::Collapse, Contrast::Level, Contrast::Growth, Contrast::Curvature];
/// Stones of families whose mean weights differ by less than this factor are of one size.
const SAME_SIZE: f64 = 1.1;

/// Numbers that follow from others: each with the weights of those (by their places) that it is the sum of.
pub fn across(world: &World<'_>, features: &[Feature]) -> Vec<(Feature, Vec<(usize, f64)>)> {
    let mut found = Vec::new();
    for contrast in CONTRASTS {
        let of_families: BTreeMap<usize, usize> = features
            .iter()
            .enumerate()
            .filter_map(|(place, feature)| match feature {
                Feature::Mean(family, own) if *own == contrast => Some((*family, place)),
                _ => None,
            })
            .collect();
        let (held, free): (Vec<usize>, Vec<usize>) =
            of_families.keys().partition(|family| world.is_held(**family));
        if !held.is_empty() && !free.is_empty() {
            let mean = |families: &[usize], sign: f64| -> Vec<(usize, f64)> {
                families.iter().map(|family| (of_families[family], sign / families.len() as f64)).collect()
            };
            found.push((Feature::Restraint(contrast), [mean(&held, 1.0), mean(&free, -1.0)].concat()));
        }
        let sizes: Vec<f64> = of_families.keys().map(|family| ln(world.stone_weight(*family))).collect();
        let middle = stats::mean(&sizes).unwrap_or(0.0);
        let squares = sizes.iter().fold(0.0, |sum, size| sum + (size - middle) * (size - middle));
        let widest = sizes.iter().fold(0.0_f64, |widest, size| widest.max((size - middle).abs()));
        if widest > 0.5 * ln(SAME_SIZE) {
            // The slope of a straight line over the logarithm of the size.
            let slope =
                of_families.values().zip(&sizes).map(|(place, size)| (*place, (size - middle) / squares));
            found.push((Feature::StoneSize(contrast), slope.collect()));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::made;

    #[test]
    fn families_are_set_against_each_other_by_their_ends_and_by_their_stones() {
        let made = made();
        let world = made.world();
        // Blocks and stones with free ends, stones between ropes.
        let features = [0, 1, 2].map(|family| Feature::Mean(family, Contrast::Level));
        let found = across(&world, &features);
        let of = |feature: Feature| found.iter().find(|(own, _)| *own == feature).map(|(_, weights)| weights);
        let restraint = of(Feature::Restraint(Contrast::Level)).expect("some are held");
        assert_eq!(restraint[..], [(2, 1.0), (0, -0.5), (1, -0.5)]);
        // What goes with the logarithm of the stones' weight has that as its slope.
        let sizes = [0, 1, 2].map(|family| ln(world.stone_weight(family)));
        let size = of(Feature::StoneSize(Contrast::Level)).expect("their stones differ");
        let slope = size.iter().fold(0.0, |sum, (place, weight)| sum + weight * (3.0 * sizes[*place] - 1.0));
        assert!((slope - 3.0).abs() < 1e-9, "{slope} {sizes:?}");
        assert!(of(Feature::Restraint(Contrast::Collapse)).is_none() && found.len() == 2);
        // One family cannot be set against another.
        assert_eq!(across(&world, &features[..1]), []);
    }
}
