//! What readings and jumps count in a feature.

use super::*;
use crate::critic::fixture::made;
use crate::math::exp;
use crate::study::MeasuredKind;

/// A specimen whose centre is read at eight tilts, and what it counts of a contrast by what the readings are in their errors of a
/// millimetre at each degree.
fn counted(contrast: Contrast, readings: usize, value: &dyn Fn(f64) -> f64) -> Option<f64> {
    let made = made();
    let (mut design, _) = Design::of(&made.study);
    design.specimens.truncate(1);
    let first = design.specimens[0].readings.iter().find(|m| m.tilt.is_some()).expect("read").clone();
    let tilts: Vec<f64> = (1..=readings as u32).map(f64::from).collect();
    design.specimens[0].readings = tilts
        .iter()
        .map(|deg| Measurement {
            tilt: Some(crate::math::radians(*deg)),
            quantity: MeasuredQuantity::DisplacementCentre,
            kind: MeasuredKind::Exact,
            resolution: 0.0,
            error: 1e-3,
            ..first.clone()
        })
        .collect();
    // Readings far below the bend count as they are: a millimetre, their error, is one standard deviation.
    let usual = Usual { sd: 1e-3, bend: 1e3, counted: [0.0, 1e-6], error: 1.0 };
    let scale = Scale { specimens: vec![vec![usual; tilts.len()]], apart: Vec::new() };
    let seen = tilts.iter().map(|deg| Seen::Value(1e-3 * value(*deg))).collect();
    let shown = Campaign { specimens: vec![seen], apart: Vec::new() };
    let family = design.specimens[0].family;
    features(&design, &scale, &shown).get(&Feature::Mean(family, contrast)).copied()
}

#[test]
fn a_jump_stands_out_of_the_steps_before_and_after_it() {
    let of = |value: &dyn Fn(f64) -> f64| counted(Contrast::Jump, 8, value).expect("it is read often enough");
    assert!(of(&|x| 3.0 * x) < 1e-6 && of(&|x| x * x) < 1e-6);
    let stepped = of(&|x| x + if x > 4.5 { 6.0 } else { 0.0 });
    // The step, in the error of four readings with the weights 1/2, 3/2, 3/2 and 1/2.
    assert!((stepped - 6.0 / 5.0_f64.sqrt()).abs() < 1e-6, "{stepped}");
    assert_eq!(counted(Contrast::Jump, 3, &|_| 0.0), None);
}

#[test]
fn a_gauge_at_its_end_slows_down_and_a_wall_never_does() {
    let of =
        |value: &dyn Fn(f64) -> f64| counted(Contrast::Slowing, 8, value).expect("it is read often enough");
    assert!(of(&|x| 3.0 * x).abs() < 1e-6);
    // Of x^2 the second differences are 2, the least of all spans.
    assert!((of(&|x| x * x) + asinh(2.0 / 6.0_f64.sqrt())).abs() < 1e-9);
    // At 4 mm it stands still: 3 mm in the three degrees before, none in the three after.
    let ended = of(&|x| x.min(4.0));
    assert!((ended - asinh(3.0 / 6.0_f64.sqrt())).abs() < 1e-9, "{ended}");
    assert_eq!(counted(Contrast::Slowing, 4, &|_| 0.0), None);
}

#[test]
fn readings_count_by_their_logarithm_far_above_their_error_and_as_they_stand_below() {
    let made = made();
    let (design, _) = Design::of(&made.study);
    let error = 1e-3;
    let m = Measurement {
        error,
        resolution: 0.0,
        kind: MeasuredKind::Exact,
        ..design.specimens[0].readings[0].clone()
    };
    // From ten to a thousand times the error, a factor apart each.
    let shown: Vec<f64> = (0..101).map(|k| error * exp(ln(10.0) * (1.0 + 0.02 * f64::from(k)))).collect();
    let usual = Usual::of(&m, &shown);
    let of = |value: f64| usual.scaled(Seen::Value(value), &m).expect("it is seen");
    // What stiffer joints do to all displacements is the same step for small and for large ones.
    let (small, large) = (of(0.04) - of(0.02), of(0.8) - of(0.4));
    assert!(small > 0.0 && (small / large - 1.0).abs() < 1e-3, "{small} {large}");
    let (once, twice) = (of(0.05 * error) - of(0.0), of(0.1 * error) - of(0.0));
    assert!((twice / once - 2.0).abs() < 0.01, "{once} {twice}");
    // The middle of the logarithms counts 0, and an error there what it moves.
    let middle = 0.1;
    assert!(of(middle).abs() < 1e-3, "{}", of(middle));
    let moved = of(middle + 0.5 * error) - of(middle - 0.5 * error);
    assert!((usual.error / moved - 1.0).abs() < 1e-3, "{moved}");
    // In metres it varies as it does.
    assert!((usual.sd - stats::sigma(&shown).expect("many")).abs() < 1e-12);
}

#[test]
fn a_reading_that_is_rounded_to_nothing_in_all_campaigns_varies_by_its_rounding() {
    let made = made();
    let (design, _) = Design::of(&made.study);
    let m =
        Measurement { value: 0.0, error: 0.0, resolution: 1e-3, ..design.specimens[0].readings[0].clone() };
    let usual = Usual::of(&m, &[0.0; 300]);
    let of = |value: f64| usual.scaled(Seen::Value(value), &m).expect("it is seen");
    assert_eq!(of(0.0), 0.0);
    assert!(of(1e-3) > 1.0 && of(1e-3) < 10.0 && usual.sd > 0.0, "{} {}", of(1e-3), usual.sd);
    let exact =
        Usual::of(&Measurement { resolution: 0.0, kind: MeasuredKind::Exact, ..m.clone() }, &[0.0; 300]);
    assert_eq!(exact.scaled(Seen::Value(0.0), &m), Some(0.0));
}
