//! `pirca compare`: which arm is the best, what is said when none is, and what cannot be compared.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use pirca::stats::{always_valid_mean, mean};
use serde_json::Value;

use crate::commands::stdout;
use crate::fixture::{Folder, STUDY, stderr};

/// Small towers of stones, solved in milliseconds: one that is thinner, and one whose every wall is that of the first.
pub fn towers() -> String {
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/hidden-effects/example/study.toml");
    let text = fs::read_to_string(study).unwrap();
    let arm = text[text.find("[[arm]]").unwrap()..].to_owned();
    let more =
        |name: &str, extra: &str| format!("\n{}{extra}\n", arm.replace("\"tower\"", &format!("\"{name}\"")));
    let slim = more("slim", "wall = { base_thickness_m = 0.074, top_thickness_m = 0.074 }");
    format!("{text}{slim}{}", more("twin", ""))
}

/// What is written, whatever the threads and after any stop.
const RESULTS: [&str; 9] = [
    "compare.json",
    "compare.csv",
    "compare.svg",
    "compare.png",
    "distributions.csv",
    "distributions.svg",
    "members.parquet",
    "steps.parquet",
    "manifest.json",
];

fn results(folder: &Folder, out: &str) -> Vec<Vec<u8>> {
    RESULTS.iter().map(|name| fs::read(folder.path(out).join(name)).unwrap()).collect()
}

fn asked(folder: &Folder, arguments: &[&str]) -> (Value, String) {
    let all = [&["compare", "studies/tiny"], arguments].concat();
    let text = folder.pirca(&all);
    assert_eq!(text.status.code(), Some(0), "{}", stderr(&text));
    let json = folder.pirca(&[&all[..], &["--json"]].concat());
    assert_eq!(json.status.code(), Some(0), "{}", stderr(&json));
    (serde_json::from_slice(&json.stdout).unwrap(), stdout(&text))
}

/// Collapse angles by arm and member, as they are in the journal.
pub fn angles(folder: &Folder, out: &str) -> BTreeMap<(String, u64), f64> {
    let text = fs::read_to_string(folder.path(out).join("journal.jsonl")).unwrap();
    let row = |line: &str| {
        let row = serde_json::from_str::<Value>(line).ok()?["entry"]["row"].clone();
        Some((
            (row["arm"].as_str()?.to_owned(), row["member"].as_u64()?),
            row["collapse_angle_deg"].as_f64()?,
        ))
    };
    text.lines().filter_map(row).collect()
}

#[test]
fn the_better_arm_is_named_with_its_paired_difference_and_a_twin_cannot_be_told_apart() {
    let folder = Folder::with_study(&towers());
    let (json, text) = asked(&folder, &["--out", "out"]);
    assert_eq!(
        (&json["settled"], &json["best"], &json["unit"]),
        (&true.into(), &"tower".into(), &"deg".into())
    );
    let conclusion: Vec<&str> = text.split("\n\n").next().unwrap().lines().collect();
    assert!(conclusion.len() <= 5 && conclusion.iter().all(|line| line.chars().count() <= 100), "{text}");
    assert!(text.contains("tower is better than slim, and the same as twin within 0.25 deg."), "{text}");
    let of = |over: &str| {
        let all = json["differences"].as_array().unwrap();
        all.iter().find(|own| own["arm"] == "tower" && own["over"] == over).unwrap().clone()
    };
    let (slim, twin) = (of("slim"), of("twin"));
    assert_eq!((&slim["shown"], &twin["shown"]), (&"better".into(), &"same".into()));
    // The same stones in both: the twin differs in nothing.
    assert_eq!((&twin["better_by"], &twin["interval"]), (&0.0.into(), &serde_json::json!([0.0, 0.0])));
    assert_eq!(twin["next_wall"]["probability"], 0.5);
    let angles = angles(&folder, "out");
    let pairs = slim["pairs"].as_u64().unwrap();
    let differences: Vec<f64> = (0..pairs)
        .map(|member| angles[&("tower".to_owned(), member)] - angles[&("slim".to_owned(), member)])
        .collect();
    assert_eq!(
        slim["better_by"].as_f64().map(|x| (x * 1e9).round()),
        mean(&differences).map(|x| (x * 1e9).round())
    );
    // The means are those of the pairs, so that they differ by the difference.
    let means = |own: &Value| [0, 1].map(|k| own["means"][k].as_f64().unwrap());
    let [tower, other] = means(&slim);
    assert!((tower - other - slim["better_by"].as_f64().unwrap()).abs() < 1e-9, "{slim}");
    assert!(text.contains("mean: over the walls that the arm shares with the best one"), "{text}");
    // Three pairs of arms share what may be missed.
    let [low, high] = always_valid_mean(&differences, 0.05 / 3.0).unwrap();
    assert!((slim["interval"][0].as_f64().unwrap() - low).abs() < 1e-9);
    assert!((slim["interval"][1].as_f64().unwrap() - high).abs() < 1e-9);
    assert!(json["probability_of_correct_selection"].as_f64().unwrap() > 0.95);
    // What was evaluated is what is told.
    assert_eq!(json["walls"].as_u64().unwrap(), angles.len() as u64);
}

