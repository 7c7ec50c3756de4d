//! Stones that bear on few points: rows of an ensemble.

use pirca::ensemble::{Row, evaluate, plan};
use pirca::model::Outcome;
use pirca::study::Study;

use crate::fixture::{Folder, STUDY, stderr};
use crate::threads::results;

/// The small study with joints that bear so.
fn bearing(stated: &str) -> String {
    STUDY.replace("cohesion_pa = 0", &format!("cohesion_pa = 0\nbearing = {{ {stated} }}"))
}

fn rows(text: &str) -> Vec<Row> {
    let folder = Folder::with_study(text);
    let study =
        Study::load(&folder.path("studies/tiny"), None).unwrap_or_else(|faults| panic!("{faults}")).study;
    plan(&study).into_iter().map(|task| evaluate(&study, task)).collect()
}

#[test]
fn walls_on_drawn_points_have_the_same_bytes_whatever_the_threads() {
    let folder = Folder::with_study(&bearing("points = 3.5, relief_m = 1e-4, share = 0.2"));
    let of = |threads: &str| {
        let output = folder.pirca(&["run", "studies/tiny", "--threads", threads, "--out", threads]);
        assert!(output.status.success(), "{}", stderr(&output));
        results(&folder, threads)
    };
    assert_eq!(of("1"), of("7"));
}

#[test]
fn walls_of_the_same_stones_differ_by_where_they_bear() {
    let text = bearing("points = 3, share = 0.2").replace("members = 1\n", "members = 3\n");
    let moved: Vec<f64> = rows(&text)
        .iter()
        .filter(|row| row.arm == "stack" && row.point == 0)
        .map(|row| row.top_displacement_m().unwrap_or_else(|| panic!("{}", row.outcome.reason())))
        .collect();
    assert_eq!(moved.len(), 3);
    assert!(moved[0] != moved[1] && moved[1] != moved[2], "{moved:?}");
}

#[test]
fn a_wall_that_cannot_stand_on_its_points_is_a_row_with_its_reason() {
    // One point of a hundredth of the face's area: hardly a wall has all of its joints under its stones' weight.
    let text = bearing("points = 1, share = 1e-4").replace("ends = \"joint_springs\"", "ends = \"free\"");
    let rows = rows(&text);
    assert_eq!(rows.len(), 2 * (1 + 8));
    let fell: Vec<&Row> = rows.iter().filter(|row| row.outcome == Outcome::UnstableAtRest).collect();
    assert!(fell.len() >= 12, "{:?}", rows.iter().map(|row| row.outcome.name()).collect::<Vec<_>>());
    for row in fell {
        assert_eq!(row.outcome.reason(), "does not stand under its own weight");
        assert_eq!(row.top_displacement_m(), None);
    }
}

#[test]
fn a_fault_in_what_is_stated_is_told_by_its_key() {
    for (stated, more, said) in [
        ("points = 0.5, share = 0.2", "", "joint.bearing.points = 0.5: allowed is a number within 1 to 16"),
        ("points = 3, share = 0", "", "joint.bearing.share = 0: allowed is a number above 0 and at most 1"),
        ("points = 3, share = 0.2, relief_m = -1", "", "joint.bearing.relief_m = -1"),
        ("points = 3", "", "joint.bearing.share"),
        ("points = 3, share = 0.2", "sampling = \"vertices\"\n", "joint.bearing"),
        (
            "points = 3, share = 0.2",
            "[mechanism.contact_area]\nshare = 0.5\n",
            "mechanism.contact_area does not go with joint.bearing",
        ),
    ] {
        let text = bearing(stated).replace("\n[load]", &format!("{more}\n[load]"));
        let folder = Folder::with_study(&text);
        let faults = match Study::load(&folder.path("studies/tiny"), None) {
            Ok(_) => panic!("{stated} is taken"),
            Err(faults) => faults.to_string(),
        };
        assert!(faults.contains(said), "{said}\n{faults}");
    }
}
