//! The implicit solver against closed forms: elastic bed, stacks, frames, rattling stones, what it hands over.

use nalgebra::Rotation3;
use pirca::contact;
use pirca::generate::canonical;
use pirca::law::Coulomb;
use pirca::math::{Vec3, asin, atan, cos, degrees, radians, tan};
use pirca::model::{Block, JointLaws, Level, Outcome, Support, Wall};
use pirca::protocol::{Base, Direction, Ends, LoadPath, Protocol, Restraint, Run, Tilting, drive, run};
use pirca::shape::Polyhedron;
use pirca::solve::explicit::{self, Simulation};
use pirca::solve::implicit::{Equilibrium, Settings};
use pirca::solve::{Ahead, Equilibrate, Followed, Solver, Status, Way};

use crate::fixture::{G, dry, on_floor, path, resting, stone, tilted};

fn exact() -> Settings {
    Settings { unbalanced_ratio: 1e-10, ..Settings::default() }
}

/// A wall with the tolerances of stones of 0.2 m, at rest on a table tilted by so much.
fn at_rest<'a>(wall: &Wall, law: &'a Coulomb, sub: [u32; 2], gravity: Vec3) -> Equilibrium<'a> {
    let mut equilibrium = Equilibrium::new(wall, law, exact(), contact::Settings::for_size(0.2, sub));
    equilibrium.set_loads(gravity, 1.0);
    let settled = equilibrium.settle(&mut |_| false);
    assert_eq!(settled.status, Status::Equilibrium, "{settled:?}");
    equilibrium
}

fn position(equilibrium: &Equilibrium, block: usize) -> Vec3 {
    equilibrium.assembly().bodies.all[block].position
}

/// Tilts a wall of stones by the implicit solver.
fn tilt(wall: &Wall, law: &Coulomb, settings: Settings, bracket_deg: f64) -> Run {
    let tilting = Tilting { bracket: radians(bracket_deg), ..Tilting::default() };
    let restraint = Restraint { base: Base::default(), ends: Ends::Free };
    run(wall, law, &Protocol::Tilting(tilting), &restraint, [2, 2], &Solver::Implicit(settings))
}

fn bracket(run: &Run) -> [f64; 2] {
    assert!(matches!(run.outcome, Outcome::Collapsed { .. }), "{:?}", run.outcome);
    run.bracket.expect("a collapse is bracketed").map(degrees)
}

#[test]
fn the_block_on_an_elastic_bed_collapses_at_the_row_of_its_convention() {
    let (b, h, w) = (0.15, 0.1875, 889.0);
    let wall = Wall { blocks: vec![resting([1.0, b, 2.0 * h], w / (G * b * 2.0 * h))] };
    // Line of action on the block's face, see `tilting.rs`.
    for (kn, row) in [(2.5e7, 15.834), (5e7, 17.088), (7.5e7, 17.694), (1.75e8, 18.718)] {
        let [low, high] = bracket(&tilt(&wall, &dry(kn, 80.0), Settings::default(), 0.002));
        println!("kn {kn:e}: {low:.4} to {high:.4} against {row}");
        assert!(high - low < 0.0021);
        assert!(low > row - 0.02 && high < row + 0.02, "kn {kn:e}: {low} to {high} against {row}");
    }
}

/// Tilt (rad) at which a block on an elastic bed is in equilibrium with its base turned by `t`: the closed form of the row
/// above, and beyond its maximum the branch on which it leans out further and bears less.
fn tilt_at([b, h, w]: [f64; 3], kn: f64, t: f64) -> f64 {
    // N depends on the tilt, so this is a fixed point; the load is that of a metre of wall.
    (0..200).fold(0.2, |a, _| {
        let n = w * cos(a + t);
        let compressed = (2.0 * n / (kn * t)).sqrt();
        let e = if compressed >= b { kn * t * b * b * b / (12.0 * n) } else { 0.5 * b - compressed / 3.0 };
        atan(e / h) - t
    })
}

