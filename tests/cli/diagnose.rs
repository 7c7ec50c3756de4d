//! `diagnose` as a user meets it: a verdict from a CSV, and what is said where there can be none.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Output;
use std::sync::OnceLock;

use pirca::critic::{Bank, Plan};
use pirca::ensemble::{Row, Task};
use pirca::study::{Study, described, nuisances};
use rayon::prelude::*;
use serde_json::Value;

use crate::fixture::{Folder, STUDY, stderr};

/// Towers that are solved in milliseconds.
const TOWERS: &str = include_str!("../../studies/hidden-effects/example/study.toml");
/// Six of them, simulated with kn of 4.1e7 Pa/m and read with a gauge that has moved by 3 mm after its zero reading.
const MEASURED: &str = include_str!("fixtures/diagnose/gauge-offset.csv");

fn folder(study: &str) -> Folder {
    let folder = Folder::with_study(study);
    symlink(Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions"), folder.path("distributions"))
        .unwrap();
    fs::write(folder.path("tests.csv"), MEASURED).unwrap();
    folder
}

/// The bank of the six towers' plan, as the library makes it; made once for all tests.
fn bank() -> &'static [u8] {
    static BANK: OnceLock<Vec<u8>> = OnceLock::new();
    BANK.get_or_init(|| {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let loaded = Study::load(&root.join("studies/hidden-effects/example"), None);
        let measured = root.join("tests/cli/fixtures/diagnose/gauge-offset.csv");
        let loaded = loaded.and_then(|loaded| loaded.with_measured(&measured));
        let study = loaded.unwrap_or_else(|faults| panic!("{faults}")).study;
        let mechanisms = described(&root.join("distributions")).unwrap_or_else(|lacks| panic!("{lacks}"));
        let nuisances = nuisances(&root.join("distributions")).unwrap_or_else(|lacks| panic!("{lacks}"));
        let plan = Plan::new(&study, &mechanisms, &nuisances, 60).unwrap_or_else(|faults| panic!("{faults}"));
        let tasks: Vec<Task> =
            (0..plan.places.len() as u32).map(|arm| Task { arm, point: 0, member: 0 }).collect();
        let rows: Vec<Row> = tasks.into_par_iter().map(|task| plan.evaluate(task)).collect();
        Bank::of(&plan, &rows).table(&plan).expect("walls make a table")
    })
}

fn ends_with(folder: &Folder, code: i32, arguments: &[&str]) -> Output {
    let output = folder.pirca(arguments);
    assert_eq!(output.status.code(), Some(code), "pirca {}: {}", arguments.join(" "), stderr(&output));
    output
}

/// Arguments of a diagnosis of the six towers.
const DIAGNOSE: [&str; 6] = ["diagnose", "studies/tiny", "--measured", "tests.csv", "--points", "60"];

/// A folder in which the six towers have been diagnosed, their bank made on the way: what was printed, and the verdict.
fn diagnosed(more: &[&str]) -> (Folder, String, Value) {
    let folder = folder(TOWERS);
    let first = ends_with(&folder, 0, &[&DIAGNOSE[..], more].concat());
    let verdict = fs::read(folder.path("runs/tiny-diagnosis/verdict.json")).unwrap();
    let json = serde_json::from_slice(&verdict).unwrap();
    (folder, String::from_utf8_lossy(&first.stdout).into_owned(), json)
}

