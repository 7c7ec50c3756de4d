//! Stones that bear on few points: closed forms of a block on its points, and the two limits, many points and points at the edge.

use pirca::contact;
use pirca::law::{Coulomb, Sampling, Seat, Seating};
use pirca::math::{Vec3, atan, cos, degrees, radians, sin};
use pirca::model::{Level, Outcome, Wall};
use pirca::protocol::{Direction, LoadPath, Run, Task, drive};
use pirca::random::Streams;
use pirca::solve::explicit::{self, Simulation};
use pirca::solve::implicit::{self, Equilibrium};
use pirca::solve::{Assembly, Equilibrate, Solver, Status, limit, nonsmooth};
use pirca::study::Bearing;

use crate::fixture::{AREA, G, SIZE, WEIGHT, dry, on_floor, path, resting, tilted};

/// Height (m) of the block's centroid.
const HEIGHT: f64 = 0.5 * SIZE[2];

fn block() -> Wall {
    on_floor(vec![resting(SIZE, 2400.0)])
}

/// A joint that bears with a share of its face on points of the floor (x and y in m, from the middle), each so far behind it (m).
fn on(law: Coulomb, share: f64, points: &[([f64; 2], f64)]) -> Coulomb {
    let seat =
        |&([x, y], recess): &([f64; 2], f64)| Seat { at: [0.5 + x / SIZE[0], 0.5 + y / SIZE[1]], recess };
    let seats: Vec<Seat> = points.iter().map(seat).collect();
    Coulomb { sampling: Sampling::Seats(Seating::new(share, &seats)), ..law }
}

/// All solvers: springs, springs stepped in time, rigid blocks with impacts, springs in contact dynamics, limit analysis.
fn all_solvers() -> [Solver; 5] {
    let compliant =
        nonsmooth::Settings { normal: nonsmooth::Normal::Compliant, ..nonsmooth::Settings::default() };
    [
        Solver::Implicit(implicit::Settings::default()),
        Solver::Explicit(explicit::Settings::default()),
        Solver::Nonsmooth(nonsmooth::Settings::default()),
        Solver::Nonsmooth(compliant),
        Solver::Limit(limit::Settings::default()),
    ]
}

fn tilt(law: &Coulomb, towards: Direction, solver: &Solver) -> Run {
    let wall = block();
    drive(&path(&wall, law, LoadPath::tilt(towards, radians(1.0), radians(80.0), radians(0.02))), solver)
}

/// The angle (deg) at which the block falls.
fn falls(law: &Coulomb, towards: Direction, solver: &Solver) -> f64 {
    match tilt(law, towards, solver).outcome {
        Outcome::Collapsed { at: Level::Tilt(angle) } => degrees(angle),
        ref other => panic!("{}: {other:?}", solver.name()),
    }
}

/// Points so small that the edges of their triangle are lines, on joints so stiff that the block does not sink in.
const SMALL: f64 = 1e-6;

#[test]
fn a_block_on_three_points_overturns_about_the_edge_of_its_triangle() {
    let law = on(dry(1e14, 75.0), SMALL, &[([-0.1, 0.08], 0.0), ([0.06, 0.12], 0.0), ([0.02, -0.15], 0.0)]);
    // Where the line from below the centroid leaves the triangle: across the two edges towards the side, and on the way to a corner.
    let edge = |[x, y]: [f64; 2], [u, v]: [f64; 2], across: usize| {
        let (a, b) = if across == 1 { (x / (x - u), [y, v]) } else { (y / (y - v), [x, u]) };
        (b[0] + a * (b[1] - b[0])).abs()
    };
    let (left, right, near) = ([-0.1, 0.08], [0.06, 0.12], [0.02, -0.15]);
    let ways = [
        (Direction::YPlus, edge(left, right, 1)),
        (Direction::YMinus, edge(left, near, 1)),
        (Direction::XPlus, edge(right, near, 0)),
        (Direction::XMinus, edge(left, near, 0)),
    ];
    for solver in all_solvers() {
        for (towards, lever) in ways {
            let (found, exact) = (falls(&law, towards, &solver), degrees(atan(lever / HEIGHT)));
            println!("{} {towards:?}: {found:.3} against {exact:.3}", solver.name());
            // Patches are 0.2 mm wide, 0.1 deg of a lever of 0.1 m; the bracket is 0.02 deg; springs give way by 0.05 mm.
            assert!((found - exact).abs() < 0.2, "{} {towards:?}: {found} against {exact}", solver.name());
        }
    }
}

