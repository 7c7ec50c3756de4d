//! What the READMEs tell of diagnoses: of the nine walls, and of the example with a hidden effect.

use std::fs;
use std::path::Path;
use std::process::Command;

use pirca::critic::{Bank, DataNote, Design, Extent, Plan, Seen, World, data_notes};
use pirca::math::radians;
use pirca::random::Streams;
use pirca::study::{MeasuredKind, MeasuredQuantity, Measurement, Study, described, nuisances};
use serde_json::Value;

/// The verdict on a study's measurements, with a bank of so many points in this folder.
fn verdict(study: &str, points: &str, bank: &Path) -> Value {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join(study.replace('/', "-"));
    let ran = Command::new(env!("CARGO_BIN_EXE_pirca"))
        .args(["diagnose", study, "--points", points, "--no-gain", "--json", "--bank"])
        .arg(bank)
        .arg("--out")
        .arg(scratch)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("it is built");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    serde_json::from_slice(&ran.stdout).expect("a verdict")
}

/// `studies/tilting-table`: something is wrong, and joints of the stones that are soft until they close are the likeliest of a few causes.
#[test]
#[ignore = "slow: 50 s of processor time"]
fn the_nine_walls_have_a_likeliest_cause_and_sbl_moves_too_far() {
    let study = "studies/tilting-table";
    let found = verdict(study, "60", &Path::new(env!("CARGO_MANIFEST_DIR")).join(study));
    assert_eq!(found["verdict"], "ambiguous");
    let causes = found["causes"].as_array().expect("causes");
    let spoken: Vec<&str> =
        causes.iter().filter(|own| own["in_verdict"] == true).filter_map(|own| own["id"].as_str()).collect();
    assert_eq!(spoken, ["joint_closure", "end_release", "base_compliance"]);
    // The stones' joints close by more than two millimetres, on their own.
    let parameters = causes[0]["parameters"].as_array().expect("they are told");
    let stones = serde_json::json!(["sbl", "sbr"]);
    let closure = parameters.iter().find(|own| own["key"] == "closure_m" && own["arms"] == stones);
    let closure = closure.and_then(|own| own["median"].as_f64()).expect("each kind has its own");
    assert!((1.8e-3..2.9e-3).contains(&closure), "{closure}");
    assert!(found["nameless_probability"].as_f64().is_some_and(|p| p < 0.1), "{found}");
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
#[ignore = "slow: a bank and a diagnosis, two minutes of processor time"]
fn the_example_names_joints_that_close_and_finds_their_parameters() {
    let bank = Path::new(env!("CARGO_TARGET_TMPDIR")).join("example-bank");
    // Walls of an earlier state would be taken for this one's.
    let _ = fs::remove_dir_all(&bank);
    let found = verdict("studies/hidden-effects/example", "120", &bank);
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

/// Causes under which a part of a wall falls first, and the rest may stand on.
const PARTS_FALL: [&str; 2] = ["end_release", "contact_inset"];

/// Campaigns with every effect of the catalogue at every strength of its prior, on the nine walls as they were read and on fifteen that
/// a gauge of 0.02 mm reads at three points: no wall is taken for one in another unit or for none at all, and a part of its readings is
/// in less than one campaign of twenty, as the ends of walls between ropes move by hardly more than the gauge's error.
#[test]
fn hidden_effects_are_not_taken_for_slips_of_the_pen() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let loaded = Study::load(&root.join("studies/tilting-table"), None);
    let study = loaded.unwrap_or_else(|faults| panic!("{faults}")).study;
    let mechanisms = described(&root.join("distributions")).expect("sound");
    let nuisances = nuisances(&root.join("distributions")).expect("sound");
    let plan = Plan::new(&study, &mechanisms, &nuisances, 60).expect("allowed");
    let bank = fs::read(root.join("studies/tilting-table/bank.parquet")).expect("it is there");
    let bank = Bank::read(&bank, &plan).expect("of this plan");
    let mut fine = study.clone();
    fine.measured = finely_read(&study.measured[0]);
    let (mut judged, mut odd, mut parts, mut overturned) = (0, Vec::new(), Vec::new(), Vec::new());
    for study in [study, fine] {
        let world = World::new(&study, &mechanisms, &nuisances, &plan, &bank).expect("it can be told");
        let (design, _) = Design::of(&study);
        let causes = std::iter::once(None).chain(world.causes().into_iter().map(Some));
        for (cause, k) in causes.flat_map(|cause| (0..20).map(move |k| (cause, k))) {
            let streams = Streams::new(33, k);
            let campaign = world.campaign(&design, &world.drawn(cause, &streams), &streams);
            let readings = design.specimens.iter().zip(&campaign.specimens);
            let readings = readings.flat_map(|(specimen, seen)| specimen.readings.iter().zip(seen));
            let shown = readings.filter_map(|(m, seen)| match seen {
                Seen::Value(value) if m.kind.is_censored() => {
                    Some(Measurement { value: *value, kind: MeasuredKind::Exact, ..m.clone() })
                }
                Seen::Value(value) => Some(Measurement { value: *value, ..m.clone() }),
                Seen::Beyond => Some(m.clone()),
                Seen::Fell | Seen::Stood | Seen::Nothing => None,
            });
            let campaign = Study { measured: shown.collect(), ..study.clone() };
            judged += 1;
            let found = data_notes(&campaign, &Design::of(&campaign).0);
            for note in found {
                let words = format!("{}: {note}", cause.map_or("nothing", |c| mechanisms[c].name));
                match note {
                    // A strong effect may move a wall so far.
                    DataNote::ThickerThanWall { .. } => {}
                    DataNote::OtherUnit { extent: Extent::Part, .. } => parts.push(words),
                    // What stands on once a part has fallen is stockier than the whole wall.
                    DataNote::Overturned { .. }
                        if cause.is_some_and(|c| PARTS_FALL.contains(&mechanisms[c].name)) =>
                    {
                        overturned.push(words)
                    }
                    _ => odd.push(words),
                }
            }
        }
    }
    assert!(judged > 600, "{judged}");
    assert!(odd.is_empty(), "{} in {judged}:\n{}", odd.len(), odd.join("\n"));
    assert!(200 * overturned.len() < judged, "{} in {judged}:\n{}", overturned.len(), overturned.join("\n"));
    // Ends that ropes hold move by hundredths of a millimetre: two of 720 look like inches.
    assert!(100 * parts.len() < judged, "{} parts in {judged}:\n{}", parts.len(), parts.join("\n"));
}

/// Five walls of each family, read at the left, the centre and the right at five tilts.
fn finely_read(of: &Measurement) -> Vec<Measurement> {
    use MeasuredQuantity as Q;
    let read = |family: &str, k: usize, quantity: Q, tilt: Option<f64>| {
        let error = if tilt.is_some() { 2e-5 } else { radians(0.1) };
        let (specimen, kind) = (format!("{family}{k}"), MeasuredKind::Exact);
        Measurement {
            specimen,
            family: family.to_owned(),
            quantity,
            tilt,
            kind,
            error,
            resolution: 0.0,
            ..of.clone()
        }
    };
    let mut found = Vec::new();
    for (family, k) in ["cbl", "sbl", "sbr"].into_iter().flat_map(|family| (0..5).map(move |k| (family, k))) {
        found.push(read(family, k, Q::CollapseAngle, None));
        for tilt in [2.5, 5.0, 7.5, 10.0, 12.5].map(radians) {
            let points = [Q::DisplacementLeft, Q::DisplacementCentre, Q::DisplacementRight];
            found.extend(points.map(|point| read(family, k, point, Some(tilt))));
        }
    }
    (2..).zip(found).map(|(line, m)| Measurement { line, ..m }).collect()
}
