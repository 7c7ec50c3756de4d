//! What counts as fallen: slabs, columns, rows and gates that topple, slide, rock and come back, whichever way they face and whatever stands
//! elsewhere.

use std::f64::consts::FRAC_PI_4;

use nalgebra::Rotation3;
use pirca::law::Coulomb;
use pirca::math::{Vec3, atan, cos, degrees, radians, sin, tan};
use pirca::model::{Block, Level, Outcome, Support, Wall};
use pirca::motion::{Motion, Pulse};
use pirca::protocol::{
    Direction, InTime, Lean, LoadPath, Rested, Shaken, Shaking, Task, Verdict, drive, pile_thicknesses, shake,
};
use pirca::shape::Polyhedron;
use pirca::solve::explicit::{self, Rayleigh};
use pirca::solve::{Solver, implicit, nonsmooth};

use crate::base_motion::nonsmooth as by_contact_dynamics;
use crate::fixture::{G, dry, path, stone};
use crate::rocking_block::{Block as Rocking, Impact};

/// Half a sine of 6 m/s^2 that lasts half a second overturns what is 0.2 m thick and 1 m high by far.
const PULSE: Pulse = Pulse::HalfSine { amplitude: 6.0, duration: 0.5 };

/// A box of a size with its foot about a place on the ground.
pub fn standing(size: [f64; 3], at: [f64; 3]) -> Block {
    let ([x, y, z], half) = (at, size.map(|own| 0.5 * own));
    let low = Vec3::new(x - half[0], y - half[1], z);
    stone(Polyhedron::cuboid(low, low + Vec3::from(size)), 2400.0)
}

/// The blocks turned about the vertical by an angle (rad), on a wide ground, which is the last block.
pub fn on_ground(mut blocks: Vec<Block>, turn: f64) -> Wall {
    let turn = Rotation3::from_axis_angle(&Vec3::z_axis(), turn).into_inner();
    blocks.iter_mut().for_each(|block| block.shape = block.shape.moved(&turn, &Vec3::zeros()));
    let ground = Polyhedron::cuboid(Vec3::new(-40.0, -40.0, -0.5), Vec3::new(40.0, 40.0, 0.0));
    blocks.push(Block { support: Support::Fixed, ..stone(ground, 2400.0) });
    Wall { blocks }
}

/// So rough that nothing slides.
pub fn rough() -> Coulomb {
    dry(1e9, degrees(atan(3.0)))
}

/// A motion whose only component acts towards an angle (rad) from x.
pub fn towards(pulse: Pulse, angle: f64) -> Motion {
    let along = Vec3::new(cos(angle), sin(angle), 0.0);
    Motion::of_pulse(pulse)
        .and_then(|pulse| pulse.along(&along).map_err(|fault| vec![fault]))
        .expect("a pulse")
}

/// The wall shaken by contact dynamics at its default step.
pub fn shaken(wall: &Wall, law: &Coulomb, motion: Motion) -> Shaken {
    shake(&at_rest(wall, law), &Shaking::new(motion), by_contact_dynamics(2e-3))
}

fn at_rest<'t>(wall: &'t Wall, law: &'t Coulomb) -> Task<'t> {
    path(wall, law, LoadPath::tilt(Direction::YPlus, 0.01, 1.0, 1e-4))
}

/// The blocks that fell, ascending.
pub fn fallen(seen: &Shaken) -> Vec<usize> {
    let mut blocks: Vec<usize> = seen.fallen.iter().map(|(block, _)| *block).collect();
    blocks.sort_unstable();
    blocks
}

#[test]
fn a_slab_that_lies_flat_has_fallen_whichever_way_it_faces() {
    let explicit = InTime::Explicit(explicit::Settings::default(), Rayleigh::default());
    for eighth in 0..8 {
        let turn = f64::from(eighth) * FRAC_PI_4;
        let wall = on_ground(vec![standing([0.2, 1.0, 1.0], [0.0; 3])], turn);
        let (law, shaking) = (rough(), Shaking::new(towards(PULSE, turn)));
        let task = at_rest(&wall, &law);
        let solvers = [by_contact_dynamics(2e-3), explicit];
        // Elastic joints in the two directions alone in which the axes differ.
        for solver in &solvers[..if eighth < 2 { 2 } else { 1 }] {
            let seen = shake(&task, &shaking, *solver);
            assert_eq!((seen.verdict, fallen(&seen)), (Verdict::Collapsed, vec![0]), "{eighth}: {seen:?}");
            assert_eq!(seen.residual_m, None);
        }
    }
}

