//! The catalogue of mechanisms: table, keys and priors agree; a study switches them on; the verb prints them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use pirca::math::{radians, tan};
use pirca::protocol::Compliance;
use pirca::study::{
    Acts, CAUSES, Cause, InLimitAnalysis, Mechanisms, Unloading, described, key_reference, load_distributions,
};

use crate::scratch::{STUDY, Scratch};

fn distributions() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions")
}

#[test]
fn the_table_the_keys_and_the_priors_agree() {
    let all = described(&distributions()).unwrap_or_else(|lacks| panic!("{lacks}"));
    assert_eq!(all.len(), CAUSES.len());
    let reference = key_reference();
    let mut priors = BTreeSet::new();
    for mechanism in &all {
        let name = mechanism.name;
        assert!(reference.contains(&format!("## `[mechanism.{name}]`")), "{name} has no keys");
        assert!(!mechanism.what.is_empty() && !mechanism.parameters.is_empty(), "{name}");
        assert!(!mechanism.confounded_with.is_empty(), "{name} is said to be like nothing");
        for other in mechanism.confounded_with {
            // Another mechanism, or a key of the base model by its path.
            let key = other.rsplit('.').next().unwrap_or(other);
            let known = all.iter().any(|m| m.name == *other) || reference.contains(&format!("| `{key}` |"));
            assert!(known && *other != name, "{name} is confounded with {other}");
        }
        for parameter in &mechanism.parameters {
            assert!(reference.contains(&format!("| `{}` |", parameter.key)), "{name}.{}", parameter.key);
            priors.insert(format!("mechanism/{name}/{}", parameter.key));
        }
    }
    // Confounding is mutual where it is between mechanisms.
    for (mechanism, other) in all.iter().flat_map(|m| m.confounded_with.iter().map(move |o| (m, o))) {
        let Some(other) = all.iter().find(|m| m.name == *other) else { continue };
        assert!(other.confounded_with.contains(&mechanism.name), "{} and {}", mechanism.name, other.name);
    }
    let files = load_distributions(&distributions()).unwrap_or_else(|faults| panic!("{faults}"));
    let there: BTreeSet<String> =
        files.keys().filter(|name| name.starts_with("mechanism/")).cloned().collect();
    assert_eq!(there, priors);
    // Every prior lies where its key allows values: a study of its mean and of its quartiles is sound.
    let others = [["joint_closure", "bearing_points"], ["stress_stiffening", "contact_area"]];
    for (at, others) in [0.25, 0.5, 0.75].into_iter().zip(others.into_iter().cycle()) {
        // One law for the closure of a joint at a time, and one part of its face that touches.
        // The base of this wall does not move.
        let of_motions = ["worn_bearing", "heading", "motion_scale", "restitution"];
        let is_here = |name: &str| !others.contains(&name) && !of_motions.contains(&name);
        let tables = all.iter().filter(|m| is_here(m.name)).map(|m| {
            let value = |p: &pirca::study::Parameter| {
                let x = if p.prior.sd() == 0.0 { p.prior.mean() } else { p.prior.quantile(at) };
                format!("{} = {x:?}\n", p.key)
            };
            // Half of the priors of factors lie below 1: this wall's sizes may be narrowed, not widened beyond 0.
            format!("[mechanism.{}]\n{}", m.name, m.parameters.iter().map(value).collect::<String>())
        });
        let scratch = tilting(&format!("priors-{at}"));
        append(&scratch, &tables.collect::<String>());
        scratch.load(None).unwrap_or_else(|faults| panic!("{faults}"));
    }
}

/// The fixture's study on a tilting table with ropes.
fn tilting(name: &str) -> Scratch {
    let scratch = Scratch::new(name);
    let text = scratch.read(STUDY);
    let (before, rest) = text.split_once("[load]").expect("the fixture has a load");
    let (_, after) = rest.split_once("\n\n").expect("something follows it");
    let text = format!("{before}[load]\nprotocol = \"tilting\"\n\n{after}");
    let roped = text.replace(
        "ends = \"joint_springs\"\n",
        "ends = \"ropes\"\n\n[restraint.rope]\nstiffness_n_per_m = 1e6\n",
    );
    // The fixture's variant samples joints at their corners, where there are no patches.
    let roped = roped.replace("\"joint.sampling\" = \"vertices\"", "\"joint.kn_over_ks\" = 3");
    scratch.write(STUDY, roped.as_bytes());
    scratch
}

