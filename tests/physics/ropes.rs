//! Ropes: elongation, slack and pretension of one rope in closed form, the same by both solvers, rigid in limit analysis;
//! where they cross a wall.

use pirca::contact;
use pirca::generate::canonical::{self, COURSE_HEIGHT, THICKNESS};
use pirca::law::Coulomb;
use pirca::math::{Vec3, atan, cos, degrees, radians, sin};
use pirca::model::{Level, Outcome, Wall};
use pirca::protocol::{Bounds, Direction, Ends, Protocol, Restraint, Rope, Tilting, ropes, run};
use pirca::solve::explicit::{self, Simulation};
use pirca::solve::implicit::{self, Equilibrium};
use pirca::solve::limit::{Analysis, Settings};
use pirca::solve::{Assembly, Equilibrate, Solver, Status, Tie};

use crate::fixture::{G, dry, on_floor, resting, tilted};

const SIZE: [f64; 3] = [0.3, 0.4, 0.2];
const WEIGHT: f64 = 0.3 * 0.4 * 0.2 * 2400.0 * G;
/// Soft enough for an elongation of some millimetres.
const STIFFNESS: f64 = 2e4;

/// A rope at the height of the block's centroid, on its uphill face: on a smooth slope a block that is pushed uphill from
/// below, by a force of fixed direction, turns about, as the tangent says.
fn rope() -> Tie {
    Tie {
        body: 0,
        point: Vec3::new(0.0, -0.2, 0.1),
        direction: Vec3::y(),
        stiffness: STIFFNESS,
        pretension: 0.0,
        slack: 0.0,
        two_sided: false,
        travel: 0.0,
    }
}