/// A sheet of 8 mm between two blocks: each soft joint closes by some millimetres under what it bears, so the sheet goes down by its own height.
#[test]
fn a_thin_stone_that_sinks_into_soft_joints_has_not_fallen() {
    let block = |low: f64, height: f64| {
        let mut block = standing([0.4, 0.4, height], [0.0; 3]);
        block.shape = block.shape.translated(&Vec3::new(0.0, 0.0, low));
        block
    };
    let wall = on_ground(vec![block(0.0, 0.3), block(0.3, 0.008), block(0.308, 0.4)], 0.0);
    let law = dry(3e6, 60.0);
    let task = path(&wall, &law, LoadPath::tilt(Direction::YPlus, radians(1.0), radians(60.0), radians(0.1)));
    let Outcome::Collapsed { at: Level::Tilt(angle) } =
        drive(&task, &Solver::Implicit(implicit::Settings::default())).outcome
    else {
        panic!("it stands at rest, and turns over its edge")
    };
    // Rigid joints: atan(0.2 / 0.354). Beds that close by some millimetres let it lean, which halves that.
    assert!((10.0..degrees(atan(0.2 / 0.354))).contains(&degrees(angle)), "{} deg", degrees(angle));
    let explicit = InTime::Explicit(explicit::Settings::default(), Rayleigh::default());
    let little = Pulse::HalfSine { amplitude: 1.0, duration: 0.2 };
    let seen = shake(&task, &Shaking::new(towards(little, 0.0)), explicit);
    assert_eq!((seen.verdict, fallen(&seen)), (Verdict::Stands, vec![]), "{seen:?}");
}

#[test]
fn rows_columns_set_apart_and_gates_fall_as_their_stones_do() {
    let row: Vec<Block> = (0..5).map(|k| standing([0.2, 1.0, 1.0], [0.0, f64::from(k), 0.0])).collect();
    let column = |x: f64, y: f64| standing([0.2, 0.2, 1.0], [x, y, 0.0]);
    let columns = vec![column(-5.0, -5.0), column(5.0, -5.0), column(-5.0, 5.0), column(5.0, 5.0)];
    let post = |x: f64| standing([0.2, 0.3, 1.0], [x, 0.0, 0.0]);
    let gate = vec![post(-0.5), post(0.5), standing([1.2, 0.3, 0.2], [0.0, 0.0, 1.0])];
    for (what, blocks) in [("row", row), ("columns", columns), ("gate", gate)] {
        for turn in [0.0, 2.0 * FRAC_PI_4] {
            let wall = on_ground(blocks.clone(), turn);
            let seen = shaken(&wall, &rough(), towards(PULSE, turn));
            assert_eq!(seen.verdict, Verdict::Collapsed, "{what} {turn}: {seen:?}");
            // Where half of the weight lies the rest is not followed.
            assert!(2 * fallen(&seen).len() >= blocks.len(), "{what} {turn}: {seen:?}");
        }
    }
}

#[test]
fn what_stands_elsewhere_and_how_stones_are_numbered_changes_nothing() {
    let slab = standing([0.2, 1.0, 1.0], [0.0; 3]);
    let stocky = |x: f64, y: f64| standing([1.0, 1.0, 0.5], [x, y, 0.0]);
    for (blocks, falls) in [
        (vec![slab.clone(), stocky(9.0, 9.0)], 0),
        (vec![stocky(-9.0, 9.0), slab.clone()], 1),
        (vec![stocky(9.0, -9.0), slab, stocky(3.0, 9.0)], 1),
    ] {
        let seen = shaken(&on_ground(blocks, 0.0), &rough(), towards(PULSE, 0.0));
        assert_eq!((seen.verdict, fallen(&seen)), (Verdict::Damaged, vec![falls]), "{seen:?}");
        let alone = on_ground(vec![standing([0.2, 1.0, 1.0], [0.0; 3])], 0.0);
        let alone = shaken(&alone, &rough(), towards(PULSE, 0.0));
        let [with, without] = [&seen, &alone].map(|own| own.first_stone_s.expect("it falls"));
        assert!((with - without).abs() < 0.01, "{with} {without}");
    }
}

