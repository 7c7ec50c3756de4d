//! Laws of compression that a study states: a table of closures and stresses, and a compressive strength.

use pirca::law::{ClosureTable, NormalLaw};
use pirca::model::JointLaws;
use pirca::random::Streams;
use pirca::study::{DrawnJoints, StatedLaw};

use crate::scratch::{STUDY, Scratch};

const LINEAR: &str = "normal_law = \"linear\"\n";
const TABLE: &str =
    "normal_law = \"table\"\ntable_closure_m = [1e-4, 2e-4, 3e-4]\ntable_stress_pa = [1e3, 4e3, 2e4]\n";

/// The fixture's study with these lines in the place of its normal law.
fn with(name: &str, lines: &str) -> Scratch {
    let scratch = Scratch::new(name);
    scratch.replace(STUDY, LINEAR, lines);
    scratch
}

#[test]
fn a_study_states_a_table_and_its_joints_close_along_it() {
    let study = with("table", TABLE).load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    let table = ClosureTable::through(&[1e-4, 2e-4, 3e-4], &[1e3, 4e3, 2e4]).expect("it rises");
    for arm in &study.arms {
        assert_eq!(arm.joint.normal_law, StatedLaw::Table(Box::new(table)));
        // What is drawn from joint to joint scales stress and shear stiffness alike; kn gives the latter alone.
        let streams = Streams::new(1, 0);
        let of = |kn: f64| DrawnJoints::new(&arm.joint, kn, streams.clone()).of(0, 1);
        let (soft, stiff) = (of(1e7), of(2e7));
        assert_eq!(soft.normal, stiff.normal);
        let factor = soft.ks * arm.joint.kn_over_ks / 1e7;
        assert!((soft.normal.stress(2e-4) / (4e3 * factor) - 1.0).abs() < 1e-12);
        assert_eq!(stiff.ks, 2.0 * soft.ks);
    }
    // As many times as stiff, all of it.
    let arm = study.arms[0].with_joints(1e7, [2.0, 1.0, 1.0]);
    let StatedLaw::Table(own) = arm.joint.normal_law else { panic!("it has a table") };
    assert_eq!((arm.kn_points, NormalLaw::Table(*own).stress(2e-4)), (vec![2e7], 8e3));
}

#[test]
fn a_study_states_a_compressive_strength() {
    let strong = with("strength", "compressive_strength_pa = 3e5\n");
    let study = strong.load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    let law = study.arms[0].joint.law(1e7, &Streams::new(1, 0), 0, 1);
    assert_eq!(law.compressive_strength, Some(3e5));
    let without = Scratch::new("no-strength").load(None).unwrap_or_else(|faults| panic!("{faults}")).study;
    assert_eq!(without.arms[0].joint.compressive_strength, None);
    assert_ne!(study.hash, without.hash);
}

#[test]
fn what_is_no_law_is_refused_with_its_place() {
    for (case, (lines, said)) in [
        (
            "normal_law = \"table\"\n",
            "joint.table_closure_m is missing: allowed is a list of 1 to 8 ascending numbers",
        ),
        (
            "normal_law = \"table\"\ntable_closure_m = [1e-4]\ntable_stress_pa = [1e3]\n",
            "joint.table_closure_m = [1e-4]: allowed is 2 to 8 knots",
        ),
        (
            "normal_law = \"table\"\ntable_closure_m = [1e-4, 2e-4]\ntable_stress_pa = [1e3, 2e3, 3e3]\n",
            "joint.table_stress_pa = [1e3, 2e3, 3e3]: allowed is 2 stresses, one for each closure; it has 3",
        ),
        (
            "normal_law = \"table\"\ntable_closure_m = [1e-4, 2e-4]\ntable_stress_pa = [2e3, 1e3]\n",
            "1000 follows 2000: sort the list and drop repeated values",
        ),
        (
            "normal_law = \"table\"\ntable_closure_m = [0.1, 0.2]\ntable_stress_pa = [1e3, 2e3]\n",
            "allowed is a list of 1 to 8 ascending numbers, each above 0 and at most 0.1 (m)",
        ),
        (
            "normal_law = \"table\"\ntable_closure_m = [0, 1e-4]\ntable_stress_pa = [1e3, 2e3]\n",
            "each above 0 and at most 0.1 (m)",
        ),
        (
            "normal_law = \"table\"\ntable_closure_mm = [0.1, 0.2]\ntable_stress_pa = [1e3, 2e3]\n",
            "joint.table_closure_mm is not a known key",
        ),
        ("table_closure_m = [1e-4, 2e-4]\n", "means nothing where normal_law = \"linear\""),
        ("normal_law = \"tabel\"\n", "did you mean \"table\"?"),
        (
            "compressive_strength_pa = 0\n",
            "joint.compressive_strength_pa = 0: allowed is a number above 0 (Pa)",
        ),
    ]
    .into_iter()
    .enumerate()
    {
        let faults = with(&format!("no-law-{case}"), lines).load(None).expect_err(said).to_string();
        assert!(faults.contains(said), "{said}\n{faults}");
    }
}

#[test]
fn limit_analysis_and_other_laws_of_closure_are_refused_by_name() {
    for (case, lines, other, said) in [
        ("table", TABLE, "", "joint.normal_law = \"table\": rigid blocks have joints without closure"),
        (
            "strength",
            "compressive_strength_pa = 3e5\n",
            "",
            "joint.compressive_strength_pa: limit analysis takes joints to bear any pressure",
        ),
        (
            "closure",
            TABLE,
            "[mechanism.joint_closure]\ninitial_pa_per_m = 1e7\nclosure_m = 1e-4\n",
            "mechanism.joint_closure does not go with joint.normal_law = \"table\"",
        ),
        (
            "stiffening",
            TABLE,
            "[mechanism.stress_stiffening]\nat_1_mpa_pa_per_m = 1e9\nexponent = 0.5\n",
            "mechanism.stress_stiffening does not go with joint.normal_law = \"table\"",
        ),
    ] {
        let scratch = with(&format!("refused-{case}"), lines);
        if other.is_empty() {
            scratch.load(None).unwrap_or_else(|faults| panic!("{faults}"));
            scratch.replace(STUDY, "agreement = false", "agreement = true");
        } else {
            scratch.replace(STUDY, "[[arm]]", &format!("{other}\n[[arm]]"));
        }
        let faults = scratch.load(None).expect_err(said).to_string();
        assert!(faults.contains(said), "{said}\n{faults}");
    }
}
