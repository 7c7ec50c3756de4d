//! The implicit solver: full tilting tests beside Rapier, single Newton iterations, a study's walls.
//!
//! `cargo bench --bench solvers`; with `--features rapier` the same tests run in Rapier as well. Limit analysis has its own
//! bench, `limit`. See `benches/README.md`.

#[cfg(feature = "rapier")]
mod peer;
mod record;

use std::path::Path;

use pirca::contact;
use pirca::ensemble::{Task, evaluate, plan};
use pirca::generate::canonical;
use pirca::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
use pirca::math::{Vec3, atan, cos, degrees, radians, sin, tan};
use pirca::model::{Outcome, Wall};
use pirca::protocol::{self, Ends, Protocol, Restraint, Tilting};
use pirca::solve::implicit::{self, Equilibrium};
use pirca::solve::joints::Anchor;
use pirca::solve::system::{DOF, System, held};
use pirca::solve::{Assembly, Equilibrate, STANDARD_GRAVITY, Solver, Status};
use pirca::study::Study;

use record::Bench;

/// Friction angle of the tilting tests (deg): the wall topples long before it slides.
const PHI_DEG: f64 = 35.0;

/// Dry joints of a stiffness (Pa/m).
fn law(kn: f64) -> Coulomb {
    Coulomb {
        normal: NormalLaw::Linear { kn },
        ks: 0.5 * kn,
        tan_phi: tan(radians(PHI_DEG)),
        cohesion: 0.0,
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    }
}

/// A tilting test of `wall_72` by half degrees.
struct Test {
    kn: f64,
    /// To this (deg) the collapse angle is bracketed.
    bracket_deg: f64,
    /// The collapse angle may be so far (deg) from the limit angle.
    allowed: f64,
}

/// The elastic loss is 0.19 deg at 1e12 Pa/m: to answer within 0.25 deg of the limit angle takes a bracket of a sixteenth.
/// At 1e9 Pa/m the loss alone is 1.9 deg. Between them no more is lost than at 1e9, above them no more than at 1e12; softer
/// walls lose what they lose, and must fall.
const TESTS: [Test; 7] = [
    Test { kn: 1e7, bracket_deg: 0.25, allowed: f64::INFINITY },
    Test { kn: 1e8, bracket_deg: 0.25, allowed: f64::INFINITY },
    Test { kn: 1e9, bracket_deg: 0.25, allowed: 2.15 },
    Test { kn: 1e10, bracket_deg: 0.25, allowed: 2.15 },
    Test { kn: 1e11, bracket_deg: 0.25, allowed: 2.15 },
    Test { kn: 1e12, bracket_deg: 0.0625, allowed: 0.25 },
    Test { kn: 1e13, bracket_deg: 0.0625, allowed: 0.25 },
];

/// Tilts until the wall collapses; the last tilt borne (deg).
fn tilt(test: &Test) -> f64 {
    let bracket = radians(test.bracket_deg);
    let protocol = Protocol::Tilting(Tilting { step: radians(0.5), bracket, ..Tilting::default() });
    let settings = implicit::Settings::default();
    let restraint = Restraint::at_ends(Ends::Free);
    let (wall, law) = (canonical::wall_72(), law(test.kn));
    let run = protocol::run(&wall, &law, &protocol, &restraint, [2, 2], &Solver::Implicit(settings));
    let Outcome::Collapsed { at } = run.outcome else { panic!("{:e} Pa/m: {:?}", test.kn, run.outcome) };
    degrees(at.value())
}