#[test]
#[ignore = "slow: 80 s of processor time"]
fn a_gauge_that_has_moved_is_named_from_a_csv() {
    let (folder, text, json) = diagnosed(&["--no-gain", "--report"]);
    assert!(text.contains("NAMED: ") && text.contains(": gauge_offset ("), "{text}");
    assert_eq!((&json["verdict"], &json["causes"][0]["id"]), (&"named".into(), &"gauge_offset".into()));
    let moved = &json["causes"][0]["parameters"][0];
    // 3 mm were hidden; ninety readings of 0.02 mm each, which softer joints move as well.
    let median = moved["median"].as_f64().unwrap();
    assert!((median - 3e-3).abs() < 2e-5, "{moved}");
    assert!(json["causes"][0]["evidence"].as_f64().unwrap() > 0.99);
    // What is in order is not doubted.
    assert_eq!(json["notes"], Value::Array(Vec::new()));
    extended_by_an_offset(&folder);
    what_is_wrong_is_shown(&folder, &text, &json);
    // It is the bank that the library makes, to the bit.
    assert!(fs::read(folder.path("runs/tiny-bank/bank.parquet")).unwrap() == bank(), "another bank");
    // Another design is not diagnosed with this bank.
    let other =
        ends_with(&folder, 3, &["diagnose", "studies/tiny", "--measured", "tests.csv", "--points", "61"]);
    assert!(stderr(&other).contains("it was made for another design"), "{}", stderr(&other));
    assert!(stderr(&other).contains("it has 60 points, wanted are 61"), "{}", stderr(&other));
    // Nor is a bank that has been tampered with.
    fs::write(folder.path("runs/tiny-bank/bank.parquet"), b"no table").unwrap();
    let broken = ends_with(&folder, 3, &DIAGNOSE);
    assert!(stderr(&broken).contains("it is no bank"), "{}", stderr(&broken));
}

#[test]
fn a_diagnosis_that_may_build_no_bank_says_how_to_make_it() {
    let folder = folder(TOWERS);
    let refused = ends_with(&folder, 3, &[&DIAGNOSE[..], &["--no-build"]].concat());
    assert!(
        stderr(&refused).contains(
            "1080 walls are to be simulated first, by\n  pirca diagnose studies/tiny --measured tests.csv --prepare"
        ),
        "{}",
        stderr(&refused)
    );
}

#[test]
#[ignore = "slow: two diagnoses with their gain, seven minutes of processor time"]
fn a_gain_is_told_and_the_verdict_comes_out_the_same() {
    let (folder, text, json) = diagnosed(&["--report"]);
    what_is_wrong_is_shown(&folder, &text, &json);
    let gain = &json["gain"]["specimens_left_out"]["rmse"];
    assert!(gain["interval"][0].as_f64().unwrap() > 1.0, "{gain}");
    let verdict = fs::read(folder.path("runs/tiny-diagnosis/verdict.json")).unwrap();
    let extended = extended_by_an_offset(&folder);
    // Again, with the bank as it is: the same verdict and the same study to the bit, and none of an earlier verdict.
    let bank = fs::read(folder.path("runs/tiny-bank/bank.parquet")).unwrap();
    for stale in ["runs/tiny-diagnosis/extended/lean", "runs/tiny-diagnosis/extended/creep"] {
        fs::create_dir_all(folder.path(stale)).unwrap();
        fs::write(folder.path(stale).join("study.toml"), "of an earlier verdict").unwrap();
    }
    fs::write(folder.path("runs/tiny-diagnosis/extended/creep/notes.txt"), "the user's own").unwrap();
    ends_with(&folder, 0, &[&DIAGNOSE[..], &["--no-build"]].concat());
    assert!(!folder.path("runs/tiny-diagnosis/extended/lean").exists());
    assert!(!folder.path("runs/tiny-diagnosis/extended/creep/study.toml").exists());
    assert!(folder.path("runs/tiny-diagnosis/extended/creep/notes.txt").exists());
    assert_eq!(fs::read(folder.path("runs/tiny-diagnosis/verdict.json")).unwrap(), verdict);
    assert_eq!(
        fs::read(folder.path("runs/tiny-diagnosis/extended/gauge_offset/study.toml")).unwrap(),
        extended
    );
    // Nor a page of an earlier verdict, where none is asked for.
    assert!(!folder.path("runs/tiny-diagnosis/report.html").exists());
    assert_eq!(fs::read(folder.path("runs/tiny-bank/bank.parquet")).unwrap(), bank);
}

#[test]
#[ignore = "slow: thirteen diagnoses and banks, seven minutes of processor time"]
fn the_self_test_of_a_bank_is_kept_and_taken_from_there() {
    let (folder, _, json) = diagnosed(&["--no-gain"]);
    the_self_test_is_kept_beside_the_bank(&folder, &json["self_test"]);
}

