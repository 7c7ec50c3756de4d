//! Hand-made measurements and rows, and what comes out of them.

use std::path::Path;

use crate::critic::calibrate::other_friction;
use crate::critic::compare::{Ours, Simulated, Walls, compare, is_rising, log_likelihood, simulated};
use crate::ensemble::{Reading, Row, StepRow, TiltingRow, TopStep, evaluate, plan};
use crate::math::{degrees, exp, ln, radians};
use crate::model::{Level, Outcome};
use crate::random::Family;
use crate::stats::sigma_factors;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement, Study};

/// A shipped study on the tilting table, with one random arm alone and this many points in kn.
pub fn study(points: &[f64], members: u64) -> Study {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-block");
    let mut study = Study::load(&folder, None).unwrap_or_else(|faults| panic!("{faults}")).study;
    study.arms.retain(|arm| arm.name == "irregular");
    study.arms[0].kn_points = points.to_vec();
    study.arms[0].members = members;
    study
}

pub fn measurement(
    specimen: &str,
    quantity: MeasuredQuantity,
    tilt_deg: Option<f64>,
    value: f64,
) -> Measurement {
    Measurement {
        specimen: specimen.into(),
        family: "irregular".into(),
        tilt: tilt_deg.map(radians),
        drift: None,
        under: None,
        quantity,
        value,
        kind: MeasuredKind::Exact,
        error: 0.0,
        common_error: 0.0,
        unknown_share: false,
        resolution: 0.0,
        order: None,
        stage: 0,
        line: 2,
    }
}

/// A wall that fell at this tilt (deg), its points moved by 1, 2 and 6 mm per degree, read every 5 deg and at the last.
pub fn fallen(member: u64, point: u32, angle: f64) -> Row {
    let step = |tilt: f64| StepRow {
        tilt_deg: Some(tilt),
        top: TopStep {
            top_displacement_m: Some(6e-3 * tilt),
            left_m: Some(1e-3 * tilt),
            centre_m: Some(2e-3 * tilt),
            right_m: Some(6e-3 * tilt),
            ..TopStep::default()
        },
        solver_steps: 1,
        ..StepRow::default()
    };
    let mut load_steps: Vec<StepRow> =
        [0.0, 5.0, 10.0].into_iter().filter(|t| *t < angle).map(step).collect();
    load_steps.push(step(angle));
    // The step in which it fell: far away, and not at rest.
    let mut fell = step(angle + 0.01);
    (fell.top.left_m, fell.top.centre_m, fell.top.right_m) = (Some(9.0), Some(9.0), Some(9.0));
    load_steps.push(fell);
    let like = evaluated();
    let [collapse_angle_deg, largest_tilt_deg] = [Some(angle); 2];
    let tilting = TiltingRow { collapse_angle_deg, largest_tilt_deg, ..like.reading.tilting };
    Row {
        point,
        member,
        drawn: Default::default(),
        outcome: Outcome::Collapsed { at: Level::Tilt(radians(angle)) },
        reading: Reading { tilting, ..like.reading },
        load_steps,
        ..like
    }
}

/// A row of which the tests state all that they read.
fn evaluated() -> Row {
    let mut study = study(&[1e9], 1);
    // The first step is beyond the whole path: nothing but gravity is solved.
    if let crate::protocol::Protocol::Tilting(tilting) = &mut study.protocol {
        tilting.end = radians(0.01);
        tilting.step = radians(0.01);
    }
    study.agreement = false;
    let task = plan(&study)[0];
    evaluate(&study, task)
}

fn walls_of(study: &Study, rows: &[Row]) -> Vec<Walls> {
    let walls = |ours| match ours {
        Ours::Walls(walls) => walls,
        Ours::None(why) => panic!("{why}"),
    };
    compare(study, rows).into_iter().map(|line| walls(line.ours)).collect()
}