#[test]
fn threads_stops_and_an_earlier_larger_budget_change_no_byte() {
    let folder = Folder::with_study(&towers());
    // A zone too narrow to settle anything within the budget.
    let run = |out: &str, threads: &str, walls: &str| {
        let arguments =
            ["--arms", "tower,twin", "--below-deg", "16.4", "--same-within-share", "0.001", "--walls", walls];
        let all =
            [&["compare", "studies/tiny"], &arguments[..], &["--out", out, "--threads", threads]].concat();
        let output = folder.pirca(&all);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        (results(&folder, out), stderr(&output))
    };
    let (one, told) = run("one", "1", "60");
    assert_eq!(run("two", "2", "60").0, one);
    // Progress: the running answer with its interval, look by look.
    assert!(
        told.lines().count() >= 3 && told.contains("20 walls: ") && told.contains("leads, over "),
        "{told}"
    );
    // Half of the record is lost, and the last line torn.
    let path = folder.path("two/journal.jsonl");
    let kept = fs::read(&path).unwrap();
    fs::write(&path, &kept[..kept.len() / 2]).unwrap();
    assert_eq!(run("two", "2", "60").0, one);
    // More walls go on from there, and fewer leave out what they did not ask for.
    let (more, _) = run("two", "2", "90");
    assert_ne!(more, one);
    assert_eq!(run("two", "2", "60").0, one);
}

#[test]
fn what_is_not_decided_is_said() {
    let folder = Folder::with_study(&towers());
    let (json, text) =
        asked(&folder, &["--arms", "tower,slim", "--same-within-deg", "0.001", "--walls", "20"]);
    // Ten pairs may do, as the slim tower is surely weaker; the twin is the same.
    assert!(json["walls"].as_u64().unwrap() <= 20, "{text}");
    let (json, text) = asked(
        &folder,
        &["--arms", "tower,twin", "--quantile", "0.5", "--same-within-deg", "0.001", "--walls", "60"],
    );
    assert_eq!(json["settled"], false, "{text}");
    assert!(text.starts_with("Not decided: tower leads, but twin may be as good."), "{text}");
    assert!(json["probability_of_correct_selection"].is_null());
}

#[test]
fn a_displacement_is_the_better_the_smaller_and_a_fixed_arm_is_one_wall() {
    let folder = Folder::with_study(STUDY);
    let (json, text) = asked(&folder, &["--same-within-m", "1e-7", "--walls", "60", "--point", "1"]);
    let difference = &json["differences"][0];
    let arm =
        |name: &str| json["arms"].as_array().unwrap().iter().find(|arm| arm["name"] == name).unwrap().clone();
    assert_eq!((&arm("stack")["walls"], &arm("stack")["random"]), (&1.into(), &false.into()));
    assert_eq!(arm("stack")["kn_pa_per_m"], 1.75e8);
    let mean = |name: &str| arm(name)["mean"]["value"].as_f64().unwrap();
    let (best, other) = (difference["arm"].as_str().unwrap(), difference["over"].as_str().unwrap());
    assert!(mean(best) < mean(other), "{text}");
    assert!((difference["better_by"].as_f64().unwrap() - (mean(other) - mean(best))).abs() < 1e-12);
    let level = format!("{}", 0.5 * (mean(best) + mean(other)));
    let (json, _) = asked(&folder, &["--above-m", &level, "--walls", "40", "--point", "1"]);
    assert_eq!((&json["difference_unit"], &json["best"]), (&"1".into(), &best.into()));
}

