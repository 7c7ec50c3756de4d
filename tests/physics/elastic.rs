//! Elastic answers in closed form: settlement of a stack, and independence of the number of sub-contacts.

use pirca::contact;
use pirca::math::Vec3;
use pirca::model::Wall;
use pirca::shape::Polyhedron;
use pirca::solve::Status;
use pirca::solve::explicit::{Settings, Simulation};

use crate::fixture::{G, dry, on_floor, stone, tilted};

fn stack(blocks: u32) -> Wall {
    let at = |k: u32| {
        let z = 0.1 * f64::from(k);
        Polyhedron::cuboid(Vec3::new(-0.15, -0.1, z), Vec3::new(0.15, 0.1, z + 0.1))
    };
    on_floor((0..blocks).map(|k| stone(at(k), 2400.0)).collect())
}

fn at_rest<'a>(wall: &Wall, law: &'a pirca::law::Coulomb, sub: [u32; 2], tilt_deg: f64) -> Simulation<'a> {
    let settings = Settings { unbalanced_ratio: 1e-9, ..Settings::default() };
    let mut simulation = Simulation::new(wall, law, settings, contact::Settings::for_size(0.2, sub));
    simulation.assembly.gravity = tilted(tilt_deg);
    let (status, _) = simulation.relax(|_| false);
    assert_eq!(status, Status::Equilibrium);
    simulation
}

#[test]
fn a_stack_settles_as_its_joints_are_pressed() {
    let (n, kn) = (6, 1e8);
    let law = dry(kn, 30.0);
    let simulation = at_rest(&stack(n), &law, [2, 2], 0.0);
    let (weight, area) = (2400.0 * 0.3 * 0.2 * 0.1 * G, 0.3 * 0.2);
    // Joint k carries the n - k blocks above it.
    let settlement: f64 = (0..n).map(|k| f64::from(n - k) * weight / (kn * area)).sum();
    let top = simulation.assembly.bodies.all[n as usize - 1].position.z;
    let found = 0.1 * (f64::from(n) - 0.5) - top;
    println!("settlement {found:e} against {settlement:e}");
    assert!((found / settlement - 1.0).abs() < 1e-3);
}

#[test]
fn a_tilted_stack_shears_as_its_joints_do() {
    // Slow enough to stay closed: 2 degrees, no slip. Shear and lean of every joint in closed form (small turns).
    let (n, kn, tilt) = (4u32, 1e9, 2.0f64);
    let law = dry(kn, 40.0);
    let simulation = at_rest(&stack(n), &law, [2, 2], tilt);
    let weight = 2400.0 * 0.3 * 0.2 * 0.1 * G;
    let (area, second) = (0.3 * 0.2, 0.3 * 0.2f64 * 0.2 * 0.2 / 12.0);
    let g = tilted(tilt);
    let along = weight * g.y / G;
    let (mut shift, mut turn) = (0.0, 0.0);
    for k in 0..n {
        let above = f64::from(n - k);
        // Everything above joint k turns with it about an axis in the joint.
        shift += along * above / (0.5 * kn * area) + if k > 0 { turn * 0.1 } else { 0.0 };
        turn += along * above * (0.05 * above) / (kn * second);
    }
    shift += turn * 0.05;
    let found = simulation.assembly.bodies.all[n as usize - 1].position.y;
    println!("shift {found:e} against {shift:e}");
    // Turns of 1e-5 rad and the weight's P-delta are left out of the closed form.
    assert!((found / shift - 1.0).abs() < 2e-3);
}

#[test]
fn a_few_sub_contacts_are_as_good_as_many() {
    let law = dry(1e8, 40.0);
    let top = |sub| at_rest(&stack(4), &law, sub, 12.0).assembly.bodies.all[3].position;
    let (coarse, fine, finest) = (top([1, 1]), top([2, 2]), top([6, 6]));
    println!("{coarse:?} {fine:?} {finest:?}");
    // The pressure is integrated exactly whatever their number; uniform shear needs one.
    // Where the joint opens its shear moves to the cells still closed: 2 x 2 cells are within half a per cent.
    assert!((fine - finest).norm() < 5e-3 * finest.y, "{fine:?} {finest:?}");
    assert!((coarse - finest).norm() < 2e-2 * finest.y, "{coarse:?} {finest:?}");
}
