//! `pirca capacity`: what simulated walls and tested specimens may be counted on to bear, and what they cannot tell.

use std::fs;
use std::path::Path;

use pirca::stats::{clopper_pearson, quantile};
use serde_json::Value;

use crate::commands::stdout;
use crate::fixture::{Folder, STUDY, stderr};

/// Small towers of stones, solved in milliseconds.
fn towers() -> Folder {
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/hidden-effects/example/study.toml");
    Folder::with_study(&fs::read_to_string(study).unwrap())
}

fn asked(folder: &Folder, arguments: &[&str]) -> (Value, String) {
    let all = [&["capacity", "studies/tiny"], arguments].concat();
    let text = folder.pirca(&all);
    assert_eq!(text.status.code(), Some(0), "{}", stderr(&text));
    let json = folder.pirca(&[&all[..], &["--json"]].concat());
    assert_eq!(json.status.code(), Some(0), "{}", stderr(&json));
    (serde_json::from_slice(&json.stdout).unwrap(), stdout(&text))
}

#[test]
fn probabilities_and_quantiles_are_those_of_the_walls() {
    let folder = towers();
    let walls = ["--members", "40", "--out", "out"];
    let (json, text) = asked(&folder, &walls);
    let group = &json["groups"][0];
    assert_eq!(
        (&group["name"], &group["walls"], &json["unit"]),
        (&"tower".into(), &40.into(), &"deg".into())
    );
    // The walls are those of `run`, which goes on from their record.
    let run = folder.pirca(&["run", "studies/tiny", "--members", "40", "--out", "out", "--json"]);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let summary: Value = serde_json::from_slice(&run.stdout).unwrap();
    let five = &summary["arms"][0]["quantiles"][0];
    assert_eq!(five["probability"], 0.05);
    assert_eq!(group["answer"], five["value"]);
    assert!(text.contains("5.0 % of walls lie below"), "{text}");
    // What 40 walls do not bound has no interval: 59 are needed.
    assert!(group["interval"].is_null());
    let angles: Vec<f64> = fs::read_to_string(folder.path("out/journal.jsonl"))
        .unwrap()
        .lines()
        .filter_map(|line| {
            serde_json::from_str::<Value>(line).ok()?["entry"]["row"]["collapse_angle_deg"].as_f64()
        })
        .collect();
    assert_eq!(angles.len(), 40);
    let level = quantile(&angles, 0.4).unwrap();
    let below = angles.iter().filter(|angle| **angle < level).count();
    let (json, text) = asked(&folder, &[&walls[..], &["--below-deg", &level.to_string()]].concat());
    let group = &json["groups"][0];
    assert_eq!(group["answer"], below as f64 / 40.0);
    let [low, high] = clopper_pearson(below, 40);
    assert_eq!((&group["interval"][0], &group["interval"][1]), (&low.into(), &high.into()));
    assert!(text.contains("with a probability of"), "{text}");
    let supported = group["supported"].as_array().unwrap();
    assert_eq!(supported.len(), 2);
    let value = |of: &str| supported[1][of]["value"].as_f64().unwrap();
    // What no more than 5 % surely lie below is lower than what the next wall lies below, and a design value than both.
    assert!(value("design") < value("tolerance_95_95") && value("tolerance_95_95") < value("characteristic"));
    assert!(value("characteristic") < quantile(&angles, 0.5).unwrap());
    assert!(folder.path("out/capacity.json").is_file());
}

#[test]
fn three_specimens_of_a_family_are_said_to_carry_no_design_value() {
    let folder = Folder::with_study(STUDY);
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-table");
    let asked = |extra: &[&str]| {
        folder.pirca(&[&["capacity", study.to_str().unwrap(), "--measured"], extra].concat())
    };
    // Lines are wrapped.
    let text = stdout(&asked(&[])).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("3 specimens carry no design value: a normal one is -27.0 deg"), "{text}");
    assert!(text.contains("too few to show a 5.0 % quantile"), "{text}");
    let json: Value = serde_json::from_slice(&asked(&["--json", "--known-cov", "0.1"]).stdout).unwrap();
    assert_eq!((&json["groups"][0]["method"], &json["known_cov"]), (&"measured".into(), &0.1.into()));
    let values: Vec<f64> = json["groups"]
        .as_array()
        .unwrap()
        .iter()
        .map(|group| group["supported"][1]["characteristic"]["value"].as_f64().unwrap())
        .collect();
    for (own, expected) in values.iter().zip([15.57, 11.84, 16.08]) {
        assert!((own - expected).abs() < 0.015, "{values:?}");
    }
}

