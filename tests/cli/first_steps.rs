//! What a beginner types: a folder that is empty, a wall or a table in the place of a study, words that are nearly right.

use std::fs;

use serde_json::Value;

use crate::fixture::{Folder, STUDY, changed, stderr};

/// What a command says on standard error, which ends so.
fn said(folder: &Folder, code: i32, arguments: &[&str]) -> String {
    let output = folder.pirca(arguments);
    assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
    stderr(&output)
}

/// `check` advises a command for a folder without a study, and that command does it.
#[test]
fn a_study_begins_in_an_empty_folder_as_check_advises() {
    let folder = Folder::with_study(STUDY);
    fs::create_dir(folder.path("empty")).unwrap();
    let advised = said(&folder, 3, &["check", "empty"]);
    assert!(advised.contains("to begin one: pirca init empty --from STUDY"), "{advised}");
    said(&folder, 0, &["init", "empty"]);
    said(&folder, 0, &["check", "empty"]);
    // What holds something else is not written over, nor is it advised.
    fs::create_dir(folder.path("full")).unwrap();
    fs::write(folder.path("full/notes.txt"), "mine").unwrap();
    let advised = said(&folder, 3, &["check", "full"]);
    assert!(advised.contains("to begin one: pirca init full/my-wall --from STUDY"), "{advised}");
    let refused = said(&folder, 2, &["init", "full"]);
    assert!(refused.contains("full is a folder with files in it"), "{refused}");
    said(&folder, 0, &["init", "full/my-wall"]);
    // A copy that fails leaves the folder as it was.
    fs::create_dir(folder.path("again")).unwrap();
    folder.write_study(&STUDY.replace("seed = 7", "seed = -7"));
    said(&folder, 3, &["init", "again", "--from", "studies/tiny"]);
    assert_eq!(fs::read_dir(folder.path("again")).unwrap().count(), 0);
}

#[test]
fn a_wall_or_a_table_in_the_place_of_a_study_is_named() {
    let folder = Folder::with_study(STUDY);
    for (file, text, words) in [
        (
            "wall.obj",
            "o a\n",
            "wall.obj is the file of one wall\nto analyse it: pirca analyse wall.obj --phi-deg 35",
        ),
        ("wall.json", "{\"blocks\": []}", "to analyse it: pirca analyse wall.json --phi-deg 35"),
        (
            "studies/tiny/survey.csv",
            "length_m\n",
            "is a file in the folder of a study\ngive the folder: studies/tiny",
        ),
        ("notes.txt", "x", "notes.txt is a file, but not a study.toml"),
    ] {
        fs::write(folder.path(file), text).unwrap();
        for verb in ["run", "check", "capacity"] {
            let found = said(&folder, 3, &[verb, file]);
            assert!(found.contains(words), "{words} in: {found}");
        }
    }
}

/// Files of COMPAS are JSON as well: of those that are no assembly the type is named, and no key of theirs is called unknown.
#[test]
fn json_of_compas_without_blocks_is_named_in_the_place_of_a_wall() {
    let folder = Folder::with_study(STUDY);
    for (text, kind) in [
        (
            "{\"dtype\": \"compas_assembly.datastructures/Assembly\", \"data\": {}}",
            "compas_assembly.datastructures/Assembly",
        ),
        (
            "[{\"dtype\": \"compas.datastructures/Mesh\", \"data\": {\"vertex\": {}}}]",
            "compas.datastructures/Mesh",
        ),
        (
            "{\"compas\": \"1.17.5\", \"datatype\": \"compas.datastructures.Mesh\", \"data\": {}}",
            "compas.datastructures.Mesh",
        ),
    ] {
        fs::write(folder.path("wall.json"), text).unwrap();
        let found = said(&folder, 3, &["analyse", "wall.json", "--phi-deg", "35"]);
        let words = format!("this is JSON of COMPAS ({kind}) without a graph of blocks; allowed is");
        assert!(found.contains(&words) && found.contains("the objects of one OBJ file"), "{found}");
        assert!(!found.contains("not a known key"), "{found}");
    }
}

