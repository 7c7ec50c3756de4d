//! What is drawn once per wall: `[uncertain]` and its faults, what each wall drew, and designs.

use std::path::Path;

use pirca::ensemble::{Row, Task, evaluate};
use pirca::random::Streams;
use pirca::study::{Loaded, Study, parameters};
use polars::prelude::*;
use polars_io::SerReader;
use polars_io::prelude::ParquetReader;
use serde_json::Value;

use crate::fixture::{Folder, STUDY, changed, stderr};

/// The small study at one stiffness, with tables put before its arms.
fn with(tables: &str) -> String {
    let one = changed("kn_pa_per_m = [5e7, 1.75e8]", "kn_pa_per_m = [5e7]");
    one.replacen("[[arm]]", &format!("{tables}\n[[arm]]"), 1)
}

fn loaded(text: &str) -> Result<Loaded, String> {
    let folder = Folder::with_study(text);
    Study::load(Path::new(&folder.path("studies/tiny")), None).map_err(|faults| faults.to_string())
}

fn rows(text: &str) -> Vec<Row> {
    let study = loaded(text).unwrap_or_else(|faults| panic!("{faults}")).study;
    (0..4).map(|member| evaluate(&study, Task { arm: 1, point: 0, member })).collect()
}

const PHI: &str = r#"[uncertain]
"joint.phi_deg" = { family = "uniform", low = 30, high = 40 }
"#;
const DENSITY: &str = r#""block.density_kg_per_m3" = { family = "lognormal", mean = 2400, sd = 200 }
"#;

#[test]
fn a_parameter_is_one_uniform_of_its_own_stream_and_changes_no_other_draw() {
    let (plain, one, two) = (rows(&with("")), rows(&with(PHI)), rows(&with(&format!("{PHI}{DENSITY}"))));
    for (member, ((plain, one), two)) in plain.iter().zip(&one).zip(&two).enumerate() {
        let u = Streams::new(7, member as u64).of("uncertain joint.phi_deg").uniform();
        assert_eq!(one.drawn["joint.phi_deg"], 30.0 + 10.0 * u);
        assert_eq!(two.drawn["joint.phi_deg"], one.drawn["joint.phi_deg"]);
        assert!(plain.drawn.is_empty() && one.drawn.len() == 1 && two.drawn.len() == 2);
        let stones = |row: &Row| {
            (
                row.built.stones,
                row.built.length_mean_m,
                row.built.height_mean_m,
                row.built.dip_sd_deg,
                row.built.redraws,
            )
        };
        assert_eq!(stones(plain), stones(one));
        assert_eq!(stones(plain), stones(two));
        assert_eq!(plain.built.weight_n, one.built.weight_n);
        let ratio = two.built.weight_n.unwrap() / plain.built.weight_n.unwrap();
        assert!((ratio - two.drawn["block.density_kg_per_m3"] / 2400.0).abs() < 1e-12, "{ratio}");
    }
    // The load, and the number that it stands for, are drawn as well.
    let load = r#"[uncertain]
"load.mean_pressure_pa" = { family = "uniform", low = 100, high = 300 }
"#;
    for (plain, loaded) in plain.iter().zip(rows(&with(load))) {
        let factor = loaded.drawn["load.mean_pressure_pa"] / 200.0;
        let ratio = loaded.top_displacement_m().unwrap() / plain.top_displacement_m().unwrap();
        // A wall with closed joints answers in proportion, and one whose joints open by more.
        assert!((ratio > 1.0) == (factor > 1.0), "{factor} {ratio}");
    }
}

#[test]
fn a_wall_is_the_same_however_its_stiffness_is_said_to_scatter() {
    let scatter = "[mechanism.specimen_scatter]\nkn_cov = 0.3\nfriction_cov = 0\n";
    let kn = "[uncertain]\n\"joint.kn_pa_per_m\" = { family = \"lognormal\", mean = 5e7, sd = 1.5e7 }\n";
    for (one, other) in rows(&with(scatter)).iter().zip(rows(&with(kn))) {
        let [a, b] = [one, &other].map(|row| row.top_displacement_m().unwrap());
        assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
        assert_ne!(other.drawn["joint.kn_pa_per_m"], 5e7);
        assert_eq!(other.kn_pa_per_m, 5e7);
    }
    let study = loaded(&with(scatter)).unwrap().study;
    assert_eq!(parameters(&study.arms).iter().map(|own| own.key).collect::<Vec<_>>(), ["joint.kn_pa_per_m"]);
}

