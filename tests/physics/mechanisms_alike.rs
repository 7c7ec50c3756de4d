//! Every mechanism on one small wall with wedges and ropes: both solvers move it alike, and each mechanism does something.

use pirca::generate::{Arrangement, BatteredFace, Layout, Limits, Outline, Sizes, Wedges, Wythes, generate};
use pirca::law::{CohesionAfterSlip, Sampling};
use pirca::math::{Vec3, pow, radians};
use pirca::protocol::{
    Confirmation, Criterion, Direction, Ends, Protocol, Restraint, Rope, Stage, Task, Tilting, climb,
};
use pirca::random::{Family, Streams};
use pirca::solve::explicit::{self, Simulation};
use pirca::solve::implicit::{self, Equilibrium};
use pirca::solve::{Equilibrate, STANDARD_GRAVITY, Status};
use pirca::study::{CAUSES, DrawnJoints, Joint, Mechanisms, StatedLaw};
use rayon::prelude::*;

/// Three courses of irregular stones, 0.9 x 0.25 m.
fn layout() -> Layout {
    Layout {
        outline: Outline {
            length: 0.9,
            height: 0.25,
            base_thickness: 0.12,
            top_thickness: 0.1,
            battered_face: BatteredFace::Front,
        },
        arrangement: Arrangement::Coursed {
            sizes: Sizes::Apart {
                length: Family::Uniform { low: 0.15, high: 0.25 },
                height: Family::Uniform { low: 0.07, high: 0.1 },
            },
            wall_size_factor: Family::Constant { value: 1.0 },
            dip: Family::Uniform { low: radians(-3.0), high: radians(3.0) },
            least_overlap: 0.2,
        },
        density: Family::Constant { value: 2200.0 },
        wythes: Wythes { count: 1, header_share: 0.0 },
        head_joint_gap: 0.001,
        wedges: Some(Wedges {
            share: 0.5,
            height: Family::Constant { value: 0.015 },
            depth: Family::Constant { value: 0.05 },
        }),
        limits: Limits {
            min_size: 0.02,
            max_aspect: 40.0,
            min_volume: 1e-6,
            max_redraws: 200,
            max_attempts: 50,
        },
    }
}

fn joint() -> Joint {
    Joint {
        kn_factor: Family::Constant { value: 1.0 },
        kn_over_ks: 2.0,
        phi_deg: Family::Constant { value: 22.0 },
        cohesion: Family::Constant { value: 0.0 },
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        normal_law: StatedLaw::Linear,
        sampling: Sampling::Area,
        bearing: None,
    }
}

/// Gravity brought on so slowly that the wall does not bounce: joints that open for a moment forget their shear.
fn rested<'a, S: Equilibrate<'a>>(mut solver: S) -> S {
    for k in 1..=100 {
        let share = pow(1e-3, 1.0 - f64::from(k) / 100.0);
        solver.set_loads(Vec3::new(0.0, 0.0, -STANDARD_GRAVITY * share), 1.0);
        assert_eq!(solver.settle(&mut |_| false).status, Status::Equilibrium);
    }
    solver
}

/// Displacements (m) of left, centre and right of the top from 0 to 6 deg, half a degree at a time, by the implicit and by the
/// explicit solver. The larger the steps, the more the order matters in which joints slip: with all at once the two are 0.7 %
/// apart in steps of a degree and 0.1 % in steps of a quarter.
fn moved(mechanisms: &Mechanisms) -> [Vec<[f64; 3]>; 2] {
    let streams = Streams::new(5, 2);
    let tilting = Tilting {
        towards: Direction::YPlus,
        step: radians(0.5),
        end: radians(6.0),
        bracket: radians(0.1),
        ..Tilting::default()
    };
    let protocol = Protocol::Tilting(tilting);
    let wall = generate(&mechanisms.layout(layout()), &streams).expect("a wall comes out").wall;
    let wall = mechanisms.built(wall, &protocol);
    let joint = joint();
    let laws = DrawnJoints::new(&joint, 1e8, streams.clone()).altered(mechanisms, &wall);
    let restraint = mechanisms.restraint(Restraint::at_ends(Ends::Ropes(Rope::default())));
    let stage = Stage::new(&wall, &laws, &protocol, &restraint, mechanisms.contacts([2, 2]));
    let task = Task {
        wall: &stage.assembly,
        laws: &stage.laws,
        contact: stage.contact,
        loads: Vec::new(),
        ties: stage.ties,
        platform: stage.platform,
        changes: mechanisms.changes(&wall, &streams),
        path: tilting.path(),
        piles: Vec::new(),
        criterion: Criterion::AnyBlock(0.01),
        confirmation: Confirmation::for_thickness(0.12),
    };
    let slow = explicit::Settings { unbalanced_ratio: 1e-6, ..explicit::Settings::default() };
    [
        climb(&task, &|assembly| rested(Equilibrium::of(assembly, implicit::Settings::default()))),
        climb(&task, &|assembly| rested(Simulation::of(assembly, slow))),
    ]
    .map(|run| {
        assert_eq!(run.outcome.name(), "equilibrium", "{mechanisms:?}: {}", run.outcome.reason());
        run.steps.iter().map(|step| step.points.expect("it has a top")).collect()
    })
}

