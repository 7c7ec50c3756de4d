//! `pirca readings`: what explains a statement is found, and nothing is where nothing does.

use std::fs;

use serde_json::Value;

use crate::fixture::{Folder, STUDY, stderr};
use crate::scratch::Scratch;

/// Two stack-bond walls of three courses, variants that change the number of their beds, one that changes the density, and one
/// that changes the solver.
fn study() -> String {
    let arms = STUDY.find("[[arm]]").expect("the fixture has arms");
    let arm = |name: &str| {
        format!(
            "[[arm]]\nname = \"{name}\"\nmembers = 1\narrangement = \"continuous\"\nblock_length_m = 0.2\ncourse_height_m = 0.1\n"
        )
    };
    let variant = |name: &str, set: &str| {
        format!("[[variant]]\nname = \"{name}\"\nwhy = \"A test.\"\nset = {{ {set} }}\n")
    };
    [
        STUDY[..arms].replace("\"joint_springs\"", "\"free\""),
        arm("a"),
        arm("b"),
        variant("heavy", "\"block.density_kg_per_m3\" = 2500"),
        variant("few-a", "\"arm.a.course_height_m\" = 0.15"),
        variant("few-b", "\"arm.b.course_height_m\" = 0.15"),
        variant("many-b", "\"arm.b.course_height_m\" = 0.05"),
        variant("damped", "\"solver.name\" = \"explicit\""),
    ]
    .concat()
}

/// Statements about a over b: its ratio lies in each of these intervals, and displacements fall with kn.
fn published(intervals: &[[f64; 2]]) -> String {
    let ratio = |[low, high]: &[f64; 2]| {
        let stated = 0.5 * (low + high);
        format!(
            "[[claim]]\nclaim = \"a is stiffer than b\"\nsource = \"a test\"\ntest = \"ratio_of_means\"\narm = \"a\"\nover = \"b\"\n\
             stated = {stated}\nlow = {low}\nhigh = {high}\nwhy = \"A test.\"\n"
        )
    };
    let ratios: String = intervals.iter().map(ratio).collect();
    let falls =
        "[[claim]]\nclaim = \"it falls\"\nsource = \"a test\"\ntest = \"falls_with_kn\"\nwhy = \"A test.\"\n";
    ratios + falls
}

fn searched(intervals: &[[f64; 2]]) -> (Value, String) {
    let folder = Folder::with_study(&study());
    fs::write(folder.path("studies/tiny/published.toml"), published(intervals)).unwrap();
    let output = folder.pirca(&["readings", "studies/tiny", "--out", "out", "--departures", "3"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    for file in ["readings.csv", "readings.svg", "readings.png"] {
        assert!(folder.path("out").join(file).is_file(), "{file}");
    }
    let json = fs::read(folder.path("out/readings.json")).unwrap();
    (serde_json::from_slice(&json).unwrap(), String::from_utf8(output.stdout).unwrap())
}

/// The ratio is 1.00 in the base, 0.82 with few-a, 0.63 with many-b and 0.51 with both: fewer beds are stiffer.
#[test]
fn the_variants_that_explain_a_statement_together_are_found() {
    let (json, text) = searched(&[[0.45, 0.57]]);
    let first = &json["readings"][0];
    assert_eq!(first["variants"], serde_json::json!(["few-a", "many-b"]), "{text}");
    assert_eq!(first["reproduced"], 2, "{text}");
    // With the density it comes out as well, by one departure more.
    assert_eq!(json["readings"][1]["variants"], serde_json::json!(["heavy", "few-a", "many-b"]), "{text}");
    let both: Vec<&Value> =
        json["readings"].as_array().unwrap().iter().filter(|one| one["reproduced"] == 2).collect();
    assert_eq!(both.len(), 2, "{text}");
    // few-b and many-b change the same key, damped the solver: 1 + 4 + 5 + 2 readings.
    assert_eq!(json["readings"].as_array().unwrap().len(), 12, "{text}");
    assert!(text.contains("With the fewest departures (2) by: few-a+many-b."), "{text}");
}

/// Readings that refute two statements are dropped after their first walls, all but the base; they count as reproducing nothing.
#[test]
fn nothing_explains_what_no_variant_gives() {
    let (json, text) = searched(&[[3.5, 4.0], [5.0, 6.0]]);
    let readings = json["readings"].as_array().unwrap();
    let in_full: Vec<&Value> = readings.iter().filter(|one| one["extent"] == "full").collect();
    assert_eq!(in_full.len(), 1, "{text}");
    assert_eq!(
        (&in_full[0]["variants"], &in_full[0]["reproduced"]),
        (&serde_json::json!([]), &serde_json::json!(1))
    );
    assert!(
        readings[1..].iter().all(|one| one["extent"] == "first_walls" && one["reproduced"].is_null()),
        "{text}"
    );
    assert!(
        text.starts_with("tiny: at most 1 of 3 statements come out together; 1 in the main reading."),
        "{text}"
    );
}

#[test]
fn a_study_that_publishes_nothing_or_has_no_variants_is_refused() {
    let folder = Folder::with_study(&study());
    let output = folder.pirca(&["readings", "studies/tiny"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("no published.toml"), "{}", stderr(&output));
    fs::write(folder.path("studies/tiny/published.toml"), published(&[[0.2, 0.3]])).unwrap();
    let text = study();
    folder.write_study(&text[..text.find("[[variant]]").unwrap()]);
    let output = folder.pirca(&["readings", "studies/tiny"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("has no variant"), "{}", stderr(&output));
}

#[test]
fn variants_are_read_together() {
    let scratch = Scratch::new("together");
    let of = |name: &str| scratch.load(Some(name)).unwrap_or_else(|faults| panic!("{faults}")).study;
    let both = of("corners+laid-cut");
    assert_eq!(both.variant.as_deref(), Some("corners+laid-cut"));
    assert_eq!(both.effective["joint.sampling"], "vertices");
    assert_eq!(both.effective["arm.laid.arrangement"], "cut");
    assert_eq!(of("laid-cut+corners"), both, "their order is that of the file");
    let faults = scratch.load(Some("corners+coners")).expect_err("one of them does not exist").to_string();
    assert!(faults.contains("has no variant \"coners\""), "{faults}");
    let more = "[[variant]]\nname = \"again\"\nwhy = \"A test.\"\nset = { joint = { sampling = \"area\" } }\n[[variant]]\nname = \"corners\"";
    scratch.replace(crate::scratch::STUDY, "[[variant]]\nname = \"corners\"", more);
    let of = |name: &str| scratch.load(Some(name)).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!(of("corners+again").effective["joint.sampling"], "area", "the later one holds");
    assert_eq!(of("again+corners").effective["joint.sampling"], "vertices");
}
