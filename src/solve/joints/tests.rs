//! The tangent of a joint against finite differences of its forces.

use crate::contact;
use crate::law::{ClosureTable, CohesionAfterSlip, Coulomb, NormalLaw, Sampling, Stiffening, Weakening};
use crate::math::Vec3;
use crate::model::{Block, Wall};
use crate::shape::Polyhedron;
use crate::solve::Assembly;
use crate::solve::joints::Anchor;

const DRY: Coulomb = Coulomb {
    normal: NormalLaw::Linear { kn: 1e8 },
    ks: 4e7,
    tan_phi: 0.6,
    cohesion: 0.0,
    tension: 0.0,
    compressive_strength: None,
    cohesion_after_slip: CohesionAfterSlip::Kept,
    weakening: None,
    sampling: Sampling::Area,
    bonded: false,
};

/// Two blocks, one half over the edge of the other.
fn pair(law: &Coulomb) -> Assembly<'_> {
    let block = |low: [f64; 3], high: [f64; 3]| {
        Block::stone(Polyhedron::cuboid(Vec3::from(low), Vec3::from(high)), 2400.0)
    };
    let wall = Wall {
        blocks: vec![block([0.0, 0.0, 0.0], [0.4, 0.3, 0.1]), block([0.15, 0.05, 0.1], [0.5, 0.25, 0.25])],
    };
    Assembly::new(&wall, law, contact::Settings::for_size(0.2, [2, 2]))
}

/// Moves the bodies by twelve numbers: shift and turn of the incident, then of the reference body.
fn moved(from: &Assembly, by: &[f64; 12]) -> crate::solve::bodies::Bodies {
    let joint = &from.joints.all[0];
    let mut bodies = from.bodies.clone();
    for (which, k) in [(joint.incident, 0), (joint.reference, 6)] {
        let (shift, turn) =
            (Vec3::from_column_slice(&by[k..k + 3]), Vec3::from_column_slice(&by[k + 3..k + 6]));
        let here = &from.bodies.all[which as usize];
        bodies.all[which as usize].place(here, &shift, &turn);
    }
    bodies
}

/// Forces and moments on the incident, then on the reference body.
fn forces(from: &Assembly, anchors: &[Anchor], by: &[f64; 12]) -> [f64; 12] {
    let mut bodies = moved(from, by);
    for body in &mut bodies.all {
        (body.force, body.torque) = (Vec3::zeros(), Vec3::zeros());
    }
    let mut joints = from.joints.clone();
    joints.apply_since(&mut bodies.all, anchors);
    let joint = &joints.all[0];
    let (i, r) = (&bodies.all[joint.incident as usize], &bodies.all[joint.reference as usize]);
    let parts = [i.force, i.torque, r.force, r.torque];
    std::array::from_fn(|k| parts[k / 3][k % 3])
}

/// The tangent after a way from the anchor against central differences, as the largest error over the largest entry.
fn error(law: &Coulomb, settled: &[f64; 12], way: &[f64; 12]) -> (f64, bool, bool) {
    let mut assembly = pair(law);
    // First a way that leaves shear on the joint, then the step whose tangent is asked for.
    let start = assembly.joints.anchors(&assembly.bodies.all);
    assembly.bodies = moved(&assembly, settled);
    assembly.joints.apply_since(&mut assembly.bodies.all, &start);
    let anchors = assembly.joints.anchors(&assembly.bodies.all);
    assembly.bodies = moved(&assembly, way);
    assembly.joints.apply_since(&mut assembly.bodies.all, &anchors);
    let mut found = None;
    assembly
        .joints
        .clone()
        .each_slope(&assembly.bodies.all, &anchors, |_, slopes| found = Some(slopes.clone()));
    let slopes = found.expect("the joint carries");
    let (mut worst, mut largest) = (0.0f64, 0.0f64);
    for column in 0..12 {
        // A ten-thousandth of the closure: second differences stay below 1e-7 of the slope.
        let h = 1e-8;
        let at = |x: f64| {
            let mut by = [0.0; 12];
            by[column] = x;
            forces(&assembly, &anchors, &by)
        };
        let (plus, minus) = (at(h), at(-h));
        for row in 0..12 {
            let exact = -(plus[row] - minus[row]) / (2.0 * h);
            worst = worst.max((slopes.stiffness[row][column] - exact).abs());
            largest = largest.max(exact.abs());
        }
    }
    (worst / largest, slopes.slips, slopes.opens)
}

/// The incident body is the upper one, the lower one is the reference.
fn press(depth: f64, slip: [f64; 2], turn: [f64; 3]) -> [f64; 12] {
    [slip[0], slip[1], -depth, turn[0], turn[1], turn[2], 1e-6, -2e-6, 0.0, 1e-6, 2e-6, -3e-6]
}