#[test]
fn the_path_is_followed_through_its_limit_point_and_down_beyond() {
    let (b, h, w, kn) = (0.15, 0.1875, 889.0, 5e7);
    let wall = on_floor(vec![resting([1.0, b, 2.0 * h], w / (G * b * 2.0 * h))]);
    let law = dry(kn, 80.0);
    let from = radians(10.0);
    let start = at_rest(&wall, &law, [2, 2], tilted(10.0));
    let loads = |level: f64| (tilted(degrees(level)), 1.0);
    let bracket = radians(0.002);
    let ahead = Ahead { loads: &loads, from, to: radians(40.0), far: 0.03, bracket };
    let Some(Followed { level, way: Way::Falls { above, at, bodies, .. }, .. }) = start.follow(&ahead) else {
        panic!("the path turns")
    };
    let limit = (1..4000).map(|k| tilt_at([b, h, w], kn, 1e-5 * f64::from(k))).fold(0.0, f64::max);
    println!("{:.4} to {:.4} against {:.4} deg", degrees(level), degrees(above), degrees(limit));
    // The closed form lets the pressure act across the base, the block's own lies in the turned face: second order in t.
    let second_order = radians(0.02);
    assert!(above - level <= bracket && level < limit + second_order && above > limit - second_order);
    // Down the path the block leans by t and stands at the tilt of the closed form.
    let built = Equilibrium::new(&wall, &law, exact(), contact::Settings::for_size(0.2, [2, 2]));
    let turned = bodies.all[0].rotation * built.assembly().bodies.all[0].rotation.transpose();
    let t = asin(turned[(1, 2)]);
    let closed_form = tilt_at([b, h, w], kn, t);
    println!("{:.4} against {:.4} deg at t = {:.3} deg", degrees(at), degrees(closed_form), degrees(t));
    assert!(at < level - radians(1.0) && (at - closed_form).abs() < second_order);
}

fn stack(blocks: u32) -> Wall {
    let at = |k: u32| {
        let z = 0.1 * f64::from(k);
        Polyhedron::cuboid(Vec3::new(-0.15, -0.1, z), Vec3::new(0.15, 0.1, z + 0.1))
    };
    on_floor((0..blocks).map(|k| stone(at(k), 2400.0)).collect())
}

/// Shift along y (m) of the top block of a stack under a push of so many times its weight: shear and lean of every joint,
/// and the weight that has leaned over it (P-delta), to first order in the turns.
fn lean(n: usize, kn: f64, push: f64) -> f64 {
    let (area, second) = (0.3 * 0.2, 0.3 * 0.2f64 * 0.2 * 0.2 / 12.0);
    let weight = 2400.0 * area * 0.1 * G;
    // Middle of the lower face, turn and centroid of each block.
    let (mut foot, mut turn, mut middle) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for _ in 0..20 {
        for k in 0..n {
            let above = (n - k) as f64;
            let moment: f64 = (k..n)
                .map(|j| weight * push * (0.1 * (j - k) as f64 + 0.05) + weight * (middle[j] - foot[k]))
                .sum();
            let (below, lower_turn) =
                if k > 0 { (foot[k - 1] + 0.1 * turn[k - 1], turn[k - 1]) } else { (0.0, 0.0) };
            // The joint lies in the plane of the block below.
            foot[k] = below + weight * above * (push + lower_turn) / (0.5 * kn * area);
            turn[k] = lower_turn + moment / (kn * second);
            middle[k] = foot[k] + 0.05 * turn[k];
        }
    }
    middle[n - 1]
}

