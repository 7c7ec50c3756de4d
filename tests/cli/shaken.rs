//! `analyse --load base-motion`: what counts as fallen, several records and scales, the ground's lean, restitution, files.

use std::fmt::Write;
use std::fs;

use serde_json::Value;

use crate::walls::Folder;

/// A box of a size with its foot about a place, as a block of a wall.json.
fn boxed(id: usize, size: [f64; 3], at: [f64; 3], more: &str) -> String {
    let mut corners = Vec::new();
    for z in [at[2], at[2] + size[2]] {
        for (x, y) in [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)] {
            corners.push(format!("[{},{},{z}]", at[0] + x * size[0], at[1] + y * size[1]));
        }
    }
    format!(
        r#"{{"id":{id},"vertices":[{}],"faces":[[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]],{more}}}"#,
        corners.join(",")
    )
}

/// A folder with a wall of boxes on a ground of 30 m x 30 m, and half a sine of 6 m/s^2 in half a second as `pulse.csv`.
fn folder(boxes: &[([f64; 3], [f64; 3])]) -> Folder {
    let folder = Folder::new();
    let mut blocks = vec![boxed(0, [30.0, 30.0, 0.5], [0.0, 0.0, -0.5], r#""fixed":true"#)];
    blocks.extend(boxes.iter().zip(1..).map(|((size, at), id)| boxed(id, *size, *at, r#""density":2400"#)));
    let mut pulse = String::from("t_s,a_m_per_s2\n");
    for k in 0..=1000 {
        let time = f64::from(k) * 1e-3;
        let value = if k <= 500 { 6.0 * pirca::math::sin(std::f64::consts::TAU * time) } else { 0.0 };
        writeln!(pulse, "{time:.3},{value:.9}").expect("a string takes all");
    }
    let wall = format!(r#"{{"unit":"m","blocks":[{}]}}"#, blocks.join(","));
    for (file, text) in [("wall.json", &wall), ("pulse.csv", &pulse), ("again.csv", &pulse)] {
        fs::write(folder.path(file), text).expect("it can be written");
    }
    folder
}

const SHAKEN: [&str; 9] =
    ["analyse", "wall.json", "--phi-deg", "40", "--solver", "nonsmooth", "--load", "base-motion", "--once"];

fn answer(folder: &Folder, asked: &[&str]) -> Value {
    let output = folder.pirca(&[asked, &["--json"]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{asked:?}: {said}");
    serde_json::from_slice(&output.stdout).expect("one JSON object on standard output")
}

fn shaken(folder: &Folder, more: &[&str]) -> Value {
    answer(folder, &[&SHAKEN[..], more].concat())
}

#[test]
fn a_slab_that_lies_flat_has_fallen_whichever_way_it_faces() {
    for (size, direction) in [([0.2, 1.0, 1.0], "x+"), ([1.0, 0.2, 1.0], "y+")] {
        let folder = folder(&[(size, [0.0; 3])]);
        let asked = ["--record", "pulse.csv", "--direction", direction];
        let fell = shaken(&folder, &asked);
        assert_eq!((&fell["outcome"], &fell["twin_outcome"]), (&"collapsed".into(), &Value::Null), "{fell}");
        assert_eq!(fell["residual_rad"], Value::Null, "{fell}");
        let text = folder.pirca(&[&SHAKEN[..], &asked].concat());
        let text = String::from_utf8_lossy(&text.stdout);
        assert!(text.starts_with("The wall falls: half of its weight has fallen after"), "{text}");
    }
}

#[test]
fn columns_that_stand_apart_fall_at_their_own_tilt() {
    // atan(1 / 3) = 18.435 deg, in steps as by limit analysis.
    let column = |x: f64, y: f64| ([0.2, 0.2, 0.6], [x, y, 0.0]);
    let folder = folder(&[column(-5.0, -5.0), column(5.0, -4.0), column(-4.0, 5.0), column(5.0, 5.0)]);
    let asked = ["analyse", "wall.json", "--phi-deg", "40", "--direction", "x+", "--solver", "nonsmooth"];
    let found = answer(&folder, &asked);
    let angle = found["collapse_angle_deg"].as_f64().unwrap_or_else(|| panic!("{found}"));
    assert!((angle - 18.435).abs() < 0.02, "{angle}");
}

#[test]
fn records_and_scales_make_a_table_and_each_run_has_its_files() {
    let folder = folder(&[([0.2, 1.0, 1.0], [0.0; 3])]);
    let asked = ["--record", "pulse.csv", "--record", "again.csv", "--scale", "0.1,1", "--direction", "x+"];
    let found = shaken(&folder, &[&asked[..], &["--out", "seen"]].concat());
    assert_eq!(found["outcomes"]["collapsed"], 2, "{found}");
    assert_eq!(found["outcomes"]["stands"], 2, "{found}");
    let scales: Vec<f64> = found["runs"]
        .as_array()
        .expect("runs")
        .iter()
        .map(|run| run["record"]["scale"].as_f64().expect("a scale"))
        .collect();
    assert_eq!(scales, [0.1, 1.0, 0.1, 1.0]);
    let table = fs::read_to_string(folder.path("seen/runs.csv")).expect("a table");
    assert_eq!(table.lines().count(), 5, "{table}");
    assert!(
        table.lines().nth(2).is_some_and(|line| line.contains(",1,") && line.contains("collapsed")),
        "{table}"
    );
    for file in [
        "report.html",
        "end.svg",
        "blocks.csv",
        "analysis.json",
        "wall.pvd",
        "wall.glb",
        "end.obj",
        "rest.obj",
    ] {
        assert!(folder.path(&format!("seen/run-002/{file}")).is_file(), "{file}");
    }
    // The replay ends with the slab on its side: its turn is a quarter, or the last state is on its way there.
    let blocks = fs::read_to_string(folder.path("seen/run-002/blocks.csv")).expect("blocks");
    let turn: f64 = blocks
        .lines()
        .nth(2)
        .and_then(|line| line.split(',').nth(8))
        .and_then(|x| x.parse().ok())
        .expect("a turn");
    assert!(turn.abs() > 0.4, "{blocks}");
    let text = folder.pirca(&[&SHAKEN[..], &asked].concat());
    let text = String::from_utf8_lossy(&text.stdout);
    assert!(text.starts_with("Of 4 runs: 2 fallen, 2 standing.\n") && text.contains("PGA m/s2"), "{text}");
}

#[test]
fn a_lean_and_a_restitution_change_what_the_ground_does() {
    let folder = folder(&[([0.4, 0.4, 1.2], [0.0; 3])]);
    let under = |more: &[&str]| {
        let asked = ["--record", "pulse.csv", "--direction", "x+", "--scale", "0.75", "--phi-deg", "60"];
        let own: Vec<&str> =
            SHAKEN.iter().copied().filter(|word| !["--phi-deg", "40"].contains(word)).collect();
        answer(&folder, &[&own[..], &asked, more].concat())
    };
    let level = under(&[]);
    assert_eq!((&level["outcome"], &level["lean_deg"]), (&"stands".into(), &0.0.into()), "{level}");
    // The stone first turns against the motion of the ground: towards x-, where a lean helps it over.
    let leant = under(&["--lean-deg", "5", "--lean-direction", "x-"]);
    assert_eq!(
        (&leant["outcome"], &leant["lean_direction_deg"]),
        (&"collapsed".into(), &180.0.into()),
        "{leant}"
    );
    let steep = under(&["--lean-deg", "19"]);
    assert_eq!(steep["outcome"], "unstable_at_rest", "{steep}");
    let springy = under(&["--restitution", "0.5"]);
    assert_eq!(springy["restitution"], 0.5, "{springy}");
    let turned =
        |own: &Value| own["residual_rad"].as_f64().unwrap_or(1.0) + own["time_s"].as_f64().expect("a time");
    assert!((turned(&springy) - turned(&level)).abs() > 1e-9, "{springy} {level}");
}

#[test]
fn one_run_has_its_page_and_its_files() {
    let folder = folder(&[([0.2, 1.0, 1.0], [0.0; 3])]);
    let asked = ["--record", "pulse.csv", "--scale", "0.3", "--direction", "x+"];
    let found = shaken(&folder, &[&asked[..], &["--out", "seen"]].concat());
    assert_eq!(found["outcome"], "stands", "{found}");
    let page = fs::read_to_string(folder.path("seen/report.html")).expect("a page");
    assert!(page.contains("Does the wall stand") && page.contains("no block falls"), "no question");
    let written = fs::read_to_string(folder.path("seen/analysis.json")).expect("an object");
    let written: Value = serde_json::from_str(&written).expect("JSON");
    assert_eq!(written["block_states"].as_array().map(Vec::len), Some(2));
    let output = folder.pirca(&[&SHAKEN[..], &asked, &["--report"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(folder.path("wall-report.html").is_file());
}
