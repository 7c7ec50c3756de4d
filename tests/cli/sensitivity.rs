//! `pirca sensitivity`: the sources of an arm, what it writes, and that nothing depends on threads or stops.

use std::fs;

use pirca::ensemble::{Row, Task, evaluate, sources};
use pirca::random::{PARTNER, Quantities};
use pirca::stats::{mean, quantile};
use pirca::study::{Study, TakenFrom};
use serde_json::Value;

use crate::commands::stdout;
use crate::fixture::{Folder, stderr};

/// Columns of full-width courses on a tilting table, as rigid blocks: a bed that dips by d towards the downhill side slides at a tilt of
/// phi - d, with all that lies above it. So the wall falls at phi - max d, with phi drawn once per wall and the dips bed by bed.
const COLUMN: &str = include_str!("../peers/column/study.toml");

fn asked(folder: &Folder, arguments: &[&str]) -> (Value, String) {
    let all = [&["sensitivity", "studies/tiny"], arguments].concat();
    let json = folder.pirca(&[&all[..], &["--json"]].concat());
    assert_eq!(json.status.code(), Some(0), "{}", stderr(&json));
    let text = folder.pirca(&all);
    assert_eq!(text.status.code(), Some(0), "{}", stderr(&text));
    (serde_json::from_slice(&json.stdout).unwrap(), stdout(&text))
}

/// Lines are wrapped.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Variance of the largest of so many dips, uniform in (-5, 5) deg, and of the friction angle, uniform in (23, 27) deg.
fn exact(beds: f64) -> [f64; 2] {
    [100.0 * beds / ((beds + 1.0) * (beds + 1.0) * (beds + 2.0)), 16.0 / 12.0]
}