#[test]
fn a_rock_of_several_parts_falls_as_one() {
    // A rock with a part inside, whose centroid hardly moves more than that of the whole.
    let mut whole = standing([0.4, 0.4, 1.2], [0.0; 3]);
    let mut inside = standing([0.1, 0.1, 0.1], [0.0, 0.0, 0.2]);
    (whole.group, inside.group) = (Some("rock".to_owned()), Some("rock".to_owned()));
    let wall = on_ground(vec![whole, inside], 0.0);
    let pulse = Pulse::HalfSine { amplitude: 9.0, duration: 0.6 };
    let seen = shaken(&wall, &rough(), towards(pulse, 0.0));
    assert_eq!((seen.verdict, fallen(&seen)), (Verdict::Collapsed, vec![0]), "{seen:?}");
}

#[test]
fn rocking_that_comes_back_has_not_fallen_and_past_the_static_limit_it_counts_from_when_it_stayed() {
    // A half sine lifts the block by 0.9 of its slenderness, and the ground takes it back.
    let (b, h) = (0.2, 0.6);
    let wall = on_ground(vec![standing([2.0 * b, 2.0 * b, 2.0 * h], [0.0; 3])], 0.0);
    let pulse = |factor: f64| Pulse::HalfSine { amplitude: factor * 5.892_17 * G / 9.81, duration: 0.460_6 };
    let back = shaken(&wall, &rough(), towards(pulse(0.98), 0.0));
    assert_eq!((back.verdict, fallen(&back)), (Verdict::Stands, vec![]), "{back:?}");
    assert!((0.6..1.03).contains(&(back.rotation.value / atan(b / h))), "{:?}", back.rotation);
    assert!(back.residual_rad.expect("it stands") < 1e-3, "{back:?}");
    let over = shaken(&wall, &rough(), towards(pulse(1.05), 0.0));
    assert_eq!(over.verdict, Verdict::Collapsed, "{over:?}");
    // Before it fell it had turned to where its centroid stood over its edge.
    assert!((over.rotation.value / atan(b / h) - 1.0).abs() < 0.02, "{:?}", over.rotation);
}

#[test]
fn what_slides_has_fallen_where_it_leaves_its_bearing_and_nowhere_else() {
    // A flat block on a table of 1.2 m x 1.2 m x 0.3 m, tan(phi) 0.3, pushed by a rectangle for 0.4 s: it slides by 0.47 m on an endless table.
    let law = dry(1e9, degrees(atan(0.3)));
    let pulse = Pulse::Rectangle { amplitude: 0.6 * G, duration: 0.4 };
    let slides = |table: f64| {
        let flat = standing([0.4, 0.4, 0.1], [0.0, 0.0, 0.3]);
        let bearing = standing([table, table, 0.3], [0.0; 3]);
        let wall = on_ground(vec![flat, Block { support: Support::Fixed, ..bearing }], 0.3);
        shaken(&wall, &law, towards(pulse, 0.3))
    };
    let stays = slides(2.0);
    assert_eq!(stays.verdict, Verdict::Stands, "{stays:?}");
    assert!((stays.residual_m.expect("it stands") / 0.471 - 1.0).abs() < 0.01, "{stays:?}");
    let off = slides(0.6);
    assert_eq!((off.verdict, fallen(&off)), (Verdict::Collapsed, vec![0]), "{off:?}");
    // A step that is lower than the block: it slides down and stands upright.
    let block = standing([0.2, 0.4, 0.2], [-0.21, 0.0, 0.04]);
    let step = Block { support: Support::Fixed, ..standing([0.25, 2.0, 0.04], [-0.235, 0.0, 0.0]) };
    let wall = on_ground(vec![block, step], 0.0);
    let pulse = Pulse::Rectangle { amplitude: -0.7 * G, duration: 0.35 };
    let down = shaken(&wall, &law, towards(pulse, 0.0));
    assert_eq!((down.verdict, fallen(&down)), (Verdict::Collapsed, vec![0]), "{down:?}");
}

