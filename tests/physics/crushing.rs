//! Crushing: a block on a bed that bears no more than its compressive strength leans, and falls, at the closed form.

use pirca::contact;
use pirca::law::Coulomb;
use pirca::math::{Vec3, atan, cos, degrees, radians, sin};
use pirca::model::{Block, Level, Outcome, Wall};
use pirca::protocol::{self, Ends, Protocol, Restraint, Tilting};
use pirca::solve::explicit::{self, Simulation};
use pirca::solve::implicit::{self, Equilibrium};
use pirca::solve::{Assembly, Equilibrate, Solver, Status};

use crate::fixture::{G, collapse_angle, dry, on_floor, resting, simulation, tilted};

/// Width and centroid height (m), weight per metre (N/m) of the block.
const B: f64 = 0.15;
const H: f64 = 0.1875;
const W: f64 = 889.0;

fn block() -> Block {
    resting([1.0, B, 2.0 * H], W / (G * B * 2.0 * H))
}

fn law(kn: f64, strength: f64) -> Coulomb {
    Coulomb { compressive_strength: Some(strength), ..dry(kn, 80.0) }
}

/// What the block lacks in balance at a tilt `a` and a turn `t` (rad): moments about the centre of its face, as `tilting` has
/// them. The stress is `kn` times the depth, which falls by `sin t` per metre from the toe on, and at most the strength: a plastic
/// part `p`, then a ramp of `r = strength / (kn sin t)` that ends at the other edge or before. Also the width that is pressed.
fn lacks(kn: f64, strength: f64, t: f64, a: f64) -> f64 {
    let (n, slope) = (W * cos(a), kn * sin(t));
    // Force and moment about the toe of a bed whose stress would be `deep` at the toe without crushing.
    let bears = |deep: f64| {
        let plastic = ((deep - strength) / slope).clamp(0.0, B);
        let end = (deep / slope).min(B);
        let [from, to] = [deep.min(strength), (deep - slope * end).clamp(0.0, strength)];
        let ramp = (end - plastic).max(0.0);
        let force = strength * plastic + 0.5 * (from + to) * ramp;
        let arm = plastic * plastic * strength / 2.0
            + to * ramp * (plastic + 0.5 * ramp)
            + 0.5 * (from - to) * ramp * (plastic + ramp / 3.0);
        (force, arm, end)
    };
    let (mut low, mut high) = (0.0, strength + 2.0 * slope * B);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if bears(middle).0 < n { low = middle } else { high = middle }
    }
    let (force, arm, end) = bears(low);
    let (ne, middle) = (force * B / 2.0 - arm, 0.5 * (B - end));
    cos(t) * ne - sin(t) * W * sin(a) * middle - W * H * sin(a + t)
}

/// The largest tilt (deg) in balance over all turns.
fn closed_form(kn: f64, strength: f64) -> f64 {
    let mut largest: f64 = 0.0;
    for i in 1..4_000 {
        let t = 1e-5 * f64::from(i) * f64::from(i).sqrt();
        let (mut low, mut high) = (0.0, 0.6);
        if t > 0.3 || lacks(kn, strength, t, low) < 0.0 {
            continue;
        }
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if lacks(kn, strength, t, middle) > 0.0 { low = middle } else { high = middle }
        }
        largest = largest.max(low);
    }
    degrees(largest)
}

/// The rigid-plastic limit (deg): `e = B / 2 - N / (2 fc)`, and `h tan a = e`.
fn rigid(strength: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let a = 0.5 * (low + high);
        let e = B / 2.0 - W * cos(a) / (2.0 * strength);
        if H * sin(a) < e * cos(a) { low = a } else { high = a }
    }
    degrees(low)
}

/// The tilt (deg) at which it falls by the implicit and by the explicit solver.
fn falls(law: &Coulomb) -> [f64; 2] {
    let (protocol, restraint) = (Protocol::Tilting(Tilting::default()), Restraint::at_ends(Ends::Free));
    let wall = Wall { blocks: vec![block()] };
    let implicit = Solver::Implicit(implicit::Settings::default());
    let run = protocol::run(&wall, law, &protocol, &restraint, [2, 2], &implicit);
    let Outcome::Collapsed { at: Level::Tilt(angle) } = run.outcome else { panic!("{:?}", run.outcome) };
    let settings = explicit::Settings { unbalanced_ratio: 1e-8, ..explicit::Settings::default() };
    let floored = on_floor(vec![block()]);
    let [low, high] = collapse_angle(simulation(&floored, law, settings, 0.3), 0.0, 2.0, 0.01, 0.05);
    [degrees(angle), 0.5 * (low + high)]
}