#[test]
fn a_block_on_two_points_overturns_about_the_outer_one_along_their_line() {
    let law = on(dry(1e14, 75.0), SMALL, &[([-0.1, 0.0], 0.0), ([0.12, 0.0], 0.0)]);
    for solver in all_solvers() {
        let found = falls(&law, Direction::XPlus, &solver);
        let exact = degrees(atan(0.12 / HEIGHT));
        println!("{}: {found:.3} against {exact:.3}", solver.name());
        // As above.
        assert!((found - exact).abs() < 0.15, "{}: {found} against {exact}", solver.name());
    }
}

fn led(law: &Coulomb, load: Vec3, exact: f64) -> [Vec3; 2] {
    fn settled<'a>(mut solver: impl Equilibrate<'a>, load: Vec3) -> Vec3 {
        solver.set_loads(load, 1.0);
        let settled = solver.settle(&mut |_| false);
        assert_eq!(settled.status, Status::Equilibrium, "{settled:?}");
        solver.assembly().bodies.all[0].position
    }
    let assembly = Assembly::new(&block(), law, contact::Settings::for_size(0.2, [2, 2]));
    let newton = implicit::Settings { unbalanced_ratio: exact, ..implicit::Settings::default() };
    let slow = explicit::Settings { unbalanced_ratio: 10.0 * exact, ..explicit::Settings::default() };
    [settled(Equilibrium::of(assembly.clone(), newton), load), settled(Simulation::of(assembly, slow), load)]
}

#[test]
fn points_are_as_stiff_as_their_areas() {
    let kn = 1e8;
    let four: Vec<_> = [[-0.1, 0.1], [0.1, 0.1], [0.1, -0.1], [-0.1, -0.1]].map(|at| (at, 0.0)).to_vec();
    for (share, points) in [(0.2, &four[..]), (1e-3, &four[..]), (0.05, &[([0.0, 0.0], 0.0)][..])] {
        let each = share * AREA / points.len() as f64;
        let exact = WEIGHT / (points.len() as f64 * each * kn);
        for place in led(&on(dry(kn, 40.0), share, points), Vec3::new(0.0, 0.0, -G), 1e-10) {
            let found = HEIGHT - place.z;
            assert!((found / exact - 1.0).abs() < 1e-6, "{found:e} against {exact:e}");
        }
    }
}

#[test]
fn a_point_behind_the_face_bears_once_it_has_closed() {
    let (kn, share, recess) = (1e8, 0.2, 2e-5);
    let mut points: Vec<_> =
        [[-0.1, 0.1], [0.1, 0.1], [0.1, -0.1], [-0.1, -0.1]].map(|at| (at, 0.0)).to_vec();
    points.push(([0.0, 0.0], recess));
    let law = on(dry(kn, 40.0), share, &points);
    let closes = |gravity: f64| led(&law, Vec3::new(0.0, 0.0, -gravity), 1e-10).map(|place| HEIGHT - place.z);
    let (light, heavy) = (closes(0.01 * G), closes(G));
    for (light, heavy) in light.into_iter().zip(heavy) {
        assert!(light < recess && heavy > recess, "{light:e} {heavy:e}");
        // Four bear the light block, all five the heavy one: W = kn (A u - A5 recess).
        let middle = share * AREA - 0.01 * WEIGHT / (kn * light);
        assert!(middle > 0.05 * share * AREA, "{middle:e}");
        let exact = (WEIGHT / kn + middle * recess) / (share * AREA);
        assert!((heavy / exact - 1.0).abs() < 1e-6, "{heavy:e} against {exact:e}");
    }
}

#[test]
fn points_with_the_whole_face_are_the_whole_face() {
    let whole = dry(5e7, 40.0);
    let bearing = Bearing { points: 5.0, relief: 0.0, share: 1.0 };
    for member in 0..5 {
        let seating = bearing.seating(&Streams::new(1, member), 0, 1);
        let law = Coulomb { sampling: Sampling::Seats(seating), ..whole };
        for (a, b) in led(&law, tilted(20.0), 1e-10).iter().zip(led(&whole, tilted(20.0), 1e-10)) {
            // The block moves by 1e-4 m; the two differ in where shear is followed.
            assert!((a - b).norm() < 2e-6, "{a} {b}");
        }
        for solver in
            [Solver::Limit(limit::Settings::default()), Solver::Nonsmooth(nonsmooth::Settings::default())]
        {
            let law = Coulomb { tan_phi: 5.0, ..law };
            let (found, exact) = (falls(&law, Direction::YPlus, &solver), degrees(atan(0.2 / HEIGHT)));
            assert!((found - exact).abs() < 0.03, "{}: {found} {exact}", solver.name());
        }
    }
}

