//! An arm whose walls are added until a statistic is known well enough: the same walls and bytes for any threads and after kills.

use std::fs;

use serde_json::Value;

use crate::fixture::{Folder, changed, stderr};
use crate::threads::results;

/// The random arm goes on until its mean is known to so much.
fn until(below: &str) -> String {
    changed(
        "members = 8",
        &format!("members = {{ until = \"half_width\", of = \"mean\", below = {below}, at_most = 100 }}"),
    )
}

fn run(folder: &Folder, more: &[&str]) -> String {
    let output = folder.pirca(&[&["run", "studies/tiny"], more].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    stderr(&output)
}

fn summary(folder: &Folder, out: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.path(out).join("summary.json")).unwrap()).unwrap()
}

#[test]
fn an_arm_stops_at_the_first_look_that_is_narrow_enough_and_says_so() {
    // The mean displacement of these walls scatters by a few percent.
    let folder = Folder::with_study(&until("0.05"));
    run(&folder, &["--out", "out", "--threads", "2"]);
    let found = summary(&folder, "out");
    for arm in found["arms"].as_array().unwrap().iter().filter(|arm| arm["arm"] == "random") {
        let enough = &arm["enough"];
        assert_eq!(
            (&enough["of"], &enough["reached"], &enough["at_most"]),
            (&"mean".into(), &true.into(), &100.into())
        );
        assert!(enough["half_width"].as_f64().unwrap() < 0.05);
        // The interval that allows for all looks is the only one that is given.
        assert_eq!(enough["ci"], arm["mean_ci"]);
        assert_eq!(enough["value"], arm["mean"]);
        let members = arm["members"].as_u64().unwrap();
        assert!(members == 20 || members == 30, "{members}");
    }
    assert!(found["arms"][0].get("enough").is_none(), "the number of the regular arm is fixed");
    for threads in ["1", "7"] {
        run(&folder, &["--out", threads, "--threads", threads]);
        assert!(results(&folder, threads) == results(&folder, "out"));
    }
    // What a kill leaves of the record, and a record of more walls than are needed, end in the same bytes.
    let path = folder.path("out/journal.jsonl");
    let journal = fs::read(&path).unwrap();
    fs::create_dir(folder.path("killed")).unwrap();
    fs::write(folder.path("killed/journal.jsonl"), &journal[..2 * journal.len() / 3]).unwrap();
    run(&folder, &["--out", "killed", "--threads", "2"]);
    assert!(results(&folder, "killed") == results(&folder, "out"));
    folder.write_study(&changed("members = 8", "members = 60"));
    run(&folder, &["--out", "more"]);
    folder.write_study(&until("0.05"));
    let said = run(&folder, &["--out", "more"]);
    assert!(said.contains("arm.random.members.at_most: nothing recorded, 100 asked for"), "{said}");
    assert!(results(&folder, "more") == results(&folder, "out"));
}

#[test]
fn an_arm_that_is_never_known_well_enough_has_all_its_walls_and_says_so() {
    let folder = Folder::with_study(&until("0.0001").replace("at_most = 100", "at_most = 25"));
    let output = folder.pirca(&["run", "studies/tiny", "--out", "out"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("25 walls, the most allowed, are not enough: mean"), "{text}");
    assert_eq!(summary(&folder, "out")["arms"][2]["members"], 25);
    // A number that is asked for takes the place of the rule.
    run(&folder, &["--out", "fixed", "--members", "8"]);
    assert!(summary(&folder, "fixed")["arms"][2].get("enough").is_none());
}

#[test]
fn a_rule_that_cannot_be_followed_is_a_fault() {
    for (rule, said) in [
        ("{ until = \"half_width\", of = \"median\", below = 0.05, at_most = 100 }", "\"quantile-P\""),
        ("{ until = \"half_width\", of = \"quantile-1.5\", below = 0.05, at_most = 100 }", "\"quantile-P\""),
        ("{ until = \"bored\", of = \"mean\", below = 0.05, at_most = 100 }", "one of \"half_width\""),
        ("{ until = \"half_width\", of = \"mean\", below = 0, at_most = 100 }", "above 0 and below 1"),
        ("{ until = \"half_width\", of = \"mean\", below = 0.05 }", "at_most is missing"),
        ("\"many\"", "a whole number within 1 to 1000000, or a table { until = ... }"),
    ] {
        let folder = Folder::with_study(&changed("members = 8", &format!("members = {rule}")));
        let output = folder.pirca(&["check", "studies/tiny"]);
        let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), stderr(&output));
        assert_ne!(output.status.code(), Some(0), "{rule}");
        assert!(text.contains(said), "{rule}: {text}");
    }
    let rule = "members = { until = \"half_width\", of = \"mean\", below = 0.05, at_most = 100 }";
    let folder = Folder::with_study(&changed("members = 1\n", &format!("{rule}\n")));
    let output = folder.pirca(&["check", "studies/tiny"]);
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), stderr(&output));
    assert!(text.contains("a number where nothing is random"), "{text}");
    // A design is laid over a number of walls that is known beforehand.
    let uncertain =
        "[uncertain]\n\"joint.phi_deg\" = { family = \"uniform\", low = 34, high = 36 }\n\n[load]";
    let designed = until("0.05").replace("seed = 7", "seed = 7\ndesign = \"sobol\"");
    folder.write_study(&designed.replace("[load]", uncertain));
    let output = folder.pirca(&["check", "studies/tiny"]);
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), stderr(&output));
    assert_ne!(output.status.code(), Some(0), "{text}");
    assert!(text.contains("this with members = a number"), "{text}");
}
