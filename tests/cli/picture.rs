//! `pirca picture` as a user meets it.

use std::fs;

use serde_json::Value;

use crate::fixture::{Folder, STUDY, changed, stderr};

/// The tiny study on a tilting table, between free ends.
fn tilting(end: &str) -> String {
    let load = "protocol = \"lateral\"\nmean_pressure_pa = 200\nbase_over_top = 2";
    changed(load, &format!("protocol = \"tilting\"\ntowards = \"y+\"\nstep_deg = 4\nbracket_deg = 0.5{end}"))
        .replace("joint_springs", "free")
        .replace("unbalanced_ratio = 1e-4", "name = \"implicit\"")
}

fn drawn(folder: &Folder, arguments: &[&str]) -> (Value, String) {
    let all = [&["picture", "studies/tiny", "--json", "--out", "wall.svg"], arguments].concat();
    let output = folder.pirca(&all);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let told = serde_json::from_slice(&output.stdout).expect("one JSON object");
    (told, fs::read_to_string(folder.path("wall.svg")).expect("the picture was written"))
}

#[test]
fn a_wall_that_falls_is_drawn_with_how_it_falls() {
    let folder = Folder::with_study(&tilting(""));
    let (told, text) = drawn(&folder, &["--arm", "stack"]);
    assert_eq!(told["outcome"], "collapsed", "{told}");
    let mode = told["mode"].as_str().expect("a mode");
    let weight = 100.0 * told["moving_weight_share"].as_f64().expect("a share");
    let hinge = 1e3 * told["hinge_height_m"].as_f64().expect("a height");
    let said = [
        "tiny: arm stack, member 0, kn 5e7 Pa/m".to_owned(),
        "Falls at a tilt of ".to_owned(),
        format!("{mode}; {weight:.0} % of the weight moves, hinge {hinge:.0} mm above the foot."),
        format!("times {}; seen from the front", told["magnification"]),
        "mm: opening of joints".to_owned(),
    ];
    for words in said {
        assert!(text.contains(&words), "{words} in {text}");
    }
    assert_eq!(drawn(&folder, &["--arm", "stack"]).1, text, "the same bytes");
    let (larger, other) = drawn(&folder, &["--arm", "stack", "--magnify", "1.5"]);
    assert_eq!(larger["magnification"], 1.5);
    assert_ne!(other, text);
    let (_, slips) = drawn(&folder, &["--arm", "stack", "--colour", "slip"]);
    assert!(slips.contains("mm: slip of joints") || slips.contains("No joint slipped."), "{slips}");
}

#[test]
fn a_wall_that_does_not_fall_is_drawn_at_rest_and_says_so() {
    for (study, level) in
        [(STUDY.to_owned(), "load factor 1"), (tilting("\nend_deg = 4"), "a tilt of 4.0000 deg")]
    {
        let folder = Folder::with_study(&study);
        let (told, text) = drawn(&folder, &["--arm", "random", "--member", "3"]);
        assert_eq!((&told["outcome"], &told["mode"]), (&Value::from("equilibrium"), &Value::Null));
        let said = format!("Does not fall: at rest at {level}, the end of the load path.");
        assert!(text.contains(&said) && text.contains("Drawn at rest"), "{said} in {text}");
    }
}

#[test]
fn a_wall_that_cannot_be_built_or_a_file_that_cannot_be_written_ends_with_1() {
    let folder = Folder::with_study(STUDY);
    let picture = |out: &str| {
        let output = folder.pirca(&["picture", "studies/tiny", "--out", out]);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        stderr(&output)
    };
    assert!(picture("no/such/folder/wall.svg").contains("cannot write no/such/folder/wall.svg"));
    let dip = "dip_deg = { family = \"uniform\", low = -3, high = 3 }";
    folder.write_study(&changed(dip, &format!("{dip}\nlimits = {{ max_aspect = 1.5, max_attempts = 3 }}")));
    assert!(picture("wall.svg").contains("arm random, member 0: invalid geometry"));
    assert!(!folder.path("wall.svg").exists());
}
