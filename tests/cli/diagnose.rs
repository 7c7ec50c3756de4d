//! `bank` and `diagnose` as a user meets them: a verdict from a CSV, and what is said where there can be none.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::fixture::{Folder, STUDY, stderr};

/// Towers that are solved in milliseconds.
const TOWERS: &str = include_str!("../hidden_effect/towers/study.toml");
/// Six of them, simulated with kn of 4.1e7 Pa/m and read with a gauge that has moved by 3 mm after its zero reading.
const MEASURED: &str = include_str!("fixtures/diagnose/gauge-offset.csv");

fn folder(study: &str) -> Folder {
    let folder = Folder::with_study(study);
    symlink(Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions"), folder.path("distributions"))
        .unwrap();
    fs::write(folder.path("tests.csv"), MEASURED).unwrap();
    folder
}

fn ends_with(folder: &Folder, code: i32, arguments: &[&str]) -> Output {
    let output = folder.pirca(arguments);
    assert_eq!(output.status.code(), Some(code), "pirca {}: {}", arguments.join(" "), stderr(&output));
    output
}

#[test]
fn a_gauge_that_has_moved_is_named_from_a_csv_and_the_bank_is_made_once() {
    let folder = folder(TOWERS);
    let diagnose = ["diagnose", "studies/tiny", "--measured", "tests.csv", "--points", "60"];
    let refused = ends_with(&folder, 3, &[&diagnose[..], &["--no-build"]].concat());
    assert!(
        stderr(&refused).contains(
            "840 walls are to be simulated first, by\n  pirca bank studies/tiny --measured tests.csv"
        ),
        "{}",
        stderr(&refused)
    );
    let first = ends_with(&folder, 0, &diagnose);
    let text = String::from_utf8_lossy(&first.stdout).into_owned();
    assert!(text.contains("NAMED: ") && text.contains("* gauge_offset"), "{text}");
    let verdict = fs::read(folder.path("runs/tiny-diagnosis/verdict.json")).unwrap();
    let json: Value = serde_json::from_slice(&verdict).unwrap();
    assert_eq!((&json["verdict"], &json["causes"][0]["id"]), (&"named".into(), &"gauge_offset".into()));
    let moved = &json["causes"][0]["parameters"][0];
    // 3 mm were hidden; 0.02 mm of error in ninety readings, and some of the 60 campaigns most alike are further away.
    let median = moved["median"].as_f64().unwrap();
    assert!((median - 3e-3).abs() < 5e-4, "{moved}");
    what_is_wrong_is_shown(&folder, &text, &json);
    let page = fs::read(folder.path("runs/tiny-diagnosis/verdict.html")).unwrap();
    // Again, with the bank as it is: the same verdict to the bit.
    let bank = fs::read(folder.path("runs/tiny-bank/bank.parquet")).unwrap();
    ends_with(&folder, 0, &[&diagnose[..], &["--no-build"]].concat());
    assert_eq!(fs::read(folder.path("runs/tiny-diagnosis/verdict.json")).unwrap(), verdict);
    assert_eq!(fs::read(folder.path("runs/tiny-diagnosis/verdict.html")).unwrap(), page);
    assert_eq!(fs::read(folder.path("runs/tiny-bank/bank.parquet")).unwrap(), bank);
    // Another design is not diagnosed with this bank.
    let other =
        ends_with(&folder, 3, &["diagnose", "studies/tiny", "--measured", "tests.csv", "--points", "61"]);
    assert!(stderr(&other).contains("it was made for another design"), "{}", stderr(&other));
    // Nor is a bank that has been tampered with.
    fs::write(folder.path("runs/tiny-bank/bank.parquet"), b"no table").unwrap();
    let broken = ends_with(&folder, 3, &diagnose);
    assert!(stderr(&broken).contains("it is no bank"), "{}", stderr(&broken));
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
    for name in ["tower.svg", "tower.png", "residuals.svg", "residuals.png"] {
        assert!(folder.path("runs/tiny-diagnosis").join(name).is_file(), "{name}");
    }
    let page = fs::read_to_string(folder.path("runs/tiny-diagnosis/verdict.html")).unwrap();
    for part in ["(gauge_offset)", "median if the cause is gauge_offset", "<td>tower: collapse angle</td>"] {
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
    said(&towers, &["bank", "studies/tiny"], &["nothing was measured"]);
    said(&towers, &["diagnose", "studies/tiny", "--measured", "none.csv"], &["none.csv"]);
    let spoilt = MEASURED.replacen("s0,tower,2.5,displacement_left", "s0,towers,2.5,displacement_lift", 1);
    fs::write(towers.path("spoilt.csv"), spoilt).unwrap();
    let faults = ["2 faults", "spoilt.csv:3: family", "spoilt.csv:3: quantity"];
    said(&towers, &["diagnose", "studies/tiny", "--measured", "spoilt.csv"], &faults);
    let pushed = folder(STUDY);
    fs::write(pushed.path("pushed.csv"), MEASURED.replace("tower", "random")).unwrap();
    said(&pushed, &["diagnose", "studies/tiny", "--measured", "pushed.csv"], &["tilts no platform"]);
}