#[test]
fn the_scatter_of_random_columns_comes_from_friction_and_dips_as_in_their_closed_form() {
    let folder = Folder::with_study(&COLUMN.replace("seed = 11", "seed = 11\ndesign = \"sobol\""));
    let (json, text) = asked(&folder, &["--points", "256", "--out", "out"]);
    let groups = json["groups"].as_array().unwrap();
    let names: Vec<&str> = groups.iter().map(|group| group["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["joint.phi_deg", "layout"]);
    assert_eq!(
        (&json["output"], &json["unit"], &json["walls"]),
        (&"collapse_angle".into(), &"deg".into(), &1024.into())
    );
    assert!(json["failed"].as_object().unwrap().is_empty(), "{json}");
    // Six courses have five beds between them that slide, as their base is fixed without a dip.
    let [dips, friction] = exact(5.0);
    let variance = json["variance"].as_f64().unwrap();
    assert!((variance / (dips + friction) - 1.0).abs() < 0.15, "{variance} for {}", dips + friction);
    for (group, own) in groups.iter().zip([friction, dips]) {
        let share = own / (dips + friction);
        for order in ["first", "total"] {
            let [value, low, high] = [0, 1, 2].map(|k| group[order][k].as_f64().unwrap());
            // The sum of two independent parts has no interactions.
            assert!((value - share).abs() < 0.12, "{} {order}: {value} for {share}", group["name"]);
            assert!(low < value && value < high && high - low < 0.6, "{low} {value} {high}");
        }
    }
    let conclusion: Vec<&str> = text.lines().take_while(|line| !line.is_empty()).collect();
    assert!(
        conclusion.len() <= 5 && text.contains("Responsible in all, with interactions: layout"),
        "{text}"
    );
    for file in ["json", "csv", "svg", "png", "parquet"] {
        assert!(folder.path(format!("out/sensitivity.{file}")).is_file(), "{file}");
    }
    assert_eq!(fs::read_to_string(folder.path("out/sensitivity.csv")).unwrap().lines().count(), 3);
}

/// With friction fixed, all of the scatter is that of the layout, whatever the estimates are.
#[test]
fn the_only_source_is_responsible_for_all_of_it_exactly() {
    let start = COLUMN.find("[uncertain]").unwrap();
    let end = COLUMN.find("[load]").unwrap();
    let folder = Folder::with_study(&format!("{}{}", &COLUMN[..start], &COLUMN[end..]));
    let (json, text) = asked(&folder, &["--points", "32", "--out", "out"]);
    let group = &json["groups"][0];
    let all = serde_json::json!([1.0, 1.0, 1.0]);
    assert_eq!((&group["name"], &group["first"], &group["total"]), (&"layout".into(), &all, &all));
    assert_eq!((&group["is_exact"], &json["points_wanted"]), (&true.into(), &Value::Null));
    assert_ne!(group["estimated_total"][0], 1.0);
    assert!(text.contains("All of it comes from layout, the only source (100 % by definition)."), "{text}");
    assert!(!text.contains("Alone they are"), "{text}");
}

/// Shares that few points tell are possible ones, and it is said how poorly they are known and how many points would do.
#[test]
fn few_points_are_warned_of_and_their_shares_can_be() {
    let folder = Folder::with_study(COLUMN);
    let few = ["--points", "32", "--out", "out"];
    let (json, text) = asked(&folder, &few);
    let of = |group: &Value, order: &str| group[order][0].as_f64().unwrap();
    let groups = json["groups"].as_array().unwrap();
    let firsts: f64 = groups.iter().map(|group| of(group, "first")).sum();
    assert!(firsts <= 1.0 + 1e-9 && json["alone"][0].as_f64().unwrap() <= 1.0, "{json}");
    for (group, other) in [(&groups[0], &groups[1]), (&groups[1], &groups[0])] {
        let (first, total) = (of(group, "first"), of(group, "total"));
        assert!((0.0..=total + 1e-9).contains(&first) && total <= 1.0, "{group}");
        // Of two sources, what one is not responsible for alone is the total of the other.
        assert!((total + of(other, "first") - 1.0).abs() < 1e-6, "{json}");
        for order in ["first", "total"] {
            let [value, low, high] = [0, 1, 2].map(|k| group[order][k].as_f64().unwrap());
            assert!(0.0 <= low && low <= value && value <= high && high <= 1.0, "{group}");
        }
    }
    let half = json["half_width"].as_f64().unwrap();
    let wanted = json["points_wanted"].as_u64().unwrap();
    assert!(half > 0.25 && wanted.is_multiple_of(16), "{half} {wanted}");
    let exact = 32.0 * (half / 0.1) * (half / 0.1);
    assert!((exact..=exact + 16.0).contains(&(wanted as f64)), "{wanted} for {exact}");
    assert!(one_line(&text).contains(&format!("with about {wanted} points (--points)")), "{text}");
    let warned = folder.pirca(&[&["sensitivity", "studies/tiny"], &few[..]].concat());
    assert!(stderr(&warned).contains("warning: --points 32: too few."), "{}", stderr(&warned));
}

#[test]
fn nothing_depends_on_threads_or_on_a_stop() {
    let folder = Folder::with_study(COLUMN);
    let (first, _) = asked(&folder, &["--points", "32", "--out", "one", "--threads", "1"]);
    asked(&folder, &["--points", "32", "--out", "two", "--threads", "2"]);
    let files = ["json", "csv", "svg", "png", "parquet"];
    let bytes = |out: &str, file: &str| fs::read(folder.path(format!("{out}/sensitivity.{file}"))).unwrap();
    for file in files {
        assert!(bytes("one", file) == bytes("two", file), "{file}");
    }
    // Half of it is lost and the last line torn; more points go on from what is left.
    let kept = fs::read_to_string(folder.path("two/sensitivity.jsonl")).unwrap();
    fs::write(folder.path("two/sensitivity.jsonl"), &kept[..kept.len() / 2]).unwrap();
    assert_eq!(asked(&folder, &["--points", "32", "--out", "two"]).0, first);
    let lines = || fs::read_to_string(folder.path("two/sensitivity.jsonl")).unwrap().lines().count();
    let before = lines();
    asked(&folder, &["--points", "48", "--out", "two"]);
    assert_eq!(lines() - before, 16 * 4);
    // Another study is refused.
    folder.write_study(
        &COLUMN.replace("phi_deg = 25", "phi_deg = 26").replace("kn_over_ks = 2", "kn_over_ks = 3"),
    );
    let other = folder.pirca(&["sensitivity", "studies/tiny", "--points", "32", "--out", "two"]);
    assert_eq!(other.status.code(), Some(1), "{}", stderr(&other));
    assert!(stderr(&other).contains("sensitivity.jsonl is of another study"), "{}", stderr(&other));
}

#[test]
fn walls_without_a_value_are_counted_and_what_cannot_be_asked_is_said() {
    // One in four columns stands to the end of the path.
    let folder = Folder::with_study(&COLUMN.replace("end_deg = 45", "end_deg = 23"));
    let (json, text) = asked(&folder, &["--points", "32", "--out", "out"]);
    let stood = json["failed"]["stood_to_the_end"].as_u64().unwrap();
    assert!(
        stood > 10 && one_line(&text).contains(&format!("{stood} without a value: {stood} stood to the end")),
        "{text}"
    );
    assert!(json["groups"][0]["points"].as_u64().unwrap() < 32);
    let said = |text: &str, arguments: &[&str], code: i32, what: &str| {
        folder.write_study(text);
        let output = folder.pirca(&[&["sensitivity", "studies/tiny"], arguments].concat());
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(what), "{arguments:?}: {}", stderr(&output));
    };
    said(COLUMN, &["--points", "40"], 2, "allowed is a multiple of 16 from 32");
    said(COLUMN, &["--arm", "wall"], 2, "the study has no such arm; it has column");
    said(COLUMN, &["--point", "1"], 2, "arm column has one kn point");
    let fixed = COLUMN.replace("{ family = \"uniform\", low = -5, high = 5 }", "0");
    let start = fixed.find("[uncertain]").unwrap();
    let end = fixed.find("[load]").unwrap();
    let fixed = format!("{}{}", &fixed[..start], &fixed[end..]);
    said(&fixed, &[], 3, "nothing is drawn in arm column");
}

/// A wall with its partner's dips has these, and all else of its own.
#[test]
fn a_source_taken_from_the_partner_brings_its_numbers_and_no_others() {
    let text =
        COLUMN.replace("height_m = 0.2", "height_m = { family = \"uniform\", low = 0.15, high = 0.25 }");
    let folder = Folder::with_study(&text);
    let study = Study::load(&folder.path("studies/tiny"), None).unwrap().study;
    let sources = sources(&study.arms[0]);
    let names: Vec<(&str, bool)> = sources.iter().map(|own| (own.name.as_str(), own.is_in_layout)).collect();
    assert_eq!(names, [("joint.phi_deg", false), ("layout", false), ("dips", true), ("sizes", true)]);
    let row = |study: &Study, member: u64| evaluate(study, Task { arm: 0, point: 0, member });
    let mixed = |name: &str, k: u64| {
        let quantities: Quantities = sources.iter().find(|own| own.name == name).unwrap().quantities.clone();
        row(&study.clone().with_taken(TakenFrom { quantities, member: k + PARTNER }), k)
    };
    let dips = |row: &Row| row.built.first_dip_sd_deg;
    for k in 0..6 {
        let (own, partner) = (row(&study, k), row(&study, k + PARTNER));
        let with_dips = mixed("dips", k);
        assert_eq!(
            (with_dips.built.height_mean_m, with_dips.drawn),
            (own.built.height_mean_m, own.drawn.clone())
        );
        let with_sizes = mixed("sizes", k);
        assert_eq!(
            (with_sizes.built.height_mean_m, with_sizes.drawn),
            (partner.built.height_mean_m, own.drawn.clone())
        );
        let layout = mixed("layout", k);
        assert_eq!(
            (dips(&layout), layout.built.height_mean_m),
            (dips(&partner), partner.built.height_mean_m)
        );
        assert_eq!(layout.drawn, own.drawn);
        assert_eq!(mixed("joint.phi_deg", k).drawn, partner.drawn);
        assert_ne!(own.drawn, partner.drawn);
    }
    let angles: Vec<f64> = (0..20).filter_map(|k| row(&study, k).collapse_angle_deg()).collect();
    assert!(angles.len() == 20 && mean(&angles) < quantile(&angles, 1.0));
}
