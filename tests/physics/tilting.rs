//! Tilting: the rigid block on an elastic no-tension bed, sliding at atan(mu) and in a groove, toppling at atan(b/h).

use pirca::math::{Vec3, asin, atan, cos, degrees, radians, sin, tan};
use pirca::model::{Block, Outcome, Support, Wall};
use pirca::protocol::{Direction, LoadPath, drive};
use pirca::shape::Polyhedron;
use pirca::solve::Solver;
use pirca::solve::explicit::Settings;

use crate::fixture::{G, collapse_angle, dry, on_floor, path, resting, simulation, stone};

/// Width and centroid height (m), weight per metre (N/m) of the block on the elastic bed.
const B: f64 = 0.15;
const H: f64 = 0.1875;
const W: f64 = 889.0;

/// Collapse angle (deg) of the block with pirca's convention: the pressure acts along the bed's normal at the points
/// of the block's face and grows with their distance from the bed; the shear acts along the bed, evenly on the area in
/// contact. With base rotation t and tilt a: `N = W cos a` and `T = W sin a` along and across the bed's normal, and
/// moments about the centre of the block's face, `N e cos t - T m sin t = W h sin(a + t)`, with N at e and T at the
/// middle m of the pressed width. The collapse angle is the largest a over t.
fn closed_form(kn: f64) -> f64 {
    let balance = |t: f64, a: f64| {
        let n = W * cos(a);
        let slope = kn * sin(t);
        // Full contact: N e = slope B^3 / 12; with uplift the pressed width is c = sqrt(2 N / slope).
        let c = (2.0 * n / slope).sqrt();
        let (ne, middle) =
            if c >= B { (slope * B * B * B / 12.0, 0.0) } else { (n * (B / 2.0 - c / 3.0), (B - c) / 2.0) };
        cos(t) * ne - sin(t) * W * sin(a) * middle - W * H * sin(a + t)
    };
    let mut largest: f64 = 0.0;
    for i in 1..20_000 {
        let t = f64::from(i) * 1e-5;
        let (mut low, mut high) = (0.0, 0.6);
        if balance(t, low) < 0.0 {
            continue;
        }
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if balance(t, middle) > 0.0 { low = middle } else { high = middle }
        }
        largest = largest.max(low);
    }
    degrees(largest)
}

fn bed_angle(kn: f64, sampling: pirca::law::Sampling) -> f64 {
    let mut law = dry(kn, 80.0);
    law.sampling = sampling;
    let block = resting([1.0, B, 2.0 * H], W / (G * B * 2.0 * H));
    let wall = on_floor(vec![block]);
    let settings = Settings { unbalanced_ratio: 1e-8, ..Settings::default() };
    let start = simulation(&wall, &law, settings, 0.3);
    let [low, high] = collapse_angle(start, 0.0, 2.0, 0.01, 0.05);
    0.5 * (low + high)
}

#[test]
fn the_block_on_an_elastic_bed_collapses_at_the_closed_form() {
    // Rows for the convention "line of action on the block's face" (derivation above; bed's face: up to 0.06 more).
    let rows = [(2.5e7, 15.834), (5e7, 17.088), (7.5e7, 17.694), (1.75e8, 18.718)];
    for (kn, row) in rows {
        let angle = bed_angle(kn, pirca::law::Sampling::Area);
        println!("kn {kn:e}: {angle:.3} deg, closed form {:.3}, row {row}", closed_form(kn));
        // The bracket is 0.01; with few sub-contacts the shear is not quite even on the pressed width.
        assert!((angle - closed_form(kn)).abs() < 0.02, "kn {kn:e}: {angle} against {}", closed_form(kn));
        assert!((angle - row).abs() < 0.1, "kn {kn:e}: {angle} against {row}");
    }
}

#[test]
fn stress_at_the_corners_only_loses_the_dependence_on_kn() {
    use pirca::law::Sampling::Vertices;
    // The two lower corners carry all: the block turns about them as a rigid one, less its own lean.
    let (soft, hard) = (bed_angle(2.5e7, Vertices), bed_angle(1.75e8, Vertices));
    println!("vertices: {soft:.3} and {hard:.3} deg");
    assert!(hard - soft < 1.0, "{soft} to {hard}");
    assert!(soft > 20.0, "{soft}");
}

#[test]
fn a_block_on_a_slope_slides_at_atan_mu() {
    for phi in [15.0, 30.0] {
        let law = dry(1e9, phi);
        let wall = on_floor(vec![resting([0.4, 0.4, 0.1], 2400.0)]);
        let start = simulation(&wall, &law, Settings { unbalanced_ratio: 1e-7, ..Settings::default() }, 0.25);
        let [low, high] = collapse_angle(start, phi - 3.0, 1.0, 0.02, 0.02);
        println!("phi {phi}: {low} to {high}");
        // The friction limit is exact on a closed joint: what is left is the bracket and the lean of the soft bed.
        assert!(
            (low - phi).abs() < 0.1 && (high - phi).abs() < 0.1,
            "phi {phi}: slides between {low} and {high}"
        );
    }
}

