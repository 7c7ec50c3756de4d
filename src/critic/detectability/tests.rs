//! Maps whose cells are known.

use std::num::NonZero;
use std::path::Path;

use super::map::cell;
use super::observable::observables;
use super::*;
use crate::critic::compare::Simulated;
use crate::critic::tests::{measurement, study};
use crate::ensemble::Silent;
use crate::math::{degrees, radians};
use crate::study::{Described, MeasuredKind, MeasuredQuantity, Measurement, Study, described};

fn mechanisms(names: &[&str]) -> Vec<Described> {
    let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
    let all = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
    all.into_iter().filter(|m| names.contains(&m.name)).collect()
}

/// Stiff walls with measured angles and displacements.
fn stiff() -> Study {
    let mut study = study(&[1e10], 2);
    let angle = MeasuredQuantity::CollapseAngle;
    let reading = |specimen, quantity, tilt, value, error| Measurement {
        error,
        ..measurement(specimen, quantity, tilt, value)
    };
    study.measured = vec![
        reading("a", angle, None, radians(14.0), radians(0.5)),
        reading("b", angle, None, radians(14.0), radians(0.5)),
        reading("a", MeasuredQuantity::DisplacementMean, Some(5.0), 1e-5, 1e-3),
        reading("a", MeasuredQuantity::DisplacementCentreMinusEnds, Some(5.0), 0.0, 1e-3),
        Measurement {
            kind: MeasuredKind::Below,
            ..reading("a", MeasuredQuantity::DisplacementCentre, Some(5.0), 2e-3, 1e-3)
        },
        reading("a", MeasuredQuantity::DisplacementMean, Some(60.0), 1e-5, 1e-3),
    ];
    study
}

fn map(study: &Study, names: &[&str], threads: usize) -> Detectability {
    let settings = DetectabilitySettings { members: 2, quantile: 0.84, threads: NonZero::new(threads) };
    detectability(study, &mechanisms(names), &settings, &Silent).unwrap_or_else(|fault| panic!("{fault}"))
}

fn value(map: &Detectability, mechanism: &str, quantity: MeasuredQuantity) -> Change {
    let row = map.mechanisms.iter().find(|row| row.mechanism == mechanism).expect("it was asked for");
    let at = |o: &Observable| o.quantity == quantity && o.tilt.is_none_or(|tilt| degrees(tilt) < 30.0);
    let column = map.observables.iter().position(at).expect("it was measured");
    match &row.cells[column] {
        Cell::Change(change) => *change,
        other => panic!("{mechanism}: {other:?}"),
    }
}