/// `--prepare` keeps the self-test, a diagnosis takes it from there, and only if it is of the same.
fn the_self_test_is_kept_beside_the_bank(folder: &Folder, computed: &Value) {
    let told_with = |seed: &[&str]| -> Value {
        let diagnose = ["diagnose", "studies/tiny", "--measured", "tests.csv", "--points", "60", "--no-gain"];
        let json = ends_with(folder, 0, &[&diagnose[..], &["--json"], seed].concat()).stdout;
        serde_json::from_slice::<Value>(&json).unwrap()["self_test"].clone()
    };
    let told = || told_with(&[]);
    let path = folder.path("runs/tiny-bank/self-test.json");
    assert!(!path.exists());
    let bank = ["diagnose", "studies/tiny", "--prepare", "--measured", "tests.csv", "--points", "60"];
    let made = ends_with(folder, 0, &[&bank[..], &["--judged", "0"]].concat());
    let made = String::from_utf8(made.stdout).unwrap();
    let tower = made.lines().last().unwrap();
    assert!(
        tower.starts_with("  tower: collapse angle ") && tower.contains(" %, displacement half way up "),
        "{made}"
    );
    let kept = fs::read_to_string(&path).unwrap();
    assert_eq!(&told(), computed);
    let other = kept.replace("\"campaigns\": 100", "\"campaigns\": 200");
    fs::write(&path, &other).unwrap();
    assert_ne!(&told(), computed);
    fs::write(&path, other.replace("\"of\": \"", "\"of\": \"0")).unwrap();
    assert_eq!(&told(), computed);
    // More found than there were campaigns: it is no self-test.
    fs::write(&path, kept.replace("\"campaigns\": 100", "\"campaigns\": 5")).unwrap();
    assert_eq!(&told(), computed);
    // A table that came without its journal needs no wall simulated, and gets the same self-test.
    fs::create_dir(folder.path("runs/alone")).unwrap();
    fs::copy(folder.path("runs/tiny-bank/bank.parquet"), folder.path("runs/alone/bank.parquet")).unwrap();
    ends_with(folder, 0, &[&bank[..], &["--out", "runs/alone", "--judged", "0"]].concat());
    assert_eq!(fs::read_dir(folder.path("runs/alone")).unwrap().count(), 2);
    assert_eq!(fs::read_to_string(folder.path("runs/alone/self-test.json")).unwrap(), kept);
    // All that a diagnosis does is asked of as many campaigns as are wanted, and told where that is known.
    ends_with(folder, 0, &[&bank[..], &["--judged", "1"]].concat());
    let judged = told();
    assert_eq!((&judged[0]["hidden"], &judged[0]["judged"]["campaigns"]), (&"nothing".into(), &5.into()));
    assert_eq!(judged[1]["judged"]["campaigns"], 1);
    assert_eq!(computed[1]["judged"]["campaigns"], 0);
    // That of another seed is of diagnoses with that seed.
    let seed = ["--seed", "5"];
    ends_with(folder, 0, &[&bank[..], &["--judged", "1"], &seed].concat());
    assert_eq!(&told(), computed);
    assert_eq!(told_with(&seed)[1]["judged"]["campaigns"], 1);
}

#[test]
#[ignore = "slow: 20 s of processor time"]
fn a_bank_is_shared_out_to_shards() {
    let folder = folder(TOWERS);
    let asked = ["studies/tiny", "--measured", "tests.csv", "--points", "10"];
    for index in ["2", "0", "1"] {
        let shard = ["--bank", "--index", index, "--of", "3", "--out", "shared"];
        ends_with(&folder, 0, &[&["shards", "run"], &asked[..], &shard].concat());
    }
    let merged = ends_with(&folder, 0, &["shards", "merge", "shared"]);
    assert!(String::from_utf8_lossy(&merged.stdout).contains("written to shared"));
    // Whether so few points are enough to judge by is another question.
    folder.pirca(&[&["diagnose"], &asked[..], &["--prepare", "--judged", "0", "--bank", "whole"]].concat());
    // Manifests differ: shards name the measurements by their whole path, as they begin in any folder.
    for name in ["bank.parquet", "members.parquet", "steps.parquet"] {
        let [own, wanted] = ["shared", "whole"].map(|out| fs::read(folder.path(out).join(name)).unwrap());
        assert!(own == wanted, "{name}");
    }
    let other = ["--bank", "--index", "0", "--of", "3", "--out", "shared"];
    let other =
        ends_with(&folder, 1, &[&["shards", "run"], &asked[..3], &["--points", "11"], &other].concat());
    assert!(stderr(&other).contains("bank.points: 10 recorded, 11 asked for"), "{}", stderr(&other));
    fs::remove_file(folder.path("shared/shards/0001-of-0003.jsonl")).unwrap();
    let partial = ends_with(&folder, 2, &["shards", "merge", "shared", "--partial"]);
    assert!(stderr(&partial).contains("a bank is of all its walls"), "{}", stderr(&partial));
}