#[test]
fn a_stiff_block_topples_at_atan_b_over_h() {
    let law = dry(2e13, 60.0);
    let wall = on_floor(vec![resting([1.0, B, 2.0 * H], 2000.0)]);
    // Little damping: at 0.8 a block on a narrow edge creeps, because the force that is damped is that of its fast
    // rattling and not that of its slow turning.
    let settings =
        Settings { unbalanced_ratio: 1e-5, damping: 0.2, max_steps: 1_000_000, ..Settings::default() };
    let start = simulation(&wall, &law, settings, 0.3);
    let [low, high] = collapse_angle(start, 20.0, 0.25, 0.02, 0.02);
    let rigid = degrees(atan(B / (2.0 * H)));
    println!("topples between {low} and {high}, rigid {rigid}");
    // The elastic loss goes as kn^(-1/3): 0.10 deg at 5e12, 0.06 deg at 2e13. Much stiffer and the
    // round-off of positions (1e-17 m) is felt in the force balance.
    assert!(high < rigid + 0.02 && low > rigid - 0.1, "{low} to {high} against {rigid}");
}

#[test]
fn cohesion_holds_a_block_beyond_its_friction_angle() {
    // Slides when W sin a = c A + W cos a tan phi; with r = c A / W: a = phi + asin(r cos phi).
    let (phi, area, weight) = (20.0, 0.16, 2400.0 * 0.016 * G);
    let mut law = dry(1e9, phi);
    law.cohesion = 0.2 * weight / area;
    let wall = on_floor(vec![resting([0.4, 0.4, 0.1], 2400.0)]);
    let start = simulation(&wall, &law, Settings { unbalanced_ratio: 1e-7, ..Settings::default() }, 0.25);
    let [low, high] = collapse_angle(start, 25.0, 1.0, 0.02, 0.02);
    let exact = phi + degrees(asin(0.2 * cos(radians(phi))));
    assert!((low - exact).abs() < 0.1 && (high - exact).abs() < 0.1, "{low} to {high} against {exact}");
}

/// A prism along y with a convex outline in x and z (m), counter-clockwise as seen from -y.
fn prism(outline: &[[f64; 2]], ends: [f64; 2]) -> Polyhedron {
    let n = outline.len() as u32;
    let vertices = ends.iter().flat_map(|&y| outline.iter().map(move |p| Vec3::new(p[0], y, p[1]))).collect();
    let sides = (0..n).map(|k| vec![(k + 1) % n, k, k + n, (k + 1) % n + n]);
    let faces = [(0..n).collect(), (n..2 * n).rev().collect()].into_iter().chain(sides).collect();
    Polyhedron { vertices, faces }
}

#[test]
fn stiff_joints_are_told_to_slide_where_dilatancy_would_hold_them() {
    // A stone in a groove of 90 degrees slides along it at tan(a) = tan(phi) / sin(45). Were it to dilate it would climb out of the groove, and bear
    // more: limit analysis cannot tell. Joints of 1e11 Pa/m take a million steps to slide away at a hundredth of a degree above.
    let held = |outline: &[[f64; 2]]| Block {
        support: Support::Fixed,
        ..stone(prism(outline, [-3.0, 3.0]), 2400.0)
    };
    let slider = prism(&[[0.0, 0.0], [0.2, 0.2], [-0.2, 0.2]], [-0.4, 0.4]);
    let wall = Wall {
        blocks: vec![
            held(&[[-1.0, 0.0], [0.0, 0.0], [-1.0, 1.0]]),
            held(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]),
            stone(slider, 2400.0),
        ],
    };
    let right = degrees(atan(tan(radians(20.0)) / sin(radians(45.0))));
    for kn in [1e9, 1e11, 1e12] {
        let law = dry(kn, 20.0);
        let tilt = LoadPath::tilt(Direction::YPlus, radians(0.05), radians(60.0), radians(0.01));
        let run = drive(&path(&wall, &law, tilt), &Solver::Explicit(Settings::default()));
        assert!(matches!(run.outcome, Outcome::Collapsed { .. }), "{kn:e}: {:?}", run.outcome);
        let [low, high] = run.bracket.expect("it fell").map(degrees);
        // A hundredth for rounding and for what the joint gives way by.
        assert!(low < right + 0.01 && right - 0.01 < high, "{kn:e}: {low} to {high}, {right}");
        assert!(high - low < 0.06, "{kn:e}: {low} to {high}");
    }
}