#[test]
fn each_mechanism_changes_what_it_can_change() {
    use MeasuredQuantity as Q;
    let study = stiff();
    let names = ["contact_inset", "density", "gauge_offset", "gauge_scale", "rope_slack"];
    let map = map(&study, &names, 1);
    let of = |name: &str, quantity| value(&map, name, quantity).value.value.expect("two walls");
    // A stiff wall falls where its section tips over, whatever it weighs: to the width at which the tilt of collapse is found,
    // 0.01 deg, from either side. Rounded arrises narrow that section: 8 mm of 114 at either edge are some degrees.
    assert!(degrees(of("density", Q::CollapseAngle)).abs() <= 0.01, "{}", of("density", Q::CollapseAngle));
    assert!(degrees(of("contact_inset", Q::CollapseAngle)) < -0.5);
    // Gauges act on displacements alone. Sums of three and of two numbers are rounded: some 1e-16 of what they read.
    let params =
        |name: &str| map.mechanisms.iter().find(|row| row.mechanism == name).expect("asked").values[0].1;
    let (factor, offset) = (params("gauge_scale"), params("gauge_offset"));
    let base = |quantity| {
        let at = |o: &Observable| o.quantity == quantity && o.tilt.is_none_or(|tilt| degrees(tilt) < 30.0);
        map.base[map.observables.iter().position(at).expect("measured")].expect("two walls")
    };
    assert!(factor > 1.0 && offset > 0.004);
    for quantity in [Q::DisplacementMean, Q::DisplacementCentre] {
        let change = of("gauge_scale", quantity);
        assert!((change - (factor - 1.0) * base(quantity)).abs() <= 1e-12 * base(quantity), "{change}");
        assert!((of("gauge_offset", quantity) - offset).abs() <= 1e-15);
    }
    assert!(of("gauge_offset", Q::DisplacementCentreMinusEnds).abs() <= 1e-15);
    assert_eq!(of("gauge_scale", Q::CollapseAngle), 0.0);
    assert_eq!(of("gauge_offset", Q::CollapseAngle), 0.0);
    // The one reading has an error of 1 mm and the walls scatter by far less.
    let errors = value(&map, "gauge_offset", Q::DisplacementMean).in_measurement_errors.and_then(|e| e.value);
    assert!((errors.expect("an error") - offset / 1e-3).abs() < 1e-9);
    // Of a reading that is only known to be below 2 mm, what lies above 2 mm counts.
    let bound = value(&map, "gauge_offset", Q::DisplacementCentre);
    let beyond = base(Q::DisplacementCentre) + offset - 2e-3;
    assert!((bound.resolved.value.expect("two walls") - beyond).abs() < 1e-12, "{bound:?} {beyond}");
    assert_eq!(value(&map, "gauge_scale", Q::DisplacementCentre).resolved.value, Some(0.0));
    // What has no number has a name.
    let late =
        map.observables.iter().position(|o| o.tilt.is_some_and(|t| degrees(t) > 30.0)).expect("measured");
    for row in &map.mechanisms {
        for (column, cell) in row.cells.iter().enumerate() {
            match (row.mechanism, column == late) {
                ("rope_slack", _) => assert_eq!(*cell, Cell::NotApplicable("there are no ropes")),
                (_, true) => assert_eq!(*cell, Cell::NeverReached),
                _ => assert!(matches!(cell, Cell::Change(_)), "{} {cell:?}", row.mechanism),
            }
        }
    }
    assert_eq!(map.mechanisms.iter().map(Effect::sight).collect::<Vec<_>>(), {
        use Sight::{Not, Seen};
        [Seen, Not, Not, Seen, Not]
    });
}

#[test]
fn threads_change_no_bit() {
    let mut study = stiff();
    study.arms[0].kn_points = vec![1e8];
    let names = ["specimen_scatter"];
    assert_eq!(map(&study, &names, 1), map(&study, &names, 2));
}

#[test]
fn outcomes_of_pairs_have_names() {
    use Simulated::{Above, FellBefore, Nothing, Value};
    let study = stiff();
    let row = |_: usize| Vec::new();
    let all = observables(&study, row);
    let observable = all.iter().find(|o| o.quantity == MeasuredQuantity::DisplacementMean).expect("measured");
    for (without, with, expected) in [
        (Value(1.0), FellBefore, Cell::FellBefore),
        (FellBefore, Value(1.0), Cell::OnlyWith),
        (FellBefore, FellBefore, Cell::NeverReached),
        (Value(1.0), Above(2.0), Cell::Stood),
        (Nothing, Value(1.0), Cell::Lost),
    ] {
        assert_eq!(cell(observable, &[without], &[with]), expected);
    }
    // One pair that can be compared, and one that cannot any more.
    let mixed = cell(observable, &[Value(1.0), Value(2.0)], &[Value(1.5), FellBefore]);
    let Cell::Change(change) = mixed else { panic!("{mixed:?}") };
    assert_eq!((change.value.value, change.pairs, change.fell_before), (Some(0.5), 1, 1));
    assert_eq!(change.value.interval, None);
    assert_eq!(Cell::Change(change).sight(), Sight::Perhaps);
}

#[test]
fn a_study_without_measurements_has_no_map() {
    let study = study(&[1e10], 1);
    let settings = DetectabilitySettings { members: 1, quantile: 0.5, threads: NonZero::new(1) };
    let fault = detectability(&study, &mechanisms(&["density"]), &settings, &Silent).unwrap_err();
    assert!(matches!(fault, NoDetectability::NothingMeasured), "{fault}");
}
