//! `studies/tilting-table`: the nine walls, and the source paper's simulations of them.

use std::path::Path;

use pirca::ensemble::{Row, Task, evaluate};
use pirca::model::Outcome;
use pirca::study::Study;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/tilting-table");

fn study(variant: Option<&str>) -> Study {
    Study::load(Path::new(FOLDER), variant).unwrap_or_else(|faults| panic!("{faults}")).study
}

fn row(study: &Study, arm: &str, point: u32, member: u64) -> Row {
    let arm = study.arms.iter().position(|a| a.name == arm).expect("the arm is in this reading") as u32;
    evaluate(study, Task { arm, point, member })
}

fn angle(study: &Study, arm: &str, point: u32) -> f64 {
    let row = row(study, arm, point, 0);
    assert!(matches!(row.outcome, Outcome::Collapsed { .. }), "{arm}: {}", row.outcome.reason());
    row.collapse_angle_deg().expect("it fell")
}

#[test]
fn the_walls_weigh_what_the_specimens_did_and_are_read_at_the_papers_stops() {
    let study = study(None);
    for (arm, weight) in [("cbl", 1333.0), ("sbl", 1371.0), ("sbr", 1371.0)] {
        let row = row(&study, arm, 0, 0);
        // Table 1 gives whole newtons.
        assert!(
            (row.built.weight_n.expect("it was built") - weight).abs() < 0.5,
            "{arm}: {:?}",
            row.built.weight_n
        );
        for stop in [5.0, 10.0, 15.0] {
            let read =
                row.load_steps.iter().any(|s| s.tilt_deg.is_some_and(|t: f64| (t - stop).abs() < 1e-9));
            assert!(read, "{arm} at {stop} deg");
        }
    }
    assert_eq!(study.measured.len(), 33);
}

/// The finding of the study's README: kn on a third of the joints brings Table 7 within 0.6 deg at phi 30, free and
/// restrained, where whole faces are 3 to 6 deg too strong.
#[test]
fn a_third_of_the_joints_in_contact_gives_table_7() {
    let (whole, third) = (study(Some("table-7")), study(Some("table-7-contact-area")));
    for (arm, stated) in [("free-30", [11.5, 14.5, 16.0]), ("restrained-30", [15.0, 19.0, 21.0])] {
        for (point, stated) in (0..).zip(stated) {
            let ours = angle(&third, arm, point);
            println!("{arm}, point {point}: {ours:.2} against {stated}");
            // The table has steps of half a degree.
            assert!((ours - stated).abs() < 0.6, "{arm}, point {point}: {ours} against {stated}");
        }
    }
    assert!(angle(&whole, "free-30", 1) > 14.5 + 3.0);
}

#[test]
fn free_walls_do_not_depend_on_phi_above_30_deg_and_restrained_ones_do() {
    let study = study(Some("table-7-contact-area"));
    let at = |arm: &str| angle(&study, arm, 0);
    // With a bracket of 0.005 deg and steps of 2.5 or 0.5 deg they differ by 0.069 deg, by slip at the edges of the joints; half of the
    // study's bracket of 0.06 comes on top.
    assert!((at("free-30") - at("free-60")).abs() < 0.1);
    assert!(at("restrained-60") - at("restrained-30") > 1.5);
}