fn tilting(bench: &mut Bench) {
    let limit = degrees(atan(canonical::THICKNESS / (9.0 * canonical::COURSE_HEIGHT)));
    for test in &TESTS {
        let quantity = format!("tilting test implicit at {:e} Pa/m", test.kn);
        bench.scene(
            ["wall_72", &quantity],
            None,
            || (),
            |()| {
                let angle = tilt(test);
                assert!((angle - limit).abs() < test.allowed, "{quantity}: {angle} against {limit}");
            },
        );
    }
    #[cfg(feature = "rapier")]
    for (name, setup) in peer::rapier::SETUPS {
        let quantity = format!("tilting test by rapier {name}");
        if !bench.wants("wall_72", &[&quantity]) {
            continue;
        }
        let wall = canonical::wall_72().with_base();
        let tilt = || peer::rapier::tilt(&wall, tan(radians(PHI_DEG)), 0.5, &setup);
        println!("rapier {name}, {setup:?}: {:?}", tilt());
        bench.scene(["wall_72", &quantity], None, || (), |()| tilt());
    }
}

/// A wall at rest on a table tilted by a share of its limit angle, with the anchors of its last load step.
fn loaded(wall: &Wall, law: &Coulomb, share: f64) -> (Assembly<'static>, Vec<Anchor>) {
    let law: &'static Coulomb = Box::leak(Box::new(*law));
    let contact = contact::Settings::for_size(0.1, [2, 2]);
    let (low, high) = wall.bounds();
    let tilt = share * atan((high.y - low.y) / (high.z - low.z));
    let mut solver = Equilibrium::new(&wall.clone().with_base(), law, implicit::Settings::default(), contact);
    let mut anchors = Vec::new();
    for tilt in [0.0, tilt] {
        let assembly = solver.assembly();
        anchors = assembly.joints.anchors(&assembly.bodies.all);
        let gravity = Vec3::new(0.0, sin(tilt), -cos(tilt)) * STANDARD_GRAVITY;
        solver.set_loads(gravity, 1.0);
        let settled = solver.settle(&mut |_| false);
        assert_eq!(settled.status, Status::Equilibrium, "tilt {tilt}: {settled:?}");
        assert_eq!(solver.assembly().joints.all.len(), anchors.len(), "the joints have changed");
    }
    (solver.into_assembly(), anchors)
}

/// Puts the tangent of all joints into the system; whether it is symmetric.
fn assemble(system: &mut System, assembly: &mut Assembly<'_>, anchors: &[Anchor]) -> bool {
    let Assembly { bodies, joints, .. } = assembly;
    let bodies = &bodies.all;
    let mut symmetric = true;
    system.clear();
    joints.each_slope(bodies, anchors, |joint, slopes| {
        symmetric &= !slopes.slips && !slopes.opens;
        system.add_joint(joint, bodies, &slopes.stiffness);
    });
    for (index, body) in bodies.iter().enumerate() {
        for &unknown in held(body) {
            system.hold(index, unknown, 1.0);
        }
    }
    symmetric
}

fn newton_iterations(bench: &mut Bench) {
    let law = law(1e11);
    for (blocks, wall) in
        [(1000, canonical::running_bond(25, 39)), (10_000, canonical::running_bond(100, 99))]
    {
        assert_eq!(wall.blocks.len(), blocks);
        let scene = format!("wall_{blocks}");
        for (name, share, symmetric) in [("symmetric", 0.0, true), ("general", 0.7, false)] {
            let [assembly_of, factorisation, substitution] =
                ["assembly of", "factorisation of", "back-substitution with"]
                    .map(|part| format!("{part} a {name} tangent"));
            if !bench.wants(&scene, &[&assembly_of, &factorisation, &substitution]) {
                continue;
            }
            let (mut assembly, anchors) = loaded(&wall, &law, share);
            let mut system = System::new(&assembly.bodies.all, &assembly.joints);
            assert_eq!(assemble(&mut system, &mut assembly, &anchors), symmetric, "{blocks} {name}");
            assert!(system.factorise(symmetric).is_some());
            let right: Vec<f64> = (0..DOF * (blocks + 1)).map(|k| (k % 7) as f64 - 3.0).collect();
            bench.scene(
                [&scene, &assembly_of],
                None,
                || (),
                |()| assemble(&mut system, &mut assembly, &anchors),
            );
            bench.scene([&scene, &factorisation], None, || (), |()| system.factorise(symmetric));
            bench.scene([&scene, &substitution], None, || (), |()| system.solve(&right));
        }
    }
}

