//! Answers of rigid blocks that need thrust which no weight brings about: an interval with its reason, in every verb.

use std::fs;

use serde_json::Value;

use crate::commands::stdout;
use crate::fixture::{Folder, stderr};
use crate::walls::example;

/// Walls of one stone in each course between two fixed blocks, which need not press on them.
const BETWEEN_ENDS: &str = r#"
[study]
question = "What do stones bear that stand between two blocks?"
seed = 3

[wall]
height_m = 0.6
length_m = 0.5
base_thickness_m = 0.2
top_thickness_m = 0.2
battered_face = "both"

[block]
density_kg_per_m3 = 2000

[joint]
kn_pa_per_m = [1e9]
kn_over_ks = 2
phi_deg = 25
cohesion_pa = 0

[load]
protocol = "tilting"
towards = "y+"
step_deg = 1
end_deg = 40
bracket_deg = 0.05

[restraint]
base = "fixed"
ends = "fixed_end_blocks"

[solver]
name = "limit"

[[arm]]
name = "held"
members = 6
arrangement = "coursed"
length_m = 0.5
height_m = { family = "uniform", low = 0.15, high = 0.25 }
dip_deg = 0
"#;

fn answered(folder: &Folder, arguments: &[&str]) -> (Value, String) {
    let text = folder.pirca(arguments);
    assert_eq!(text.status.code(), Some(0), "{}", stderr(&text));
    let json = folder.pirca(&[arguments, &["--json"]].concat());
    assert_eq!(json.status.code(), Some(0), "{}", stderr(&json));
    let text = stdout(&text).split_whitespace().collect::<Vec<_>>().join(" ");
    (serde_json::from_slice(&json.stdout).expect("one object"), text)
}

fn pyramid(more: &[&str]) -> (Value, String) {
    let wall = example("pyramid.json").display().to_string();
    let asked = ["analyse", &wall, "--phi-deg", "40", "--direction", "y+"];
    answered(&Folder::with_study(BETWEEN_ENDS), &[&asked, more].concat())
}

/// The part that goes overturns at 14.823 deg by itself; the wall is bounded at 30.727 deg.
#[test]
fn a_pyramid_is_answered_by_an_interval_with_its_reason() {
    // Statics bears 20 deg without friction at the sides, so that contact dynamics does not need the thrust, but the choice of forces.
    let choice = "one of many distributions of joint forces";
    for (more, upper, needs) in [
        (&["--solver", "limit"][..], [30.72, 30.74], "kN in upright joints"),
        (&["--flow", "non-associative"], [29.4, 29.6], "N in upright joints"),
        (&["--solver", "nonsmooth"], [15.6, 30.7], choice),
    ] {
        let (json, text) = pyramid(more);
        let open = &json["undecided"];
        let of = |key: &str| open[key].as_f64().unwrap_or_else(|| panic!("{key}: {json}"));
        assert!(14.4 < of("lower") && of("lower") < 14.823, "{json}");
        assert!(upper[0] < of("upper") && of("upper") < upper[1], "{json}");
        assert_eq!(json["collapse_angle_deg"], open["upper"], "the upper end stays what it was");
        assert_eq!(of("thrust_at_rest_n") < of("thrust_needed_n"), needs != choice, "{json}");
        assert!(text.starts_with("The wall collapses at a tilt between 14."), "{text}");
        assert!(text.contains("rigid blocks leave open which") && text.contains(needs), "{text}");
    }
    let (json, text) = pyramid(&["--solver", "implicit", "--kn", "1e12"]);
    assert_eq!(json["undecided"], Value::Null);
    assert!(text.starts_with("The wall collapses at a tilt of 14.68"), "{text}");
}

#[test]
fn the_page_of_a_pyramid_says_so_as_well() {
    let folder = Folder::with_study(BETWEEN_ENDS);
    let wall = example("pyramid.json").display().to_string();
    let output = folder.pirca(&["analyse", &wall, "--phi-deg", "40", "--direction", "y+", "--out", "out"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = fs::read_to_string(folder.path("out/report.html")).expect("a page");
    assert!(page.contains("collapses at a tilt between 14.") && page.contains("rigid blocks leave open"));
}

#[test]
fn a_clamped_bar_stands_or_does_not() {
    let wall = example("clamped-bar.json").display().to_string();
    let folder = Folder::with_study(BETWEEN_ENDS);
    let (json, text) = answered(&folder, &["analyse", &wall, "--phi-deg", "40.03"]);
    assert_eq!((&json["outcome"], &json["mechanism"]), (&"stable".into(), &serde_json::json!([])));
    let open = &json["undecided"];
    assert_eq!((&open["lower"], &open["upper"]), (&0.0.into(), &Value::Null), "{json}");
    assert!(text.contains("do not bear the weight"), "{text}");
}

/// Statics has the ends hold every wall at any tilt; by their weight they slide at 25 deg.
#[test]
fn run_and_capacity_say_which_walls_rigid_blocks_leave_open() {
    let folder = Folder::with_study(BETWEEN_ENDS);
    let (json, text) = answered(&folder, &["run", "studies/tiny", "--out", "out", "--csv"]);
    let arm = &json["arms"][0];
    assert_eq!((&arm["left_open"]["walls"], &arm["stood_to_the_end"]), (&6.into(), &6.into()), "{arm}");
    let lowest = arm["left_open"]["lowest"].as_f64().expect("a tilt");
    assert!(10.0 < lowest && lowest < 25.0, "{lowest}");
    assert!(text.contains("rigid blocks leave") && text.contains("6 of 6 walls open"), "{text}");
    let table = fs::read_to_string(folder.path("out/members.csv")).expect("a table");
    assert!(table.lines().next().is_some_and(|head| head.contains("stiff_angle_deg")), "{table}");

    let (json, text) = answered(&folder, &["capacity", "studies/tiny", "--out", "out", "--below-deg", "30"]);
    let group = &json["groups"][0];
    assert_eq!((&group["probability"], &group["left_open"]["probability"]), (&0.0.into(), &1.0.into()));
    assert!(text.contains("with what stiff joints bear it is 1.00"), "{text}");
}