#[test]
fn a_ground_that_leans_is_that_of_the_reference_and_too_steep_a_one_lets_fall() {
    let (b, h) = (0.2, 0.6);
    let law = rough();
    let wall = on_ground(vec![standing([2.0 * b, 2.0 * b, 2.0 * h], [0.0; 3])], 0.0);
    let task = at_rest(&wall, &law);
    let pulse = Pulse::HalfSine { amplitude: -0.5 * G, duration: 0.3 };
    let motion = towards(pulse, 0.0);
    for angle in [0.02, -0.03] {
        let lean = match angle > 0.0 {
            true => Lean { towards: Direction::XPlus, angle },
            false => Lean { towards: Direction::XMinus, angle: -angle },
        };
        let seen = Rested::of(&task, lean, by_contact_dynamics(5e-4)).shaken(&Shaking::new(motion.clone()));
        let block = Rocking { slope: angle, ..Rocking::perfect(b, h) };
        let wanted = block.shaken(&motion.accelerogram(&Vec3::x()), 5.0, Impact::Housner);
        assert!(!wanted.overturned && seen.verdict == Verdict::Stands, "{wanted:?} {seen:?}");
        assert!((seen.rotation.value / wanted.peak - 1.0).abs() < 5e-3, "{angle}: {wanted:?} {seen:?}");
    }
    // Its slenderness is 18.4 deg.
    for (deg, verdict) in [(18.0, Verdict::Stands), (19.0, Verdict::UnstableAtRest)] {
        let lean = Lean { towards: Direction::At(0.5), angle: radians(deg) };
        let turned = on_ground(vec![standing([2.0 * b, 2.0 * b, 2.0 * h], [0.0; 3])], 0.5);
        let task = at_rest(&turned, &law);
        let still = Pulse::HalfSine { amplitude: 1e-3, duration: 0.1 };
        let seen =
            Rested::of(&task, lean, by_contact_dynamics(2e-3)).shaken(&Shaking::new(towards(still, 0.5)));
        assert_eq!(seen.verdict, verdict, "{deg}: {seen:?}");
    }
}

#[test]
fn columns_set_apart_collapse_at_their_own_tilt() {
    // 0.2 m x 0.6 m: atan(1 / 3) = 18.4 deg, however far apart they stand.
    let column = |x: f64, y: f64| standing([0.2, 0.2, 0.6], [x, y, 0.0]);
    let wall =
        on_ground(vec![column(-5.0, -5.0), column(5.0, -4.0), column(-4.0, 5.0), column(5.0, 5.0)], 0.0);
    let law = dry(1e9, 40.0);
    let joints = (0..4).map(|block| (block, 4));
    let piles = pile_thicknesses(&wall, joints);
    assert!(piles[..4].iter().all(|own| (own - 0.2).abs() < 1e-12) && piles[4] == 0.0, "{piles:?}");
    let tilt = LoadPath::tilt(Direction::XPlus, radians(1.0), radians(89.0), radians(0.05));
    let task = Task { piles, ..path(&wall, &law, tilt) };
    let run = drive(&task, &Solver::Nonsmooth(nonsmooth::Settings::default()));
    let Outcome::Collapsed { at } = run.outcome else { panic!("{:?}", run.outcome) };
    assert!((tan(at.value()) * 3.0 - 1.0).abs() < 0.01, "{at}");
}

#[test]
fn a_pile_is_as_thick_as_it_is_across_whichever_way_it_lies() {
    // Two stones that touch and lie at 30 deg, beside a third one apart.
    let blocks = vec![
        standing([0.4, 0.2, 0.3], [0.0; 3]),
        standing([0.4, 0.2, 0.3], [0.4, 0.0, 0.0]),
        standing([1.0, 0.7, 0.3], [5.0, 5.0, 0.0]),
    ];
    let wall = on_ground(blocks, radians(30.0));
    let found = pile_thicknesses(&wall, [(0, 1), (0, 3), (1, 3), (2, 3)].into_iter());
    for (found, wanted) in found.iter().zip([0.2, 0.2, 0.7, 0.0]) {
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
}
