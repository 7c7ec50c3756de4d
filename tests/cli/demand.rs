//! `--demand` and `--assert`: whether walls bear what is demanded, how surely, and what the exit code says.

use std::fs;

use serde_json::Value;

use crate::fixture::stderr;
use crate::walls::Folder;

/// One stone, 0.2 m deep and 0.4 m high: it overturns at half its weight, which is a tilt of 26.565 deg.
const STONE: &str = "x,z,length,height\n0,0,0.4,0.4\n";

/// What is printed, and the exit code, of the stone under a demand.
fn asked(more: &[&str]) -> (String, Option<i32>) {
    let folder = Folder::new();
    fs::write(folder.path("wall.csv"), STONE).expect("written");
    let wall = ["analyse", "wall.csv", "--unit", "m", "--thickness", "20cm"];
    let output = folder.pirca(&[&wall[..], more].concat());
    (String::from_utf8_lossy(&output.stdout).into_owned() + &stderr(&output), output.status.code())
}

fn answered(more: &[&str]) -> Value {
    let (said, _) = asked(&[more, &["--json"]].concat());
    serde_json::from_str(&said).unwrap_or_else(|_| panic!("no object: {said}"))
}

#[test]
fn a_wall_stands_or_fails_against_a_demand_in_any_unit() {
    let stands = ["--phi-deg", "40", "--assert", "--demand"];
    for demand in ["0.4g", "0.4", "40 %", "21.8deg", "3.9m/s2"] {
        for load in ["tilt", "lateral"] {
            let (said, code) = asked(&[&stands[..], &[demand, "--load", load]].concat());
            assert!(
                code == Some(0) && said.contains("The wall stands: it bears"),
                "{demand}, {load}: {said}"
            );
        }
    }
    for demand in ["0.51g", "27deg"] {
        let (said, code) = asked(&[&stands[..], &[demand]].concat());
        assert!(
            code == Some(4) && said.contains("The wall fails: it bears 26.57 against"),
            "{demand}: {said}"
        );
    }
    // Without the question of a program the answer is no failure.
    assert_eq!(asked(&["--phi-deg", "40", "--demand", "0.6g"]).1, Some(0));
    let demand = &answered(&["--phi-deg", "40", "--load", "lateral", "--demand", "0.25g"])["demand"];
    assert_eq!((demand["met"].as_str(), demand["level"].as_f64()), (Some("bears"), Some(0.25)));
    assert!((demand["ratio"].as_f64().expect("a ratio") - 2.0).abs() < 1e-6, "{demand}");
}

#[test]
fn a_demand_of_something_else_is_refused_with_what_is_allowed() {
    for (more, wanted) in [
        (&["--demand", "4mm"][..], "allowed is a tilt (8.5deg) or a share of the weight (0.15g)"),
        (
            &["--demand", "4mm", "--load", "lateral"],
            "allowed is a share of the weight (0.15g) or a tilt (8.5deg)",
        ),
        (&["--demand", "0.15kg"], "allowed is a number above 0 with its unit"),
        (&["--assert"], "--demand"),
        (&["--demand", "0.1g", "--assert=2"], "0.05 is 5 %"),
    ] {
        let (said, code) = asked(&[&["--phi-deg", "40"], more].concat());
        assert!(code == Some(2) && said.contains(wanted), "{more:?}: {said}");
    }
}

