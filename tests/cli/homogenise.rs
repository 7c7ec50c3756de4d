//! `pirca homogenise`: masonry of a study's kinds as a plate.

use std::fs;

use serde_json::Value;

use crate::commands::stdout;
use crate::fixture::{Folder, stderr};

/// A running bond, and random courses of the same stones.
pub const STUDY: &str = r#"
[study]
question = "What is it as a plate?"
seed = 3

[wall]
height_m = 1.0
length_m = 2.0
base_thickness_m = 0.3
top_thickness_m = 0.3
battered_face = "both"
wythes = 1
header_share = 0
head_joint_gap_m = 0

[block]
density_kg_per_m3 = 2400

[joint]
kn_pa_per_m = [1e9]
kn_over_ks = 2.0
phi_deg = 32
cohesion_pa = 0
tension_pa = 0

[load]
protocol = "tilting"
towards = "y+"
step_deg = 1
end_deg = 60
bracket_deg = 0.05

[restraint]
base = "fixed"
ends = "free"

[solver]
name = "limit"

[[arm]]
name = "regular"
members = 1
arrangement = "discontinuous"
block_length_m = 0.4
course_height_m = 0.2
overlap = 0.5

[[arm]]
name = "random"
members = 5
arrangement = "coursed"
length_m = { family = "uniform", low = 0.3, high = 0.5 }
height_m = { family = "uniform", low = 0.15, high = 0.25 }
dip_deg = { family = "uniform", low = -5, high = 5 }
least_overlap = 0.1
"#;

fn asked(folder: &Folder, arguments: &[&str]) -> (Value, String) {
    let all = [&["homogenise", "studies/tiny", "--cells", "4", "--stones", "2,4"], arguments].concat();
    let json = folder.pirca(&[&all[..], &["--json"]].concat());
    assert_eq!(json.status.code(), Some(0), "{}", stderr(&json));
    let text = folder.pirca(&all);
    assert_eq!(text.status.code(), Some(0), "{}", stderr(&text));
    (serde_json::from_slice(&json.stdout).unwrap(), stdout(&text))
}

fn refused(study: &str, arguments: &[&str], said: &str) {
    let folder = Folder::with_study(study);
    let out = folder.pirca(&[&["homogenise", "studies/tiny"], arguments].concat());
    assert!(matches!(out.status.code(), Some(2 | 3)), "{:?}", out.status);
    assert!(stderr(&out).contains(said), "{}", stderr(&out));
    assert!(!folder.path("runs").exists(), "nothing is written");
}

