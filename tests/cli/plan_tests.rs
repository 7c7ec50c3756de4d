//! `pirca plan-tests`: how many real specimens tell what, by which reading.

use pirca::stats::{
    Aim, characteristic_loss, correlation, mean, pairs_to_see, power_of_groups, sigma, smallest_seen,
    specimens_for_characteristic, specimens_to_see,
};
use serde_json::Value;

use crate::commands::stdout;
use crate::compare::{angles, towers};
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
    // By the walls that were recorded: the error of 0.25 deg is part of the scatter, and no wall shares it with another.
    let walls = angles(&folder, "out");
    let [tower, thin] = ["tower", "slim"]
        .map(|arm| (0..12).map(|member| walls[&(arm.to_owned(), member)]).collect::<Vec<f64>>());
    let difference = mean(&tower).unwrap() - mean(&thin).unwrap();
    let [one, other] = [&tower, &thin].map(|walls| sigma(walls).unwrap());
    let scatter = (0.5 * (one * one + other * other) + 0.25 * 0.25).sqrt();
    let shared = correlation(&tower, &thin).unwrap() * (1.0 - 0.25 * 0.25 / (scatter * scatter));
    let aim = Aim { confidence: 0.95, power: 0.8 };
    let effect = difference / scatter;
    for (key, expected) in [
        ("difference", difference),
        ("sigma", scatter),
        ("correlation", shared),
        ("pairs", pairs_to_see(scatter, shared, difference, aim)),
        ("power", power_of_groups(effect, 3, 0.95)),
        ("smallest_seen", scatter * smallest_seen(3, aim).unwrap()),
    ] {
        let found = slim[key].as_f64().unwrap();
        assert!((found / expected - 1.0).abs() < 1e-9, "{key}: {found} for {expected}");
    }
    let needed = specimens_to_see(effect, aim).unwrap() as u64;
    assert_eq!(slim["specimens"].as_u64(), Some(needed));
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
    let worse = (scatter * scatter + 2.0 * 2.0 - 0.25 * 0.25).sqrt();
    let more = specimens_to_see(difference / worse, aim).unwrap() as u64;
    assert!(more > needed, "{more}");
    assert_eq!(own["specimens"].as_u64(), Some(more));
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
    let enough = specimens_for_characteristic(0.05, 0.1, 0.05).unwrap() as u64;
    assert_eq!(arm["specimens"].as_u64(), Some(enough));
    assert!(text.contains("Characteristic value of 5 specimens"), "{text}");
    assert_eq!(json["asked"]["known_cov"], 0.1);
}

#[test]
fn a_stated_scatter_that_walls_or_specimens_exceed_is_doubted_and_the_plan_by_theirs_follows() {
    let folder = Folder::with_study(&towers());
    let plan = ["--specimens", "5", "--members", "12", "--out", "out", "--cov"];
    let (json, text) = asked(&folder, &[&plan[..], &["0.001"]].concat());
    let otherwise = json["otherwise"].as_array().unwrap();
    assert_eq!((otherwise.len(), &otherwise[0]["by"]), (1, &"simulated walls".into()), "{text}");
    assert_eq!(json["arms"][0]["stated_cov"]["doubted"], "larger");
    let (own, _) = asked(&folder, &plan[..plan.len() - 1]);
    assert_eq!(otherwise[0]["plan"], own);
    assert!(text.contains("With the COV of the simulated walls:"), "{text}");
    let warned = folder.pirca(&[&["plan-tests", "studies/tiny"], &plan[..], &["0.001"]].concat());
    assert!(
        stderr(&warned).contains("warning: --cov: tower: The stated COV of 0.10 % is in doubt"),
        "{}",
        stderr(&warned)
    );
    // Specimens that were measured speak as well.
    let head = "specimen,family,tilt_deg,quantity,value,unit,error,kind\n";
    let rows = [9.0, 12.0, 18.0, 24.0, 30.0]
        .map(|angle| format!("{angle},tower,,collapse_angle,{angle},deg,0.25,exact\n"));
    std::fs::write(folder.path("studies/tiny/measured.csv"), head.to_owned() + &rows.concat()).unwrap();
    let (json, text) = asked(&folder, &["--specimens", "5", "--members", "12", "--cov", "0.2"]);
    let otherwise = json["otherwise"].as_array().unwrap();
    assert_eq!((otherwise.len(), &otherwise[0]["by"]), (1, &"specimens".into()), "{text}");
    let found = json["arms"][0]["stated_cov_of_specimens"]["found"].as_f64().unwrap();
    assert!((found - 0.4619).abs() < 1e-4, "{found}");
    assert_eq!(otherwise[0]["plan"]["asked"]["known_cov"].as_f64(), Some(found));
    // What walls scatter less than is no contradiction: real ones scatter more.
    let (json, _) = asked(&folder, &["--specimens", "5", "--members", "12", "--cov", "0.9"]);
    assert!(json.get("otherwise").is_none(), "{json}");
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
