//! Contact dynamics from the command line: walls with known answers, studies, what it refuses, and the problem of a step as a file.

use std::collections::BTreeSet;
use std::fs;

use pirca::math::{atan, degrees, radians, sin, tan};
use pirca::solve::Solver;
use pirca::solve::nonsmooth::{Normal, Settings, StepSolver};
use pirca::study::{Faults, Study};
use serde_json::Value;

use crate::scratch::{STUDY, Scratch};
use crate::walls::{Folder, example};

/// The JSON object about the leaning tower.
fn tower(folder: &Folder, more: &[&str]) -> Value {
    let path = example("leaning-tower.json").display().to_string();
    let arguments = [&["analyse", &path, "--json", "--solver", "nonsmooth"], more].concat();
    let output = folder.pirca(&arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    serde_json::from_slice(&output.stdout).expect("one JSON object on standard output")
}

/// It topples at tan(a) = 1/3 and slides at its friction angle; the bracket of 0.01 deg lies about either.
#[test]
fn a_leaning_tower_topples_and_slides_at_its_closed_forms() {
    let folder = Folder::new();
    for (phi, expected) in [("30", degrees(atan(1.0 / 3.0))), ("12", 12.0)] {
        let answer = tower(&folder, &["--phi-deg", phi]);
        assert_eq!((&answer["outcome"], &answer["solver"]), (&"collapsed".into(), &"nonsmooth".into()));
        let found = answer["collapse_angle_deg"].as_f64().expect("it falls");
        assert!((found - expected).abs() < 0.011, "{found} instead of {expected}");
        assert!(answer["meaning"].as_str().expect("words").contains("without dilatancy"), "{answer}");
        assert_eq!(answer["warnings"], serde_json::json!([]), "{answer}");
    }
    let pushed = tower(&folder, &["--phi-deg", "30", "--load", "lateral"]);
    // Brackets of multipliers are 1e-4 wide.
    assert!((pushed["multiplier"].as_f64().expect("it falls") - 1.0 / 3.0).abs() < 1.1e-4, "{pushed}");
}

#[test]
fn a_stiffness_has_no_bearing_on_rigid_joints_and_a_range_of_it_is_refused() {
    let folder = Folder::new();
    let answer = tower(&folder, &["--phi-deg", "12", "--kn", "1e6", "--ks", "1e5"]);
    assert!((answer["collapse_angle_deg"].as_f64().expect("it falls") - 12.0).abs() < 0.011);
    assert_eq!(
        answer["warnings"],
        serde_json::json!(["contact dynamics is of rigid blocks: --kn and --ks do not matter"])
    );
    let path = example("leaning-tower.json").display().to_string();
    for (more, said) in [
        (
            &["--kn", "1e7..1e9"][..],
            "--kn takes a range for elastic joints, and contact dynamics is of rigid blocks",
        ),
        (&["--cohesion", "100", "--fclib", "step.json"], "--fclib is for dry joints"),
        (&["--at-deg", "5"], "--fclib"),
        (&["--settle", "0=0.01"], "--settle is for elastic joints: rigid blocks drop after a support"),
        (&["--fclib", "step.json", "--at-deg", "90"], "0 to 89 degrees"),
    ] {
        let asked = [&["analyse", &path, "--solver", "nonsmooth", "--phi-deg", "30"], more].concat();
        let output = folder.pirca(&asked);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {told}");
        assert!(told.contains(said), "{more:?}: {told}");
    }
}

/// A sparse matrix of the file times a vector, or its transpose times it.
fn times(matrix: &Value, x: &[f64], is_transposed: bool) -> Vec<f64> {
    let whole = |name: &str| {
        let list = matrix[name].as_array().expect(name).iter();
        list.map(|of| of.as_u64().expect("a whole number") as usize).collect::<Vec<_>>()
    };
    let (rows, columns, values) = (whole("i"), whole("p"), reals(&matrix["x"]));
    assert_eq!(matrix["nz"], values.len());
    let size = if is_transposed { &matrix["n"] } else { &matrix["m"] };
    let mut sums = vec![0.0; size.as_u64().expect("a size") as usize];
    for ((row, column), value) in rows.into_iter().zip(columns).zip(values) {
        let (to, from) = if is_transposed { (column, row) } else { (row, column) };
        sums[to] += value * x[from];
    }
    sums
}

fn reals(list: &Value) -> Vec<f64> {
    list.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// Largest difference of two vectors.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Its blocks are 0.5 m x 0.5 m x 0.2 m of 2400 kg/m^3, and a step takes 2 ms.
#[test]
fn the_problem_of_a_step_is_read_back_with_its_solution() {
    let folder = Folder::new();
    let answer = tower(&folder, &["--phi-deg", "30", "--fclib", "step.json", "--at-deg", "10"]);
    assert_eq!(answer["fclib"], "step.json");
    let read = |name: &str| -> Value {
        serde_json::from_str(&fs::read_to_string(folder.path(name)).expect(name)).expect("JSON")
    };
    let step = read("step.json");
    assert_eq!((&step["spacedim"], &step["load"]["tilt_deg"]), (&3.into(), &10.0.into()));
    assert_eq!(step["bodies"], serde_json::json!([1, 2, 3, 4, 5, 6]));
    let pairs = step["contacts"].as_array().expect("contacts");
    let joints: BTreeSet<String> = pairs.iter().map(Value::to_string).collect();
    assert_eq!((joints.len(), &step["H"]["m"]), (6, &36.into()));
    assert_eq!(step["H"]["n"], 3 * pairs.len());
    let mass = 2400.0 * 0.5 * 0.5 * 0.2;
    assert!((step["M"]["x"][0].as_f64().expect("a mass") / mass - 1.0).abs() < 1e-9);
    let weight = 6.0 * mass * 9.80665 * 2e-3;
    let (solution, f, w) = (&step["solution"], reals(&step["f"]), reals(&step["w"]));
    let [v, u, r] = ["v", "u", "r"].map(|name| reals(&solution[name]));
    // M v = H r + f to rounding of the weights.
    let given: Vec<f64> = times(&step["H"], &r, false).iter().zip(&f).map(|(h, f)| h + f).collect();
    assert!(apart(&times(&step["M"], &v, false), &given) < 1e-12 * weight);
    // At 10 deg it stands: what H r gives is what f takes, and f is a step's gravity.
    let pushed: f64 = f.chunks(6).map(|of| of[1]).sum();
    assert!((pushed / (weight * sin(radians(10.0))) - 1.0).abs() < 1e-12, "{pushed}");
    let moved: Vec<f64> = times(&step["H"], &v, true).iter().zip(&w).map(|(u, w)| u + w).collect();
    assert!(apart(&moved, &u) < 1e-14);
    assert!(v.iter().all(|v| v.abs() < 1e-6));
    // Coulomb's law at each contact, within what a solution may leave over (1e-8 of the weight).
    let left = 1e-8 * weight;
    assert!(solution["residual"]["natural_map"].as_f64().expect("a number") < 1e-8);
    for (k, mu) in reals(&step["mu"]).into_iter().enumerate() {
        let [n, a, b] = [r[3 * k], r[3 * k + 1], r[3 * k + 2]];
        assert!((mu / tan(radians(30.0)) - 1.0).abs() < 1e-12);
        assert!(n >= -left && (a * a + b * b).sqrt() <= mu * n + left, "{n} {a} {b}");
    }
    // Where nothing is said, at the last tilt that it bears; any solver finds that.
    let path = example("leaning-tower.json").display().to_string();
    let output = folder.pirca(&["analyse", &path, "--phi-deg", "30", "--fclib", "last.json"]);
    assert!(String::from_utf8_lossy(&output.stdout).contains("written to last.json"));
    let tilt = read("last.json")["load"]["tilt_deg"].as_f64().expect("a tilt");
    assert!((tilt - degrees(atan(1.0 / 3.0))).abs() < 1e-4, "{tilt}");
}

/// The fixture's study with this solver, this load, and more at its end.
fn study(name: &str, solver: &str, load: &str, more: &str) -> Result<Study, Faults> {
    let scratch = Scratch::new(&format!("nonsmooth-{name}"));
    let text = scratch.read(STUDY);
    let with = |text: String, head: &str, own: &str| {
        let (before, rest) = text.split_once(head).expect(head);
        let (_, after) = rest.split_once("\n\n").expect("something follows it");
        format!("{before}{own}\n\n{after}")
    };
    let text = with(text, "[load]", &format!("[load]\n{load}"));
    let text = with(text, "[solver]", &format!("[solver]\nname = \"nonsmooth\"\n{solver}"));
    // The variant with joints that are sampled at corners goes with fewer mechanisms.
    let text = text.replace("\"joint.sampling\" = \"vertices\"", "\"joint.phi_deg\" = 31");
    scratch.write(STUDY, format!("{text}\n{more}\n").as_bytes());
    scratch.load(None).map(|loaded| loaded.study)
}

const TILTING: &str = "protocol = \"tilting\"";
const LATERAL: &str = "protocol = \"lateral\"\nmean_pressure_pa = 1000\nbase_over_top = 2";

#[test]
fn a_study_states_contact_dynamics_with_its_settings() {
    let of = |name: &str, solver: &str, load: &str| {
        study(name, solver, load, "").unwrap_or_else(|faults| panic!("{faults}"))
    };
    let plain = of("plain", "", TILTING);
    assert_eq!(plain.solver, Solver::Nonsmooth(Settings::default()));
    assert_eq!(plain.effective["solver.normal"], "gap");
    let own = "time_step_s = 1e-3\nnormal = \"velocity\"\nrestitution = 0.2\nstep_solver = \"sweeps\"\ntolerance = 1e-6\nmax_steps = 50";
    let expected = Settings {
        time_step: 1e-3,
        normal: Normal::Velocity { restitution: 0.2 },
        solver: StepSolver::Sweeps,
        tolerance: 1e-6,
        max_steps: 50,
        ..Settings::default()
    };
    assert_eq!(of("own", own, TILTING).solver, Solver::Nonsmooth(expected));
    let programs = of("programs", "step_solver = \"cone_program\"", TILTING);
    let expected = Settings { solver: StepSolver::ConeProgram, ..Settings::default() };
    assert_eq!(programs.solver, Solver::Nonsmooth(expected));
    // Joints with a stiffness have displacements.
    let soft = of("soft", "normal = \"compliant\"", LATERAL);
    assert_eq!(soft.solver, Solver::Nonsmooth(Settings { normal: Normal::Compliant, ..Settings::default() }));
    // By its name alone it is the same, and refused where it does not go.
    let tilting =
        plain.clone().with_solver("explicit").expect("it goes").with_solver("nonsmooth").expect("it goes");
    assert_eq!((tilting.solver, tilting.hash), (plain.solver, plain.hash));
    let refused = Scratch::new("nonsmooth-lateral").load(None).expect("sound").study.with_solver("nonsmooth");
    let said = refused.expect_err("it is lateral").to_string();
    assert!(said.contains("rigid blocks do not move before they fall"), "{said}");
}

#[test]
fn a_study_that_asks_for_more_than_contact_dynamics_has_is_refused_by_name() {
    let closure = "[mechanism.joint_closure]\ninitial_pa_per_m = 1e8\nclosure_m = 1e-4";
    let area = "[mechanism.contact_area]\nshare = 0.5";
    let turning = "protocol = \"tilting\"\n[load.turning]\nrate_deg_per_s = 2";
    for (case, (solver, load, more, said)) in [
        ("", TILTING, closure, "joint_closure: rigid blocks have joints without closure"),
        ("", TILTING, area, "contact_area: rigid joints of contact dynamics touch over their whole area"),
        (
            "",
            TILTING,
            "[mechanism.friction]\nfactor = 1\nresidual_share = 0.8",
            "mechanism.friction.residual_share: friction of contact dynamics does not weaken with slip",
        ),
        (
            "",
            TILTING,
            "[mechanism.creep]\nrate_per_deg = 0.1",
            "creep: shear of contact dynamics does not relax",
        ),
        (
            "",
            turning,
            "",
            "load.turning: a platform that turns steadily is followed by the explicit solver alone",
        ),
        ("", "protocol = \"tilting\"\nobserves = \"displacement\"", "", "load.observes = \"displacement\""),
        ("", "protocol = \"tilting\"\nremainders = true", "", "load.remainders: rigid blocks"),
        ("", LATERAL, "", "load.protocol = \"lateral\", which observes a displacement"),
        ("restitution = 0.5", TILTING, "", "none but with normal = \"velocity\""),
        (
            "normal = \"compliant\"\nstep_solver = \"cone_program\"",
            TILTING,
            "",
            "\"newton\" or \"sweeps\" with normal = \"compliant\"",
        ),
        ("damping = 0.5", TILTING, "", "damping"),
    ]
    .into_iter()
    .enumerate()
    {
        let faults = study(&format!("refused-{case}"), solver, load, more).expect_err(said).to_string();
        assert!(faults.contains(said), "{said}\n{faults}");
    }
    // What it refuses of rigid joints goes with those that have a stiffness.
    for (case, more) in [closure, area].into_iter().enumerate() {
        let sound = study(&format!("soft-{case}"), "normal = \"compliant\"", TILTING, more);
        sound.unwrap_or_else(|faults| panic!("{faults}"));
    }
}

/// Two stones, 0.2 m thick and 0.4 m high together, topple at atan(1/2), whatever the stiffness of their joints.
const TWO_STONES: &str = r#"
[study]
question = "When do two stones topple?"
seed = 1
[wall]
height_m = 0.4
length_m = 0.4
base_thickness_m = 0.2
top_thickness_m = 0.2
battered_face = "both"
wythes = 1
header_share = 0
head_joint_gap_m = 0
[block]
density_kg_per_m3 = 2400
[joint]
kn_pa_per_m = [1e7, 1e9]
kn_over_ks = 2
phi_deg = 40
cohesion_pa = 0
[load]
protocol = "tilting"
[restraint]
base = "fixed"
ends = "free"
[solver]
name = "nonsmooth"
[[arm]]
name = "two"
members = 1
arrangement = "continuous"
block_length_m = 0.4
course_height_m = 0.2
"#;

#[test]
fn a_study_is_run_by_contact_dynamics() {
    let folder = Folder::new();
    fs::create_dir_all(folder.path("studies/two")).unwrap();
    fs::write(folder.path("studies/two/study.toml"), TWO_STONES).unwrap();
    let output = folder.pirca(&["run", "studies/two", "--out", "out", "--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let summary: Value =
        serde_json::from_str(&fs::read_to_string(folder.path("out/summary.json")).expect("a summary"))
            .expect("JSON");
    assert_eq!(summary["solver"], "nonsmooth");
    let arms = summary["arms"].as_array().expect("arms");
    assert_eq!(arms.len(), 2);
    for arm in arms {
        let mean = arm["mean"].as_f64().expect("a mean");
        assert!((mean - degrees(atan(0.5))).abs() < 0.011, "{arm}");
    }
}