#[test]
fn a_block_on_a_bed_that_is_crushed_falls_at_the_closed_form() {
    for (kn, strength) in [(1.75e8, 2e4), (1.75e8, 6e4), (2e9, 3e4)] {
        let exact = closed_form(kn, strength);
        let found = falls(&law(kn, strength));
        println!(
            "kn {kn:e}, fc {strength:e}: {found:?} against {exact:.3} deg, rigid-plastic {:.3}",
            rigid(strength)
        );
        for angle in found {
            // The bracket is 0.01; with few sub-contacts the shear is not quite even on the pressed width.
            assert!((angle - exact).abs() < 0.03, "kn {kn:e}, fc {strength:e}: {angle} against {exact}");
        }
        assert!(exact < rigid(strength), "{exact}");
    }
    // As stiffness grows the rigid-plastic block comes out, and as strength grows the one that is never crushed.
    assert!((closed_form(1e13, 3e4) - rigid(3e4)).abs() < 0.05, "{} {}", closed_form(1e13, 3e4), rigid(3e4));
    assert!((closed_form(1.75e8, 1e9) - 18.718).abs() < 0.02, "{}", closed_form(1.75e8, 1e9));
    assert!((rigid(1e12) - degrees(atan(B / 2.0 / H))).abs() < 1e-5);
}

#[test]
fn a_block_turns_as_its_toe_is_crushed() {
    // At a tilt of 13 deg: turns without and with crushing, from the balance of moments.
    let (kn, a) = (1.75e8, radians(13.0));
    let turns = |strength: f64| {
        let (mut low, mut high) = (1e-6, 2e-2);
        // The balance is positive on the stable branch from the turn on at which the block rests.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if lacks(kn, strength, middle, a) > 0.0 { high = middle } else { low = middle }
        }
        low
    };
    let wall = on_floor(vec![block()]);
    let mut of = Vec::new();
    for strength in [1e9, 1.5e4] {
        let exact = turns(strength);
        let law = law(kn, strength);
        let assembly = Assembly::new(&wall, &law, contact::Settings::for_size(0.3, [2, 2]));
        let accurate = implicit::Settings { unbalanced_ratio: 1e-10, ..implicit::Settings::default() };
        let slow = explicit::Settings { unbalanced_ratio: 1e-9, ..explicit::Settings::default() };
        for found in
            [turned(Equilibrium::of(assembly.clone(), accurate)), turned(Simulation::of(assembly, slow))]
        {
            println!("fc {strength:e}: {found:e} against {exact:e} rad");
            // The shear is followed at a few points of the pressed width and not evenly over it.
            assert!((found / exact - 1.0).abs() < 5e-3, "fc {strength:e}: {found:e} against {exact:e}");
        }
        of.push(exact);
    }
    assert!(of[1] > 1.1 * of[0], "crushing hardly matters: {of:?}");
}

/// The turn (rad) of the block at 13 deg, tilted in quarters of a degree.
fn turned<'a>(mut solver: impl Equilibrate<'a>) -> f64 {
    let upright = solver.assembly().bodies.all[0].rotation;
    for k in 0..=52 {
        solver.set_loads(tilted(0.25 * f64::from(k)), 1.0);
        let settled = solver.settle(&mut |_| false);
        assert_eq!(settled.status, Status::Equilibrium, "{settled:?}");
    }
    let up = solver.assembly().bodies.all[0].rotation * upright.transpose() * Vec3::z();
    atan(up.y / up.z)
}

#[test]
fn a_block_that_is_too_heavy_for_its_bed_does_not_come_to_rest() {
    let wall = on_floor(vec![block()]);
    for (share, rests) in [(1.05, true), (0.95, false)] {
        let law = law(1.75e8, share * W / B);
        let assembly = Assembly::new(&wall, &law, contact::Settings::for_size(0.3, [2, 2]));
        let implicit = status_of(Equilibrium::of(assembly.clone(), implicit::Settings::default()));
        let explicit = status_of(Simulation::of(assembly, explicit::Settings::default()));
        for status in [implicit, explicit] {
            assert_eq!(status == Status::Equilibrium, rests, "{share}: {status:?}");
        }
    }
}

/// How it ends under its weight, watched until it has sunk by 10 mm.
fn status_of<'a>(mut solver: impl Equilibrate<'a>) -> Status {
    solver.set_loads(tilted(0.0), 1.0);
    solver.settle(&mut |bodies| bodies.all[0].position.z < H - 0.01).status
}