/// What a named offset of the gauge writes: a study that is checked and run from any place. Its bytes.
fn extended_by_an_offset(folder: &Folder) -> Vec<u8> {
    let written = folder.path("runs/tiny-diagnosis/extended/gauge_offset");
    assert_eq!(fs::read(written.join("measured.csv")).unwrap(), MEASURED.as_bytes());
    let text = fs::read_to_string(written.join("study.toml")).unwrap();
    for part in [
        "# Made by `pirca diagnose` from the study \"tiny\", seed 7.\n",
        "#   mechanism.gauge_offset.offset_m  0.003000 [0.00299",
        "#   arm.tower.joint.kn_pa_per_m",
        "\n[mechanism.gauge_offset]\noffset_m = 0.00299",
        "\nname = \"draw-20\"\n",
    ] {
        assert!(text.contains(part), "{part} in: {text}");
    }
    // Nothing lies beside or above it there.
    let elsewhere = Folder::with_study(STUDY);
    for file in ["study.toml", "measured.csv"] {
        fs::copy(written.join(file), elsewhere.path("studies/tiny").join(file)).unwrap();
    }
    let checked = ends_with(&elsewhere, 0, &["check", "studies/tiny"]);
    let said = String::from_utf8_lossy(&checked.stdout).into_owned();
    assert!(said.contains("measured: 96 values on 6 specimens"), "{said}");
    assert_eq!(said.matches("variant draw-").count(), 20, "{said}");
    let run = ["run", "studies/tiny", "--variant", "draw-07", "--members", "1"];
    ends_with(&elsewhere, 0, &run);
    assert!(elsewhere.path("runs/tiny-draw-07/summary.json").exists());
    text.into_bytes()
}

#[test]
#[ignore = "slow: 20 s of processor time"]
fn variants_have_banks_and_diagnoses_of_their_own() {
    let folder = folder(&format!(
        "{TOWERS}\n[[variant]]\nname = \"soft\"\nwhy = \"Softer joints.\"\nset = {{ \"joint.kn_pa_per_m\" = [4e7] }}\n"
    ));
    let soft = ["studies/tiny", "--variant", "soft", "--measured", "tests.csv", "--points", "12"];
    let refused = ends_with(&folder, 3, &[&["diagnose", "--no-build"], &soft[..]].concat());
    let wanted = "there is no runs/tiny-soft-bank/bank.parquet: 216 walls are to be simulated first, by\n  \
                  pirca diagnose studies/tiny --variant soft --measured tests.csv --prepare --points 12";
    assert!(stderr(&refused).contains(wanted), "{}", stderr(&refused));
    ends_with(&folder, 0, &[&["diagnose", "--no-gain"], &soft[..]].concat());
    assert!(folder.path("runs/tiny-soft-bank/bank.parquet").is_file());
    let text =
        fs::read_to_string(folder.path("runs/tiny-soft-diagnosis/extended/gauge_offset/study.toml")).unwrap();
    assert!(text.contains("from the study \"tiny\", variant soft, seed 7"), "{text}");
    assert!(text.contains("\n[joint]\nkn_pa_per_m = [40000000.0]\n"), "{text}");
    assert!(!folder.path("runs/tiny-bank").exists() && !folder.path("runs/tiny-diagnosis").exists());
}

