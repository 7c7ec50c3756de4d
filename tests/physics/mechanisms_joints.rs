//! Mechanisms of the joints against closed forms: hyperbolic closure, stiffness that grows with the stress, patches, rounded arrises, friction that weakens.

use pirca::contact;
use pirca::law::{ClosureTable, Coulomb, NormalLaw, Sampling, Stiffening, Weakening};
use pirca::math::{Vec3, atan, cos, degrees, ln, pow, radians, sin};
use pirca::model::{Block, Wall};
use pirca::protocol::{Bounds, Contacts, Ends, Protocol, Restraint, Tilting};
use pirca::solve::explicit::{self, Simulation};
use pirca::solve::implicit::{self, Equilibrium};
use pirca::solve::{Assembly, Equilibrate, Status, Tie};

use crate::fixture::{G, dry, on_floor, resting, tilted};

const SIZE: [f64; 3] = [0.3, 0.4, 0.2];
const AREA: f64 = 0.3 * 0.4;
const WEIGHT: f64 = AREA * 0.2 * 2400.0 * G;

/// Takes a block by both solvers through the loads and gives its places.
fn places(law: &Coulomb, tie: Option<Tie>, loads: &[Vec3]) -> [Vec3; 2] {
    led_to(&on_floor(vec![resting(SIZE, 2400.0)]), law, tie, loads).map(|places| places[0])
}

/// Takes a wall by both solvers through the loads and gives the places of its blocks.
fn led_to(wall: &Wall, law: &Coulomb, tie: Option<Tie>, loads: &[Vec3]) -> [Vec<Vec3>; 2] {
    fn led<'a>(mut solver: impl Equilibrate<'a>, loads: &[Vec3]) -> Vec<Vec3> {
        for load in loads {
            solver.set_loads(*load, 1.0);
            let settled = solver.settle(&mut |_| false);
            assert_eq!(settled.status, Status::Equilibrium, "{settled:?}");
        }
        solver.assembly().bodies.all.iter().map(|body| body.position).collect()
    }
    let mut assembly = Assembly::new(wall, law, contact::Settings::for_size(0.2, [2, 2]));
    tie.iter().for_each(|tie| assembly.add_tie(*tie));
    let exact = implicit::Settings { unbalanced_ratio: 1e-10, ..implicit::Settings::default() };
    let slow = explicit::Settings { unbalanced_ratio: 1e-9, ..explicit::Settings::default() };
    [led(Equilibrium::of(assembly.clone(), exact), loads), led(Simulation::of(assembly, slow), loads)]
}

fn hyperbola(kn: f64, initial: f64, closure: f64) -> Coulomb {
    Coulomb { normal: NormalLaw::Hyperbolic { kn, initial, closure }, ..dry(kn, 40.0) }
}

/// Patches of a joint, a byte for each row: the middle quarter, a sixteenth at each corner, a quarter at either end.
const MIDDLE: u64 = 0x0000_3c3c_3c3c_0000;
const CORNERS: u64 = 0xc3c3_0000_0000_c3c3;
const EDGES: u64 = 0xffff_0000_0000_ffff;

#[test]
fn a_block_settles_along_the_hyperbola() {
    let (kn, initial, closure) = (1e8, 1e7, 1e-4);
    for gravity in [0.1 * G, G, 10.0 * G] {
        let sigma = WEIGHT / AREA * gravity / G;
        let exact = sigma / kn + closure * sigma / (initial * closure + sigma);
        for place in places(&hyperbola(kn, initial, closure), None, &[Vec3::new(0.0, 0.0, -gravity)]) {
            let found = 0.1 - place.z;
            println!("{sigma} Pa: {found:e} against {exact:e}");
            assert!((found / exact - 1.0).abs() < 1e-6, "{found:e} against {exact:e}");
        }
    }
    // Without closure it is the linear law.
    let (soft, linear) = (hyperbola(kn, initial, 1e-12), dry(kn, 40.0));
    for (a, b) in places(&soft, None, &[tilted(5.0)]).iter().zip(places(&linear, None, &[tilted(5.0)])) {
        // The closure itself, over settlements of 5e-5.
        assert!((a - b).norm() < 1e-10, "{:e}", (a - b).norm());
    }
}

/// A joint of the power `m` of the stress, between a floor of 1e6 Pa/m and a ceiling `kn`.
fn power(kn: f64, at_1_mpa: f64, m: f64) -> Coulomb {
    Coulomb { normal: NormalLaw::Stiffening(Stiffening::new(kn, at_1_mpa, m, 1e6)), ..dry(kn, 40.0) }
}

