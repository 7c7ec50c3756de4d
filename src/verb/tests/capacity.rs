//! Capacities: which walls bring a value, which stood to the end, what is drawn and written.

use std::collections::BTreeMap;
use std::fs;

use super::{KN, claim, collected, failed, stood, summary_of, tilted};
use crate::ensemble::{Mechanism, Quantity, Row, TiltingRow};
use crate::model::{Level, Outcome};
use crate::stats::{clopper_pearson, dkw_half_width};
use crate::study::{Claim, ClaimTest};
use crate::verb::run::answer::files::write_summary;
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::published::{Verdict, judge_all};
use crate::verb::run::answer::table::terminal_table;

fn fell(member: u64, angle: f64) -> Row {
    let mode = if member == 0 { "sliding" } else { "rocking" };
    let mechanism: Mechanism = serde_json::from_value(serde_json::json!({
        "mode": mode, "moving": 3, "weight_share": 0.5, "hinge_height_m": 0.1, "turning_share": 0.7,
        "length_share": 0.9, "place": 0.5
    }))
    .unwrap();
    Row {
        reading: tilted(TiltingRow { collapse_angle_deg: Some(angle), ..TiltingRow::default() }),
        mechanism: Some(mechanism),
        ..failed(member, Outcome::Collapsed { at: Level::Tilt(0.2) })
    }
}

fn capacity(rows: &[Row]) -> Population {
    collected(("irregular", false), (KN[0], rows.len() as u64), Quantity::CollapseAngle, rows)
}

#[test]
fn walls_that_fall_bring_values_and_a_curve() {
    let rows = [fell(0, 12.0), fell(1, 11.0), fell(2, 13.0), failed(3, Outcome::UnstableAtRest)];
    let summary = summary_of(&[capacity(&rows)], &[]);
    let arm = &summary.arms[0];
    assert_eq!((arm.mean, arm.in_mean, arm.quantity, arm.unit), (Some(12.0), 3, "collapse_angle", "deg"));
    assert_eq!(arm.failure_modes, BTreeMap::from([("sliding".into(), 1), ("rocking".into(), 2)]));
    assert!(arm.note.as_ref().unwrap().contains("over 3 of 4 walls; not in the numbers: 1 unstable at rest"));
    let steps: Vec<(f64, u64)> = arm.fragility.iter().map(|s| (s.value, s.count)).collect();
    assert_eq!(steps, [(11.0, 1), (12.0, 2), (13.0, 3)]);
    assert_eq!(arm.fragility[1].pointwise, clopper_pearson(2, 3));
    // With three walls the band is wider than what is left on either side.
    assert!(dkw_half_width(3) > 2.0 / 3.0);
    assert_eq!(arm.fragility[0].simultaneous, [0.0, 1.0]);
    let table = terminal_table(&summary);
    assert!(table.contains("mean deg") && table.contains("12.0 ["), "{table}");
}

#[test]
fn a_wall_that_stood_to_the_end_leaves_the_mean_undefined_and_counts_in_the_curve() {
    let rows = [fell(0, 12.0), fell(1, 11.0), stood(2, 30.0), stood(3, 30.0)];
    let summary = summary_of(&[capacity(&rows)], &[]);
    let arm = &summary.arms[0];
    assert_eq!((arm.mean, arm.sigma, arm.in_mean, arm.stood_to_the_end), (None, None, 0, 2));
    let steps: Vec<(f64, f64)> = arm.fragility.iter().map(|s| (s.value, s.probability)).collect();
    assert_eq!(steps, [(11.0, 0.25), (12.0, 0.5)]);
    let note = arm.note.as_ref().unwrap();
    assert!(note.contains("2 of 4 walls stood to the end of the load path (30.0 deg)"), "{note}");
    assert!(!note.contains("not in the numbers"), "{note}");
}