/// Oddities of the measurements: name, the file, and what is said of it.
fn odd() -> [(&'static str, String, &'static str); 6] {
    let header = MEASURED.lines().next().unwrap();
    let of_one = MEASURED.lines().filter(|line| line.starts_with("s0,")).collect::<Vec<_>>().join("\n");
    let in_metres = |line: &str| match line.split_once(",mm,") {
        Some((before, behind)) if line.starts_with("s0,") => {
            let (names, value) = before.rsplit_once(',').unwrap();
            format!("{names},{},mm,{behind}\n", value.parse::<f64>().unwrap() / 1e3)
        }
        _ => format!("{line}\n"),
    };
    [
        (
            "metres",
            MEASURED.lines().map(in_metres).collect(),
            "lines 3 to 17: s0 alone is off by a factor of about 1000 on all 15 readings, which are too small",
        ),
        (
            "level",
            format!("{MEASURED}s0,tower,0,displacement_left,0.05,mm,0.02,exact\n"),
            "line 98: a displacement at 0 deg is 0, as readings are relative to the one at rest at 0 deg, and is not used",
        ),
        (
            "one",
            format!("{header}\n{of_one}\n"),
            "there is one specimen: the scatter between specimens cannot be judged",
        ),
        (
            "unit",
            MEASURED.replacen("3.228331,mm", "3.228331,cm", 1),
            "line 3: s0 is off by a factor of about 10 on displacement_left alone, which is too large (displacement_left of s0 is 32.28 mm",
        ),
        (
            "thick",
            MEASURED.replacen("3.228331,mm", "322.8331,mm", 1),
            "line 3: displacement_left of s0 is 322.8 mm at 2.5 deg, more than the wall's thickness of 80 mm",
        ),
        (
            "steep",
            MEASURED.replacen("collapse_angle,16.707637", "collapse_angle,60", 1),
            "line 2: collapse_angle of s0 is 60 deg, where 99.9 % of simulated readings lie within ",
        ),
    ]
}

/// A folder with the towers' bank in `bank`.
fn with_bank() -> Folder {
    let folder = folder(TOWERS);
    fs::create_dir(folder.path("bank")).unwrap();
    fs::write(folder.path("bank/bank.parquet"), bank()).unwrap();
    folder
}

/// Diagnoses a file; its notes are said on standard error as well.
fn noted(folder: &Folder, text: &str) -> Vec<String> {
    fs::write(folder.path("odd.csv"), text).unwrap();
    let diagnose = ["diagnose", "studies/tiny", "--measured", "odd.csv", "--json"];
    let arguments =
        [&diagnose[..], &["--points", "60", "--bank", "bank", "--no-build", "--no-gain"]].concat();
    let output = ends_with(folder, 0, &arguments);
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let notes: Vec<String> =
        json["notes"].as_array().unwrap().iter().filter_map(Value::as_str).map(str::to_owned).collect();
    assert!(notes.iter().all(|own| stderr(&output).contains(&format!("note: {own}\n"))), "{notes:?}");
    notes
}

/// What is said of measurements that are judged all the same, on standard error and in the verdict.
#[test]
#[ignore = "slow: 60 s of processor time"]
fn what_looks_odd_is_noted_and_judged() {
    let folder = with_bank();
    let [metres, level, one, unit, thick, steep] = odd();
    // What needs no walls is said before there are any.
    for (name, text, note) in [&metres, &level, &one, &thick] {
        fs::write(folder.path("odd.csv"), text).unwrap();
        let arguments = ["diagnose", "studies/tiny", "--measured", "odd.csv", "--no-build"];
        let said = stderr(&ends_with(&folder, 3, &arguments));
        assert!(said.contains(&format!("note: {note}")), "{name}: {said}");
    }
    // The other oddities in one file.
    let [angle, level] = [steep.1.lines().nth(1).unwrap(), level.1.lines().last().unwrap()];
    let all = unit.1.replacen(MEASURED.lines().nth(1).unwrap(), angle, 1) + level + "\n";
    let notes = noted(&folder, &all);
    let about =
        |note: &str| notes.iter().find(|own| own.starts_with(note)).unwrap_or_else(|| panic!("{notes:?}"));
    about(steep.2);
    about("line 98: a displacement at 0 deg is 0");
    // Far beyond its fellows; a strong cause of the search prior may move a wall so far.
    assert!(about(unit.2).ends_with("where 3.215 mm is usual): was it meant in another unit?"), "{notes:?}");
}