/// Closure (m) under a stress between the knees of [`power`]: the compliance over the floor, and above it.
fn closed_by(stress: f64, at_1_mpa: f64, m: f64) -> f64 {
    let leaves = 1e6 * pow(1e6 / at_1_mpa, 1.0 / m);
    let rest = 1.0 - m;
    let grown =
        if rest == 0.0 { ln(stress / leaves) } else { (pow(stress, rest) - pow(leaves, rest)) / rest };
    leaves / 1e6 + pow(1e6, m) / at_1_mpa * grown
}

#[test]
fn a_stack_under_its_weight_closes_by_the_power_of_the_stress() {
    let course = |k: u32| {
        let block = resting(SIZE, 2400.0);
        Block { shape: block.shape.translated(&Vec3::new(0.0, 0.0, 0.2 * f64::from(k))), ..block }
    };
    let wall = on_floor((0..4).map(course).collect());
    for (at_1_mpa, m) in [(3e8, 1.0 / 3.0), (7e8, 0.5), (5e9, 1.0)] {
        // The ceiling is out of reach.
        let law = power(1e9, at_1_mpa, m);
        for places in led_to(&wall, &law, None, &[tilted(0.0)]) {
            let mut below = 0.0;
            for (k, position) in places[..4].iter().enumerate() {
                let stress = WEIGHT / AREA * (4 - k) as f64;
                let closure = 0.1 + 0.2 * k as f64 - position.z - below;
                let exact = closed_by(stress, at_1_mpa, m);
                println!("m {m:.2}, {stress:.0} Pa: {closure:e} against {exact:e}");
                assert!((closure / exact - 1.0).abs() < 1e-5, "m {m}, {stress} Pa: {closure:e}, {exact:e}");
                below += closure;
            }
        }
    }
}

#[test]
fn a_block_on_stiff_joints_is_as_on_linear_ones_where_the_power_law_has_reached_its_ceiling() {
    // 47 Pa at the ceiling, and 4.7 kPa on it: what is lost before is known in closed form.
    let law = power(1e7, 1.46e9, 0.5);
    let knee = 1e6 * pow(1e7 / 1.46e9, 2.0);
    for place in places(&law, None, &[tilted(0.0)]) {
        let (found, exact) = (0.1 - place.z, closed_by(knee, 1.46e9, 0.5) + (WEIGHT / AREA - knee) / 1e7);
        assert!((found / exact - 1.0).abs() < 1e-6, "{found:e} against {exact:e}");
    }
}

#[test]
fn a_stack_closes_along_the_table_that_it_is_given() {
    let course = |k: u32| {
        let block = resting(SIZE, 2400.0);
        Block { shape: block.shape.translated(&Vec3::new(0.0, 0.0, 0.2 * f64::from(k))), ..block }
    };
    let wall = on_floor((0..4).map(course).collect());
    let closures = [2e-4, 3e-4, 3.5e-4, 3.7e-4];
    let table = |stresses: [f64; 4]| Coulomb {
        normal: NormalLaw::Table(ClosureTable::through(&closures, &stresses).expect("it rises")),
        ..dry(1e8, 40.0)
    };
    // The bed under the k-th block from above is pressed by k of them: at a knot.
    let law = table([1.0, 2.0, 3.0, 4.0].map(|k| k * WEIGHT / AREA));
    for places in led_to(&wall, &law, None, &[tilted(0.0)]) {
        let mut below = 0.0;
        for (k, position) in places[..4].iter().enumerate() {
            let closure = 0.1 + 0.2 * k as f64 - position.z - below;
            assert!((closure / closures[3 - k] - 1.0).abs() < 1e-6, "{k}: {closure:e}");
            below += closure;
        }
    }
    // A straight one is the linear law.
    let straight = table(closures.map(|u| 5e7 * u));
    let (straight, linear) = (Coulomb { ks: 2.5e7, ..straight }, dry(5e7, 40.0));
    for (a, b) in places(&straight, None, &[tilted(5.0)]).iter().zip(places(&linear, None, &[tilted(5.0)])) {
        assert!((a - b).norm() < 1e-9, "{:e}", (a - b).norm());
    }
}

#[test]
fn a_block_leans_on_the_slope_of_the_hyperbola() {
    // A push so small that the joint's slope hardly changes across it: kt I against turning.
    let (kn, initial, closure) = (1e8, 1e7, 1e-4);
    let law = hyperbola(kn, initial, closure);
    let sigma = WEIGHT / AREA;
    let knee = initial * closure;
    let slope = 1.0 / (1.0 / kn + closure * knee / ((knee + sigma) * (knee + sigma)));
    let push = 1e-4;
    // The resultant of the shear lies in the bed; the weight leans over it, and settles the height.
    let settled = sigma / kn + closure * sigma / (knee + sigma);
    let (height, inertia) = (0.1 - settled, 0.3 * 0.4f64 * 0.4 * 0.4 / 12.0);
    let shear = WEIGHT * push / (0.5 * kn * AREA);
    let turn = WEIGHT * push * height / (slope * inertia - WEIGHT * height);
    for place in places(&law, None, &[tilted(0.0), Vec3::new(0.0, G * push, -G)]) {
        let exact = shear + turn * 0.1;
        println!("{:e} against {exact:e}: {:.1e}", place.y, place.y / exact - 1.0);
        // Of the second order in the lean, which the bed's own place makes 1e-3 of it.
        assert!((place.y / exact - 1.0).abs() < 2e-3, "{:e} against {exact:e}", place.y);
    }
}

