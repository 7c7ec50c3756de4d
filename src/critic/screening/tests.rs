//! Which readings of campaigns look odd, and which do not.

use crate::critic::fixture::made;
use crate::critic::screening::{DataNote, data_notes, data_notes_by_simulation};
use crate::critic::simulate::{Design, Unused};
use crate::math::radians;
use crate::study::MeasuredKind;

#[test]
fn a_zero_reading_is_not_used_and_one_that_is_said_so() {
    let mut made = made();
    let zero = made.study.measured.iter().find(|m| m.specimen == "SBL2" && m.tilt.is_some());
    let mut zero = zero.expect("it was read").clone();
    (zero.tilt, zero.value, zero.error, zero.line) = (Some(0.0), 0.0, 0.0, 99);
    made.study.measured.push(zero);
    let (design, _) = Design::of(&made.study);
    assert_eq!(design.unused, [(Unused::AtLevel, 99)]);
    assert!(design.specimens.iter().all(|own| own.readings.iter().all(|m| m.line != 99)));
    let found = data_notes(&made.study, &design);
    assert!(matches!(&found[..], [DataNote::Level { lines }] if *lines == [99]), "{found:?}");
}

#[test]
fn readings_where_every_wall_has_fallen_are_noted() {
    let made = made();
    let world = made.world();
    let (mut design, campaign) = Design::of(&made.study);
    // A mechanism of three parameters needs 56 walls, and there are 45 points.
    let few = data_notes_by_simulation(&world, &design, &campaign, 5);
    assert!(
        matches!(&few[..], [DataNote::NotConsidered { mechanisms }] if mechanisms.contains(&"friction")),
        "{few:?}"
    );
    let sbl = design.specimens.iter().position(|s| s.name == "SBL2").expect("it was tested");
    design.specimens[sbl].readings[1].tilt = Some(radians(60.0));
    let line = design.specimens[sbl].readings[1].line;
    let found = data_notes_by_simulation(&world, &design, &campaign, 5).split_off(1);
    assert!(matches!(&found[..], [DataNote::Fallen { lines, .. }] if *lines == [line]), "{found:?}");
    let words = found[0].to_string();
    assert!(words.contains("of SBL2 is 12 mm at 60 deg, where every simulated wall has fallen"), "{words}");
}

#[test]
fn a_bound_that_no_simulated_wall_keeps_is_noted() {
    let made = made();
    let world = made.world();
    let noted = |value: f64, kind: MeasuredKind| {
        let mut study = made.study.clone();
        let m = study
            .measured
            .iter_mut()
            .find(|m| m.specimen == "SBL2" && m.tilt.is_some())
            .expect("it was read");
        (m.value, m.kind, m.resolution) = (value, kind, 0.0);
        let (design, campaign) = Design::of(&study);
        let found = data_notes_by_simulation(&world, &design, &campaign, 5).into_iter();
        let out = found.filter_map(|note| match note {
            DataNote::OutOfRange { fits, .. } => Some(fits),
            _ => None,
        });
        out.collect::<Vec<_>>()
    };
    // Walls move downhill by millimetres at the first tilt, and gauges are off by a few.
    assert_eq!(noted(0.1, MeasuredKind::Below), []);
    assert_eq!(noted(-0.1, MeasuredKind::Above), []);
    let (less, more) = (noted(-0.1, MeasuredKind::Below), noted(2.0, MeasuredKind::Above));
    assert!(less.len() == 1 && more.len() == 1, "{less:?} {more:?}");
    // Two metres were meant as two centimetres, or less.
    assert!(more[0].is_some_and(|fits| fits <= 0.02 + 1e-9), "{more:?}");
}
