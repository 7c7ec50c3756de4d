//! `studies/arrangements`: six arrangements of stones, under a tilt and a pressure, with free and with held ends.

use std::path::Path;

use pirca::ensemble::{Row, Task, evaluate};
use pirca::protocol::FailureMode;
use pirca::study::Study;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/arrangements");
const ARMS: [&str; 6] = ["continuous", "discontinuous", "irregular", "wedged", "two-wythes", "headers"];

/// The first wall of each arm.
fn walls(variant: Option<&str>) -> Vec<Row> {
    let study = Study::load(Path::new(FOLDER), variant).expect("the study is sound").study;
    let names: Vec<&str> = study.arms.iter().map(|arm| arm.name.as_str()).collect();
    assert_eq!(names, ARMS);
    (0..6).map(|arm| evaluate(&study, Task { arm, point: 0, member: 0 })).collect()
}

#[test]
fn wythes_that_are_not_tied_fall_first_and_headers_help() {
    let rows = walls(None);
    let angle = |arm: usize| rows[arm].collapse_angle_deg().expect("it falls");
    assert!(angle(4) < angle(5) && angle(5) < angle(2), "{} {} {}", angle(4), angle(5), angle(2));
    assert!((angle(1) - angle(2)).abs() < 2.0, "{} {}", angle(1), angle(2));
    assert_eq!(rows[1].mechanism.expect("it was watched").mode, FailureMode::Rocking);
    // The same stones, where the distributions are the same.
    for arm in [3, 4, 5] {
        assert_eq!(rows[arm].built.dip_mean_deg, rows[2].built.dip_mean_deg);
    }
}

#[test]
fn columns_gain_little_from_ends_that_are_held_and_bonded_walls_much() {
    let (free, held) = (walls(Some("lateral")), walls(Some("lateral-restrained")));
    let kept = |arm: usize| {
        let [held, free] = [&held, &free].map(|rows| rows[arm].top_displacement_m().expect("it stands"));
        held / free
    };
    assert!(kept(0) > 0.7, "continuous: {}", kept(0));
    for (arm, name) in ARMS.iter().enumerate().skip(1) {
        assert!(kept(arm) < 0.6, "{name}: {}", kept(arm));
    }
}