#[test]
fn the_likelihood_of_a_reading_is_that_of_its_kind() {
    let m = |kind, resolution| Measurement {
        kind,
        resolution,
        ..measurement("a", MeasuredQuantity::DisplacementMean, Some(5.0), 1.0)
    };
    let at = |kind, resolution| exp(log_likelihood(&m(kind, resolution), 0.0, 0.5));
    // Two standard deviations above the mean: density 0.053991 / 0.5, tail 0.022750 (Abramowitz and Stegun, Table 26.1).
    assert!((at(MeasuredKind::Exact, 0.0) - 0.107_981_93).abs() < 1e-8);
    assert!((at(MeasuredKind::Above, 0.0) - 0.022_750_13).abs() < 1e-8);
    assert!((at(MeasuredKind::Below, 0.0) - 0.977_249_87).abs() < 1e-8);
    // Between one and three: 0.998650 - 0.841345.
    assert!((at(MeasuredKind::Rounded, 1.0) - 0.157_305_36).abs() < 1e-8);
    // Finely rounded it is the density times the resolution; the curvature takes (h^2/24)(z^2 - 1)/sd^2 = 5e-7 of it.
    let fine = at(MeasuredKind::Rounded, 1e-3) / (1e-3 * at(MeasuredKind::Exact, 0.0));
    assert!((fine - 1.0).abs() < 1e-6, "{fine}");
}

#[test]
fn a_displacement_is_read_between_steps_and_never_beyond_the_last_at_rest() {
    use MeasuredQuantity as Q;
    let row = fallen(0, 0, 13.0);
    let at = |quantity, tilt: f64| simulated(quantity, Some(radians(tilt)), &row);
    let close = |found: Option<Simulated>, expected: f64| match found {
        Some(Simulated::Value(x)) => (x - expected).abs() < 1e-12,
        _ => false,
    };
    assert!(close(at(Q::DisplacementLeft, 5.0), 5e-3) && close(at(Q::DisplacementRight, 10.0), 60e-3));
    assert!(close(at(Q::DisplacementMean, 7.0), 21e-3), "{:?}", at(Q::DisplacementMean, 7.0));
    assert!(close(at(Q::DisplacementCentreMinusEnds, 12.0), -18e-3));
    assert!(close(at(Q::DisplacementCentre, 0.0), 0.0) && close(at(Q::DisplacementCentre, 13.0), 26e-3));
    assert_eq!(at(Q::DisplacementCentre, 13.005), Some(Simulated::FellBefore));
    assert!(close(simulated(Q::CollapseAngle, None, &row), radians(13.0)));
    assert_eq!(simulated(Q::JointKn, None, &row), None);
    let mut lost = Row { outcome: Outcome::NonFinite { at: Level::Tilt(radians(13.01)) }, ..row.clone() };
    lost.reading.tilting.collapse_angle_deg = None;
    assert_eq!(simulated(Q::DisplacementCentre, Some(radians(15.0)), &lost), Some(Simulated::Nothing));
    assert!(close(simulated(Q::DisplacementCentre, Some(radians(10.0)), &lost), 20e-3));
    let mut stood = Row { outcome: Outcome::Equilibrium, ..row };
    let tilting = &mut stood.reading.tilting;
    (tilting.collapse_angle_deg, tilting.largest_tilt_deg) = (None, Some(45.0));
    assert_eq!(simulated(Q::CollapseAngle, None, &stood), Some(Simulated::Above(radians(45.0))));
}

#[test]
fn a_remainder_is_read_between_the_steps_from_which_the_platform_went_back() {
    use MeasuredQuantity as Q;
    let mut row = fallen(0, 0, 13.0);
    for step in row.load_steps.iter_mut().filter(|step| [Some(5.0), Some(10.0)].contains(&step.tilt_deg)) {
        let left = |whole: Option<f64>| whole.map(|x| 0.1 * x);
        let top = &mut step.top;
        top.left_remainder_m = left(top.left_m);
        top.centre_remainder_m = left(top.centre_m);
        top.right_remainder_m = left(top.right_m);
    }
    let at = |quantity, tilt: f64| simulated(quantity, Some(radians(tilt)), &row);
    let value = |quantity, tilt: f64| match at(quantity, tilt) {
        Some(Simulated::Value(x)) => x,
        other => panic!("{other:?}"),
    };
    assert!((value(Q::RemainderLeft, 5.0) - 0.5e-3).abs() < 1e-12);
    assert!((value(Q::RemainderCentre, 2.5) - 0.5e-3).abs() < 1e-12);
    assert!((value(Q::RemainderMean, 7.5) - 2.25e-3).abs() < 1e-12);
    assert!((value(Q::RemainderCentreMinusEnds, 10.0) + 1.5e-3).abs() < 1e-12);
    assert_eq!(at(Q::RemainderMean, 11.0), Some(Simulated::Nothing));
    assert_eq!(at(Q::RemainderMean, 13.5), Some(Simulated::FellBefore));
}

