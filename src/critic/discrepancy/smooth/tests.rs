//! Components of discrepancies that were put in, and of none.

use super::*;
use crate::critic::fixture::made;
use crate::critic::simulate::{Truth, World};
use crate::random::Streams;
use crate::study::Measurement;

/// The components of a campaign of a design whose readings of stones are off by so much (m), by their specimen's order and quantity.
fn components(
    world: &World<'_>,
    design: &Design,
    off: &dyn Fn(Option<u32>, MeasuredQuantity) -> f64,
) -> Vec<ComponentEstimate> {
    components_in(world, design, off, &|_| 2e-3)
}

/// The same, the base model's standard deviations of displacements (m) being these.
fn components_in(
    world: &World<'_>,
    design: &Design,
    off: &dyn Fn(Option<u32>, MeasuredQuantity) -> f64,
    unit: &dyn Fn(MeasuredQuantity) -> f64,
) -> Vec<ComponentEstimate> {
    let joints = vec![0.0; world.inputs(None)];
    let truth = world.truth(None, &joints);
    let mut campaign = world.campaign(design, &truth, &Streams::new(71, 1));
    for (specimen, seen) in design.specimens.iter().zip(&mut campaign.specimens) {
        for (m, seen) in specimen.readings.iter().zip(seen) {
            if let (1, Some(_), Seen::Value(value)) = (specimen.family, m.tilt, &*seen) {
                *seen = Seen::Value(value + off(specimen.order, m.quantity));
            }
        }
    }
    let draws: Vec<Truth> = vec![truth; 40];
    let base = Predicted::of(world, design, &draws, 72);
    let known: Vec<Vec<bool>> = design.specimens.iter().map(|s| vec![true; s.readings.len()]).collect();
    let units: Vec<Vec<f64>> = design
        .specimens
        .iter()
        .map(|s| s.readings.iter().map(|m| if m.tilt.is_some() { unit(m.quantity) } else { 0.01 }).collect())
        .collect();
    SmoothDiscrepancy::new(design, &campaign, &known, &base, &units).expect("readings").components()
}

fn sure(estimate: &&ComponentEstimate) -> bool {
    estimate.value.abs() > 2.0 * estimate.sd
}

#[test]
fn what_is_lacking_is_found_where_it_is_and_with_its_size() {
    let made = made();
    let (world, (design, _)) = (made.world(), Design::of(&made.study));
    let estimates = components(&world, &design, &|_, _| 8e-3);
    let own: Vec<&ComponentEstimate> =
        estimates.iter().filter(|b| b.family == 1 && b.tilt.is_some()).collect();
    assert!(!own.is_empty() && own.iter().copied().filter(sure).count() == own.len(), "{own:?}");
    // Three readings of 1.7 mm each, and what a smooth curve shrinks it by.
    assert!(own.iter().all(|b| (b.value - 8e-3).abs() < 3e-3), "{own:?}");
    assert!(estimates.iter().filter(|b| b.tilt.is_none()).filter(sure).count() == 0, "{estimates:?}");
    assert!(components(&world, &design, &|_, _| 0.0).iter().filter(sure).count() == 0);
    // Who reads one point of a wall, in an order that nobody wrote down, sees no twist and no drift.
    assert!(estimates.iter().all(|b| b.part == Component::Level), "{estimates:?}");
}