/// The tilt (deg) at which limit analysis sees a block of width b and height h fall.
fn falls_at(b: f64, h: f64, law: &Coulomb, contacts: Contacts) -> f64 {
    let wall = Wall { blocks: vec![resting([0.3, b, h], 2400.0)] };
    let (protocol, restraint) = (Protocol::Tilting(Tilting::default()), Restraint::at_ends(Ends::Free));
    let bounds = Bounds::of(&wall, law, &protocol, &restraint, contacts);
    degrees(bounds.associative.expect("it falls"))
}

#[test]
fn a_block_topples_over_the_edge_of_what_touches() {
    let (b, h, law) = (0.2, 0.5, dry(1e9, 60.0));
    let whole = Contacts::from([2, 2]);
    for (name, law, contacts, half_width) in [
        ("whole", law, whole, 0.5 * b),
        ("rounded by 8 mm", law, Contacts { inset: 8e-3, ..whole }, 0.5 * b - 8e-3),
        ("the middle quarter", Coulomb { sampling: Sampling::Patches(MIDDLE), ..law }, whole, 0.25 * b),
        ("all patches", Coulomb { sampling: Sampling::Patches(u64::MAX), ..law }, whole, 0.5 * b),
        ("the four corners", Coulomb { sampling: Sampling::Patches(CORNERS), ..law }, whole, 0.5 * b),
    ] {
        let (found, exact) = (falls_at(b, h, &law, contacts), degrees(atan(half_width / (0.5 * h))));
        println!("{name}: {found} against {exact}");
        // The accuracy of the conic solver.
        assert!((found - exact).abs() < 1e-5, "{name}: {found} against {exact}");
    }
}

#[test]
fn a_block_on_patches_settles_by_their_share() {
    // Symmetric patches: the block stays level. Stiffness per area in contact stays.
    for (mask, share) in [(u64::MAX, 1.0), (CORNERS, 0.25), (MIDDLE, 0.25), (EDGES, 0.5)] {
        let law = Coulomb { sampling: Sampling::Patches(mask), ..dry(1e8, 40.0) };
        for place in places(&law, None, &[tilted(0.0)]) {
            let (found, exact) = (0.1 - place.z, WEIGHT / (1e8 * AREA * share));
            assert!((found / exact - 1.0).abs() < 1e-6, "{mask:x}: {found:e} against {exact:e}");
        }
    }
}

#[test]
fn a_block_on_a_rope_slides_as_its_friction_weakens() {
    let (mu, residual, distance, rope) = (0.5, 0.4, 0.01, 2e4);
    let law = Coulomb { tan_phi: mu, weakening: Some(Weakening { residual, distance }), ..dry(1e9, 0.0) };
    let tie = Tie {
        body: 0,
        point: Vec3::new(0.0, -0.2, 0.1),
        direction: Vec3::y(),
        stiffness: rope,
        pretension: 0.0,
        slack: 0.0,
        two_sided: false,
        travel: 0.0,
    };
    // W sin a = k u + W cos a mu (1 - (1 - r) u / d) on the way down, and r mu at its end.
    let push = |a: f64| WEIGHT * sin(radians(a));
    let grip = |a: f64| mu * WEIGHT * cos(radians(a));
    let falling = (push(30.0) - grip(30.0)) / (rope - grip(30.0) * (1.0 - residual) / distance);
    let fallen = (push(45.0) - grip(45.0) * residual) / rope;
    assert!(falling < distance && fallen > distance);
    let slowly = |to: u32| -> Vec<Vec3> { (0..=4 * to).map(|k| tilted(0.25 * f64::from(k))).collect() };
    for (tilt, exact) in [(30, falling), (45, fallen)] {
        let [implicit, explicit] = places(&law, Some(tie), &slowly(tilt)).map(|place| place.y);
        println!("{tilt} deg: {implicit:e} {explicit:e} against {exact:e}");
        // The joint's own shear, 3e-6 m, is no slip; the two slopes that nearly balance make three times as much of it.
        assert!((implicit / exact - 1.0).abs() < 2e-3, "{tilt}: {implicit:e} against {exact:e}");
        // A block that slips in time overshoots by a share of each quarter of a degree.
        assert!((explicit / exact - 1.0).abs() < 2e-2, "{tilt}: {explicit:e} against {exact:e}");
    }
}
