//! `pirca analyse` over ranges of friction, stiffness and density, against closed forms.

use std::fs;
use std::process::Command;

use pirca::exchange::write_wall_json;
use pirca::math::{Vec3, atan, degrees, radians, tan};
use pirca::model::{Block, Support, Wall};
use pirca::shape::Polyhedron;
use serde_json::Value;

use crate::walls::Folder;

/// Depth and height of the block (m): it overturns at the angle of their quotient, and slides at that of friction.
const DEPTH: f64 = 0.2;
const HEIGHT: f64 = 0.4;
/// Accuracy of the limit analysis (deg).
const EXACT: f64 = 1e-4;

fn overturns() -> f64 {
    degrees(atan(DEPTH / HEIGHT))
}

/// A block of that depth along y on a wide fixed one.
fn block() -> Wall {
    let own = |support, low: [f64; 3], high: [f64; 3]| {
        let shape = Polyhedron::cuboid(Vec3::from(low), Vec3::from(high));
        Block { support, ..Block::stone(shape, 2400.0) }
    };
    Wall {
        blocks: vec![
            own(Support::Fixed, [-1.0, -1.0, -0.2], [1.0, 1.0, 0.0]),
            own(Support::Free, [-0.2, -DEPTH / 2.0, 0.0], [0.2, DEPTH / 2.0, HEIGHT]),
        ],
    }
}

/// A folder with the block as wall.json.
fn folder() -> Folder {
    let folder = Folder::new();
    fs::write(folder.path("wall.json"), write_wall_json(&block())).unwrap();
    folder
}

/// Standard output, all that is printed, and the exit code.
fn said(folder: &Folder, more: &[&str]) -> (String, String, Option<i32>) {
    let output = folder.pirca(&[&["analyse", "wall.json"], more].concat());
    let [out, err] =
        [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    (out.clone(), out + &err, output.status.code())
}

fn analysed(more: &[&str]) -> Value {
    let (out, all, code) = said(&folder(), &[more, &["--json"]].concat());
    assert_eq!(code, Some(0), "{more:?}: {all}");
    serde_json::from_str(&out).expect("one JSON object on standard output")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("no number: {value}"))
}

fn close(found: &Value, expected: f64, tolerance: f64) {
    let found = number(found);
    assert!((found - expected).abs() <= tolerance, "{found} instead of {expected}");
}

/// Above the angle at which it overturns, friction does not matter, and the mechanism says why.
#[test]
fn friction_does_not_matter_to_a_block_that_overturns() {
    let answer = analysed(&["--phi-deg", "30..38"]);
    let uncertain = &answer["uncertain"];
    close(&answer["collapse_angle_deg"], overturns(), EXACT);
    for end in ["min", "max", "middle"] {
        close(&uncertain["answer"][end], overturns(), EXACT);
    }
    let influence = &uncertain["influence"][0];
    assert_eq!(influence["matters"], false);
    assert_eq!(influence["why"], "the wall overturns as one body");
    let (out, ..) = said(&folder(), &["--phi-deg", "30..38"]);
    assert!(
        out.contains("friction does not matter from 30 to 38 deg: the wall overturns as one body"),
        "{out}"
    );
}

/// Where a range of friction straddles that angle, the block slides at the angle of friction or overturns: the answer is the smaller of
/// the two. Of angles spread evenly from 20 to 32 deg a share of (26.565 - 20) / 12 slides.
#[test]
fn the_answers_over_friction_are_distributed_as_the_smaller_of_two_angles() {
    let folder = folder();
    let more = ["--phi-deg", "20..32", "--walls", "128", "--json", "--out", "seen"];
    let (out, all, code) = said(&folder, &more);
    assert_eq!(code, Some(0), "{all}");
    let answer: Value = serde_json::from_str(&out).unwrap();
    let of = &answer["uncertain"]["answer"];
    // Of 128 points each 128th of the range holds about one.
    let cell = 12.0 / 128.0;
    close(&of["min"], 20.0, 2.0 * cell);
    close(&of["max"], overturns(), EXACT);
    close(&of["interval"][0], 20.0 + 0.05 * 12.0, 3.0 * cell);
    close(&of["interval"][1], overturns(), EXACT);
    assert_eq!((&of["walls"], &of["stood"], &of["level"]), (&128.into(), &0.into(), &0.9.into()));
    let influence = &answer["uncertain"]["influence"][0];
    close(&influence["change"], overturns() - 20.0, EXACT);
    assert_eq!((&influence["matters"], &influence["why"]), (&true.into(), &Value::Null));

    let table = fs::read_to_string(folder.path("seen/uncertainty.csv")).unwrap();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("wall,phi_deg,outcome,collapse_angle_deg"));
    let mut slid = 0.0;
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let [phi, angle]: [f64; 2] = [cells[1], cells[3]].map(|cell| cell.parse().unwrap());
        assert!((angle - phi.min(overturns())).abs() < EXACT, "{line}");
        slid += if angle < overturns() - EXACT { 1.0 / 128.0 } else { 0.0 };
    }
    assert!((slid - (overturns() - 20.0) / 12.0).abs() < 0.02, "{slid}");
    let picture = fs::read_to_string(folder.path("seen/uncertainty.svg")).unwrap();
    assert_eq!(picture.matches("<circle").count(), 128);
    assert!(folder.path("seen/uncertainty.png").is_file());
}