#[test]
fn a_twist_a_bow_and_a_drift_are_told_from_a_level() {
    let made = made();
    let (world, (mut design, _)) = (made.world(), Design::of(&made.study));
    // Three points read to 0.3 mm, and the tests of the stones numbered 1, 4 and 7.
    let points = [
        MeasuredQuantity::DisplacementLeft,
        MeasuredQuantity::DisplacementCentre,
        MeasuredQuantity::DisplacementRight,
    ];
    for (index, specimen) in design.specimens.iter_mut().enumerate() {
        specimen.order = Some((index % 3 * 3 + index / 3) as u32);
        let readings = specimen.readings.iter().flat_map(|m| match m.tilt {
            Some(_) => points
                .map(|quantity| Measurement {
                    quantity,
                    error: 3e-4,
                    kind: crate::study::MeasuredKind::Exact,
                    resolution: 0.0,
                    ..m.clone()
                })
                .to_vec(),
            None => vec![m.clone()],
        });
        specimen.readings = readings.collect();
    }
    let of_points = |off: [f64; 3]| {
        move |_: Option<u32>, quantity| {
            let at = points.iter().position(|point| *point == quantity);
            off[at.expect("one of the three")]
        }
    };
    let drifting = |order: Option<u32>, _| 2e-3 * (f64::from(order.expect("numbered")) - 4.0);
    let of = |estimates: &[ComponentEstimate], part: Component| -> Vec<ComponentEstimate> {
        estimates
            .iter()
            .filter(|b| b.part == part && (b.family == 1 || part == Component::Drift))
            .copied()
            .collect()
    };
    let estimates = components(&world, &design, &of_points([4e-3, 0.0, -4e-3]));
    let twists = of(&estimates, Component::Twist);
    assert!(!twists.is_empty() && twists.iter().filter(sure).count() == twists.len(), "{twists:?}");
    assert!(twists.iter().all(|b| (b.value - 8e-3).abs() < 2e-3), "{twists:?}");
    assert_eq!(of(&estimates, Component::Drift).iter().filter(sure).count(), 0, "{estimates:?}");
    assert_eq!(of(&estimates, Component::Bow).iter().filter(sure).count(), 0, "{estimates:?}");
    let estimates = components(&world, &design, &of_points([-3e-3, 6e-3, -3e-3]));
    let bows = of(&estimates, Component::Bow);
    assert!(bows.len() == twists.len() && bows.iter().filter(sure).count() == bows.len(), "{bows:?}");
    assert!(bows.iter().all(|b| (b.value - 9e-3).abs() < 2e-3 && b.quantity == points[1]), "{bows:?}");
    assert_eq!(of(&estimates, Component::Twist).iter().filter(sure).count(), 0, "{estimates:?}");
    // Every line is about the readings that it names, however differently they vary.
    let vary = |quantity: MeasuredQuantity| if quantity == points[1] { 3e-3 } else { 1e-3 };
    for off in [[-3e-3, 6e-3, -3e-3], [5e-3, 1e-3, -3e-3]] {
        let estimates = components_in(&world, &design, &of_points(off), &vary);
        for (k, point) in points.into_iter().enumerate() {
            let levels = of(&estimates, Component::Level);
            let own: Vec<&ComponentEstimate> = levels.iter().filter(|b| b.quantity == point).collect();
            assert!(!own.is_empty() && own.iter().all(|b| (b.value - off[k]).abs() < 2e-3), "{own:?}");
        }
        let [twist, bow] = [off[0] - off[2], off[1] - 0.5 * (off[0] + off[2])];
        for (part, wanted) in [(Component::Twist, twist), (Component::Bow, bow)] {
            let own = of(&estimates, part);
            assert!(!own.is_empty() && own.iter().all(|b| (b.value - wanted).abs() < 3e-3), "{own:?}");
        }
    }
    let estimates = components(&world, &design, &drifting);
    let drifts: Vec<ComponentEstimate> = of(&estimates, Component::Drift);
    // Of the displacements, and of the collapse angles.
    assert_eq!((drifts.len(), drifts.iter().filter(sure).count()), (2, 1), "{drifts:?}");
    let own = drifts.iter().find(|b| b.quantity != MeasuredQuantity::CollapseAngle).expect("it was read");
    // One family in three drifts.
    assert!(own.value > 0.3e-3 && own.value < 2.5e-3, "{own:?}");
    assert_eq!(of(&estimates, Component::Twist).iter().filter(sure).count(), 0, "{estimates:?}");
}