#[test]
fn points_at_the_edge_are_an_inset() {
    // Four points as far from both edges: their quarters of the face, shrunk about them, end where an inset begins.
    let (share, from_edge) = (0.25, 0.03);
    let inset = (1.0 - f64::sqrt(share)) * from_edge;
    let (x, y) = (0.5 * SIZE[0] - from_edge, 0.5 * SIZE[1] - from_edge);
    let corners = [[-x, y], [x, y], [x, -y], [-x, -y]].map(|at| (at, 0.0));
    let (stiff, wall) = (dry(1e12, 80.0), block());
    let law = on(stiff, share, &corners);
    let compliant = nonsmooth::Normal::Compliant;
    // Springs of contact dynamics stand at points inside of their patches, so that these have no edge.
    let ends_at_edges =
        |solver: &Solver| !matches!(solver, Solver::Nonsmooth(own) if own.normal == compliant);
    for solver in all_solvers().into_iter().filter(ends_at_edges) {
        for (towards, half) in [(Direction::YPlus, 0.2), (Direction::XMinus, 0.15)] {
            let found = falls(&law, towards, &solver);
            let task =
                path(&wall, &stiff, LoadPath::tilt(towards, radians(1.0), radians(80.0), radians(0.02)));
            let contact = contact::Settings { inset, ..task.contact };
            let worn = drive(&Task { contact, ..task }, &solver);
            let Outcome::Collapsed { at: Level::Tilt(worn) } = worn.outcome else {
                panic!("{:?}", worn.outcome)
            };
            let exact = degrees(atan((half - inset) / HEIGHT));
            println!("{} {towards:?}: {found:.3}, inset {:.3}, {exact:.3}", solver.name(), degrees(worn));
            // Brackets of 0.02 deg each. Springs turn on a strip of 0.2 mm, which is shorter, and so sinks in deeper, where it is one of points.
            let near = (found - degrees(worn)).abs() < 0.12 && (found - exact).abs() < 0.25;
            assert!(near, "{} {towards:?}: {found} {exact}", solver.name());
        }
    }
}

/// A stone's bearing with heights within 2 mm, on a fifth of its face.
fn bearing(points: f64) -> Bearing {
    Bearing { points, relief: 2e-3, share: 0.2 }
}

fn drawn(points: f64, member: u64) -> Vec<Seat> {
    bearing(points).seating(&Streams::new(2, member), 3, 8).seats().to_vec()
}

#[test]
fn a_joint_bears_alike_whatever_the_order_of_its_blocks_and_another_relief() {
    let streams = Streams::new(5, 2);
    let one = bearing(4.0).seating(&streams, 3, 8);
    assert_eq!(one, bearing(4.0).seating(&streams, 8, 3));
    let places = |seating: Seating| seating.seats().iter().map(|seat| seat.at).collect::<Vec<_>>();
    let flat = Bearing { relief: 0.0, ..bearing(4.0) }.seating(&streams, 3, 8);
    assert_eq!(places(one), places(flat));
    assert!(flat.seats().iter().all(|seat| seat.recess == 0.0));
    for other in [bearing(4.0).seating(&streams, 3, 9), bearing(4.0).seating(&Streams::new(5, 3), 3, 8)] {
        assert_ne!(places(one), places(other));
    }
}

