//! `[sweep]`: a key with several values, each an arm of its own.

use std::fs;

use serde_json::Value;

use crate::fixture::{Folder, stderr};
use crate::homogenise::STUDY;

fn run(study: &str, more: &[&str]) -> (Folder, Value) {
    let folder = Folder::with_study(study);
    let run = folder.pirca(&[&["run", "studies/tiny", "--out", "out", "--json"], more].concat());
    assert!(run.status.success(), "{}", stderr(&run));
    (folder, serde_json::from_slice(&run.stdout).unwrap())
}

fn names(summary: &Value) -> Vec<&str> {
    summary["arms"].as_array().unwrap().iter().map(|arm| arm["arm"].as_str().unwrap()).collect()
}

/// The mean of an arm, and what its walls came to.
fn mean(summary: &Value, arm: &str) -> Value {
    let arms = summary["arms"].as_array().unwrap();
    arms.iter().find(|own| own["arm"] == arm).unwrap_or_else(|| panic!("{arm}"))["mean"].clone()
}

#[test]
fn every_value_is_an_arm_with_the_walls_of_a_study_that_sets_it() {
    let (folder, summary) = run(&format!("{STUDY}\n[sweep]\n\"joint.phi_deg\" = [15, 32.5]\n"), &[]);
    assert_eq!(
        names(&summary),
        ["regular-phi_deg-15", "regular-phi_deg-32_5", "random-phi_deg-15", "random-phi_deg-32_5"]
    );
    assert_eq!(summary["sweep"][3]["of"], "random");
    assert_eq!(summary["sweep"][3]["settings"][0]["number"], 32.5);
    for (value, arm) in [("15", "phi_deg-15"), ("32.5", "phi_deg-32_5")] {
        let (_, alone) = run(STUDY, &["--variant", &format!("joint.phi_deg={value}")]);
        for kind in ["regular", "random"] {
            assert_eq!(mean(&summary, &format!("{kind}-{arm}")), mean(&alone, kind), "{kind} {value}");
        }
    }
    assert_ne!(mean(&summary, "random-phi_deg-15"), mean(&summary, "random-phi_deg-32_5"));
    let table = fs::read_to_string(folder.path("out/sweep.csv")).unwrap();
    assert!(table.starts_with("arm,made_from,joint.phi_deg,kn_pa_per_m,walls_in_mean,mean_"), "{table}");
    assert!(
        table.lines().any(|line| line.starts_with("random-phi_deg-32_5,random,32.5,1000000000,5,")),
        "{table}"
    );
    let figure = fs::read_to_string(folder.path("out/sweep.svg")).unwrap();
    assert!(figure.contains("friction angle (deg)") && figure.contains("regular"));
    assert!(folder.path("out/sweep.png").exists());
}

#[test]
fn keys_are_crossed_and_one_of_an_arm_leaves_the_others() {
    let sweep = "[sweep]\njoint.phi_deg = [25, 32]\n\"arm.random.dip_deg\" = [0, { family = \"uniform\", low = -10, high = 10 }]\n";
    let only = STUDY.replace("seed = 3", "seed = 3\narms = [\"random\"]");
    let (folder, summary) = run(&format!("{only}\n{sweep}"), &["--variant", "arm.random.members=2"]);
    // A distribution makes no name.
    assert_eq!(
        names(&summary),
        ["random-dip_deg-0-phi_deg-25", "random-dip_deg-0-phi_deg-32", "random-3", "random-4"]
    );
    assert!(summary["arms"].as_array().unwrap().iter().all(|arm| arm["members"] == 2));
    // Dips are no numbers: the figure is over the angle of friction, with a curve for each dip.
    let figure = fs::read_to_string(folder.path("out/sweep.svg")).unwrap();
    assert!(figure.contains("friction angle (deg)") && figure.contains("random, dip_deg 0"), "{figure}");
}

#[test]
fn values_of_kn_are_points_of_every_arm() {
    let (one, _) = run(&format!("{STUDY}\n[sweep]\n\"joint.kn_pa_per_m\" = [1e8, 1e9]\n"), &[]);
    let (other, _) = run(&STUDY.replace("[1e9]", "[1e8, 1e9]"), &[]);
    for file in ["summary.json", "members.parquet"] {
        let [one, other] = [&one, &other].map(|folder| fs::read(folder.path("out").join(file)).unwrap());
        assert!(one == other, "{file}");
    }
}

#[test]
fn what_cannot_be_swept_is_refused_by_its_line() {
    for (sweep, said) in [
        (
            "\"load.step_deg\" = [1, 2]",
            "a key of [wall], [block], [joint], [restraint], [mechanism], [uncertain], or arm.<name>.<key>",
        ),
        ("\"joint.phi\" = [1, 2]", "sets what does not exist"),
        ("\"joint.phi_deg\" = 25", "a list of values for each key"),
        ("\"joint.phi_deg\" = []", "a list of values for each key"),
        ("\"joint.phi_deg\" = [25, 30, 25]", "has 25 twice"),
        ("\"joint.phi_deg\" = [25, 95]", "joint.phi_deg"),
        ("\"arm.randon.dip_deg\" = [0]", "one of regular, random"),
        ("\"arm.regular.dip_deg\" = [0]", "dip_deg"),
        (
            "\"joint.phi_deg\" = [1]\n\"wall.length_m\" = [1]\n\"wall.height_m\" = [1]\n\"joint.cohesion_pa\" = [1]",
            "has 4 keys",
        ),
    ] {
        let folder = Folder::with_study(&format!("{STUDY}\n[sweep]\n{sweep}\n"));
        let run = folder.pirca(&["check", "studies/tiny"]);
        assert_eq!(run.status.code(), Some(3), "{sweep}");
        let text = stderr(&run);
        assert!(text.contains(said) && text.contains("study.toml:"), "{sweep}: {text}");
    }
}