/// Adds tables before the arms, as top-level tables must stand.
fn append(scratch: &Scratch, tables: &str) {
    scratch.replace(STUDY, "[[arm]]", &format!("{tables}\n[[arm]]"));
}

const ALL: &str = "
[mechanism.contact_inset]
radius_m = 0.003
[mechanism.joint_closure]
initial_pa_per_m = 1e7
closure_m = 1e-4
[mechanism.contact_area]
share = 0.5
[mechanism.friction]
factor = 0.9
residual_share = 0.8
slip_distance_m = 0.001
[mechanism.cohesion]
added_pa = 100
[mechanism.lean]
angle_deg = 1
[mechanism.base_compliance]
settlement_n_per_m = 5e6
rotation_n_m_per_rad = 5e4
[mechanism.wedge_loss]
share = 0.25
beyond_deg = 7
[mechanism.rope_slack]
added_m = 0.002
[mechanism.size_scatter]
factor = 1.1
[mechanism.density]
factor = 1.05
[mechanism.gauge_offset]
offset_m = 0.001
[mechanism.gauge_scale]
factor = 1.02
[mechanism.creep]
rate_per_deg = 0.01
hold_share = 0.05
[mechanism.specimen_scatter]
kn_cov = 0.3
friction_cov = 0.05
[mechanism.end_release]
within_m = 0.2
friction_share = 0.5
stiffness_share = 0.4
[mechanism.platform_friction]
phi_deg = 20
[mechanism.bedding]
stiffness_share = 0.3
";

#[test]
fn a_study_switches_all_of_them_on() {
    let scratch = tilting("all-mechanisms");
    let without = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert!(without.arms.iter().all(|arm| arm.mechanisms == Mechanisms::default()));
    append(&scratch, ALL);
    let study = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    let values: [(&str, &[f64]); 18] = [
        ("contact_inset", &[0.003]),
        ("joint_closure", &[1e7, 1e-4]),
        ("contact_area", &[0.5]),
        ("friction", &[0.9, 0.8, 0.001]),
        ("cohesion", &[100.0]),
        ("lean", &[1.0]),
        ("base_compliance", &[5e6, 5e4]),
        ("wedge_loss", &[0.25, 7.0]),
        ("rope_slack", &[0.002]),
        ("size_scatter", &[1.1]),
        ("density", &[1.05]),
        ("gauge_offset", &[0.001]),
        ("gauge_scale", &[1.02]),
        ("creep", &[0.01, 0.05, 5.0]),
        ("specimen_scatter", &[0.3, 0.05]),
        ("end_release", &[0.2, 0.5, 0.4]),
        ("platform_friction", &[20.0]),
        ("bedding", &[0.3]),
    ];
    let expected = values.iter().fold(Mechanisms::default(), |all, (name, values)| all.with(name, values));
    assert!(study.arms.iter().all(|arm| arm.mechanisms == expected), "{:?}", study.arms[0].mechanisms);
    assert_eq!(study.arms[0].layout.density.mean(), 1.05 * without.arms[0].layout.density.mean());
    assert_ne!(study.hash, without.hash);
    // Those that act on layout and restraint are in these.
    let compliance = Compliance { settlement: 5e6, rotation: 5e4 };
    assert_eq!(study.arms[0].restraint.base.compliance, Some(compliance));
    assert_eq!(study.arms[0].restraint.base.tan_phi, Some(tan(radians(20.0))));
    let pirca::protocol::Ends::Ropes(rope) = study.arms[0].restraint.ends else {
        panic!("the ends are ropes")
    };
    assert_eq!(rope.slack, 0.002);
}

#[test]
fn stiffness_that_grows_with_the_stress_has_a_floor_of_its_own() {
    let scratch = tilting("stiffening");
    append(&scratch, "[mechanism.stress_stiffening]\nat_1_mpa_pa_per_m = 2e9\nexponent = 0.5\n");
    let study = scratch.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    let expected = Mechanisms::default().with("stress_stiffening", &[2e9, 0.5, 1e6]);
    assert!(study.arms.iter().all(|arm| arm.mechanisms == expected), "{:?}", study.arms[0].mechanisms);
}