#[test]
fn the_files_of_a_capacity_are_whole_and_hold_the_numbers() {
    let folder = std::env::temp_dir().join(format!("pirca-report-{}-capacity", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let rows = [fell(0, 12.0), fell(1, 11.0), fell(2, 13.0)];
    fs::write(folder.join("capacity.png"), "of an earlier run").unwrap();
    write_summary(&summary_of(&[capacity(&rows)], &[]), &folder, None).unwrap();
    let mut names: Vec<String> =
        fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    // One stiffness is no figure over them.
    let expected = ["capacity.csv"];
    let fragility = ["fragility.csv", "fragility.png", "fragility.svg", "summary.json"];
    assert_eq!(names, [&expected[..], &fragility[..]].concat());
    let csv = fs::read_to_string(folder.join("fragility.csv")).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert!(
        lines[0].starts_with("arm,kn_pa_per_m,walls,collapse_angle_deg,collapsed,probability,pointwise_low")
    );
    assert!(lines[1].starts_with("irregular,75000000,3,11,1,0.3333333333333333,"), "{csv}");
    assert_eq!(lines.len(), 4);
    assert!(fs::read_to_string(folder.join("capacity.csv")).unwrap().contains("mean_deg,mean_low_deg"));
    let svg = fs::read_to_string(folder.join("fragility.svg")).unwrap();
    assert!(svg.contains("3 walls, band: 95 % pointwise (Clopper and Pearson)"), "{svg}");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_mean_a_ratio_of_forces_and_a_mechanism_are_judged() {
    let arm = |name: &str, angles: &[f64], claims: &[Claim]| {
        let mut own = Population::new((name, false), (KN[0], 4), Quantity::CollapseAngle, 1, claims);
        angles.iter().zip(0..).for_each(|(angle, member)| own.take(&fell(member, *angle)));
        own
    };
    let told = |test: ClaimTest| {
        let claims = [claim(test)];
        let strong = arm("strong", &[29.9, 30.0, 30.1, 30.0], &claims);
        judge_all(&claims, &[strong, arm("weak", &[14.4, 14.5, 14.5, 14.6], &claims)]).remove(0)
    };
    let name = |name: &str| name.to_string();
    let mean = |low, high| ClaimTest::Mean { arm: name("strong"), at_kn: None, stated: 30.0, low, high };
    assert_eq!(told(mean(29.5, 30.5)).verdict, Verdict::Reproduced);
    assert_eq!(told(mean(30.5, 31.0)).verdict, Verdict::NotReproduced);
    let elsewhere =
        ClaimTest::Mean { arm: name("strong"), at_kn: Some(1.0), stated: 30.0, low: 29.0, high: 31.0 };
    assert_eq!(told(elsewhere).verdict, Verdict::CannotJudge, "no wall has that stiffness");
    // sin 30 deg over sin 14.5 deg is 1.997.
    let ratio = |low, high| ClaimTest::RatioOfSines {
        arm: name("strong"),
        over: name("weak"),
        at_kn: None,
        stated: 2.0,
        low,
        high,
    };
    assert_eq!(told(ratio(1.95, 2.05)).verdict, Verdict::Reproduced);
    assert_eq!(told(ratio(1.0, 1.9)).verdict, Verdict::NotReproduced);
    let mechanism = |mode, weight: [f64; 2], least_share| ClaimTest::Mechanism {
        arm: name("strong"),
        stated: name("the upper part topples"),
        mode: Some(serde_json::from_value(serde_json::json!(mode)).unwrap()),
        weight_share: weight,
        length_share: [0.8, 1.0],
        place: [0.4, 0.6],
        least_share,
    };
    // Member 0 slides and three rock; all move half the weight.
    assert_eq!(told(mechanism("rocking", [0.4, 0.6], 0.5)).verdict, Verdict::Reproduced);
    assert_eq!(told(mechanism("rocking", [0.7, 1.0], 0.7)).verdict, Verdict::NotReproduced);
    assert_eq!(told(mechanism("bulging", [0.0, 1.0], 0.5)).verdict, Verdict::CannotJudge);
}

#[test]
fn a_statement_about_an_arm_that_is_left_out_is_not_judged() {
    let rows = [fell(0, 10.0), fell(1, 11.0)];
    let here = collected(("here", false), (KN[0], 2), Quantity::CollapseAngle, &rows);
    let of =
        |arm: &str| claim(ClaimTest::Cov { arm: arm.into(), stated: "0.05".into(), low: 0.0, high: 1.0 });
    assert_eq!(judge_all(&[of("here"), of("elsewhere")], &[here]).len(), 1);
}