/// It slides at the tangent of its friction angle, which is even between 20 and 24 deg.
#[test]
fn over_ranges_the_share_that_fails_has_its_interval() {
    let ranges = ["--phi-deg", "20..24", "--walls", "64", "--demand"];
    let share = |demand: &str| {
        let over = answered(&[&ranges[..], &[demand]].concat())["demand"]["over_ranges"].clone();
        let number = |value: &Value| value.as_f64().expect("a number");
        [number(&over["share"]), number(&over["share_ci"][0]), number(&over["share_ci"][1])]
    };
    let [quarter, low, high] = share("21deg");
    assert!((quarter - 0.25).abs() < 0.02 && low < 0.2 && high > 0.32, "{quarter} [{low}, {high}]");
    let (said, code) = asked(&[&ranges[..], &["21deg", "--assert"]].concat());
    assert!(code == Some(4) && said.contains("The wall stands at the middle of the ranges"), "{said}");
    assert!(said.contains("over the ranges it fails in 25 [15, 37] % of 64 walls"), "{said}");
    assert_eq!(asked(&[&ranges[..], &["21deg", "--assert=0.5"]].concat()).1, Some(0));
    assert_eq!(asked(&[&ranges[..], &["19deg", "--assert"]].concat()).1, Some(0), "64 walls show 5 %");
    let few = ["--phi-deg", "20..24", "--walls", "32", "--demand", "19deg", "--assert"];
    assert_eq!(asked(&few).1, Some(4), "32 walls do not");
}

/// Walls of one stone whose friction is even between 20 and 24 deg.
const STUDY: &str = r#"[study]
question = "Do such walls stand?"
seed = 3
[joint]
kn_pa_per_m = [1e9]
kn_over_ks = 2
phi_deg = 35
cohesion_pa = 0
sub_contacts = [4, 4]
[uncertain]
"joint.phi_deg" = { family = "uniform", low = 20, high = 24 }
[load]
protocol = "tilting"
towards = "y+"
capacity = "first_stone"
[restraint]
base = "fixed"
ends = "free"
[solver]
name = "limit"
flow = "non-associative"
[[arm]]
name = "stone"
members = 40
arrangement = "file"
file = "wall.csv"
unit = "m"
unstated_density_kg_per_m3 = 2400
thickness_m = 0.2
"#;

#[test]
fn a_study_says_how_many_of_its_walls_fail() {
    let folder = Folder::new();
    fs::create_dir(folder.path("stones")).expect("a folder");
    fs::write(folder.path("stones/study.toml"), STUDY).expect("written");
    fs::write(folder.path("stones/wall.csv"), STONE).expect("written");
    let asked = |more: &[&str]| {
        let output = folder.pirca(more);
        (String::from_utf8_lossy(&output.stdout).into_owned() + &stderr(&output), output.status.code())
    };
    let (said, code) = asked(&["run", "stones", "--demand", "21deg", "--report", "--assert"]);
    assert_eq!(code, Some(4), "{said}");
    assert!(said.starts_with("Against 21deg: ") && said.contains("Against the demand 21deg"), "{said}");
    let summary = fs::read_to_string(folder.path("runs/stones/summary.json")).expect("a summary");
    let summary: Value = serde_json::from_str(&summary).expect("JSON");
    let arm = &summary["demand"]["arms"][0];
    let angles = summary["arms"][0]["quantiles"][0]["value"].as_f64().expect("a quantile");
    assert!(angles > 19.9 && arm["walls"] == 40 && arm["unknown"] == 0, "{arm}");
    let share = arm["share"].as_f64().expect("a share");
    assert!(share > 0.05 && share < 0.5 && arm["share_ci"][1].as_f64() > Some(share), "{arm}");
    let page = fs::read_to_string(folder.path("runs/stones/report.html")).expect("a page");
    assert!(page.contains("Against the demand 21deg"), "the page has the table");
    // The same probability as of the level.
    let capacity = |more: &[&str]| {
        let output = folder.pirca(&[&["capacity", "stones", "--json"], more].concat());
        let answer: Value = serde_json::from_slice(&output.stdout).expect("one object");
        answer["groups"].clone()
    };
    assert_eq!(capacity(&["--demand", "21deg"]), capacity(&["--below-deg", "21"]));
    assert_eq!(asked(&["capacity", "stones", "--demand", "21deg", "--assert"]).1, Some(4));
    assert_eq!(asked(&["capacity", "stones", "--demand", "19deg", "--assert=0.1"]).1, Some(0));
    let (said, code) = asked(&["run", "stones", "--demand", "12kN"]);
    assert!(code == Some(2) && said.contains("allowed is a tilt (8.5deg)"), "{said}");
}
