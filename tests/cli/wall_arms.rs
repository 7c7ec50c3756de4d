//! Arms whose stones a file describes: the same walls as drawn, as `analyse` reads them; what of a file is refused; what notices a change.

use std::fs;

use serde_json::Value;

use crate::fixture::{Folder, STUDY, stderr};
use crate::loads::{SHEAR, TILTING, loaded};
use crate::walls::example;

/// The head of a study of walls from files: joints, load, restraint and solver, as `analyse` has them.
const HEAD: &str = "[study]\nquestion = \"Which one falls first?\"\nseed = 1\n\n[joint]\nkn_pa_per_m = [1e8]\nkn_over_ks = 2\nphi_deg = 35\n\
    cohesion_pa = 0\nsub_contacts = [4, 4]\n\n[load]\nprotocol = \"tilting\"\ntowards = \"y+\"\ncapacity = \"first_stone\"\n\n[restraint]\n\
    base = \"fixed\"\nends = \"free\"\n\n[solver]\nname = \"limit\"\n";

fn arm(name: &str, file: &str) -> String {
    format!("\n[[arm]]\nname = \"{name}\"\nmembers = 1\narrangement = \"file\"\nfile = \"{file}\"\n")
}

/// The answer of a command that must succeed.
fn answer(folder: &Folder, command: &[&str]) -> Value {
    let output = folder.pirca(&[command, &["--json"]].concat());
    assert!(output.status.success(), "{command:?}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

/// The means of all arms.
fn means(folder: &Folder, solver: &str) -> Vec<f64> {
    let out = format!("out-{solver}");
    let summary = answer(folder, &["run", "studies/tiny", "--solver", solver, "--out", &out]);
    let arms = summary["arms"].as_array().expect("its arms");
    arms.iter().map(|arm| arm["mean"].as_f64().expect("a mean")).collect()
}

/// What is wrong with the study.
fn faults(folder: &Folder, text: &str) -> String {
    folder.write_study(text);
    let output = folder.pirca(&["check", "studies/tiny"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    stderr(&output)
}

#[test]
fn a_wall_from_a_file_falls_as_the_one_that_was_drawn_and_as_analyse_says_to_the_last_digit() {
    let drawn = loaded(TILTING, "name = \"limit\"")
        .replace("step_deg = 4\nbracket_deg = 0.5", "capacity = \"first_stone\"")
        .replace("cohesion_pa = 0", "cohesion_pa = 0\nsub_contacts = [4, 4]")
        .replace("[5e7, 1.75e8]", "[1e8]")
        .replace("members = 8", "members = 1");
    let folder = Folder::with_study(&drawn);
    for (file, base) in
        [("bare.json", None), ("based.json", Some("--with-base")), ("based.obj", Some("--with-base"))]
    {
        let path = format!("studies/tiny/{file}");
        let command =
            [&["wall", "studies/tiny", "--arm", "random", "--out", &path][..], base.as_slice()].concat();
        assert!(folder.pirca(&command).status.success(), "{command:?}");
    }
    let files = [arm("bare", "bare.json"), arm("based", "based.json"), arm("obj", "based.obj")].concat();
    folder.write_study(&drawn.replace("\n[[variant]]", &format!("{files}\n[[variant]]")));
    for solver in ["limit", "implicit"] {
        let found = means(&folder, solver);
        let asked = ["analyse", "studies/tiny/based.json", "--phi-deg", "35", "--solver", solver];
        let kn = if solver == "limit" { &[][..] } else { &["--kn", "1e8"] };
        let analysed =
            answer(&folder, &[&asked[..], kn].concat())["collapse_angle_deg"].as_f64().expect("an angle");
        assert_eq!(found[1..], [analysed; 4], "{solver}");
    }
}

#[test]
fn a_wall_from_a_file_is_sheared_and_pressed_as_the_one_that_was_drawn() {
    for text in [loaded(SHEAR, "name = \"limit\""), STUDY.to_owned()] {
        let drawn = text.replace("[5e7, 1.75e8]", "[1e8]").replace("members = 8", "members = 1");
        let folder = Folder::with_study(&drawn);
        for (file, base) in [("bare.json", None), ("based.json", Some("--with-base"))] {
            let path = format!("studies/tiny/{file}");
            let command = ["wall", "studies/tiny", "--arm", "random", "--out", &path];
            assert!(folder.pirca(&[&command[..], base.as_slice()].concat()).status.success(), "{file}");
        }
        let files = [arm("bare", "bare.json"), arm("based", "based.json")].concat();
        folder.write_study(&drawn.replace("\n[[variant]]", &format!("{files}\n[[variant]]")));
        let summary = answer(&folder, &["run", "studies/tiny", "--out", "out"]);
        let mean = |arm: usize| summary["arms"][arm]["mean"].as_f64().expect("a mean");
        assert_eq!([mean(2), mean(3)], [mean(1); 2]);
    }
}

#[test]
fn analyse_writes_a_study_that_gives_its_number() {
    // Groups, supports on several heights, an opening; the base comes first in some files, which changes the order of the unknowns alone.
    for (file, within) in [("leaning-tower.json", 1e-7), ("arch.json", 1e-7), ("drums.obj", 1e-7)] {
        let folder = Folder::with_study(STUDY);
        fs::copy(example(file), folder.path(file)).expect("it can be copied");
        let command = [
            "analyse",
            file,
            "--phi-deg",
            "33.5",
            "--direction",
            "y-",
            "--cohesion",
            "100",
            "--study",
            "mine",
        ];
        let analysed = answer(&folder, &command)["collapse_angle_deg"].as_f64().expect("an angle");
        let run =
            answer(&folder, &["run", "mine", "--out", "out"])["arms"][0]["mean"].as_f64().expect("a mean");
        assert!((run - analysed).abs() <= within * analysed, "{file}: {run} {analysed}");
    }
}

#[test]
fn ranges_of_analyse_are_drawn_in_its_study_and_what_a_study_cannot_ask_is_refused() {
    let folder = Folder::with_study(STUDY);
    fs::copy(example("leaning-tower.json"), folder.path("tower.json")).expect("it can be copied");
    let asked =
        ["analyse", "tower.json", "--phi-deg", "normal(34,2)", "--density", "2000..2400", "--walls", "32"];
    answer(&folder, &[&asked[..], &["--study", "mine"]].concat());
    let text = fs::read_to_string(folder.path("mine/study.toml")).expect("it was written");
    for line in
        ["members = 32", "\"joint.phi_deg\" = {", "\"block.density_kg_per_m3\" = {", "file = \"tower.json\""]
    {
        assert!(text.contains(line), "{line}: {text}");
    }
    for (more, why) in [
        (&["--load", "lateral"][..], "a pressure on one face"),
        (&["--dead-load", "1=100"], "states no loads"),
        (&["--solver", "implicit", "--kn", "1e7..1e9"], "even in the logarithm"),
        (&["--solver", "implicit", "--kn", "1e8", "--settle", "0=0.001"], "a support that goes down"),
    ] {
        let command = [&["analyse", "tower.json", "--phi-deg", "34", "--study", "other"][..], more].concat();
        let output = folder.pirca(&command);
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        assert!(stderr(&output).contains(why), "{more:?}: {}", stderr(&output));
        assert!(!folder.path("other").exists(), "{more:?}");
    }
    let again = folder.pirca(&["analyse", "tower.json", "--phi-deg", "34", "--study", "mine"]);
    assert!(stderr(&again).contains("is there already"), "{}", stderr(&again));
}

#[test]
fn what_a_file_states_is_taken_and_what_does_not_go_with_it_is_refused_with_its_place() {
    let folder = Folder::with_study(&(HEAD.to_owned() + &arm("tower", "walls/tower.json")));
    fs::create_dir(folder.path("studies/tiny/walls")).expect("it can be made");
    let place = folder.path("studies/tiny/walls/tower.json");
    fs::copy(example("leaning-tower.json"), &place).expect("it can be copied");
    let one = HEAD.to_owned() + &arm("tower", "walls/tower.json");
    for (text, expected) in [
        (
            one.replace("[joint]", "[block]\ndensity_kg_per_m3 = 2000\n\n[joint]"),
            "block has nothing to act on",
        ),
        (one.clone() + "unit = \"mm\"\n", "for files that state no unit"),
        (one.clone() + "length_m = 2\n", "means nothing where arrangement = \"file\""),
        (one.clone() + "wall.turned = true\n", "means nothing where arrangement = \"file\""),
        (
            one.clone() + "block.density_kg_per_m3 = { family = \"uniform\", low = 2000, high = 2400 }\n",
            "one number, the mean density",
        ),
        (one.replace("walls/tower", "walls/towr"), "did you mean \"tower.json\"?"),
        (one.replace("walls/tower.json", "../tower.json"), "a wall in the folder of the study"),
        (
            one.clone() + &STUDY[STUDY.find("\n[[arm]]\nname = \"stack\"").expect("an arm")..],
            "wall is missing",
        ),
        (one.clone() + "touch_tolerance_m = 0.9\n", "touch_tolerance_m of the arm"),
    ] {
        let said = faults(&folder, &text);
        assert!(said.contains(expected), "{expected}: {said}");
    }
    // Stones that float above the platform, and a file that is no wall.
    folder.write_study(&one);
    let stones = fs::read_to_string(&place).expect("it can be read");
    fs::write(
        &place,
        stones
            .replace("\"fixed\": true", "\"fixed\": false, \"density\": 2400")
            .replace("\"fixed\":true", "\"fixed\":false,\"density\":2400"),
    )
    .expect("it can be written");
    let said = faults(&folder, &one);
    assert!(said.contains("walls/tower.json") && said.contains("platform"), "{said}");
    fs::write(&place, "{").expect("it can be written");
    assert!(faults(&folder, &one).starts_with("error: 1 fault"), "{}", faults(&folder, &one));
}

#[test]
fn a_file_that_has_changed_is_another_study() {
    let folder = Folder::with_study(&(HEAD.to_owned() + &arm("tower", "tower.json")));
    let place = folder.path("studies/tiny/tower.json");
    fs::copy(example("leaning-tower.json"), &place).expect("it can be copied");
    let hash = |folder: &Folder| answer(folder, &["report", "out", "--cite"])["study_hash"].clone();
    answer(&folder, &["run", "studies/tiny", "--out", "out"]);
    let shard = ["shards", "run", "studies/tiny", "--index", "0", "--of", "1", "--out", "shards"];
    answer(&folder, &shard);
    let before = hash(&folder);
    let text = fs::read_to_string(&place).expect("it can be read");
    fs::write(&place, text.replacen("\"density\"", " \"density\"", 1)).expect("it can be written");
    for command in [&["run", "studies/tiny", "--out", "out"][..], &shard, &["shards", "merge", "shards"]] {
        let output = folder.pirca(command);
        let said = stderr(&output);
        assert!(!output.status.success() && said.contains("arm.tower.file"), "{command:?}: {said}");
    }
    fs::write(&place, text).expect("it can be written");
    answer(&folder, &["shards", "merge", "shards"]);
    assert_eq!(before, hash(&folder));
    assert_ne!(before, Value::Null);
}