#[test]
fn walls_that_cannot_be_built_are_counted_and_bounded() {
    let text = towers();
    let at = text.find("name = \"slim\"").unwrap();
    let strict = "limits = { max_redraws = 16, max_attempts = 1, min_size_m = 0.03 }\n";
    let end = at + text[at..].find("wall = {").unwrap();
    let folder = Folder::with_study(&format!("{}{strict}{}", &text[..end], &text[end..]));
    let (json, text) = asked(&folder, &["--arms", "tower,slim", "--walls", "120"]);
    let slim = json["arms"].as_array().unwrap().iter().find(|arm| arm["name"] == "slim").unwrap().clone();
    let lost: u64 = slim["failed"].as_object().unwrap().values().map(|count| count.as_u64().unwrap()).sum();
    let difference = &json["differences"][0];
    let walls = slim["walls"].as_u64().unwrap();
    assert!(lost > 0 && lost < walls, "{lost} of {walls} must fail: {text}");
    assert_eq!(difference["pairs"].as_u64().unwrap() + difference["lost_pairs"].as_u64().unwrap(), walls);
    let ends = |of: &str| [0, 1].map(|k| difference[of][k].as_f64().unwrap());
    let (own, whatever) = (ends("interval"), ends("interval_whatever_failed"));
    assert!(whatever[0] <= own[0] && whatever[1] > own[1], "{own:?} {whatever:?}");
    assert_eq!(difference["next_wall"]["pairs"][3], difference["lost_pairs"]);
    assert!(text.contains(&format!("{lost} walls brought no value")), "{text}");
    assert!(
        !stdout(&folder.pirca(&["compare", "studies/tiny", "--arms", "tower,slim", "--walls", "120"]))
            .contains("NaN")
    );
}

#[test]
fn what_cannot_be_compared_is_said_with_what_is_allowed() {
    let folder = Folder::with_study(&towers());
    let said = |arguments: &[&str], code: i32, what: &str| {
        let output = folder.pirca(&[&["compare", "studies/tiny"], arguments].concat());
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(what), "{arguments:?}: {}", stderr(&output));
        assert!(stdout(&output).is_empty());
    };
    said(&["--confidence", "1"], 2, "allowed is a number from 0.5, below 1");
    said(&["--confidence", "0"], 2, "allowed is a number from 0.5, below 1");
    said(&["--quantile", "1"], 2, "allowed is a number above 0 and below 1");
    said(&["--same-within-deg", "0"], 2, "allowed is a number above 0");
    said(&["--same-within-m", "0.1"], 2, "collapse angles are compared; say it with --same-within-deg");
    said(
        &["--below-deg", "9", "--same-within-deg", "1"],
        2,
        "probabilities are compared; say it with --same-within-share",
    );
    said(&["--above-m", "0.01"], 2, "ask with --below-deg");
    said(&["--walls", "20"], 2, "10 walls of each random arm are evaluated before the first look, 30 in all");
    said(&["--arms", "tower"], 2, "one arm, `tower`, cannot be compared: two or more are needed");
    said(
        &["--arms", "tower,slimm"],
        2,
        "no arm `slimm`, the nearest is `slim`; allowed are tower, slim, twin",
    );
    said(&["--arms", "tower,tower"], 2, "named twice");
    said(&["--point", "1"], 2, "has 1 kn points; allowed is 0 to 0");
    assert!(!folder.path("runs").exists());
    said(&["--below-deg", "2", "--walls", "60"], 2, "all 60 walls lie on one side of it");
    let alone = &towers()[..towers().find("name = \"slim\"").unwrap()];
    folder.write_study(alone.trim_end().trim_end_matches("[[arm]]"));
    said(&["--out", "alone"], 3, "one arm, `tower`, cannot be compared");
    let stack = &STUDY[STUDY.find("[[arm]]").unwrap()..STUDY.find("[[arm]]\nname = \"random\"").unwrap()];
    let fixed = format!(
        "{}{stack}{}{}",
        &STUDY[..STUDY.find("[[arm]]").unwrap()],
        stack.replace("\"stack\"", "\"other\""),
        &STUDY[STUDY.find("[[variant]]").unwrap()..]
    );
    folder.write_study(&fixed);
    said(&["--out", "fixed"], 3, "nothing is drawn in any arm that is compared");
    // Every wall of one arm falls under the load.
    folder.write_study(&STUDY.replace("mean_pressure_pa = 200", "mean_pressure_pa = 900000"));
    said(&["--out", "fallen"], 1, "none of the 1 walls of arm `stack` brought a value (the first: ");
}