#[test]
fn an_arm_or_a_variant_has_mechanisms_of_its_own() {
    let scratch = tilting("one-arm");
    append(&scratch, "[mechanism.lean]\nangle_deg = 1\n[mechanism.density]\nfactor = 1.1\n");
    let text = scratch.read(STUDY);
    let (head, tail) = text.split_once("name = \"running\"\n").expect("the fixture has that arm");
    let own = "mechanism = { lean = { angle_deg = 2 }, gauge_scale = { factor = 0.9 } }\n";
    scratch.write(STUDY, format!("{head}name = \"running\"\n{own}{tail}").as_bytes());
    scratch.replace(STUDY, "\"joint.kn_over_ks\" = 3", "\"arm.stack.mechanism.cohesion.added_pa\" = 50");
    let of = |variant: Option<&str>, name: &str| {
        let study = scratch.load(variant).unwrap_or_else(|faults| panic!("{faults}")).study;
        study.arms.into_iter().find(|arm| arm.name == name).expect("it has the arm").mechanisms
    };
    let shared = Mechanisms::default().with("lean", &[1.0]).with("density", &[1.1]);
    assert_eq!(of(None, "stack"), shared);
    let running = shared.clone().with("lean", &[2.0]).with("gauge_scale", &[0.9]);
    assert_eq!(of(None, "running"), running);
    assert_eq!(of(Some("corners"), "stack"), shared.with("cohesion", &[50.0]));
    assert_eq!(of(Some("corners"), "running"), running);
}

#[test]
fn what_does_not_go_together_is_refused_by_name() {
    for (case, (tables, from, to, said)) in [
        (
            "[mechanism.creep]\nrate_per_deg = 0.1\n[mechanism.base_compliance]\nsettlement_n_per_m = 1e6\nrotation_n_m_per_rad = 1e4\n[mechanism.joint_closure]\ninitial_pa_per_m = 1e7\nclosure_m = 1e-4\n",
            "agreement = false",
            "agreement = true",
            "solver.agreement asks limit analysis about base_compliance: rigid blocks stand on rigid ground; creep: limit \
             analysis knows no history; joint_closure: rigid blocks have joints without closure",
        ),
        (
            "[mechanism.stress_stiffening]\nat_1_mpa_pa_per_m = 1e9\nexponent = 0.5\n",
            "agreement = false",
            "agreement = true",
            "solver.agreement asks limit analysis about stress_stiffening: rigid blocks have joints without closure",
        ),
        (
            "[mechanism.stress_stiffening]\nat_1_mpa_pa_per_m = 1e9\nexponent = 0.5\n[mechanism.joint_closure]\ninitial_pa_per_m = 1e7\nclosure_m = 1e-4\n",
            "seed = 7",
            "seed = 8",
            "mechanism.stress_stiffening does not go with mechanism.joint_closure",
        ),
        (
            "[mechanism.stress_stiffening]\nat_1_mpa_pa_per_m = 1e9\nexponent = 1.5\n",
            "seed = 7",
            "seed = 8",
            "mechanism.stress_stiffening.exponent = 1.5: allowed is a number within 0.1 to 1",
        ),
        ("[mechanism.rope_slack]\nadded_m = 0.001\n", "ends = \"ropes\"\n\n[restraint.rope]\nstiffness_n_per_m = 1e6\n", "ends = \"free\"\n", "mechanism.rope_slack has nothing to act on: allowed is an arm whose ends are ropes"),
        ("[mechanism.creep]\nrate_per_deg = 0.1\n", "protocol = \"tilting\"", "protocol = \"lateral\"\nmean_pressure_pa = 1\nbase_over_top = 1", "mechanism.creep has nothing to act on: allowed is a platform that tilts"),
        ("[mechanism.size_scatter]\nfactor = 50\n", "seed = 7", "seed = 8", "mechanism.size_scatter widens"),
        ("[mechanism.creeep]\nrate_per_deg = 0.1\n", "seed = 7", "seed = 8", "mechanism.creeep is not a known key"),
        ("[mechanism.creep]\nrate = 0.1\n", "seed = 7", "seed = 8", "mechanism.creep.rate is not a known key"),
        ("[mechanism.contact_area]\nshare = 0\n", "seed = 7", "seed = 8", "mechanism.contact_area.share = 0: allowed is a number above 0 and at most 1"),
        ("[mechanism.contact_area]\nshare = 0.5\n[mechanism.bearing_points]\npoints = 3\nshare = 0.2\n", "seed = 7", "seed = 8", "mechanism.bearing_points does not go with mechanism.contact_area"),
        ("[mechanism.bearing_points]\npoints = 3\nshare = 0.2\n", "sampling = \"area\"", "sampling = \"vertices\"", "mechanism.bearing_points does not go with joint.sampling = \"vertices\""),
        ("[mechanism.contact_area]\nshare = 0.5\n", "sampling = \"area\"", "sampling = \"vertices\"", "mechanism.contact_area does not go with joint.sampling = \"vertices\""),
    ]
    .into_iter()
    .enumerate()
    {
        let scratch = tilting(&format!("refused-{case}"));
        append(&scratch, tables);
        scratch.replace(STUDY, from, to);
        let faults = scratch.load(None).expect_err(said).to_string();
        assert!(faults.contains(said), "{said}\n{faults}");
    }
    // What limit analysis honours or does not care about goes with it.
    let scratch = tilting("honoured");
    let honoured = ALL.split("[mechanism.").filter(|table| {
        let cause = CAUSES.iter().find(|cause| table.starts_with(&format!("{}]", cause.name)));
        cause.is_some_and(|cause| !matches!(cause.limit(), InLimitAnalysis::Refused))
    });
    let tables: String = honoured.map(|table| format!("[mechanism.{table}")).collect();
    assert_eq!(tables.matches("[mechanism.").count(), CAUSES.len() - 11);
    append(&scratch, &tables);
    scratch.replace(STUDY, "agreement = false", "agreement = true");
    scratch.load(None).unwrap_or_else(|faults| panic!("{faults}"));
}

