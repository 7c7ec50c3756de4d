//! Effects are hidden in campaigns of real walls, and must be found; where nothing is hidden, nothing may be found.
//!
//! The campaigns come from the solver itself, with other seeds and finer steps than the bank that the inference knows, with joints
//! drawn anew, and with errors that are drawn here.

use std::path::Path;
use std::sync::OnceLock;

use pirca::critic::{Bank, Design, Diagnosis, Effort, Judge, Limits, Plan, Verdict, World};
use pirca::ensemble::{Row, Task, evaluate};
use pirca::math::{exp, radians};
use pirca::protocol::Protocol;
use pirca::random::Streams;
use pirca::random::standard_normal::quantile;
use pirca::study::{
    Described, MeasuredKind, MeasuredQuantity, Measurement, Nuisance, Study, described, nuisances,
};
use rayon::prelude::*;

/// Specimens of a campaign.
const SPECIMENS: u64 = 6;
/// Tilts of the readings (deg).
const TILTS: [f64; 5] = [2.5, 5.0, 7.5, 10.0, 12.5];
/// Random error of a collapse angle (deg) and of a displacement (m).
const ERRORS: [f64; 2] = [0.1, 2e-5];
/// Points of the bank.
const POINTS: u64 = 60;

/// What the inference knows.
struct Known {
    study: Study,
    mechanisms: Vec<Described>,
    nuisances: [Nuisance; 3],
    plan: Plan,
    bank: Bank,
}

fn towers() -> Study {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hidden_effect/towers");
    Study::load(&folder, None).unwrap_or_else(|faults| panic!("{faults}")).study
}

fn known() -> &'static Known {
    static KNOWN: OnceLock<Known> = OnceLock::new();
    KNOWN.get_or_init(|| {
        let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let mechanisms = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        let nuisances = nuisances(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        let mut study = towers();
        // The design: what is read is the same in every campaign.
        study.measured = campaign(&towers(), &Hidden::default(), 1);
        let plan =
            Plan::new(&study, &mechanisms, &nuisances, POINTS).unwrap_or_else(|faults| panic!("{faults}"));
        let tasks: Vec<Task> =
            (0..plan.places.len() as u32).map(|arm| Task { arm, point: 0, member: 0 }).collect();
        let rows: Vec<Row> = tasks.into_par_iter().map(|task| plan.evaluate(task)).collect();
        Known { bank: Bank::of(&rows), study, mechanisms, nuisances, plan }
    })
}