#[test]
fn density_never_matters_to_rigid_blocks_and_the_others_are_told_at_its_middle() {
    let answer = analysed(&["--phi-deg", "20..24", "--density", "normal(2200, 80)", "--load", "lateral"]);
    let influence = &answer["uncertain"]["influence"];
    let (phi, density) = (&influence[0], &influence[1]);
    assert_eq!((&phi["parameter"], &phi["matters"]), (&"phi_deg".into(), &true.into()));
    let multiplier = |deg: f64| tan(radians(deg));
    close(&phi["answers"][0], multiplier(20.0), 1e-5);
    close(&phi["answers"][2], multiplier(24.0), 1e-5);
    assert_eq!((&density["parameter"], &density["matters"]), (&"density_kg_per_m3".into(), &false.into()));
    assert!(density["why"].as_str().unwrap().contains("forces grow with the weight"));
    close(&answer["uncertain"]["parameters"]["density_kg_per_m3"]["middle"], 2200.0, 1e-6);
}

/// On joints of stiffness kn the block leans before it overturns, less where they are stiffer, and a heavier block leans more: what
/// counts is the quotient.
#[test]
fn stiffness_and_density_of_elastic_joints_act_by_their_quotient() {
    let asked = ["--phi-deg", "60", "--solver", "implicit", "--walls", "32"];
    let alone = |more: &[&str]| analysed(&[&asked[..], more].concat())["uncertain"].clone();
    let stiff = alone(&["--kn", "1e7..4e7"]);
    let dense = alone(&["--kn", "2e7", "--density", "1200..4800"]);
    close(&stiff["parameters"]["kn_pa_per_m"]["middle"], 2e7, 1.0);
    let [by_kn, by_density] = [&stiff, &dense].map(|of| of["influence"][0]["answers"].clone());
    // kn 1e7 at 2400 kg/m^3 is as 2e7 at 4800, within the bracket of 0.01 deg and the solver's tolerance.
    close(&by_kn[0], number(&by_density[2]), 0.02);
    close(&by_kn[2], number(&by_density[0]), 0.02);
    assert!(number(&by_kn[2]) - number(&by_kn[0]) > 0.5, "{by_kn}");
    assert!(number(&by_kn[2]) < overturns());
    assert_eq!(stiff["influence"][0]["matters"], true);
}

#[test]
fn the_answer_is_the_same_on_any_number_of_threads() {
    let folder = folder();
    let on = |threads: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_pirca"))
            .args([
                "analyse",
                "wall.json",
                "--phi-deg",
                "lognormal(26, 4)",
                "--density",
                "2000..2400",
                "--json",
            ])
            .env("RAYON_NUM_THREADS", threads)
            .current_dir(folder.path(""))
            .output()
            .unwrap();
        let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
        answer["uncertain"].to_string()
    };
    let one = on("1");
    assert!(one.contains("interval"));
    assert_eq!(one, on("2"));
}

/// A wall that does not fall is counted, and hides the upper end of the interval.
#[test]
fn walls_that_stand_are_counted() {
    let answer = analysed(&["--phi-deg", "20..30", "--load", "lateral", "--vertical", "-2"]);
    let of = &answer["uncertain"]["answer"];
    assert!(number(&of["stood"]) > 0.0, "{of}");
    assert_eq!((&of["max"], &of["interval"][1]), (&Value::Null, &Value::Null));
    let outcomes = of["outcomes"].as_object().unwrap();
    assert_eq!(outcomes.values().map(number).sum::<f64>(), 64.0);
    assert_eq!(of["failed"], serde_json::json!({}));
}

#[test]
fn a_range_that_is_none_or_in_vain_is_refused() {
    for (more, said_is) in [
        (&["--phi-deg", "38..30"][..], "high = 30: must be above low"),
        (&["--phi-deg", "30..95"], "its values run from 30 to 95; allowed is a number from 0 to 89 degrees"),
        (&["--phi-deg", "gauss(30,2)"], "no distribution \"gauss\""),
        (&["--phi-deg", "30", "--walls", "64"], "--walls and --seed are for a design over ranges"),
        (&["--phi-deg", "30..38", "--walls", "50"], "a multiple of 16 from 32"),
        (&["--phi-deg", "30", "--kn", "1e8..1e9"], "ask --solver implicit, or leave --kn out"),
        (&["--phi-deg", "30", "--density", "5..2400"], "10 to 23000 kg/m^3"),
    ] {
        let (_, all, code) = said(&folder(), more);
        assert_eq!(code, Some(2), "{more:?}: {all}");
        assert!(all.contains(said_is), "{more:?}: {all}");
    }
}

/// The multiplier stands beside the angle. No code is cited: its checks need more than a multiplier.
#[test]
fn a_tilt_has_its_multiplier_beside_it() {
    let tilt = analysed(&["--phi-deg", "35"]);
    close(&tilt["collapse_multiplier"], DEPTH / HEIGHT, 1e-5);
    let lateral = analysed(&["--phi-deg", "35", "--load", "lateral"]);
    close(&lateral["collapse_multiplier"], DEPTH / HEIGHT, 1e-5);
    let elastic = analysed(&["--phi-deg", "35", "--solver", "implicit", "--kn", "1e9"]);
    close(&elastic["collapse_multiplier"], tan(radians(number(&elastic["collapse_angle_deg"]))), 1e-9);
    let (_, printed, _) = said(&folder(), &["--phi-deg", "35"]);
    assert!(!printed.contains("Circolare") && !printed.contains("FC"), "{printed}");
}