/// How far (m) a block held by a rope goes down a slope, by the solver that `of` makes.
fn slid<'a, S: Equilibrate<'a>>(
    law: &'a Coulomb,
    tie: Tie,
    tilt_deg: f64,
    of: impl Fn(Assembly<'a>) -> S,
) -> f64 {
    let wall = on_floor(vec![resting(SIZE, 2400.0)]);
    let mut assembly = Assembly::new(&wall, law, contact::Settings::for_size(0.2, [2, 2]));
    assembly.add_tie(tie);
    let mut solver = of(assembly);
    solver.set_loads(tilted(tilt_deg), 1.0);
    let settled = solver.settle(&mut |_| false);
    assert_eq!(settled.status, Status::Equilibrium, "{settled:?}");
    solver.assembly().bodies.all[0].position.y
}

fn by_both(law: &Coulomb, tie: Tie, tilt_deg: f64) -> [f64; 2] {
    let exact = implicit::Settings { unbalanced_ratio: 1e-10, ..implicit::Settings::default() };
    let slow = explicit::Settings { unbalanced_ratio: 1e-9, ..explicit::Settings::default() };
    [
        slid(law, tie, tilt_deg, |assembly| Equilibrium::of(assembly, exact)),
        slid(law, tie, tilt_deg, |assembly| Simulation::of(assembly, slow)),
    ]
}

#[test]
fn a_rope_is_stretched_by_what_friction_does_not_hold() {
    let (a, mu) = (radians(20.0), 0.1);
    let (push, grip) = (WEIGHT * sin(a), mu * WEIGHT * cos(a));
    let (smooth, rough) =
        (Coulomb { tan_phi: 0.0, ..dry(1e9, 0.0) }, Coulomb { tan_phi: mu, ..dry(1e9, 0.0) });
    let cases = [
        ("smooth", smooth, rope(), push / STIFFNESS),
        ("pretension", smooth, Tie { pretension: 50.0, ..rope() }, (push - 50.0) / STIFFNESS),
        ("slack", smooth, Tie { slack: 3e-3, ..rope() }, 3e-3 + push / STIFFNESS),
        ("two-sided slack", smooth, Tie { slack: 3e-3, two_sided: true, ..rope() }, 3e-3 + push / STIFFNESS),
    ];
    for (name, law, tie, exact) in cases {
        for found in by_both(&law, tie, 20.0) {
            println!("{name}: {found:e} against {exact:e}");
            // The block sinks by 5 um under its weight, and turns by a tenth of that where friction acts at its foot: the
            // rope's point moves by less than a micrometre more or less than the centroid.
            assert!((found - exact).abs() < 1e-6, "{name}: {found:e} against {exact:e}");
        }
    }
    // Friction that acts uphill leaves the rope the least; a block that slides into the rope in time swings past that, and
    // may be held by friction the other way.
    let (least, most) = (3e-3 + (push - grip) / STIFFNESS, 3e-3 + (push + grip) / STIFFNESS);
    let [still, swung] = by_both(&rough, Tie { slack: 3e-3, ..rope() }, 20.0);
    println!("rough: {still:e} and {swung:e}, {least:e} to {most:e}");
    assert!((still - least).abs() < 1e-6, "{still:e}");
    assert!(swung >= least && swung <= most, "{swung:e}");
}

#[test]
fn a_rope_that_is_pushed_goes_slack_and_a_strut_does_not() {
    let rough = dry(1e9, 30.0);
    // Tilted the other way: friction holds the block, which only shears its joint.
    for found in by_both(&rough, rope(), -10.0) {
        let shear = -WEIGHT * sin(radians(10.0)) / (5e8 * 0.3 * 0.4);
        println!("{found:e} against {shear:e}");
        // The block leans as well, on a bed twice as stiff and under a moment of a fifth of its width.
        assert!(found < shear && found > 2.0 * shear, "{found:e} against {shear:e}");
    }
    let smooth = Coulomb { tan_phi: 0.0, ..dry(1e9, 0.0) };
    let strut = Tie { two_sided: true, point: Vec3::new(0.0, 0.2, 0.1), ..rope() };
    for found in by_both(&smooth, strut, -10.0) {
        let exact = -WEIGHT * sin(radians(10.0)) / STIFFNESS;
        assert!((found - exact).abs() < 1e-6, "{found:e} against {exact:e}");
    }
    // Drawn uphill by its pretension until there is none left, on a slope where nothing else acts.
    for found in by_both(&smooth, Tie { pretension: 60.0, two_sided: true, ..rope() }, 0.0) {
        assert!((found + 60.0 / STIFFNESS).abs() < 1e-6, "{found:e}");
    }
}

#[test]
fn limit_analysis_ties_a_block_with_a_rope_that_does_not_stretch() {
    // Width b, height h, rope at height z. Its pull T and the friction F at the foot, at most mu N, hold the push: T + F =
    // W sin a. About the middle of the base W sin a h/2 = T z + N e with e at most b/2. The block hangs on the rope as high
    // as the friction lets its foot press against it, F = -mu N: tan a (h/2 - z) = b/2 + mu z. The other way round a rope
    // is slack and the block slides, where a strut holds it.
    let (b, h, z, mu) = (0.2, 0.4, 0.1, 0.2);
    let law = Coulomb { tan_phi: mu, ..dry(1e9, 0.0) };
    let wall = on_floor(vec![resting([0.3, b, h], 2400.0)]);
    let tie = Tie { point: Vec3::new(0.0, 0.5 * b, z), slack: 0.01, pretension: 5.0, ..rope() };
    let angle = |two_sided: bool, direction: Vec3| {
        let analysis =
            Analysis::new(&wall, &law, contact::Settings::for_size(0.2, [2, 2]), Settings::default());
        let limit = analysis.with_ties(&[Tie { two_sided, ..tie }]).tilt(direction, &[]);
        assert!(limit.accuracy.gap.abs() < 1e-6, "{:?}", limit.accuracy);
        match limit.outcome {
            Outcome::Collapsed { at: Level::Tilt(angle) } => angle,
            other => panic!("{other:?}"),
        }
    };
    let held = atan((0.5 * b + mu * z) / (0.5 * h - z));
    for (two_sided, direction, exact) in [
        (false, Vec3::y(), held),
        (false, -Vec3::y(), atan(mu)),
        (true, Vec3::y(), held),
        (true, -Vec3::y(), held),
    ] {
        let found = angle(two_sided, direction);
        println!("{two_sided} {direction:?}: {} against {} deg", degrees(found), degrees(exact));
        // The accuracy of the conic solver.
        assert!(degrees(found - exact).abs() < 1e-5, "{} against {}", degrees(found), degrees(exact));
    }
}

#[test]
fn each_stone_that_a_rope_crosses_on_the_downhill_face_is_tied_at_mid_height() {
    let (wall, rope) = (canonical::running_bond(4, 3), Rope { from_end: 0.05, ..Rope::default() });
    let front = ropes(&wall, &rope, Direction::YPlus);
    assert_eq!(front.len(), 8);
    for (k, tie) in front.iter().enumerate() {
        let x = if k < 4 { 0.05 } else { 0.65 };
        let middle = Vec3::new(x, 0.5 * THICKNESS, (k % 4) as f64 * COURSE_HEIGHT + 0.5 * COURSE_HEIGHT);
        assert!((tie.point - middle).norm() < 1e-12, "{k}: {:?}", tie.point);
        // The first and the last of four stones in a course.
        assert_eq!(tie.body, 4 * (k % 4) + if k < 4 { 0 } else { 3 });
    }
    let back = ropes(&wall, &rope, Direction::YMinus);
    assert!(back.iter().all(|tie| tie.point.y == -0.5 * THICKNESS && tie.direction == -Vec3::y()));
    // A second wythe behind it is not tied.
    let mut two = wall.clone();
    for block in &wall.blocks {
        let mut behind = block.clone();
        behind.shape = behind.shape.translated(&Vec3::new(0.0, -THICKNESS, 0.0));
        two.blocks.push(behind);
    }
    assert_eq!(ropes(&two, &rope, Direction::YPlus), front);
    // In a head joint there is nothing to tie.
    assert_eq!(ropes(&wall, &Rope { from_end: 0.1, ..rope }, Direction::YPlus).len(), 4);
}

fn tilt(wall: &Wall, ends: Ends, end_deg: f64, solver: &Solver) -> pirca::protocol::Run {
    let tilting =
        Tilting { step: radians(1.0), end: radians(end_deg), bracket: radians(0.1), ..Tilting::default() };
    run(wall, &dry(5e8, 35.0), &Protocol::Tilting(tilting), &Restraint::at_ends(ends), [2, 2], solver)
}

#[test]
fn a_roped_wall_stands_longer_moves_less_and_both_solvers_agree() {
    let wall = canonical::running_bond(6, 4);
    let implicit = Solver::Implicit(implicit::Settings::default());
    let explicit = Solver::Explicit(explicit::Settings {
        damping: 0.5,
        unbalanced_ratio: 1e-7,
        ..explicit::Settings::default()
    });
    let roped = Ends::Ropes(Rope::default());
    let points = |ends, solver| {
        tilt(&wall, ends, 15.0, solver).steps.last().and_then(|s| s.points).expect("it stands")
    };
    let (free, a, b) = (points(Ends::Free, &implicit), points(roped, &implicit), points(roped, &explicit));
    println!("free {free:?} roped {a:?} {b:?}");
    for (k, (x, y)) in a.iter().zip(&b).enumerate() {
        // The way to rest differs and slip with it: as for free walls, a per cent of the largest displacement.
        assert!((x - y).abs() < 0.01 * a[1], "{k}: {x:e} {y:e}");
        assert!(*x < 0.9 * free[k], "{k}: {x:e} of {:e}", free[k]);
    }
    // The ends are held, the middle hangs between them.
    assert!(a[1] > a[0] && a[1] > a[2], "{a:?}");
    let angle = |ends, solver| match tilt(&wall, ends, 80.0, solver).outcome {
        Outcome::Collapsed { at: Level::Tilt(at) } => at,
        other => panic!("{other:?}"),
    };
    let (free, roped_implicit, roped_explicit) =
        (angle(Ends::Free, &implicit), angle(roped, &implicit), angle(roped, &explicit));
    println!("{} {} {}", degrees(free), degrees(roped_implicit), degrees(roped_explicit));
    assert!(roped_implicit > free + radians(1.0));
    // Ropes hold rigid blocks as well: the bound of limit analysis is above.
    let protocol = Protocol::Tilting(Tilting::default());
    let bound = Bounds::of(&wall, &dry(5e8, 35.0), &protocol, &Restraint::at_ends(roped), [2, 2]);
    println!("{:?}", bound.associative.map(degrees));
    assert!(bound.associative.expect("it falls") > roped_implicit);
    // As free random walls do.
    assert!(degrees(roped_implicit - roped_explicit).abs() < 0.25);
}