#[test]
fn a_stack_settles_and_leans_as_its_joints_do() {
    let (n, kn) = (6usize, 1e9);
    let law = dry(kn, 40.0);
    let (weight, area) = (2400.0 * 0.3 * 0.2 * 0.1 * G, 0.3 * 0.2);
    let settled = at_rest(&stack(n as u32), &law, [2, 2], tilted(0.0));
    // Joint k carries the n - k blocks above it.
    let settlement: f64 = (0..n).map(|k| (n - k) as f64 * weight / (kn * area)).sum();
    let found = 0.1 * (n as f64 - 0.5) - position(&settled, n - 1).z;
    println!("settlement {found:e} against {settlement:e}");
    assert!((found / settlement - 1.0).abs() < 1e-6);
    // Pushes so small that what the closed form leaves out, the squares of turns of 1e-7 rad and settled heights, stays out.
    for push in [1e-4, 1e-3] {
        let pushed = at_rest(&stack(n as u32), &law, [2, 2], Vec3::new(0.0, G * push, -G));
        let (found, shift) = (position(&pushed, n - 1).y, lean(n, kn, push));
        println!("shift {found:e} against {shift:e}: {:.1e}", found / shift - 1.0);
        // Settled by 1e-5 m the joints lie 1e-4 of a block's height closer together.
        assert!((found / shift - 1.0).abs() < 2e-4, "{found:e} {shift:e}");
    }
    // Three hundred times stiffer nothing of that is left.
    let stiff = dry(3e11, 40.0);
    let pushed = at_rest(&stack(n as u32), &stiff, [2, 2], Vec3::new(0.0, G * 1e-2, -G));
    let (found, shift) = (position(&pushed, n - 1).y, lean(n, 3e11, 1e-2));
    println!("shift {found:e} against {shift:e}: {:.1e}", found / shift - 1.0);
    assert!((found / shift - 1.0).abs() < 1e-6, "{found:e} {shift:e}");
}

#[test]
fn more_sub_contacts_change_less_and_less() {
    let wall = canonical::running_bond(5, 3).with_base();
    let law = dry(1e8, 35.0);
    let top = |sub| position(&at_rest(&wall, &law, sub, tilted(14.0)), 18);
    let (two, four, eight) = (top([2, 2]), top([4, 4]), top([8, 8]));
    let start = wall.blocks[18].shape.mass_properties().centroid;
    let size = (eight - start).norm();
    println!("2 x 2: {:e}, 4 x 4: {:e} of {size:e}", (two - eight).norm(), (four - eight).norm());
    // Four points of each part follow shear that is affine over it, so that even 2 x 2 leave next to nothing to gain.
    assert!((two - eight).norm() < 5e-3 * size);
    assert!((four - eight).norm() < (two - eight).norm());
}

#[test]
fn a_turned_and_moved_wall_answers_the_same() {
    let wall = canonical::running_bond(4, 3).with_base();
    let law = dry(1e8, 30.0);
    let turn = Rotation3::from_euler_angles(0.7, -0.4, 1.9).into_inner();
    let shift = Vec3::new(3.0, -2.0, 5.0);
    let mut elsewhere = wall.clone();
    for block in &mut elsewhere.blocks {
        block.shape = block.shape.moved(&turn, &shift);
    }
    let here = at_rest(&wall, &law, [2, 2], tilted(12.0));
    let there = at_rest(&elsewhere, &law, [2, 2], turn * tilted(12.0));
    let (mut largest, mut difference) = (0.0f64, 0.0f64);
    for block in 0..wall.blocks.len() {
        let moved = position(&here, block) - wall.blocks[block].shape.mass_properties().centroid;
        let moved_there = position(&there, block) - elsewhere.blocks[block].shape.mass_properties().centroid;
        largest = largest.max(moved.norm());
        difference = difference.max((turn * moved - moved_there).norm());
    }
    println!("displacement {largest:e}, difference {difference:e}");
    assert!(largest > 1e-5);
    // Positions of 5 m are rounded to 1e-15, gaps so to 1e-11 of the displacement; the stop lets through 1e-10 of the force
    // where leaning is a thousand times softer than pressing.
    assert!(difference < 1e-6 * largest, "{difference:e} of {largest:e}");
}

