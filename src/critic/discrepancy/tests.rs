//! What is off in campaigns of walls whose formula is known.

use crate::critic::discrepancy::{Contrast, Feature};
use crate::critic::fixture::made;
use crate::critic::simulate::Seen;
use crate::random::Streams;

#[test]
fn a_family_that_moves_four_times_too_far_is_found_and_said_to() {
    let made = made();
    let (world, design, reference) = made.reference();
    let streams = Streams::new(3, 3);
    let truth = world.drawn(None, &streams);
    let mut campaign = world.campaign(&design, &truth, &streams);
    for (specimen, seen) in design.specimens.iter().zip(&mut campaign.specimens) {
        for (m, seen) in specimen.readings.iter().zip(seen).filter(|(m, _)| m.tilt.is_some()) {
            if let (true, Seen::Value(value)) = (made.study.arms[specimen.family].name == "sbl", &*seen) {
                *seen = Seen::of(4.0 * value, m);
            }
        }
    }
    let discrepancy = reference.discrepancy(&design, &campaign);
    // One in 40,000 by chance for one feature, of some thirty.
    assert!(discrepancy.largest() > 4.2, "{}", discrepancy.largest());
    let worst = discrepancy
        .excess
        .iter()
        .filter_map(|(f, x)| Some((*f, (*x)?)))
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let sbl = made.study.arms.iter().position(|arm| arm.name == "sbl").expect("a family");
    let (feature, excess) = worst.expect("something is shown");
    assert!(
        matches!(feature, Feature::Mean(family, Contrast::Level | Contrast::Growth | Contrast::Curvature) if family == sbl)
    );
    assert!(excess > 0.0 || !matches!(feature, Feature::Mean(_, Contrast::Level)), "{feature:?} {excess}");
}

#[test]
fn what_a_cause_moves_is_nothing_where_it_does_nothing_and_more_the_stronger_it_is() {
    let made = made();
    let (world, design, reference) = made.reference();
    let shift = |name: &str, score: f64| {
        let mut truth = world.drawn(Some(made.cause(name)), &Streams::new(61, 0));
        truth.parameters.iter_mut().for_each(|own| *own = score);
        // Joints far out, where a straight fit of them errs.
        truth.joints.iter_mut().for_each(|joints| joints[0] = 2.0);
        reference.shift(&world, &design, &truth, 100, 62)
    };
    // In the made-up bank cohesion does nothing; what is left is the emulator's.
    let [nothing, weak, strong] = [shift("cohesion", 1.5), shift("creep", -1.0), shift("creep", 1.5)];
    assert!(nothing < 0.3 && weak > 2.0 * nothing && strong > 2.0 * weak, "{nothing} {weak} {strong}");
}