/// Limit analysis finds the factor on a pressure at which a wall falls. Bed by bed, a wall that is one stone wide slides, or turns about
/// its front edge, where the pressure above that bed is more than its weight there can hold: the closed form is the least over the beds.
#[test]
fn limit_analysis_of_a_wall_under_pressure_is_shown_as_its_factor() {
    let pressed = STUDY_UNDER_PRESSURE;
    let folder = Folder::with_study(pressed);
    let output = folder.pirca(&["run", "studies/tiny", "--out", "out", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let told: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
    let arm = &told["arms"][0];
    // Course by course of height h over the height z above a bed: weight w z, resultant P(z) and moment M(z) of a pressure that falls
    // linearly from 100 parts at the base to one at the top (mean 1000 Pa).
    let (height, thickness, density, courses) = (1.0, 0.4, 2400.0, 5);
    let top = 2.0 * 1000.0 / 101.0;
    let slope = 99.0 * top / height;
    let bed = |course: i32| {
        let z = height * f64::from(course) / f64::from(courses);
        let weight = density * 9.80665 * thickness * z;
        let push = top * z + slope * z * z / 2.0;
        let moment = top * z * z / 2.0 + slope * z * z * z / 6.0;
        (weight * pirca::math::tan(35f64.to_radians()) / push).min(weight * thickness / 2.0 / moment)
    };
    let wanted = (1..=courses).map(bed).fold(f64::INFINITY, f64::min);
    assert!((wanted - 5.593).abs() < 1e-3, "{wanted}");
    let found = arm["mean"].as_f64().expect("a factor");
    assert!((found - wanted).abs() < 1e-4 * wanted, "{found} {wanted}");
    assert_eq!(
        (&arm["quantity"], &arm["unit"], &arm["in_mean"]),
        (&"load_factor".into(), &"1".into(), &1.into())
    );
    let text = crate::commands::stdout(&folder.pirca(&["run", "studies/tiny", "--out", "out"]));
    for words in [
        "tiny: 1 wall, none failed, 1 of 1 bear the full load.",
        "Mean load at collapse in full loads",
        "stone 5.59",
    ] {
        assert!(text.contains(words), "{words} in: {text}");
    }
    // Five times the pressure and more: it does not bear it, and the factor is as much smaller.
    folder.write_study(&pressed.replace("mean_pressure_pa = 1000", "mean_pressure_pa = 8000"));
    let text = crate::commands::stdout(&folder.pirca(&["run", "studies/tiny", "--out", "more"]));
    assert!(text.contains("0 of 1 bear the full load") && text.contains("stone 0.699"), "{text}");
}

const STUDY_UNDER_PRESSURE: &str = r#"
[study]
question = "What does a wall bear?"
seed = 7

[wall]
height_m = 1.0
length_m = 1.0
base_thickness_m = 0.4
top_thickness_m = 0.4
battered_face = "both"

[block]
density_kg_per_m3 = 2400

[joint]
kn_pa_per_m = [1e9]
kn_over_ks = 2.0
phi_deg = 35
cohesion_pa = 0

[load]
protocol = "lateral"
mean_pressure_pa = 1000
base_over_top = 100
steps = 10

[restraint]
base = "fixed"
ends = "free"

[solver]
name = "limit"

[[arm]]
name = "stone"
members = 1
arrangement = "continuous"
block_length_m = 1.0
course_height_m = 0.2
"#;

/// Why walls failed stands in the text of a run, in the words of the first one.
#[test]
fn the_reason_of_failed_walls_stands_in_the_text() {
    let dip = "dip_deg = { family = \"uniform\", low = -3, high = 3 }";
    let text = changed(dip, &format!("{dip}\nlimits = {{ max_aspect = 1.5, max_attempts = 3 }}"));
    let folder = Folder::with_study(&text);
    let output = folder.pirca(&["run", "studies/tiny", "--members", "3", "--out", "out"]);
    // Lines are wrapped.
    let text = crate::commands::stdout(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("3 invalid geometry (wall 0: "), "{text}{}", stderr(&output));
}

/// A spreadsheet's line of means below a table would count as one more specimen, on the unsafe side: it is left out, and named.
#[test]
fn a_row_that_sums_the_others_up_is_left_out() {
    let folder = Folder::with_study(STUDY);
    let head = "specimen,family,tilt_deg,quantity,value,unit,error,kind\n";
    let row = |name: &str, angle: f64| format!("{name},random,,collapse_angle,{angle},deg,0,exact\n");
    let rows = [row("S1", 18.5), row("S2", 19.0), row("S3", 20.5)].concat();
    let measured = |text: String| {
        fs::write(folder.path("studies/tiny/measured.csv"), text).unwrap();
        said(&folder, 0, &["check", "studies/tiny"])
    };
    let alone = measured(format!("{head}{rows}"));
    assert!(!alone.contains("left out"), "{alone}");
    for name in ["mean", "Mittelwert", "Average"] {
        let warned = measured(format!("{head}{rows}{}", row(name, 19.33)));
        let words =
            format!("measured.csv:5: specimen is \"{name}\", which sums others up: the row was left out");
        assert!(warned.contains(&words), "{warned}");
        let output = folder.pirca(&["check", "studies/tiny"]);
        let told = crate::commands::stdout(&output);
        assert!(told.contains("3 values on 3 specimens"), "{told}");
    }
}