/// A trough that leans by so much along x, with a stone in it that is narrower by 2 mm and floats above its floor.
fn rattling(lift: f64) -> Wall {
    let cuboid = |low: [f64; 3], high: [f64; 3]| Polyhedron::cuboid(Vec3::from(low), Vec3::from(high));
    on_floor(vec![
        stone(cuboid([-0.2, -0.1, 0.0], [0.2, 0.1, 0.1]), 2400.0),
        stone(cuboid([-0.2, -0.1, 0.1], [-0.05, 0.1, 0.2]), 2400.0),
        stone(cuboid([0.05, -0.1, 0.1], [0.2, 0.1, 0.2]), 2400.0),
        stone(cuboid([-0.049, -0.09, 0.1 + lift], [0.049, 0.09, 0.15 + lift]), 2400.0),
        stone(cuboid([-0.2, -0.1, 0.2], [0.2, 0.1, 0.3]), 2400.0),
    ])
}

#[test]
fn a_stone_that_rattles_does_not_end_the_solve() {
    let law = dry(1e8, 35.0);
    let wall = rattling(0.013);
    let settled = at_rest(&wall, &law, [2, 2], tilted(0.0));
    // It has come down to the floor of the trough, and presses there with its weight.
    let down =
        |block: usize| wall.blocks[block].shape.mass_properties().centroid.z - position(&settled, block).z;
    // By the gap, and by what its own weight presses into the floor: 2.1 kg on 0.0176 m^2 of 1e8 Pa/m.
    let fallen = down(3) - down(0);
    assert!((fallen - 0.013 - 1.2e-5).abs() < 1e-5, "{fallen}");
    let carried =
        settled.assembly().joints.all.iter().filter(|j| j.pair() == (0, 3)).map(|j| j.force).sum::<f64>();
    let weight = settled.assembly().bodies.all[3].mass * G;
    assert!((carried / weight - 1.0).abs() < 1e-6, "{carried} N of {weight} N");
    assert!(settled.loose().is_empty(), "{:?}", settled.loose());
}

#[test]
fn the_stabilisation_does_not_change_the_answer() {
    // A stone hung between two others by nothing but its edge on the floor: weightless, it carries nothing at all.
    let mut wall = rattling(0.0);
    wall.blocks.truncate(5);
    let law = dry(1e8, 35.0);
    let angle = |stabilisation| {
        let settings = Settings { stabilisation, ..Settings::default() };
        bracket(&tilt(&wall, &law, settings, 0.002))[0]
    };
    let (weak, default, strong) = (angle(1e-11), angle(1e-8), angle(1e-5));
    println!("collapse at {weak}, {default}, {strong} deg");
    // 0.01 deg is what is asked for; the bracket is 0.002.
    assert!((weak - default).abs() < 0.005 && (strong - default).abs() < 0.005, "{weak} {default} {strong}");
}

/// Rough joints, but for those of one block, which are smooth.
struct AllButOne(u32);

impl JointLaws for AllButOne {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        dry(1e8, if a == self.0 || b == self.0 { 0.0 } else { 35.0 })
    }
}

#[test]
fn a_stone_that_nothing_holds_is_named() {
    // The stone in the trough stands on a smooth floor, 1 mm from either side.
    let (wall, laws) = (rattling(0.0), AllButOne(3));
    let contact = contact::Settings::for_size(0.2, [2, 2]);
    let mut pushed = Equilibrium::new(&wall, &laws, Settings::default(), contact);
    pushed.set_loads(Vec3::new(0.001 * G, 0.0, -G), 1.0);
    let settled = pushed.settle(&mut |_| false);
    println!("{settled:?}, loose {:?}", pushed.loose());
    assert_eq!(pushed.loose(), [3]);
    // It slides until it meets the side of the trough and is carried there.
    assert_eq!(settled.status, Status::Equilibrium);
    let slid = position(&pushed, 3).x - wall.blocks[3].shape.mass_properties().centroid.x;
    assert!((slid - 0.001).abs() < 1e-5, "{slid}");
}

/// A pillar of 0.1 m (y) by `width` and 1 m of height on one soft joint, under its own weight.
fn pillar(width: f64, kn: f64) -> Status {
    let wall = on_floor(vec![resting([width, 0.1, 1.0], 2400.0)]);
    let law = dry(kn, 40.0);
    let mut upright = Equilibrium::new(&wall, &law, exact(), contact::Settings::for_size(0.2, [2, 2]));
    upright.set_loads(tilted(0.0), 1.0);
    upright.settle(&mut |_| false).status
}