#[test]
fn the_tangent_is_that_of_finite_differences() {
    let settled = press(1e-4, [1e-5, -2e-5], [1e-4, -2e-4, 5e-5]);
    let rough = Coulomb { tan_phi: 50.0, ..DRY };
    let cohesive = Coulomb { cohesion: 3e3, tension: 2e3, ..DRY };
    let vertices = Coulomb { sampling: Sampling::Vertices, ..DRY };
    let patches = Coulomb { sampling: Sampling::Patches(0x69b5_a7c3_19f0_5ad6), ..rough };
    let weak = |distance| Coulomb { weakening: Some(Weakening { residual: 0.4, distance }), ..DRY };
    // Some 10 to 15 kPa press on the joint.
    let crushed = Coulomb { compressive_strength: Some(1.2e4), ..rough };
    let cases = [
        ("crushed", crushed, press(2e-5, [3e-6, 5e-6], [2e-5, 1e-5, 3e-5]), [false, false]),
        ("crushed and partly open", crushed, press(-5e-5, [3e-6, 5e-6], [9e-4, 4e-4, 3e-5]), [false, true]),
        (
            "crushed and slipping",
            Coulomb { compressive_strength: Some(1.2e4), ..DRY },
            press(2e-5, [3e-3, 5e-3], [2e-5, 1e-5, 3e-3]),
            [true, false],
        ),
        ("closed", DRY, press(2e-5, [3e-6, 5e-6], [2e-5, 1e-5, 3e-5]), [false, false]),
        ("partly open", rough, press(-5e-5, [3e-6, 5e-6], [9e-4, 4e-4, 3e-5]), [false, true]),
        ("slipping", DRY, press(2e-5, [3e-3, 5e-3], [2e-5, 1e-5, 3e-3]), [true, false]),
        ("slipping and partly open", DRY, press(-5e-5, [3e-3, 5e-3], [9e-4, 4e-4, 3e-3]), [true, true]),
        ("cohesive, slipping", cohesive, press(2e-5, [3e-3, -5e-3], [2e-5, 1e-5, 3e-3]), [true, false]),
        ("weakening", weak(2e-2), press(2e-5, [3e-3, 5e-3], [2e-5, 1e-5, 3e-3]), [true, false]),
        ("weakened", weak(1e-3), press(2e-5, [3e-3, 5e-3], [2e-5, 1e-5, 3e-3]), [true, false]),
        (
            "weakening and partly open",
            weak(2e-2),
            press(-5e-5, [3e-3, 5e-3], [9e-4, 4e-4, 3e-3]),
            [true, true],
        ),
        ("patches partly open", patches, press(-5e-5, [3e-6, 5e-6], [9e-4, 4e-4, 3e-5]), [false, true]),
        ("at vertices", vertices, press(-5e-5, [3e-6, 5e-6], [9e-4, 4e-4, 3e-5]), [false, false]),
        (
            "bonded",
            Coulomb { bonded: true, ..DRY },
            press(-5e-4, [3e-3, 5e-3], [9e-4, 4e-4, 3e-3]),
            [false, false],
        ),
    ];
    for (name, law, way, [slips, opens]) in cases {
        let (error, found_slips, found_opens) = error(&law, &settled, &way);
        println!("{name}: {error:.1e}");
        // Third differences: the cut moves by the step over the size of the lean, 1e-8 over some 1e-5 of the joint.
        assert!(error < 5e-6, "{name}: {error:.1e}");
        assert_eq!((found_slips, found_opens), (slips, opens), "{name}");
    }
}

#[test]
fn the_tangent_of_a_curved_law_is_that_of_its_law() {
    let power = |m: f64, at_1_mpa: f64| NormalLaw::Stiffening(Stiffening::new(1e9, at_1_mpa, m, 1e7));
    // The slope of the law by quadrature is not the slope of the quadrature: they differ by its error. It is larger for a law
    // whose own slope has a knee within a cell.
    for (soft, tolerance) in [
        (NormalLaw::Hyperbolic { kn: 1e8, initial: 2e7, closure: 1e-4 }, 1e-3),
        (power(1.0 / 3.0, 4e8), 5e-3),
        (power(1.0, 1e10), 5e-3),
        (
            NormalLaw::Table(ClosureTable::through(&[5e-5, 1e-4, 2e-4], &[1e3, 4e3, 2e4]).expect("it rises")),
            5e-3,
        ),
    ] {
        of_curved(soft, tolerance);
    }
}

fn of_curved(soft: NormalLaw, tolerance: f64) {
    let settled = press(1e-4, [1e-5, -2e-5], [1e-4, -2e-4, 5e-5]);
    let rough = Coulomb { normal: soft, tan_phi: 50.0, ..DRY };
    for (name, law, way) in [
        ("closed", Coulomb { normal: soft, ..DRY }, press(2e-5, [3e-6, 5e-6], [2e-5, 1e-5, 3e-5])),
        ("partly open", rough, press(-5e-5, [3e-6, 5e-6], [9e-4, 4e-4, 3e-5])),
        ("slipping", Coulomb { normal: soft, ..DRY }, press(2e-5, [3e-3, 5e-3], [2e-5, 1e-5, 3e-3])),
    ] {
        let (error, ..) = error(&law, &settled, &way);
        println!("{name}: {error:.1e}");
        assert!(error < tolerance, "{soft:?}, {name}: {error:.1e}");
    }
}