#[test]
fn what_cannot_be_drawn_is_said_with_its_place_and_how_to_mend_it() {
    let kn = "\"joint.kn_pa_per_m\" = ";
    let cases: &[(&str, &[&str])] = &[
        // What is at fault, and where.
        (
            &format!("[uncertain]\n{kn}{{ family = \"normal\", mean = 5e7, sd = 3e7 }}\n"),
            &[
                "study.toml:35: uncertain.joint.kn_pa_per_m",
                "a distribution above 0 (Pa/m)",
                "truncate or shift it",
            ],
        ),
        (
            &format!("[uncertain]\n{kn}{{ family = \"lognormal\", mean = -5e7, sd = 3e7 }}\n"),
            &["study.toml:35: uncertain.joint.kn_pa_per_m.mean = -5e7"],
        ),
        (&format!("[uncertain]\n{kn}6e7\n"), &["a number belongs where the study states it"]),
        (
            "[uncertain]\n\"joint.phi_degrees\" = 3\n",
            &["is not a known key", "did you mean \"joint.phi_deg\"?"],
        ),
        (
            "[uncertain]\njoint.phi_deg = { family = \"uniform\", low = 30, high = 40 }\n",
            &["uncertain.joint is a part of a path", "write the whole path in quotes, as \"joint.<key>\""],
        ),
        (
            &format!("{PHI}[mechanism.specimen_scatter]\nkn_cov = 0.2\nfriction_cov = 0.1\n"),
            &["study.toml:35: uncertain.joint.phi_deg is drawn here, and by mechanism.specimen_scatter"],
        ),
        (
            "[uncertain]\n\"mechanism.lean.angle_deg\" = { family = \"uniform\", low = -1, high = 1 }\n",
            &["has no single number to take the place of", "state one number there, or remove"],
        ),
        (
            "[uncertain]\n\"load.vertical_load_n\" = { family = \"uniform\", low = 1, high = 2 }\n",
            &["uncertain.load.vertical_load_n is drawn here, and has no single number"],
        ),
    ];
    for (tables, words) in cases {
        let faults = loaded(&with(tables)).expect_err(tables);
        for word in *words {
            assert!(faults.contains(word), "{tables}: no `{word}` in {faults}");
        }
        assert!(faults.starts_with("1 fault in"), "{faults}");
    }
    // Two stiffnesses are no single number, and a distribution is none.
    let kn = "[uncertain]\n\"joint.kn_pa_per_m\" = { family = \"lognormal\", mean = 5e7, sd = 1e7 }\n[[arm]]";
    let faults = loaded(&STUDY.replacen("[[arm]]", kn, 1)).expect_err("two points");
    assert!(faults.contains("one number at joint.kn_pa_per_m, which is drawn nowhere else"), "{faults}");
    let twice = with(PHI).replace("phi_deg = 35", "phi_deg = { family = \"uniform\", low = 30, high = 40 }");
    let faults = loaded(&twice).expect_err("drawn twice");
    assert!(
        faults.contains("has no single number to take the place of") && faults.starts_with("1 fault"),
        "{faults}"
    );
    // An arm that states a number of its own draws it itself, or not at all.
    let own =
        with(PHI).replace("course_height_m = 0.1\n", "course_height_m = 0.1\n[arm.joint]\nphi_deg = 33\n");
    let faults = loaded(&own).expect_err("stated twice");
    assert!(faults.contains("arm.stack.joint.phi_deg is stated here, and drawn in the study's"), "{faults}");
    let drawn = own.replace(
        "phi_deg = 33\n",
        "phi_deg = 33\n[arm.uncertain]\n\"joint.phi_deg\" = { family = \"uniform\", low = 20, high = 21 }\n",
    );
    let study = loaded(&drawn).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert!(evaluate(&study, Task { arm: 0, point: 0, member: 0 }).drawn["joint.phi_deg"] < 21.0);
}