/// What is hidden in a campaign.
#[derive(Default)]
struct Hidden {
    /// A mechanism with its parameters.
    mechanism: Option<(&'static str, &'static [(&'static str, f64)])>,
    /// Scores of kn and of the friction angle in their priors, where they are not drawn.
    joints: Option<[f64; 2]>,
}

/// What is read on walls of the solver. The seed is that of walls, joints and errors.
fn campaign(study: &Study, hidden: &Hidden, seed: u64) -> Vec<Measurement> {
    let mut draws = Streams::new(seed, 0).of("hidden");
    let mut normal = || quantile(draws.uniform());
    let drawn = [normal(), normal()];
    let [kn, phi] = hidden.joints.unwrap_or(drawn);
    let mut study = study.clone().with_seed(seed);
    if let Some((name, parameters)) = hidden.mechanism {
        study = study.with_mechanism(name, parameters).unwrap_or_else(|faults| panic!("{faults}")).study;
    }
    // Lognormal, as the priors are: 47 % of kn, 6 % of the friction angle.
    let arm = study.arms[0].with_joints(5e7, [exp(0.47 * kn), exp(0.06 * phi), 1.0]);
    study.arms[0] = arm;
    let Protocol::Tilting(tilting) = &mut study.protocol else { panic!("towers are tilted") };
    tilting.step = radians(1.25);
    let rows: Vec<Row> = (0..SPECIMENS)
        .into_par_iter()
        .map(|member| evaluate(&study, Task { arm: 0, point: 0, member }))
        .collect();
    let mut readings = Vec::new();
    for row in &rows {
        let Some(collapse) = row.collapse_angle_deg else { continue };
        let mut read = |quantity, tilt: Option<f64>, value: f64, error: f64| {
            readings.push(Measurement {
                specimen: format!("T{}", row.member),
                family: study.arms[0].name.clone(),
                tilt: tilt.map(radians),
                quantity,
                value: value + error * normal(),
                kind: MeasuredKind::Exact,
                error,
                common_error: 0.0,
                resolution: 0.0,
                order: None,
                stage: 0,
                line: 0,
            });
        };
        read(MeasuredQuantity::CollapseAngle, None, radians(collapse), radians(ERRORS[0]));
        for tilt in TILTS.into_iter().filter(|tilt| *tilt < collapse) {
            let steps = row.load_steps.iter();
            let step = steps.min_by(|a, b| {
                let off = |tilted: Option<f64>| (tilted.unwrap_or(f64::INFINITY) - tilt).abs();
                off(a.tilt_deg).total_cmp(&off(b.tilt_deg))
            });
            let step = step.expect("it has been tilted");
            assert!((step.tilt_deg.expect("it is a tilt") - tilt).abs() < 1e-6, "no step at {tilt} deg");
            let points = [
                (MeasuredQuantity::DisplacementLeft, step.left_m),
                (MeasuredQuantity::DisplacementCentre, step.centre_m),
                (MeasuredQuantity::DisplacementRight, step.right_m),
            ];
            for (quantity, value) in points {
                read(quantity, Some(tilt), value.expect("it was read"), ERRORS[1]);
            }
        }
    }
    readings
}

/// What is said of a campaign.
fn verdict(hidden: &Hidden, seed: u64) -> (Verdict, Diagnosis) {
    let known = known();
    let mut study = known.study.clone();
    study.measured = campaign(&towers(), hidden, seed);
    let world = World::new(&study, &known.mechanisms, &known.nuisances, &known.plan, &known.bank);
    let world = world.expect("enough walls");
    let (design, measured) = Design::of(&study);
    let judge = Judge::trained(&world, &design, Effort { reference: 1500, training: 800 }, 11);
    let found = judge.expect("it can be told").diagnosed(&measured, &Limits::default(), 13);
    (found.verdict.clone(), found)
}

/// The verdict with the names of the mechanisms.
fn said(hidden: &Hidden, seed: u64) -> (Verdict, Vec<&'static str>) {
    let (verdict, _) = verdict(hidden, seed);
    let name = |cause: &usize| known().mechanisms[*cause].name;
    let names = match &verdict {
        Verdict::Named(cause) => vec![name(cause)],
        Verdict::Ambiguous(causes) => causes.iter().map(name).collect(),
        Verdict::NothingFound | Verdict::Unexplained => Vec::new(),
    };
    println!("{:?}, seed {seed}: {verdict:?} {names:?}", hidden.mechanism);
    (verdict, names)
}

#[test]
fn nothing_is_named_where_nothing_is_hidden() {
    // Joints drawn from their priors, and kn two standard deviations from where it is thought to be, either way.
    let cases = (200..208).map(|seed| (None, seed));
    let far = [(Some([2.0, 0.0]), 300), (Some([-2.0, 0.0]), 301), (Some([2.0, -1.0]), 302)];
    let mut found = 0;
    for (joints, seed) in cases.chain(far) {
        let (verdict, _) = said(&Hidden { joints, mechanism: None }, seed);
        assert!(!matches!(verdict, Verdict::Named(_)), "seed {seed}");
        found += usize::from(verdict != Verdict::NothingFound);
    }
    // One in twenty is found by chance: three of eleven would be one in fifty times.
    assert!(found < 3, "{found} of 11");
}

#[test]
fn strong_effects_that_the_data_identify_are_named() {
    let cases: [(&'static str, &'static [(&'static str, f64)]); 3] = [
        ("gauge_offset", &[("offset_m", 3e-3)]),
        ("joint_closure", &[("initial_pa_per_m", 6e6), ("closure_m", 3e-4)]),
        ("contact_area", &[("share", 0.5)]),
    ];
    for (name, parameters) in cases {
        let named = (100..103).filter(|&seed| {
            let (_, names) = said(&Hidden { mechanism: Some((name, parameters)), joints: None }, seed);
            // Whatever is said, the truth is among it.
            assert!(names.is_empty() || names.contains(&name), "{name} hidden, {names:?} said");
            names == [name]
        });
        assert!(named.count() >= 2, "{name}");
    }
}

#[test]
fn what_looks_alike_is_said_to_look_alike() {
    // Lean and rounded arrises both take a piece off the angle and add little to the displacements.
    for seed in 100..103 {
        let (verdict, names) =
            said(&Hidden { mechanism: Some(("lean", &[("angle_deg", 1.0)])), joints: None }, seed);
        assert!(verdict == Verdict::NothingFound || names.contains(&"lean"), "{verdict:?}");
        assert!(names != ["contact_inset"]);
    }
}

#[test]
fn a_diagnosis_comes_out_the_same_bit_for_bit() {
    let hidden = Hidden { mechanism: Some(("gauge_offset", &[("offset_m", 3e-3)])), joints: None };
    let (first, second) = (verdict(&hidden, 100).1, verdict(&hidden, 100).1);
    assert_eq!(first, second);
}