#[test]
fn a_regular_arm_has_its_closed_forms_and_a_random_one_scatters_between_bounds() {
    let folder = Folder::with_study(STUDY);
    let (json, text) = asked(&folder, &["--out", "out"]);
    let [regular, random] = [0, 1].map(|arm| json["arms"][arm].clone());
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{value}"));
    // kn 1e9, ks 5e8, b 0.4, a 0.2, t 0.3.
    let (kn, ks, b, a, t) = (1e9, 5e8, 0.4, 0.2, 0.3);
    for (name, exact) in [("A1111", t * (kn * b + ks * b * b / (4.0 * a))), ("A2222", t * kn * a)] {
        assert!((number(&regular["moduli"][name]["mean"]) / exact - 1.0).abs() < 1e-9, "{name}");
    }
    assert_eq!((&regular["cell"]["cells"], &random["cell"]["cells"]), (&1.into(), &4.into()));
    assert!(regular["moduli"]["A1111"]["cov"].is_null() && regular["moduli"]["A1111"]["by_size"].is_null());
    let own = &random["moduli"]["A1111"];
    let [low, high] = [0, 1].map(|end| number(&own["interval"][end]));
    assert!(low < number(&own["mean"]) && number(&own["mean"]) < high && number(&own["cov"]) > 0.0);
    let bounds = &own["bounds"];
    assert!(
        number(&bounds["static"]) < number(&own["mean"])
            && number(&own["mean"]) < number(&bounds["kinematic"])
    );
    // Two sizes of four cells and of one.
    assert_eq!(random["cell"]["nested"], serde_json::json!({"held": 8, "of": 8}));
    assert_eq!(own["by_size"]["stones"], serde_json::json!([[2, 2], [4, 4]]));
    // 8 and 26 directions.
    let surface = random["surface"].as_array().unwrap();
    assert_eq!(surface.len(), 34);
    let push = surface.iter().find(|own| own["direction"][0] == -1.0 && own["direction"][2] == 0.0).unwrap();
    assert_eq!((&push["unbounded"], &push["value"]["n"]), (&4.into(), &0.into()));
    let bent =
        surface.iter().find(|own| own["direction"] == serde_json::json!([0.0, 0.0, 0.0, 0.0, 1.0, 0.0]));
    assert!((number(&bent.unwrap()["value"]["mean"]) - 0.5).abs() < 0.05, "half the thickness");
    assert!(
        text.contains("Strength beside the vertical stress")
            && text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
    for file in ["homogenised.json", "cells.csv", "surface.csv", "surface.svg", "surface.png", "scatter.svg"]
    {
        assert!(folder.path("out").join(file).is_file(), "{file}");
    }
    let cells = fs::read_to_string(folder.path("out/cells.csv")).unwrap();
    // Five cells of two sizes with three borders, and the head.
    assert_eq!(cells.lines().count(), 1 + 10 * 3);
}

#[test]
#[ignore = "slow: 60 s of processor time"]
fn walls_are_held_against_plates_with_the_strength_of_cells() {
    let folder = Folder::with_study(STUDY);
    let walls = ["--walls", "6", "--plates", "3", "--directions", "in-plane"];
    let both = ["--method", "associative,non-associative", "--out", "out"];
    let (json, text) = asked(&folder, &[&walls[..], &both[..]].concat());
    let [regular, random] = [0, 1].map(|arm| json["arms"][arm]["walls"].clone());
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{value}"));
    // A free wall overturns at its thickness over its height, by its stones and as a plate: to the solvers' accuracy.
    for sample in ["stones", "plates"] {
        assert_eq!(regular[sample]["n"], 1);
        assert!((number(&regular[sample]["mean"]["value"]) - 0.3).abs() < 1e-4, "{sample}");
    }
    assert_eq!((&random["stones"]["n"], &random["plates"]["n"]), (&6.into(), &3.into()));
    assert_eq!(random["within_5_percent"]["of"], 6);
    // Too few walls to fit an interval by some and look at it with the others.
    assert!(random["by_walls"].is_null());
    // Free walls overturn as their plates do: the interval is narrow, and holds the one wall.
    assert_eq!(regular["validity"]["stones_over_plate"], serde_json::json!([0.98, 1.02]));
    assert_eq!(regular["by_cells"]["held"]["count"], 1);
    let flow = &random["non_associative_over_associative"];
    assert_eq!(number(&flow["n"]) + number(&random["non_associative_failed"]), 6.0);
    assert!(number(&flow["mean"]["value"]) <= 1.0 + 1e-6, "associative flow bounds from above");
    assert!(text.contains("Walls beside their plates"), "{text}");
    let table = fs::read_to_string(folder.path("out/walls.csv")).unwrap();
    assert_eq!(table.lines().filter(|line| line.contains(",plate,")).count(), 1 + 3);
    assert_eq!(table.lines().filter(|line| line.contains(",stones,")).count(), 2 * (1 + 6));
    assert_eq!(fs::read_to_string(folder.path("out/timing.csv")).unwrap().lines().count(), 1 + 4 + 7);
}

/// A led wall of half bond, 1 m high.
fn led(length: &str, thickness: &str) -> String {
    let thick =
        |side: &str| [format!("{side}_thickness_m = 0.3"), format!("{side}_thickness_m = {thickness}")];
    let [[base, own_base], [top, own_top]] = ["base", "top"].map(thick);
    STUDY
        .replace("length_m = 2.0", &format!("length_m = {length}"))
        .replace(&base, &own_base)
        .replace(&top, &own_top)
        .replace("ends = \"free\"", "ends = \"out_of_plane\"")
}

/// The one wall of half bond and its plate: what is written, and what is printed.
fn regular_wall(folder: &Folder) -> (Value, String) {
    let cells = ["homogenise", "studies/tiny", "--arms", "regular", "--stones", "2", "--cells", "2"];
    let walls = ["--directions", "none", "--walls", "1", "--plates", "1", "--out", "out"];
    let out = folder.pirca(&[&cells[..], &walls[..]].concat());
    assert_eq!(out.status.code(), Some(0), "{}", stderr(&out));
    let json: Value =
        serde_json::from_str(&fs::read_to_string(folder.path("out/homogenised.json")).unwrap()).unwrap();
    (json["arms"][0]["walls"].clone(), stdout(&out))
}

#[test]
fn a_plate_that_stones_slide_out_of_is_refused_with_its_reason() {
    // 10 by 5 stones between led ends: the plate folds at 0.75, and friction of 0.62 holds no stone at the top.
    let folder = Folder::with_study(&led("4.0", "0.35"));
    let (found, text) = regular_wall(&folder);
    assert_eq!((&found["plates"]["n"], &found["plates"]["out_of_range"]), (&0.into(), &1.into()));
    assert!(found["stones"]["mean"]["value"].as_f64().is_some() && found["stones_over_plate"].is_null());
    assert!(found["by_cells"].is_null() && found["validity"].is_null());
    let why = found["plates"]["out_of_range_why"].as_str().unwrap();
    assert!(why.contains("courses slide out before the wall folds"), "{why}");
    assert!(text.contains("out of the range of plates"), "{text}");
    let table = fs::read_to_string(folder.path("out/walls.csv")).unwrap();
    assert!(table.contains("regular,plate,0,associative,out_of_range,,,"), "{table}");
}

#[test]
fn masonry_that_was_not_measured_makes_no_plate_that_stands_for_it() {
    let study = led("6.0", "0.2");
    let bond = "block_length_m = 0.4\ncourse_height_m = 0.2\noverlap = 0.5";
    for (from, to, said) in [
        (bond, &*bond.replace("0.5", "0.1"), "head joints of neighbouring courses may come as near as 0.1"),
        ("wythes = 1", "wythes = 2", "the wall has 2 wythes"),
        ("length_m = 6.0", "length_m = 2.4", "the wall has 6.0 stones along it and 5.0 courses"),
        ("phi_deg = 32", "phi_deg = 50", "the tangent of the friction angle is 1.192"),
    ] {
        assert!(study.contains(from), "{from}");
        let folder = Folder::with_study(&study.replace(from, to));
        let (found, _) = regular_wall(&folder);
        let why = found["plates"]["out_of_range_why"].as_str().unwrap();
        assert!(why.contains(said) && why.contains("judge such walls by their stones"), "{why}");
        assert!(found["stones"]["n"] == 1 || found["stones"]["bear_any"] == 1, "{found}");
    }
}

#[test]
#[ignore = "slow: 20 s of processor time"]
fn a_plate_within_its_range_says_between_what_its_walls_lie() {
    // 15 by 5 stones, thin enough to fold at half of what friction bears.
    let folder = Folder::with_study(&led("6.0", "0.2"));
    let (found, text) = regular_wall(&folder);
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{value}"));
    let plate = number(&found["plates"]["mean"]["value"]);
    let tan_phi = pirca::math::tan(32f64.to_radians());
    assert!((number(&found["validity"]["shear_ratio"]) / (plate / tan_phi) - 1.0).abs() < 1e-12);
    let [low, high] = [0, 1].map(|end| number(&found["validity"]["stones_over_plate"][end]));
    assert!((0.5 * (low + high) - (0.95 + 0.13 * tan_phi)).abs() < 1e-12);
    for (end, ratio) in [(0, low), (1, high)] {
        assert!((number(&found["by_cells"]["interval"][end]) / (plate * ratio) - 1.0).abs() < 1e-12);
    }
    assert_eq!(found["by_cells"]["held"]["count"], 1, "{found}");
    assert!(text.contains("a wall bears"), "{text}");
}

#[test]
fn head_joints_that_are_built_open_carry_nothing_however_narrow_they_are() {
    // Half bond of stones 0.3 x 0.12 x 0.15 m; kn 2e8, ks 8e7 Pa/m. The search for contacts reaches some 0.9 mm.
    let study = STUDY
        .replace("thickness_m = 0.3", "thickness_m = 0.15")
        .replace("kn_pa_per_m = [1e9]", "kn_pa_per_m = [2e8]")
        .replace("kn_over_ks = 2.0", "kn_over_ks = 2.5")
        .replace("block_length_m = 0.4", "block_length_m = 0.3")
        .replace("course_height_m = 0.2", "course_height_m = 0.12");
    let (b, a, t, ks) = (0.3, 0.12, 0.15, 8e7);
    for gap in [1e-6, 1e-4, 5e-4, 8e-4, 1e-3, 2e-3] {
        let open = study.replace("head_joint_gap_m = 0", &format!("head_joint_gap_m = {gap}"));
        let folder = Folder::with_study(&open);
        let (json, text) = asked(&folder, &["--arms", "regular", "--directions", "none", "--out", "out"]);
        let moduli = &json["arms"][0]["moduli"];
        let sheared = t * ks * (0.5 * b - gap) * b / (2.0 * a);
        let turned = sheared * (t * t + (0.5 * b - gap) * (0.5 * b - gap)) / 12.0;
        for (name, exact) in [("A1111", sheared), ("D1111", turned)] {
            let found = moduli[name]["mean"].as_f64().unwrap();
            assert!((found / exact - 1.0).abs() < 1e-9, "{gap}, {name}: {found} {exact}");
        }
        assert_eq!(json["arms"][0]["cell"]["head_joint_gap_m"], gap);
        assert!(text.contains("head joints are open by"), "{text}");
    }
}

#[test]
fn a_pressure_on_the_back_overturns_a_wall_as_its_plate() {
    let load = "protocol = \"lateral\"\nmean_pressure_pa = 1000\nbase_over_top = 2\nsteps = 5\n";
    let (from, to) = (STUDY.find("protocol").unwrap(), STUDY.find("[restraint]").unwrap());
    let study = format!("{}{load}\n{}", &STUDY[..from], &STUDY[to..]);
    let folder = Folder::with_study(&study);
    let (json, _) =
        asked(&folder, &["--walls", "1", "--plates", "1", "--arms", "regular", "--directions", "none"]);
    // Weight times half the thickness over pressure times its lever, 4/9 of the height, of a wall 1 m high.
    let exact = 2400.0 * 9.80665 * 0.3 * 0.15 / (1000.0 * 4.0 / 9.0);
    for sample in ["stones", "plates"] {
        let found = json["arms"][0]["walls"][sample]["mean"]["value"].as_f64().unwrap();
        assert!((found / exact - 1.0).abs() < 1e-3, "{sample}: {found} for {exact}");
    }
}

#[test]
fn walls_that_are_no_plates_are_refused_before_anything_is_computed() {
    const ROPES: &str = "ends = \"ropes\"\n[restraint.rope]\nstiffness_n_per_m = 1e6\n";
    let walls = ["--walls", "2", "--plates", "1"];
    refused(
        &STUDY.replace("cohesion_pa = 0", "cohesion_pa = 10"),
        &walls,
        "joint.cohesion_pa and joint.tension_pa to 0",
    );
    refused(&STUDY.replace("ends = \"free\"", "ends = \"joint_springs\""), &walls, "which no plate has");
    refused(
        &STUDY.replace("ends = \"free\"", ROPES).replace("\"y+\"", "\"y-\""),
        &walls,
        "take load.towards = \"y+\"",
    );
    refused(STUDY, &["--walls", "2", "--plates", "9", "--cells", "3"], "no more plates than --cells");
    refused(STUDY, &["--plates", "1"], "--walls");
}

#[test]
fn the_same_bytes_come_of_any_number_of_threads() {
    let folder = Folder::with_study(STUDY);
    let options =
        "--cells 2 --stones 1x2,2 --directions in-plane --method associative,elastic --walls 2 --plates 1";
    for (threads, out) in [("1", "one"), ("3", "three")] {
        let own = ["homogenise", "studies/tiny", "--threads", threads, "--out", out];
        let all: Vec<&str> = own.into_iter().chain(options.split(' ')).collect();
        let run = folder.pirca(&all);
        assert!(run.status.success(), "{}", stderr(&run));
    }
    for file in ["homogenised.json", "cells.csv", "surface.csv", "walls.csv", "surface.svg", "scatter.svg"] {
        let [one, three] = ["one", "three"].map(|out| fs::read(folder.path(out).join(file)).unwrap());
        assert!(one == three, "{file}");
    }
}

/// The files of a folder that no clock decides.
fn results(folder: &Folder, out: &str) -> Vec<Vec<u8>> {
    let all = ["homogenised.json", "cells.csv", "surface.csv", "walls.csv"];
    all.map(|file| fs::read(folder.path(out).join(file)).unwrap()).into()
}

#[test]
fn cells_and_walls_are_kept_added_to_and_shared_out() {
    let folder = Folder::with_study(STUDY);
    let run = |out: &str, more: &[&str]| {
        let all = ["homogenise", "studies/tiny", "--stones", "2", "--directions", "in-plane", "--out", out];
        let run = folder.pirca(&[&all[..], more].concat());
        assert!(run.status.success(), "{}", stderr(&run));
        stdout(&run)
    };
    let lines =
        |out: &str, file: &str| fs::read_to_string(folder.path(out).join(file)).unwrap().lines().count();
    let few = ["--cells", "2", "--walls", "1", "--plates", "1"];
    let many = ["--cells", "4", "--walls", "3", "--plates", "2"];
    run("whole", &many);
    run("grown", &few);
    // Of the regular arm one of each, of the random one as many as are asked for.
    assert_eq!((lines("grown", "cells.jsonl"), lines("grown", "walls.jsonl")), (3, 4));
    run("grown", &many);
    assert_eq!((lines("grown", "cells.jsonl"), lines("grown", "walls.jsonl")), (5, 7));
    assert!(results(&folder, "grown") == results(&folder, "whole"));
    // Another question of the same cells is not answered by what is kept.
    run("grown", &[&many[..], &["--pressure-pa", "2e4"]].concat());
    assert_eq!(lines("grown", "cells.jsonl"), 10);
    for shard in ["1/2", "0/2"] {
        let text = run("shared", &[&many[..], &["--shard", shard]].concat());
        assert!(text.contains("of 2 is evaluated"), "{text}");
        assert!(!folder.path("shared/homogenised.json").exists());
    }
    run("shared", &many);
    assert_eq!(lines("shared", "cells.jsonl"), 0);
    assert!(results(&folder, "shared") == results(&folder, "whole"));
}

#[test]
fn another_seed_gives_other_cells_and_the_same_seed_the_same() {
    let folder = Folder::with_study(STUDY);
    let of = |seed: &str, out: &str| {
        let (json, _) = asked(&folder, &["--seed", seed, "--directions", "none", "--out", out]);
        json["arms"][1]["moduli"]["A1111"]["mean"].as_f64().unwrap()
    };
    assert_eq!(of("3", "a"), of("3", "b"));
    assert_ne!(of("3", "a"), of("4", "c"));
}

#[test]
fn what_has_no_cell_or_no_surface_is_refused_before_anything_is_computed() {
    let battered = STUDY.replace("top_thickness_m = 0.3", "top_thickness_m = 0.2");
    refused(&battered, &[], "0.3 m thick at its base and 0.2 m at its top");
    refused(&STUDY.replace("phi_deg = 32", "phi_deg = 0"), &[], "joint.phi_deg and joint.cohesion_pa are 0");
    refused(
        &STUDY.replace("least_overlap = 0.1", "least_overlap = 0.45"),
        &["--stones", "3"],
        "take an even number of courses",
    );
    refused(STUDY, &["--stones", "0"], "allowed is a whole number from 1 to 200");
    refused(STUDY, &["--stones", "4,2"], "give the sizes from small to large");
    refused(STUDY, &["--arms", "randon"], "the nearest is `random`");
    refused(STUDY, &["--directions", "none,in-plane"], "none goes with no other set");
    refused(STUDY, &["--pressure-pa", "0"], "allowed is a number above 0");
    refused(STUDY, &["--point", "1"], "has 1 kn points");
}