#[test]
fn the_verb_prints_the_catalogue() {
    let pirca = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pirca"));
        command.args(["reference", "causes"]).args(arguments).current_dir(env!("CARGO_MANIFEST_DIR"));
        let output = command.output().expect("it runs");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    let (code, text, _) = pirca(&[]);
    assert_eq!(code, Some(0));
    for said in [
        "creep: Shear tractions that relax",
        "acts on: the readings alone",
        "limit analysis: refused",
        "rate_per_deg (1/deg)",
        "prior (assumed): {\"family\":\"triangular\"",
        "source paper section 2.2",
    ] {
        assert!(text.contains(said), "{said} is missing in\n{text}");
    }
    let (code, json, _) = pirca(&["--json"]);
    assert_eq!(code, Some(0));
    let value: serde_json::Value = serde_json::from_str(&json).expect("it is JSON");
    let list = value["mechanisms"].as_array().expect("a list");
    assert_eq!(list.len(), CAUSES.len());
    let creep = list.iter().find(|m| m["name"] == "creep").expect("it is there");
    assert_eq!((&creep["acts"], &creep["unloading"]), (&"loading".into(), &"irreversible".into()));
    assert_eq!(creep["parameters"][2]["prior"]["value"], 5.0);
    let (code, help, _) = pirca(&["--help"]);
    assert_eq!(code, Some(0));
    for said in
        ["Usage: pirca reference causes", "Example: pirca reference causes", "Exit codes: 0", "--json"]
    {
        assert!(help.contains(said), "{said} is missing in\n{help}");
    }
    let (code, _, error) = pirca(&["--distributions", "src"]);
    assert_eq!(code, Some(3));
    assert!(error.contains("mechanism/creep/rate_per_deg.toml"), "{error}");
}

#[test]
fn gauges_and_slip_are_said_to_stay_or_to_go() {
    let of = |name: &str| Cause::named(name).expect("it is there");
    assert_eq!(
        (of("gauge_offset").acts, of("gauge_offset").unloading),
        (Acts::Readings, Unloading::Irreversible)
    );
    assert_eq!(of("joint_closure").unloading, Unloading::Reversible);
    assert_eq!(of("creep").unloading, Unloading::Irreversible);
}
