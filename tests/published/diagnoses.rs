//! What the READMEs tell of diagnoses: of the nine walls, and of the example with a hidden effect.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// The verdict on a study's measurements, with a bank in this folder.
fn verdict(study: &str, bank: &Path) -> Value {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join(study.replace('/', "-"));
    let ran = Command::new(env!("CARGO_BIN_EXE_pirca"))
        .args(["diagnose", study, "--no-gain", "--json", "--bank"])
        .arg(bank)
        .arg("--out")
        .arg(scratch)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("it is built");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    serde_json::from_slice(&ran.stdout).expect("a verdict")
}

/// `studies/tilting-table`: something is wrong, and nothing in the catalogue explains it.
#[test]
fn the_nine_walls_stay_unexplained_as_sbl_moves_too_far() {
    let study = "studies/tilting-table";
    let found = verdict(study, &Path::new(env!("CARGO_MANIFEST_DIR")).join(study));
    assert_eq!(found["verdict"], "unexplained");
    assert!(found["p_value"].as_f64().is_some_and(|p| p < 0.005), "{}", found["p_value"]);
    // Table 11: SBL at 5 deg 13.3 mm measured; beyond all that scatters, unless all errors are common to all means.
    let group = |family: &str, quantity: &str, tilt: Option<f64>| {
        let groups = found["groups"].as_array().expect("groups");
        let own = groups.iter().find(|group| {
            (&group["family"], &group["quantity"]) == (&family.into(), &quantity.into())
                && group["tilt_deg"].as_f64() == tilt
        });
        own.unwrap_or_else(|| panic!("{family} {quantity}")).clone()
    };
    let sbl = group("sbl", "displacement_mean", Some(5.0));
    assert!(sbl["stands"] == "above" && sbl["p_value"].as_f64().is_some_and(|p| p < 0.01), "{sbl}");
    // SBR's 50 % difference there is no finding, and neither is CBL's collapse angle.
    assert_eq!(group("sbr", "displacement_centre_minus_ends", Some(5.0))["stands"], "within");
    assert_eq!(group("cbl", "collapse_angle", None)["stands"], "within");
}

/// `studies/hidden-effects/example`: 6e6 Pa/m at first and 0.3 mm in all were hidden.
#[test]
#[ignore = "slow: a bank and a diagnosis, fifty seconds of processor time"]
fn the_example_names_joints_that_close_and_finds_their_parameters() {
    let bank = Path::new(env!("CARGO_TARGET_TMPDIR")).join("example-bank");
    // Walls of an earlier state would be taken for this one's.
    let _ = fs::remove_dir_all(&bank);
    let found = verdict("studies/hidden-effects/example", &bank);
    let cause = &found["causes"][0];
    assert_eq!((&found["verdict"], &cause["id"]), (&"named".into(), &"joint_closure".into()));
    let parameters = cause["parameters"].as_array().expect("they are told");
    assert_eq!(parameters.len(), 2);
    for (parameter, (key, hidden)) in parameters.iter().zip([("initial_pa_per_m", 6e6), ("closure_m", 3e-4)])
    {
        assert_eq!(parameter["key"], key);
        let [low, high] = [0, 1].map(|end| parameter["interval"][end].as_f64().expect("a number"));
        // Nine in ten such intervals hold what was hidden, and these do.
        assert!(low < hidden && hidden < high, "{key}: [{low}, {high}]");
    }
}