#[test]
fn an_upright_pillar_is_an_equilibrium_only_while_it_is_stable() {
    // Balanced it is in any case; it is stable while the bed's stiffness against lean exceeds the weight's lever:
    // kn b^2 / 12 > density g H^2 / 2, that is kn > 1.41e7 Pa/m.
    let critical = 12.0 * 2400.0 * G * 0.5 / (0.1 * 0.1);
    for width in [0.3, 0.1] {
        // One direction of instability, and two: the determinant alone would not tell.
        assert_eq!(pillar(width, 1.02 * critical), Status::Equilibrium, "width {width}");
        assert_eq!(pillar(width, 0.98 * critical), Status::NoEquilibrium, "width {width}");
    }
}

#[test]
fn the_ways_a_wall_ends_are_told_apart() {
    let law = dry(1e9, 30.0);
    let implicit = Solver::Implicit(Settings::default());
    let multiplier = |end| LoadPath::multiplier(Direction::YPlus, 0.1, end, 1e-4);
    let low_block = on_floor(vec![resting([0.4, 0.4, 0.1], 2400.0)]);
    let stands = drive(&path(&low_block, &law, multiplier(0.5)), &implicit);
    assert_eq!(stands.outcome, Outcome::Equilibrium);
    let slides = drive(&path(&low_block, &law, multiplier(10.0)), &implicit);
    let Outcome::Collapsed { at: Level::Multiplier(at) } = slides.outcome else {
        panic!("{:?}", slides.outcome);
    };
    // A block slides at tan(phi); the bed leans by 1e-6 rad.
    assert!((at - tan(radians(30.0))).abs() < 2e-4, "{at}");
    let [low, high] = slides.bracket.unwrap();
    assert!(high - low <= 1.0001e-4, "{low} to {high}");
    // An overhang of more than half.
    let ledge = Block {
        support: Support::Fixed,
        ..stone(Polyhedron::cuboid(Vec3::zeros(), Vec3::repeat(0.2)), 2400.0)
    };
    let over = stone(Polyhedron::cuboid(Vec3::new(0.0, 0.11, 0.2), Vec3::new(0.2, 0.31, 0.3)), 2400.0);
    let hangs = Wall { blocks: vec![ledge, over] };
    assert_eq!(drive(&path(&hangs, &law, multiplier(1.0)), &implicit).outcome, Outcome::UnstableAtRest);
}

#[test]
fn the_explicit_solver_takes_over_where_the_implicit_one_ends() {
    let law = dry(1e8, 35.0);
    let wall = canonical::running_bond(4, 2).with_base();
    let settled = at_rest(&wall, &law, [2, 2], tilted(10.0));
    let before: Vec<Vec3> = settled.assembly().bodies.all.iter().map(|b| b.position).collect();
    let settings =
        explicit::Settings { damping: 0.3, unbalanced_ratio: 1e-8, ..explicit::Settings::default() };
    let mut simulation = Simulation::of(settled.into_assembly(), settings);
    // It finds it at rest: shear history and all have been handed over.
    assert_eq!(simulation.relax(|_| false).0, Status::Equilibrium);
    let after = &simulation.assembly.bodies.all;
    let moved = before.iter().zip(after).map(|(b, a)| (a.position - b).norm()).fold(0.0, f64::max);
    let far = (before[10] - wall.blocks[10].shape.mass_properties().centroid).norm();
    println!("moved on by {moved:e} of {far:e}");
    assert!(moved < 1e-4 * far, "{moved:e} of {far:e}");
    // Tilted past its limit it falls from there.
    simulation.assembly.gravity = tilted(40.0);
    let top = after_top(&simulation);
    assert_eq!(simulation.relax(|bodies| bodies.all[10].position.y > top + 0.02).0, Status::Stopped);
}

fn after_top(simulation: &Simulation) -> f64 {
    simulation.assembly.bodies.all[10].position.y
}
