//! `pirca wall` as a user meets it.

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
    let all = [&["wall", "studies/tiny", "--json", "--out", "wall.svg"], arguments].concat();
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

/// The names of the files in a folder, in order.
fn names(folder: &Folder, below: &str) -> Vec<String> {
    let entries = fs::read_dir(folder.path(below)).expect("the folder was made").flatten();
    let mut names: Vec<String> =
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_wall_is_drawn_and_written_in_every_state_from_rest_through_the_collapse() {
    let folder = Folder::with_study(&tilting(""));
    let asked = ["--arm", "stack", "--frames", "frames", "--series", "seen"];
    // What an earlier replay of more states left would be mixed with this one.
    fs::create_dir_all(folder.path("frames")).expect("a folder");
    fs::write(folder.path("frames/frame-099.svg"), "old").expect("a file");
    let (told, picture) = drawn(&folder, &asked);
    assert_eq!(drawn(&folder, &["--arm", "stack"]).1, picture, "the picture is the same without them");
    let states = told["states"].as_u64().expect("so many states") as usize;
    assert!((10..=100).contains(&states), "{told}");
    assert_eq!(names(&folder, "frames").len(), states);
    assert_eq!(
        names(&folder, "seen"),
        ["collapse.obj", "joints.pvd", "rest.obj", "series", "wall.glb", "wall.pvd"]
    );
    assert_eq!(names(&folder, "seen/series").len(), 2 * states);
    let read = |name: &str| fs::read_to_string(folder.path(name)).expect("it was written");
    let (first, last) = (read("frames/frame-000.svg"), read(&format!("frames/frame-{:03}.svg", states - 1)));
    assert!(first.contains(&format!("State 1 of {states}: at rest at a tilt of 0.0000 deg.")), "{first}");
    assert!(last.contains(&format!("State {states} of {states}: falling, ")), "{last}");
    assert!(last.contains("beyond the limit at a tilt of "), "one capacity: {last}");
    // All frames are of one size, and the ground, which is drawn first, stays where it is.
    let head = |text: &str| text.lines().take(4).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(head(&first), head(&last));
    // The collapse is that of the last state; the ground is in it.
    let last = read(&format!("seen/series/wall-{:03}.vtu", states - 1));
    assert!(last.contains("Name=\"at_rest\" NumberOfTuples=\"1\" format=\"ascii\">\n0\n"));
    let stones = read("seen/collapse.obj").lines().filter(|line| line.starts_with("o ")).count();
    assert!(last.contains(&format!("NumberOfCells=\"{stones}\"")) && stones == 13, "{stones}");
    assert!(read("seen/collapse.obj").contains("\no base_12\n"));
}

#[test]
fn a_wall_that_stands_has_a_series_of_its_states_at_rest_and_no_collapse() {
    let folder = Folder::with_study(STUDY);
    let (told, _) = drawn(&folder, &["--arm", "stack", "--frames", "frames", "--series", "seen"]);
    assert_eq!(names(&folder, "seen"), ["joints.pvd", "rest.obj", "series", "wall.glb", "wall.pvd"]);
    let frame = fs::read_to_string(folder.path("frames/frame-001.svg")).expect("a second state");
    assert!(told["states"].as_u64() > Some(1) && frame.contains("at rest at load factor "), "{frame}");
    // What moves by fractions of a millimetre is enlarged to be seen.
    let times = frame.split("Movements times ").nth(1).and_then(|rest| rest.split(';').next());
    assert!(times.and_then(|times| times.parse::<f64>().ok()) > Some(10.0), "{times:?}");
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
        let output = folder.pirca(&["wall", "studies/tiny", "--out", out]);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        stderr(&output)
    };
    assert!(picture("no/such/folder/wall.svg").contains("cannot write no/such/folder/wall.svg"));
    let dip = "dip_deg = { family = \"uniform\", low = -3, high = 3 }";
    folder.write_study(&changed(dip, &format!("{dip}\nlimits = {{ max_aspect = 1.5, max_attempts = 3 }}")));
    assert!(picture("wall.svg").contains("arm random, member 0: invalid geometry"));
    assert!(!folder.path("wall.svg").exists());
}