#[test]
#[ignore = "slow: five diagnoses, two minutes of processor time"]
fn each_oddity_alone_is_noted_and_judged() {
    let folder = with_bank();
    for (name, text, note) in odd() {
        let notes = noted(&folder, &text);
        assert!(notes.iter().any(|own| own.starts_with(note)), "{name}: {notes:?}");
        assert!(
            name != "unit" || notes.iter().any(|own| own.ends_with("): was it meant in another unit?")),
            "{notes:?}"
        );
    }
}

/// Whoever tests but some of the families of a study needs no bank of his own.
#[test]
#[ignore = "slow: a diagnosis of three walls, a minute of processor time"]
fn the_bank_beside_a_study_serves_measurements_of_one_of_its_families() {
    let folder = folder(TOWERS);
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-table");
    let all = fs::read_to_string(study.join("measured.csv")).unwrap();
    let own: Vec<&str> =
        all.lines().filter(|line| line.starts_with("specimen") || line.starts_with("SBR")).collect();
    fs::write(folder.path("sbr.csv"), own.join("\n") + "\n").unwrap();
    let diagnose = ["diagnose", study.to_str().unwrap(), "--measured", "sbr.csv"];
    let judged = ends_with(
        &folder,
        0,
        &[&diagnose[..], &["--no-build", "--no-gain", "--threads", "1", "--json"]].concat(),
    );
    let json: Value = serde_json::from_slice(&judged.stdout).unwrap();
    let families = json["groups"].as_array().unwrap().iter().map(|group| &group["family"]);
    assert!(families.clone().count() == 4 && families.clone().all(|family| family == "sbr"), "{json}");
}

/// A table of another design says what differs, wherever it lies.
#[test]
fn a_bank_of_other_families_is_refused_with_both() {
    let folder = folder(TOWERS);
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-table");
    fs::create_dir_all(folder.path("wrong")).unwrap();
    fs::copy(study.join("bank.parquet"), folder.path("wrong/bank.parquet")).unwrap();
    let other = ["diagnose", "studies/tiny", "--measured", "tests.csv", "--bank", "wrong"];
    let refused = stderr(&ends_with(&folder, 3, &other));
    assert!(refused.contains("its walls are of cbl, sbl, sbr, wanted are those of tower"), "{refused}");
}

#[test]
fn tilts_beyond_the_platforms_range_are_noted_before_anything_is_simulated() {
    let folder = folder(&TOWERS.replace("step_deg = 2.5", "step_deg = 2.5\nend_deg = 11"));
    let refused =
        ends_with(&folder, 3, &["diagnose", "studies/tiny", "--measured", "tests.csv", "--no-build"]);
    let note = "note: lines 15, 16, 17, 31, 32, 33, 47, 48, 49, 63, 64, 65, 79, 80, 81, 95, 96, 97: read at up to 12.5 deg, and the \
                study's platform goes to 11 deg";
    assert!(stderr(&refused).contains(note), "{}", stderr(&refused));
}

/// An arm that the study has and a variant leaves out: its rows are named, and not taken for weights.
#[test]
fn rows_of_an_arm_that_is_not_evaluated_are_named() {
    let (before, arm) = TOWERS.split_once("[[arm]]").unwrap();
    let second = arm.replace("name = \"tower\"", "name = \"other\"");
    let variant =
        "\n[[variant]]\nname = \"other-only\"\nwhy = \"One arm.\"\nset = { \"study.arms\" = [\"other\"] }\n";
    let folder = folder(&format!("{before}[[arm]]{arm}\n[[arm]]{second}{variant}"));
    let with = |rows: &str| {
        fs::write(folder.path("both.csv"), format!("{MEASURED}{rows}")).unwrap();
        let arguments =
            ["diagnose", "studies/tiny", "--variant", "other-only", "--measured", "both.csv", "--no-build"];
        stderr(&ends_with(&folder, 3, &arguments))
    };
    let none = with("x0,other,,joint_phi,35,deg,1,exact\n");
    assert!(none.contains("no specimen was tilted") && none.contains("a wall of other;"), "{none}");
    let one = with("x0,other,,collapse_angle,16,deg,0.1,exact\n");
    assert!(one.contains("note: lines 2 to 97: tower is an arm that the study does not evaluate"), "{one}");
}