#[test]
fn points_are_uniform_and_hold_the_middle() {
    let n = 2000;
    for points in [1.0, 2.0, 3.0, 6.0] {
        let mut sums = [0.0; 2];
        for member in 0..n {
            let seats = drawn(points, member);
            assert_eq!(seats.len(), points as usize);
            // Ahead of every line through the middle lies a point.
            for turn in 0..12 {
                let (c, s) = (cos(radians(30.0 * f64::from(turn))), sin(radians(30.0 * f64::from(turn))));
                let ahead = |seat: &Seat| (seat.at[0] - 0.5) * c + (seat.at[1] - 0.5) * s > 0.0;
                assert!(points < 3.0 || seats.iter().any(ahead), "{seats:?}");
            }
            seats.iter().for_each(|seat| (0..2).for_each(|k| sums[k] += seat.at[k]));
        }
        for sum in sums {
            let mean = sum / (n as f64 * points);
            // Five standard deviations of a mean of so many walls, each of which scatters by 0.35 at most.
            assert!((mean - 0.5).abs() < 5.0 * 0.35 / (n as f64).sqrt(), "{points}: {mean}");
        }
    }
    // Alone it is uniform: variance 1/12, known to 4.5 % of itself by 2000 draws, five times over a fifth.
    let variance =
        (0..n).map(|member| drawn(1.0, member)[0].at[0] - 0.5).map(|x| x * x).sum::<f64>() / n as f64;
    assert!((12.0 * variance - 1.0).abs() < 0.1, "{variance}");
    // 2.4 points are 2 in six joints of ten and 3 in four: 800 of 2000, five sigma of a binomial.
    let three = (0..n).filter(|member| drawn(2.4, *member).len() == 3).count();
    assert!(three.abs_diff(800) < 110, "{three}");
}

#[test]
fn three_points_touch_and_the_others_lie_behind_their_plane() {
    for member in 0..200 {
        for points in [4.0, 6.0, 16.0] {
            let seats = drawn(points, member);
            let flush: Vec<usize> = (0..seats.len()).filter(|k| seats[*k].recess == 0.0).collect();
            assert!(flush.len() == 3 && seats.iter().all(|seat| seat.recess >= 0.0), "{seats:?}");
            // Height and gap together are the plane in which the stone lies: affine over the face.
            let mut heights = Streams::new(2, member).of("joint bearing height 3-8");
            let tops: Vec<f64> = seats.iter().map(|seat| 2e-3 * heights.uniform() + seat.recess).collect();
            let [a, b, c] = [0, 1, 2].map(|k| (seats[flush[k]].at, tops[flush[k]]));
            let of = |p: [f64; 2]| {
                let twice = |u: [f64; 2], v: [f64; 2], w: [f64; 2]| {
                    (v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0])
                };
                let whole = twice(a.0, b.0, c.0);
                [twice(p, b.0, c.0), twice(a.0, p, c.0), twice(a.0, b.0, p)].map(|part| part / whole)
            };
            assert!(of([0.5; 2]).iter().all(|weight| *weight > 0.0), "the three hold the middle");
            for (seat, top) in seats.iter().zip(&tops) {
                let [u, v, w] = of(seat.at);
                let plane = u * a.1 + v * b.1 + w * c.1;
                // Outside of a thin triangle its plane is known to some digits less.
                assert!((plane - top).abs() < 1e-9, "{plane} {top}");
            }
        }
    }
}

#[test]
fn many_points_come_to_partial_contact() {
    // Sixteen points with a quarter of the face against sixteen of 64 patches, under a tilted block: both scatter with the draw.
    let kn = 5e7;
    let n = 24;
    let top = |law: &Coulomb| led(law, tilted(20.0), 1e-8)[0] - Vec3::new(0.0, 0.0, HEIGHT);
    let many = Bearing { points: 16.0, relief: 0.0, share: 0.25 };
    let seated = |member| Sampling::Seats(many.seating(&Streams::new(4, member), 0, 1));
    let (mut sum, mut square) = (Vec3::zeros(), 0.0);
    for member in 0..n {
        let moved = top(&Coulomb { sampling: seated(member), ..dry(kn, 60.0) });
        sum += moved;
        square += moved.y * moved.y;
    }
    let mean = sum / n as f64;
    // One patch of every four by four: 16 of 64, spread evenly.
    let even = (0..4).flat_map(|i| (0..4).map(move |j| 8 * (2 * i + (i + j) % 2) + 2 * j + j % 2));
    let even = even.fold(0, |mask, bit| mask | 1u64 << bit);
    let patches = top(&Coulomb { sampling: Sampling::Patches(even), ..dry(kn, 60.0) });
    let whole = top(&dry(0.25 * kn, 60.0));
    let sd = (square / n as f64 - mean.y * mean.y).max(0.0).sqrt();
    println!("seats {mean}, sd of y {sd:e}; patches {patches}; a quarter of kn {whole}");
    assert!((mean.y / patches.y - 1.0).abs() < 0.15, "{} {}", mean.y, patches.y);
    assert!((mean.z / whole.z - 1.0).abs() < 0.15, "{} {}", mean.z, whole.z);
}