/// A shipped study, as it is or in one of its variants.
fn shipped(name: &str, variant: Option<&str>) -> Study {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies").join(name);
    Study::load(&folder, variant).unwrap_or_else(|faults| panic!("{name}: {faults}")).study
}

/// All walls of the joint-arrangement study by the implicit solver.
fn joint_arrangement(bench: &mut Bench) {
    let study =
        shipped("joint-arrangement", None).with_solver("implicit").expect("there is an implicit solver");
    let tasks = plan(&study);
    assert_eq!(tasks.len(), 192);
    bench.scene(
        ["joint-arrangement", "processor time of 192 walls with the implicit solver"],
        None,
        || (),
        |()| {
            let rows = tasks.iter().map(|&task| evaluate(&study, task));
            assert_eq!(rows.filter(|row| row.outcome == Outcome::Equilibrium).count(), tasks.len());
        },
    );
}

/// Walls of the tilting-table study to their fall: a family in a variant, with a mechanism.
struct Walls {
    family: &'static str,
    variant: Option<&'static str>,
    mechanism: Option<(&'static str, &'static [(&'static str, f64)])>,
    count: u64,
}

/// Joints that are five hundred times softer until they have closed by a millimetre.
const SOFT: (&str, &[(&str, f64)]) = ("joint_closure", &[("initial_pa_per_m", 1e5), ("closure_m", 1e-3)]);

/// The kinds of wall that differ most in what they take.
const WALLS: [Walls; 7] = [
    Walls { family: "sbl", variant: None, mechanism: None, count: 4 },
    Walls { family: "sbr", variant: None, mechanism: None, count: 4 },
    Walls { family: "sbl", variant: Some("two-wythes"), mechanism: None, count: 4 },
    Walls { family: "sbr", variant: Some("ropes-soft"), mechanism: None, count: 4 },
    Walls { family: "sbl", variant: None, mechanism: Some(("lean", &[("angle_deg", 4.0)])), count: 4 },
    Walls { family: "sbl", variant: None, mechanism: Some(("contact_area", &[("share", 0.25)])), count: 1 },
    Walls { family: "sbl", variant: None, mechanism: Some(SOFT), count: 4 },
];

/// The first walls of each kind to their fall.
fn tilting_table(bench: &mut Bench) {
    for walls in &WALLS {
        let Walls { family, variant, mechanism, count } = walls;
        let with = [*variant, mechanism.map(|(name, _)| name)].into_iter().flatten();
        let scene = with.fold("tilting-table".to_owned(), |scene, name| format!("{scene} {name}"));
        let quantity = format!("first walls of {family} to their fall");
        if !bench.wants(&scene, &[&quantity]) {
            continue;
        }
        let mut study = shipped("tilting-table", *variant);
        if let Some((name, parameters)) = mechanism {
            let switched = study.with_mechanism(name, parameters);
            study = switched.unwrap_or_else(|faults| panic!("{name}: {faults}")).study;
        }
        let of = |task: &Task| study.arms[task.arm as usize].name == *family && task.member < *count;
        let tasks: Vec<Task> = plan(&study).into_iter().filter(of).collect();
        assert_eq!(tasks.len() as u64, *count, "{scene}");
        bench.scene(
            [&scene, &quantity],
            None,
            || (),
            |()| {
                for &task in &tasks {
                    let row = evaluate(&study, task);
                    let has_fallen = matches!(row.outcome, Outcome::Collapsed { .. });
                    assert!(has_fallen, "{scene}, {task:?}: {:?}", row.outcome);
                }
            },
        );
    }
}

fn main() {
    let mut bench = Bench::start();
    tilting(&mut bench);
    newton_iterations(&mut bench);
    joint_arrangement(&mut bench);
    tilting_table(&mut bench);
    bench.finish();
}