#[test]
fn a_variant_may_draw_and_what_each_wall_drew_is_in_the_table() {
    let variant = "[[variant]]\nname = \"unsure\"\nwhy = \"Nobody tested the joints.\"\n[variant.set]\n\
                   \"uncertain.joint.phi_deg\" = \"joint/friction:dry-stone\"\n";
    let folder = Folder::with_study(&format!("{}\n{variant}", with("")));
    let entry = "quantity = \"friction angle\"\nsymbol = \"phi\"\nunit = \"deg\"\n[dry-stone]\nfamily = \"uniform\"\nlow = 31\n\
                 high = 39\nstatus = \"assumed\"\nsource = \"a test\"\n";
    std::fs::create_dir_all(folder.path("distributions/joint")).unwrap();
    std::fs::write(folder.path("distributions/joint/friction.toml"), entry).unwrap();
    let run = folder.pirca(&["run", "studies/tiny", "--variant", "unsure", "--out", "out", "--json"]);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let file = std::fs::File::open(folder.path("out/members.parquet")).unwrap();
    let table: DataFrame = ParquetReader::new(file).finish().unwrap();
    let drawn = table.column("drawn joint.phi_deg").unwrap().f64().unwrap();
    assert_eq!(drawn.len(), 9);
    assert!(drawn.iter().all(|x| x.is_some_and(|x| 31.0 < x && x < 39.0)));
    // Without it, nothing is drawn.
    let run = folder.pirca(&["run", "studies/tiny", "--out", "plain", "--json"]);
    let summary: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert!(summary["arms"][1]["parameters"].get("uncertain").is_none());
    let measured = folder.pirca(&["detectability", "studies/tiny", "--variant", "unsure"]);
    assert_eq!(measured.status.code(), Some(3), "{}", stderr(&measured));
    assert!(stderr(&measured).contains("take a variant without it"), "{}", stderr(&measured));
}

#[test]
fn a_design_covers_what_is_drawn_once_per_wall_and_its_intervals_rest_on_randomisations() {
    let designed = |design: &str| {
        with(PHI)
            .replace("seed = 7", &format!("seed = 7\ndesign = \"{design}\""))
            .replace("members = 8", "members = 64")
    };
    for design in ["latin_hypercube", "sobol"] {
        let study = loaded(&designed(design)).unwrap_or_else(|faults| panic!("{faults}")).study;
        for randomisation in [0, 7] {
            let drawn = |k: u64| study.as_drawn(1, 16 * k + randomisation).values["joint.phi_deg"];
            let mut quarters: Vec<u32> = (0..4).map(|k| ((drawn(k) - 30.0) / 2.5) as u32).collect();
            quarters.sort_unstable();
            assert_eq!(quarters, [0, 1, 2, 3], "{design}");
        }
        // The stones are those of the plain design.
        let plain = loaded(&designed("plain")).unwrap().study;
        assert_eq!(
            study.streams(5).of("stone length 0").uniform(),
            plain.streams(5).of("stone length 0").uniform()
        );
        assert_ne!(study.as_drawn(1, 5).values, plain.as_drawn(1, 5).values);
    }
    let folder = Folder::with_study(&designed("sobol"));
    let run = folder.pirca(&["run", "studies/tiny", "--out", "out", "--json"]);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let summary: Value = serde_json::from_slice(&run.stdout).unwrap();
    let arm = &summary["arms"][1];
    assert!(arm["mean_ci"][0].as_f64().unwrap() < arm["mean"].as_f64().unwrap());
    assert!(arm["sigma_bootstrap_ci"].is_null() && arm["quantiles"][1]["ci"][0].is_f64());
    let refused = folder.pirca(&["run", "studies/tiny", "--members", "50", "--out", "other"]);
    assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
    assert!(stderr(&refused).contains("a multiple of 16 from 32"), "{}", stderr(&refused));
    let capacity = folder.pirca(&["capacity", "studies/tiny"]);
    assert_eq!(capacity.status.code(), Some(3), "{}", stderr(&capacity));
    assert!(stderr(&capacity).contains("study.design = \"plain\""), "{}", stderr(&capacity));
    let faults =
        loaded(&with("").replace("seed = 7", "seed = 7\ndesign = \"sobol\"")).expect_err("nothing drawn");
    assert!(faults.contains("plain where nothing is drawn once per wall"), "{faults}");
    let uneven = designed("sobol").replace("members = 64", "members = 24");
    assert!(loaded(&uneven).expect_err("uneven").contains("as many walls in every arm"), "uneven");
}