#[test]
fn what_cannot_be_asked_is_said_and_nothing_is_computed() {
    let folder = towers();
    let said = |arguments: &[&str], code: i32, what: &str| {
        let output = folder.pirca(&[&["capacity", "studies/tiny"], arguments].concat());
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(what), "{arguments:?}: {}", stderr(&output));
    };
    said(&["--quantile", "0"], 2, "allowed is a number above 0 and below 1");
    said(&["--quantile", "1.5"], 2, "allowed is a number above 0 and below 1");
    said(&["--below-deg", "-3"], 2, "allowed is a number above 0");
    said(&["--known-cov", "10"], 2, "up to 1 (0.1 is 10 %)");
    said(&["--above-m", "0.01"], 2, "ask with --below-deg");
    said(&["--quantile", "0.1", "--below-deg", "9"], 2, "cannot be used with");
    said(&["--walls", "2000"], 2, "--walls: further walls are evaluated towards a level; name one");
    said(&["--measured"], 3, "no collapse angle in measured.csv");
    folder.write_study(STUDY);
    said(&["--known-cov", "0.1"], 2, "observes a displacement");
    let alone =
        STUDY.replace("members = 8\narrangement = \"coursed\"", "members = 1\narrangement = \"continuous\"");
    let alone = &alone[..alone.find("length_m = {").unwrap()];
    folder.write_study(&format!("{alone}block_length_m = 0.2\ncourse_height_m = 0.1\n"));
    said(&[], 3, "nothing is drawn in any arm");
    assert!(!folder.path("runs").exists());
}

/// The level that three in a hundred towers fall before, of 300; and what subset simulation says of it.
#[test]
#[ignore = "slow: 2,000 towers, half a minute of processor time"]
fn a_rare_probability_is_that_of_many_plain_walls_whatever_the_threads_and_after_a_stop() {
    let folder = towers();
    let (json, _) = asked(&folder, &["--members", "300", "--quantile", "0.03", "--out", "plain"]);
    let level = json["groups"][0]["answer"].as_f64().unwrap().to_string();
    let (json, _) = asked(&folder, &["--members", "300", "--below-deg", &level, "--out", "plain-below"]);
    let ends = |of: &Value| [0, 1].map(|k| of["interval"][k].as_f64().unwrap());
    let plain = ends(&json["groups"][0]);
    let rare = |out: &str, threads: &str| {
        let few =
            ["--members", "30", "--below-deg", &level, "--walls", "1500", "--out", out, "--threads", threads];
        asked(&folder, &few)
    };
    let (first, text) = rare("rare", "2");
    let group = &first["groups"][0];
    assert_eq!(group["method"], "subset", "{text}");
    assert!(text.contains("subset simulation") && group["repeats"]["failed"] == 0, "{text}");
    let own = ends(group);
    assert!(own[0] < plain[1] && plain[0] < own[1], "{own:?} and {plain:?}: {text}");
    // The weakest wall lies beyond all plain ones' level.
    assert!(group["repeats"]["weakest"][1].as_f64().unwrap() < level.parse().unwrap());
    let (other, _) = rare("rare-alone", "1");
    assert_eq!(first, other);
    // Half of what it had evaluated is lost, and the last line torn.
    let path = folder.path("rare/draws.jsonl");
    let kept = fs::read_to_string(&path).unwrap();
    fs::write(&path, &kept[..kept.len() / 2]).unwrap();
    assert_eq!(rare("rare", "2").0, first);
}