/// Three specimens at 13, 14 and 15 deg with an error of 0.3 deg, half of it shared, beside walls at 15, 16 and 17.
#[test]
fn the_difference_has_its_three_parts() {
    let mut study = study(&[1e8], 3);
    for (k, angle) in [13.0, 14.0, 15.0].into_iter().enumerate() {
        let mut m = measurement(&k.to_string(), MeasuredQuantity::CollapseAngle, None, radians(angle));
        (m.error, m.common_error) = (radians(0.3), radians(0.15));
        study.measured.push(m);
    }
    let rows = [fallen(0, 0, 15.0), fallen(1, 0, 16.0), fallen(2, 0, 17.0)];
    let lines = compare(&study, &rows);
    assert_eq!(lines.len(), 1);
    let [low, high] = lines[0].measured.values.sigma.interval.expect("three values");
    let factors = sigma_factors(3);
    assert!((degrees(low) - factors[0]).abs() < 1e-9 && (degrees(high) - factors[1]).abs() < 1e-9);
    let walls = &walls_of(&study, &rows)[0];
    let parts = walls.difference.expect("both have a mean");
    let in_degrees = [parts.value, parts.measurement, parts.scatter, parts.ensemble].map(degrees);
    // 0.3^2 / 3 + 0.15^2; the walls' sigma is 1 as is the specimens', so the larger is the walls': 1/3; and 1/3 again.
    let expected = [2.0, (0.03_f64 + 0.0225).sqrt(), (1.0_f64 / 3.0).sqrt(), (1.0_f64 / 3.0).sqrt()];
    for (found, expected) in in_degrees.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{in_degrees:?}");
    }
    assert!((parts.in_sd() - 2.0 / (0.0525_f64 + 2.0 / 3.0).sqrt()).abs() < 1e-9);
    // Walls that do not scatter leave the specimens' own scatter, less the random error in it.
    let rows = [fallen(0, 0, 16.0), fallen(1, 0, 16.0), fallen(2, 0, 16.0)];
    let parts = walls_of(&study, &rows)[0].difference.expect("both have a mean");
    assert!(
        (degrees(parts.scatter) - (0.91_f64 / 3.0).sqrt()).abs() < 1e-9 && parts.ensemble == 0.0,
        "{parts:?}"
    );
}

/// Bounds are compared by the share of walls that agree, and are in no mean.
#[test]
fn bounds_are_never_numbers() {
    let mut study = study(&[1e8], 4);
    for (specimen, error) in [("a", 0.0), ("b", 3e-3)] {
        let bound = measurement(specimen, MeasuredQuantity::DisplacementMean, Some(10.0), 0.030);
        study.measured.push(Measurement { kind: MeasuredKind::Below, error, ..bound });
    }
    // Three walls are at the bound exactly (means of 3 mm per degree), the fourth fell before.
    let mut rows: Vec<Row> =
        [12.0, 13.0, 14.0, 9.0].into_iter().zip(0..).map(|(angle, k)| fallen(k, 0, angle)).collect();
    let walls = walls_of(&study, &rows).remove(0);
    assert_eq!((walls.values.n, walls.fell_before, walls.difference), (3, 1, None));
    // Without an error they are not below it; with one, half of their readings would be. The one that fell disagrees.
    assert!((walls.agreeing.expect("bounds") - 0.5 * (0.0 + 1.5 / 4.0)).abs() < 1e-9, "{walls:?}");
    for step in rows.iter_mut().flat_map(|row| &mut row.load_steps) {
        step.top.right_m = step.top.right_m.map(|x| 0.1 * x);
    }
    // Now 12 mm, six standard deviations below the bound.
    let agreeing = walls_of(&study, &rows)[0].agreeing.expect("bounds");
    assert!((agreeing - 0.75).abs() < 1e-8, "{agreeing}");
}