/// Rate of creep (1/deg): one part in e per radian.
const CREEP: f64 = std::f64::consts::PI / 180.0;

/// Every mechanism in turn, by its name, and some together.
fn cases() -> Vec<(&'static str, Mechanisms)> {
    let values: [(&str, &[f64]); 18] = [
        ("contact_inset", &[8e-3]),
        ("joint_closure", &[2e7, 1e-4]),
        ("stress_stiffening", &[1e9, 0.5, 1e7]),
        ("contact_area", &[0.4]),
        ("friction", &[0.7, 0.8, 1e-3]),
        ("cohesion", &[500.0]),
        ("lean", &[2.0]),
        ("base_compliance", &[5e6, 5e4]),
        ("wedge_loss", &[0.6, 3.0]),
        ("rope_slack", &[1e-3]),
        ("size_scatter", &[1.3]),
        ("density", &[1.2]),
        ("creep", &[CREEP, 0.1, 5.0]),
        ("specimen_scatter", &[0.3, 0.1]),
        ("end_release", &[0.2, 0.5, 0.3]),
        // The wall slides as a whole at 6.8 deg: at the end a part of its base does.
        ("platform_friction", &[6.8428]),
        ("bearing_points", &[3.5, 1e-4, 0.3]),
        ("bedding", &[0.2]),
    ];
    let many: [(&str, &[f64]); 8] = [
        ("contact_inset", &[3e-3]),
        ("joint_closure", &[2e7, 1e-4]),
        ("contact_area", &[0.7]),
        ("friction", &[0.9, 0.8, 1e-3]),
        ("lean", &[0.5]),
        ("base_compliance", &[5e6, 5e4]),
        ("creep", &[CREEP, 0.1, 5.0]),
        ("end_release", &[0.2, 0.5, 0.3]),
    ];
    let one = |on: Mechanisms, (name, values): &(&str, &[f64])| on.with(name, values);
    let each = values.iter().map(|case| (case.0, one(Mechanisms::default(), case)));
    each.chain([("many", many.iter().fold(Mechanisms::default(), one))]).collect()
}

#[test]
#[ignore = "slow: 70 s of processor time"]
fn both_solvers_move_a_wall_alike_with_every_mechanism() {
    let cases = cases();
    // Gauges act on readings alone, see `mechanisms` among the tests of ensembles; others on how a wall meets motions of its base, see
    // `shaken` there.
    let elsewhere = ["gauge_offset", "gauge_scale", "worn_bearing", "heading", "motion_scale", "restitution"];
    let acting = CAUSES.iter().map(|cause| cause.name).filter(|name| !elsewhere.contains(name));
    assert!(acting.eq(cases.iter().map(|(name, _)| *name).filter(|name| *name != "many")));
    let [base, _] = moved(&Mechanisms::default());
    let compared: Vec<_> = cases.par_iter().map(|(name, mechanisms)| (*name, moved(mechanisms))).collect();
    for (name, [a, b]) in compared {
        assert_eq!(a.len(), b.len());
        let size = |x: &[[f64; 3]]| x.iter().flatten().fold(0.0, |m: f64, d| m.max(d.abs()));
        let apart = |x: &[[f64; 3]], y: &[[f64; 3]]| {
            x.iter().flatten().zip(y.iter().flatten()).fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()))
        };
        let (differ, changed) = (apart(&a, &b) / size(&a), apart(&a, &base) / size(&base));
        println!(
            "{name}: {:.3e} m, solvers {:.2} % apart, changed by {:.1} %",
            size(&a),
            100.0 * differ,
            100.0 * changed
        );
        // What is lost at once is lost with an overshoot in time, a per cent; the rest agrees to some thousandths.
        assert!(differ < if name == "wedge_loss" { 0.02 } else { 0.005 }, "{name}: {a:?} {b:?}");
        // Far above what the implicit solver leaves, 1e-7; without slip cohesion acts in a few sub-contacts alone.
        assert!(changed > 1e-5, "{name} changes nothing: {a:?}");
    }
}