/// Faults of the file that a diagnosis is asked for: file, line, what is allowed.
#[test]
fn faulty_measurements_are_refused_with_their_lines() {
    let folder = folder(TOWERS);
    let first = "s0,tower,2.5,displacement_left,3.228331,mm,0.02,exact";
    let cases: [(&str, &str, &str); 7] = [
        ("tilt_deg,quantity", "tilt,quantity", "bad.csv:1: tilt is not a known column"),
        (
            first,
            &first.replace("tower", "wall"),
            "bad.csv:3: family = wall: allowed is an arm of study.toml: tower",
        ),
        (
            first,
            &first.replace("displacement_left", "speed"),
            "bad.csv:3: quantity = speed: allowed is one of \"collapse_angle\"",
        ),
        (
            first,
            &first.replace("mm", "deg"),
            "bad.csv:3: unit = deg: allowed is one of \"m\", \"cm\", \"mm\"",
        ),
        (
            first,
            &first.replace("0.02", "-0.02"),
            "bad.csv:3: error = -0.02: allowed is a number at least 0 (mm)",
        ),
        (first, &first.replace("2.5", "95"), "bad.csv:3: tilt_deg = 95"),
        (first, &first.replace("3.228331", "3,2"), "bad.csv:3: has 9 cells"),
    ]
    .map(|(from, to, said)| (from, Box::leak(to.to_owned().into_boxed_str()) as &str, said));
    for (from, to, said) in cases {
        fs::write(folder.path("bad.csv"), MEASURED.replacen(from, to, 1)).unwrap();
        for verb in [&["diagnose"][..], &["diagnose", "--prepare"]] {
            let error =
                stderr(&ends_with(&folder, 3, &[verb, &["studies/tiny", "--measured", "bad.csv"]].concat()));
            assert!(error.contains(said), "{said} in: {error}");
        }
    }
    assert!(!folder.path("runs").exists());
}

/// Studies in folders of their own take each file from the nearest `distributions` above them that has it, else what is built in,
/// for references and for priors.
#[test]
fn a_nested_study_finds_its_distributions_further_up() {
    let nested = folder(TOWERS);
    let length = "length_m = { family = \"uniform\", low = 0.08, high = 0.12 }";
    assert!(TOWERS.contains(length));
    let text = TOWERS.replace(length, "length_m = \"block/size:shaped-stone-length\"");
    fs::create_dir_all(nested.path("studies/hidden-effects/example")).unwrap();
    fs::write(nested.path("studies/hidden-effects/example/study.toml"), text).unwrap();
    ends_with(&nested, 0, &["check", "studies/hidden-effects/example"]);
    let arguments = ["diagnose", "studies/hidden-effects/example", "--measured", "tests.csv", "--no-build"];
    assert!(stderr(&ends_with(&nested, 3, &arguments)).contains("walls are to be simulated first"));
    // A prior that lies nearer counts, and a faulty one is refused.
    let nearer = nested.path("studies/distributions/nuisance/kn_factor.toml");
    fs::create_dir_all(nearer.parent().unwrap()).unwrap();
    let prior = include_str!("../../distributions/nuisance/kn_factor.toml");
    assert!(prior.contains("sd = 0.5"));
    fs::write(&nearer, prior.replace("sd = 0.5", "sd = -0.5")).unwrap();
    let refused = stderr(&ends_with(&nested, 3, &arguments));
    assert!(refused.contains("kn_factor.toml") && refused.contains("sd = -0.5"), "{refused}");
    fs::remove_dir_all(nested.path("studies/distributions")).unwrap();
    // Where there is no such folder, what is built in serves.
    fs::remove_file(nested.path("distributions")).unwrap();
    ends_with(&nested, 0, &["check", "studies/hidden-effects/example"]);
    assert!(stderr(&ends_with(&nested, 3, &arguments)).contains("walls are to be simulated first"));
}