#[test]
fn what_cannot_be_compared_says_why() {
    let mut study = study(&[1e8], 3);
    let read = |stage, tilt| Measurement {
        stage,
        ..measurement("a", MeasuredQuantity::DisplacementMean, Some(tilt), 0.01)
    };
    study.measured = vec![
        read(0, 5.0),
        read(1, 10.0),
        read(2, 5.0),
        Measurement { stage: 2, ..measurement("a", MeasuredQuantity::RemainderMean, Some(10.0), 1e-3) },
        measurement("b", MeasuredQuantity::JointKn, None, 5e7),
        Measurement {
            family: "elsewhere".into(),
            ..measurement("c", MeasuredQuantity::CollapseAngle, None, 0.3)
        },
    ];
    let rows = [fallen(0, 0, 15.0), fallen(1, 0, 16.0), fallen(2, 0, 17.0)];
    let said: Vec<String> = compare(&study, &rows)
        .into_iter()
        .map(|line| match line.ours {
            Ours::None(why) => why.to_string(),
            Ours::Walls(walls) => walls.values.n.to_string(),
        })
        .collect();
    assert_eq!(
        said,
        [
            "read after the load had been larger",
            "3",
            "3",
            "the platform does not go back here: load.remainders = true",
            "the simulation does not give it",
            "the arm is not evaluated here"
        ]
    );
}

/// Readings of one tilt may be numbered one by one; who comes back to a tilt reads another state of the wall.
#[test]
fn a_tilt_is_read_for_the_first_time_however_many_points_are_numbered_there() {
    use MeasuredQuantity as Q;
    let read =
        |stage, quantity, tilt: f64| Measurement { stage, ..measurement("a", quantity, Some(tilt), 0.01) };
    let [left, centre] = [Q::DisplacementLeft, Q::DisplacementCentre];
    let all = [
        read(0, left, 5.0),
        read(1, centre, 5.0),
        read(2, left, 10.0),
        read(3, centre, 10.0),
        read(4, Q::RemainderLeft, 10.0),
        read(5, left, 10.0),
        read(6, left, 8.0),
        read(7, centre, 12.0),
        read(8, left, 12.0),
    ];
    let rising: Vec<bool> = all.iter().map(|m| is_rising(m, &all)).collect();
    assert_eq!(rising, [true, true, true, true, true, false, false, true, true]);
    // Without going back between them, but with a smaller tilt.
    let all = [read(0, left, 10.0), read(1, left, 8.0), read(2, centre, 10.0)];
    assert_eq!(all.each_ref().map(|m| is_rising(m, &all)), [true, false, false]);
}

/// Arms that differ in friction alone give the same specimens another kn; arms that differ in more are no such arms.
#[test]
fn the_sensitivity_to_friction_comes_from_arms_that_differ_in_nothing_else() {
    let kns = [2e7, 5e7, 1e8, 2e8];
    let mut study = study(&kns, 2);
    let mut slippery = study.arms[0].clone();
    (slippery.name, slippery.joint.phi_deg) = ("slippery".into(), Family::Constant { value: 20.0 });
    let mut sticky = slippery.clone();
    (sticky.name, sticky.joint.tension) = ("sticky".into(), 1e3);
    study.arms.extend([slippery, sticky]);
    study.measured.push(measurement("a", MeasuredQuantity::CollapseAngle, None, radians(16.0)));
    let mut rows = Vec::new();
    for arm in 0..3_u32 {
        for (point, kn) in kns.iter().enumerate() {
            for (member, apart) in [(0, -0.1), (1, 0.1)] {
                let angle = 16.0 + 2.0 * ln(kn / 6e7) - f64::from(arm) + apart;
                rows.push(Row { arm_index: arm, ..fallen(member, point as u32, angle) });
            }
        }
    }
    let others = other_friction(&study, 0, &rows);
    assert_eq!(others.iter().map(|o| (o.arm.as_str(), o.phi_deg)).collect::<Vec<_>>(), [("slippery", 20.0)]);
    // One degree less at every kn is made up for by a factor of exp(1/2) on kn.
    let own = crate::critic::calibrate_family(&study, 0, &rows).expect("four points").0;
    let (crate::critic::End::At(own), crate::critic::End::At(other)) = (own.best, others[0].calibration.best)
    else {
        panic!("{:?}", own.best)
    };
    // The grid's parabola is good to a hundredth of its step of ln(10)/120.
    assert!((ln(other / own) - 0.5).abs() < 2e-3, "{own:e} and {other:e}");
    assert!((ln(own / 6e7)).abs() < 2e-3, "{own:e}");
}
