//! `pirca plan-tests`: how many real specimens tell what, by which reading.

use pirca::stats::{Aim, characteristic_loss, power_of_groups, specimens_to_see};
use serde_json::Value;

use crate::commands::stdout;
use crate::compare::towers;
use crate::fixture::{Folder, STUDY, stderr};

fn asked(folder: &Folder, arguments: &[&str]) -> (Value, String) {
    let all = [&["plan-tests", "studies/tiny"], arguments].concat();
    let text = folder.pirca(&all);
    assert_eq!(text.status.code(), Some(0), "{}", stderr(&text));
    let json = folder.pirca(&[&all[..], &["--json"]].concat());
    (serde_json::from_slice(&json.stdout).unwrap(), stdout(&text))
}

#[test]
fn specimens_follow_from_the_scatter_of_walls_and_the_error_of_the_reading() {
    let folder = Folder::with_study(&towers());
    let (json, text) = asked(&folder, &["--specimens", "3", "--members", "12", "--out", "out"]);
    let all = json["differences"].as_array().unwrap();
    let of = |over: &str, reading: &str| {
        let own =
            all.iter().find(|own| own["arm"] == "tower" && own["over"] == over && own["reading"] == reading);
        own.unwrap_or_else(|| panic!("{over} {reading}: {text}")).clone()
    };
    let slim = of("slim", "collapse angle");
    let (difference, sigma) = (slim["difference"].as_f64().unwrap(), slim["sigma"].as_f64().unwrap());
    // The error of 0.25 deg is part of the scatter.
    assert!(difference > 0.5 && sigma >= 0.25, "{slim}");
    let aim = Aim { confidence: 0.95, power: 0.8 };
    let needed = specimens_to_see(difference / sigma, aim).unwrap() as u64;
    assert_eq!(slim["specimens"].as_u64(), Some(needed));
    assert!((slim["power"].as_f64().unwrap() - power_of_groups(difference / sigma, 3, 0.95)).abs() < 1e-12);
    // Walls of the same stones are alike, and no number shows a difference that is none.
    let twin = of("twin", "collapse angle");
    assert!(twin["specimens"].is_null() && twin["pairs"].is_null(), "{twin}");
    assert!(text.contains("tower and twin: no number of specimens shows a difference."), "{text}");
    // A displacement on the way is read as well.
    assert!(all.iter().any(|own| own["reading"].as_str().unwrap().starts_with("displacement at ")), "{text}");
    for file in ["plan-tests.json", "plan-tests.csv"] {
        assert!(folder.path("out").join(file).is_file());
    }
    // A worse instrument asks for more.
    let (json, _) =
        asked(&folder, &["--specimens", "3", "--members", "12", "--error-deg", "2", "--out", "out"]);
    let own = json["differences"]
        .as_array()
        .unwrap()
        .iter()
        .find(|own| own["over"] == "slim" && own["reading"] == "collapse angle")
        .unwrap()
        .clone();
    assert!(own["specimens"].as_u64().unwrap() > needed);
}

#[test]
fn a_stated_scatter_takes_the_place_of_the_simulated_one() {
    let folder = Folder::with_study(&towers());
    let (json, text) =
        asked(&folder, &["--specimens", "5", "--members", "4", "--cov", "0.1", "--error-deg", "1e-9"]);
    let arm = &json["arms"][0];
    assert!((arm["cov"].as_f64().unwrap() - 0.1).abs() < 1e-9);
    let loss = characteristic_loss(5, 0.05, 0.1).unwrap();
    assert!((arm["loss"].as_f64().unwrap() - loss).abs() < 1e-8);
    assert!(text.contains("Characteristic value of 5 specimens"), "{text}");
    assert_eq!(json["asked"]["known_cov"], 0.1);
}

#[test]
fn what_cannot_be_planned_is_said() {
    let folder = Folder::with_study(&towers());
    let said = |arguments: &[&str], code: i32, what: &str| {
        let output = folder.pirca(&[&["plan-tests", "studies/tiny"], arguments].concat());
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(what), "{arguments:?}: {}", stderr(&output));
    };
    said(&["--specimens", "1"], 2, "one specimen alone shows no scatter");
    said(&["--specimens", "3", "--cov", "0"], 2, "allowed is a number above 0, up to 1");
    said(&["--specimens", "3", "--power", "1.2"], 2, "allowed is a number from 0.5, below 1");
    said(&["--specimens", "3", "--point", "4"], 2, "allowed is 0 to 0");
    said(&[], 2, "--specimens");
    let fixed = &STUDY[..STUDY.find("[[arm]]\nname = \"random\"").unwrap()];
    folder.write_study(fixed);
    said(&["--specimens", "3"], 3, "simulated walls show no scatter; state that of real ones with --cov");
    assert!(!folder.path("runs").exists());
}
