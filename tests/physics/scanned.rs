//! A stone from its scan: it stands on what its hull bears on, and weighs as the scan.

use pirca::contact;
use pirca::exchange::{ReadOptions, WallFile, read_obj, read_wall_json, write_wall_json};
use pirca::math::{Vec3, atan, cbrt, degrees, radians};
use pirca::model::{Level, Outcome, Wall};
use pirca::protocol::{Direction, LoadPath, drive};
use pirca::solve::bodies::Bodies;
use pirca::solve::limit::{self, Analysis};
use pirca::solve::{STANDARD_GRAVITY, Solver, implicit, nonsmooth};

use crate::fixture::{dry, path};

/// A box of 0.4 x 0.3 x 0.6 m, hollow from the front (y = 0.3) to half its thickness, as triangles: 20 mm further down in the file, and
/// inside out.
const HOLLOW: &str = "\
o rock
v 0 0 -0.02\nv 0.4 0 -0.02\nv 0.4 0.3 -0.02\nv 0 0.3 -0.02
v 0 0 0.58\nv 0.4 0 0.58\nv 0.4 0.3 0.58\nv 0 0.3 0.58
v 0.2 0.15 0.28
f 1 2 3\nf 1 3 4\nf 5 7 6\nf 5 8 7
f 1 6 2\nf 1 5 6\nf 2 7 3\nf 2 6 7\nf 4 5 1\nf 4 8 5
f 3 9 4\nf 7 9 3\nf 8 9 7\nf 4 9 8
";

fn rock(bearing: f64, turn_deg: f64) -> WallFile {
    let options = ReadOptions {
        scan_bearing: Some(bearing),
        turn: radians(turn_deg),
        on_platform: true,
        ..ReadOptions::default()
    };
    read_obj(HOLLOW, &options).expect("a closed mesh").on_ground()
}

/// Where the scan's centroid is above the middle of the front edge of what bears: behind it, and up. The hollow is a pyramid.
fn lever(bearing: f64) -> [f64; 2] {
    let (whole, hollow) = (0.4 * 0.3 * 0.6, 0.4 * 0.6 * 0.15 / 3.0);
    let y = (whole * 0.15 - hollow * (0.3 - 0.15 / 4.0)) / (whole - hollow);
    [0.3 - y, 0.3 - bearing]
}

#[test]
fn its_body_is_the_scan() {
    let rock = rock(1e-3, 0.0);
    let bodies = Bodies::from_wall(&rock.wall);
    let [behind, up] = lever(1e-3);
    assert!((bodies.all[0].mass - 2400.0 * (0.072 - 0.012)).abs() < 1e-9, "{}", bodies.all[0].mass);
    let centroid = bodies.all[0].position + bodies.origin;
    assert!((centroid - Vec3::new(0.2, 0.3 - behind, up)).norm() < 1e-12, "{centroid}");
    // What is drawn and measured of a block is counted from the middle of its hull.
    let middle = bodies.centroid(0) + bodies.origin;
    assert!((middle - Vec3::new(0.2, 0.15, 0.2995)).norm() < 1e-12, "{middle}");
    let back = read_wall_json(&write_wall_json(&rock.wall)).expect("it reads back");
    assert_eq!(back.wall, rock.wall);
}

const KN: f64 = 1e13;

/// The tilt (deg) at which it falls to the front by a solver, with joints that do not slip.
fn tilt(wall: &Wall, solver: &Solver) -> f64 {
    let law = dry(KN, 60.0);
    let forward = Direction::named("y+").expect("a direction");
    let way = LoadPath::tilt(forward, radians(0.5), radians(60.0), radians(0.01));
    match drive(&path(wall, &law, way), solver).outcome {
        Outcome::Collapsed { at: Level::Tilt(angle) } => degrees(angle),
        other => panic!("{other:?}"),
    }
}

/// How much earlier (rad) elastic joints let it fall. A normal force N so far (e) behind the edge compresses 3 e of the base, which turns the
/// stone by 2 N / (9 e^2 L kn) more; the tilt at which e comes to that is largest where e^3 = 4 N r / (9 L kn), r from the edge to the centroid.
fn lean([behind, up]: [f64; 2]) -> f64 {
    let r = (behind * behind + up * up).sqrt();
    let normal = 2400.0 * 0.06 * STANDARD_GRAVITY * up / r;
    1.5 * cbrt(4.0 * normal * r / (9.0 * 0.4 * KN)) / r
}

#[test]
fn it_overturns_where_its_weight_leaves_what_bears() {
    let wall = rock(1e-3, 0.0).wall;
    let [behind, up] = lever(1e-3);
    let exact = degrees(atan(behind / up));
    let law = dry(KN, 60.0);
    let contact = contact::Settings::for_size(0.4, [4, 4]);
    let found = Analysis::new(&wall, &law, contact, limit::Settings::default()).tilt(Vec3::y(), &[]);
    match found.outcome {
        Outcome::Collapsed { at: Level::Tilt(angle) } => {
            assert!((degrees(angle) - exact).abs() < 1e-3, "{} {exact}", degrees(angle))
        }
        other => panic!("{other:?}"),
    }
    // The tilt is bracketed to 0.01 deg.
    let elastic = exact - degrees(lean([behind, up]));
    let implicit = tilt(&wall, &Solver::Implicit(implicit::Settings::default()));
    assert!((implicit - elastic).abs() < 0.02, "{implicit} {elastic}");
    let rigid = tilt(&wall, &Solver::Nonsmooth(nonsmooth::Settings::default()));
    assert!((rigid - exact).abs() < 0.02, "{rigid} {exact}");
}

#[test]
fn it_turns_as_a_whole() {
    let wall = rock(1e-3, 90.0).wall;
    let [behind, up] = lever(1e-3);
    // By a quarter turn the front looks to x-.
    let contact = contact::Settings::for_size(0.4, [4, 4]);
    let law = dry(KN, 60.0);
    let found = Analysis::new(&wall, &law, contact, limit::Settings::default()).tilt(-Vec3::x(), &[]);
    let exact = degrees(atan(behind / up));
    assert!(
        matches!(found.outcome, Outcome::Collapsed { at: Level::Tilt(angle) } if (degrees(angle) - exact).abs() < 1e-3),
        "{:?}",
        found.outcome
    );
}