/// Readings and their groups in the text, in the JSON and in the figures.
fn what_is_wrong_is_shown(folder: &Folder, text: &str, json: &Value) {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "- tower: collapse angle: 16.6 deg measured, ",
        "- tower: displacement left at 2.5 deg: 3.21 mm measured, ",
    ] {
        assert!(words.contains(part), "no `{part}` in\n{text}");
    }
    let (residuals, groups) = (json["residuals"].as_array().unwrap(), json["groups"].as_array().unwrap());
    // Six towers, their angles and three points at five tilts.
    assert_eq!((residuals.len(), groups.len()), (6 * 16, 16));
    let of = |group: &&Value| group["quantity"] == "displacement_left" && group["tilt_deg"] == 2.5;
    let group = groups.iter().find(of).unwrap();
    assert_eq!(
        (&group["family"], &group["readings"], &group["unit"]),
        (&"tower".into(), &6.into(), &"m".into())
    );
    // 3 mm against a few tenths of one.
    assert_eq!(group["stands"], "above");
    assert!(group["in_sd"].as_f64().unwrap() > 5.0 && group["p_value"].as_f64().unwrap() < 0.01, "{group}");
    let sd = |part: &str| group["simulated"][part].as_f64().unwrap();
    let parts = ["sd_measurement", "sd_scatter", "sd_parameters"].map(sd);
    let together = parts.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!((together / sd("sd") - 1.0).abs() < 1e-9, "{group}");
    // 0.02 mm in each of six readings.
    assert!((parts[0] - 2e-5 / 6.0_f64.sqrt()).abs() < 1e-12, "{group}");
    for name in ["tower.svg", "tower.png", "residuals.svg", "residuals.png", "best-fit.svg"] {
        assert!(folder.path("runs/tiny-diagnosis").join(name).is_file(), "{name}");
    }
    let page = fs::read_to_string(folder.path("runs/tiny-diagnosis/report.html")).unwrap();
    for part in [
        "one cause explains the readings: a gauge that moved, or a wrong zero.",
        "Fewer than 1 in 2,000 simulated campaigns",
        "id=\"sketch-gauge_offset\"",
        "median if the cause is gauge_offset",
        "<td>tower: collapse angle</td>",
        "diagnose studies&#x2f;tiny --measured tests.csv",
    ] {
        assert!(page.contains(part), "no `{part}` in the page");
    }
}

#[test]
fn what_cannot_be_diagnosed_is_said_before_anything_is_simulated() {
    let towers = folder(TOWERS);
    let said = |folder: &Folder, arguments: &[&str], words: &[&str]| {
        let error = stderr(&ends_with(folder, 3, arguments));
        for word in words {
            assert!(error.contains(word), "{word} in: {error}");
        }
        assert!(!folder.path("runs").exists());
    };
    said(&towers, &["diagnose", "studies/tiny"], &["nothing was measured", "--measured"]);
    said(&towers, &["diagnose", "studies/tiny", "--prepare"], &["nothing was measured"]);
    fs::write(towers.path("taken"), "").unwrap();
    let taken =
        ends_with(&towers, 1, &["diagnose", "studies/tiny", "--measured", "tests.csv", "--out", "taken"]);
    assert!(stderr(&taken).contains("taken"), "{}", stderr(&taken));
    said(&towers, &["diagnose", "studies/tiny", "--measured", "none.csv"], &["none.csv"]);
    let spoilt = MEASURED.replacen("s0,tower,2.5,displacement_left", "s0,towers,2.5,displacement_lift", 1);
    fs::write(towers.path("spoilt.csv"), spoilt).unwrap();
    let faults = ["2 faults", "spoilt.csv:3: family", "spoilt.csv:3: quantity"];
    said(&towers, &["diagnose", "studies/tiny", "--measured", "spoilt.csv"], &faults);
    let header = MEASURED.lines().next().unwrap();
    let weight =
        format!("{header}\ns0,tower,,specimen_weight,600,N,1,exact\ns0,tower,,joint_phi,35,deg,1,exact\n");
    fs::write(towers.path("weights.csv"), weight).unwrap();
    said(
        &towers,
        &["diagnose", "studies/tiny", "--measured", "weights.csv"],
        &["no specimen was tilted", "tower"],
    );
    said(
        &towers,
        &["diagnose", "studies/tiny", "--prepare", "--measured", "weights.csv"],
        &["no specimen was tilted"],
    );
    let pushed = folder(STUDY);
    fs::write(pushed.path("pushed.csv"), MEASURED.replace("tower", "random")).unwrap();
    said(
        &pushed,
        &["diagnose", "studies/tiny", "--measured", "pushed.csv"],
        &["neither tilts, shears nor shakes its walls"],
    );
}
