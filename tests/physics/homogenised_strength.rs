//! Strength of cells against the closed forms of running bond (de Buhan and de Felice 1997) and each other.

use pirca::contact;
use pirca::homogenise::{Direction, Found, IN_PLANE, Method, out_of_plane, surface};
use pirca::model::{Cell, Six};
use pirca::solve::limit::{Analysis, Settings};

use crate::cells::Bond;
use crate::fixture::dry;

fn contacts() -> contact::Settings {
    contact::Settings::for_size(0.1, [2, 2])
}

fn friction(mu: f64) -> pirca::law::Coulomb {
    pirca::law::Coulomb { tan_phi: mu, ..dry(1e9, 30.0) }
}

/// The largest multiple of `live` beside unit vertical pressure and a stress along the wall.
fn borne(cell: &Cell, mu: f64, along: f64, live: Six) -> f64 {
    let analysis = Analysis::of_cell(cell, &friction(mu), contacts(), Settings::default(), 1.0);
    analysis.bears([along, -1.0, 0.0, 0.0, 0.0, 0.0], &[live])[0].limit.multiplier
}

fn value(cell: &Cell, mu: f64, method: Method, direction: Direction) -> f64 {
    let points = surface(cell, &friction(mu), contacts(), method, 1000.0, &[direction]);
    points[0].found.value().unwrap_or_else(|| panic!("{:?}", points[0]))
}

const PULL: Six = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
const SHEAR: Six = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
const BEND_ALONG: Six = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
const BEND_UP: Six = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0];

#[test]
fn running_bond_bears_in_its_plane_what_its_closed_form_says() {
    // C2 to C4: relative accuracy of the program.
    let close = |found: f64, exact: f64| assert!((found - exact).abs() < 1e-6, "{found} {exact}");
    let square = Bond::of([0.4, 0.2, 0.3], 1, 1).cell(|_, _| 0.0);
    close(borne(&square, 0.6, 0.0, PULL), 0.6);
    for (along, exact) in [(0.0, 0.375), (-0.2, 0.5), (-0.5, 0.6), (-1.0, 0.6)] {
        close(borne(&square, 0.6, along, SHEAR), exact);
    }
    for ratio in [2.0, 1.5, 1.0, 0.5] {
        let (mu, m) = (0.4, 2.0 / ratio);
        let cell = Bond::of([0.2 * ratio, 0.2, 0.3], 1, 1).cell(|_, _| 0.0);
        close(borne(&cell, mu, 0.0, SHEAR), mu / (1.0 + m * mu));
    }
    // mu m > 1: stones rock before they slide.
    let tall = Bond::of([0.2, 0.2, 0.3], 1, 1).cell(|_, _| 0.0);
    let exact = [0.307_692, 0.384_615, 0.461_538, 0.642_857, 0.8];
    for (along, exact) in [0.0, -0.1, -0.2, -0.5, -1.0].into_iter().zip(exact) {
        close(borne(&tall, 0.8, along, SHEAR), exact);
    }
}

#[test]
fn any_direction_in_the_plane_ends_where_the_closed_form_ends() {
    // m = 2 a / b; for mu m <= 1: |t| <= mu p and m s11 + (1 + m mu) |t| <= mu p.
    for (length, mu) in [(0.4, 0.3), (0.4, 0.9), (0.6, 0.5), (0.25, 0.6)] {
        let (cell, m) = (Bond::of([length, 0.2, 0.3], 1, 1).cell(|_, _| 0.0), 0.4 / length);
        assert!(mu * m <= 1.0);
        for k in 0..16 {
            let angle = std::f64::consts::TAU * (f64::from(k) + 0.3) / 16.0;
            let [s, t] = [pirca::math::cos(angle), pirca::math::sin(angle)];
            let wedged = m * s + (1.0 + m * mu) * t.abs();
            let exact = [mu / t.abs(), if wedged > 0.0 { mu / wedged } else { f64::INFINITY }];
            let exact = exact[0].min(exact[1]);
            if exact < 9.0 {
                let found = borne(&cell, mu, 0.0, [s, 0.0, t, 0.0, 0.0, 0.0]);
                assert!((found - exact).abs() < 1e-6, "{length} {mu} {angle}: {found} {exact}");
            }
        }
    }
}

#[test]
fn random_head_joints_leave_the_associative_domain_in_the_plane_as_it_is() {
    // C7: which stones touch is unchanged, and so is the domain.
    let regular = Bond::of([0.4, 0.2, 0.3], 1, 1).cell(|_, _| 0.0);
    for n in [2, 4, 8] {
        for member in 0..3 {
            let cell = Bond::of([0.4, 0.2, 0.3], n, n).shifted(0.2, member);
            for direction in [PULL, SHEAR, [1.0, 0.0, 1.0, 0.0, 0.0, 0.0]] {
                let [found, exact] =
                    [&cell, &regular].map(|cell| value(cell, 0.6, Method::Associative, direction));
                assert!((found / exact - 1.0).abs() < 1e-6, "{n} {member} {direction:?}: {found} {exact}");
            }
        }
    }
}

#[test]
fn a_wall_without_head_joints_turns_its_stones_in_their_beds() {
    // C5, the corner model: beds at half bond, each pressed at its corners, turn about their middle.
    let ([b, a, t], mu, slot) = ([0.4, 0.2, 0.3], 0.6, 1e-3);
    let bond = Bond { slot, ..Bond::of([b, a, t], 1, 1) };
    let overlap = 0.5 * b - slot;
    let exact = mu * 0.5 * b * (overlap * overlap + t * t).sqrt() / (2.0 * a) / t;
    let found = value(&bond.cell(|_, _| 0.0), mu, Method::Associative, BEND_ALONG);
    assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
    // Closed head joints press at a face of the wall, and it bears more.
    let closed = value(&Bond::of([b, a, t], 1, 1).cell(|_, _| 0.0), mu, Method::Associative, BEND_ALONG);
    assert!(closed > 1.1 * found, "{closed} {found}");
}

#[test]
fn beds_open_at_a_face_under_half_the_thickness() {
    for method in [Method::Associative, Method::NonAssociative] {
        for direction in [BEND_UP, BEND_UP.map(|x| -x)] {
            let found = value(&Bond::of([0.4, 0.2, 0.3], 2, 2).shifted(0.2, 7), 0.6, method, direction);
            assert!((found - 0.5).abs() < 1e-6, "{method:?}: {found}");
        }
    }
}

#[test]
fn a_state_without_dilatancy_bears_no_more() {
    let cell = Bond::of([0.4, 0.2, 0.3], 4, 4).shifted(0.2, 1);
    let directions: Vec<Direction> = IN_PLANE.into_iter().chain(out_of_plane()).collect();
    let [upper, found] = [Method::Associative, Method::NonAssociative]
        .map(|method| surface(&cell, &friction(0.6), contacts(), method, 1000.0, &directions));
    let mut less = 0;
    for (upper, found) in upper.iter().zip(&found) {
        if let (Some(most), Some(value)) = (upper.found.value(), found.found.value()) {
            // The fixed point is found to 1e-5.
            assert!(value <= most * (1.0 + 2e-5), "{:?}: {value} {most}", upper.direction);
            less += usize::from(value < 0.999 * most);
        }
    }
    assert!(less > 0, "dilatancy costs nothing in any direction");
}

#[test]
fn the_normal_of_a_point_is_that_of_a_plane_that_no_other_point_is_beyond() {
    let cell = Bond::of([0.4, 0.2, 0.3], 3, 2).shifted(0.2, 2);
    let directions: Vec<Direction> = IN_PLANE.into_iter().chain(out_of_plane()).collect();
    let points = surface(&cell, &friction(0.6), contacts(), Method::Associative, 1000.0, &directions);
    let at = |k: usize| {
        let value = points[k].found.value()?;
        let mut stress = points[k].direction.map(|x| x * value);
        stress[1] -= 1.0;
        Some(stress)
    };
    let mut ended = 0;
    for (k, point) in points.iter().enumerate() {
        let Some(own) = at(k) else {
            assert_eq!(point.found, Found::Unbounded, "{:?}", point.direction);
            continue;
        };
        ended += 1;
        let power = |stress: &Six| stress.iter().zip(&point.normal).map(|(a, b)| a * b).sum::<f64>();
        // Without cohesion nothing is dissipated but by friction, which dilatancy takes up: the planes go through the origin.
        assert!(power(&own).abs() < 1e-6, "{:?}: {}", point.direction, power(&own));
        for other in (0..points.len()).filter_map(at) {
            assert!(power(&other) < 1e-6, "{:?} is beyond {:?}", other, point.direction);
        }
    }
    assert!(ended > 30, "{ended}");
}

#[test]
fn the_reach_along_a_strain_rate_is_that_of_the_closed_domain() {
    // Corners of the domain in the plane: (mu / m, 0) and (-mu^2, +-mu).
    let ([b, a, t], mu) = ([0.4, 0.2, 0.3], 0.6);
    let m = 2.0 * a / b;
    let cell = Bond::of([b, a, t], 2, 2).shifted(0.1, 3);
    let analysis = Analysis::of_cell(&cell, &friction(mu), contacts(), Settings::default(), 1.0);
    for shear in [-3.0_f64, -0.5, 0.0, 0.7, 1.0, 2.0, 10.0] {
        let exact = (mu / m).max(shear.abs() * mu - mu * mu);
        let found = analysis.reaches(1.0, &[1.0, 0.0, shear, 0.0, 0.0, 0.0]).unwrap();
        let value = found.limit.multiplier;
        assert!((value / exact - 1.0).abs() < 1e-6, "{shear}: {value} {exact}");
        // The plane's normal has the reach in the place of E22.
        let scale = found.rate[0];
        assert!((found.rate[1] / scale - exact).abs() < 1e-5, "{shear}: {:?}", found.rate);
    }
}

#[test]
fn no_stress_that_is_borne_lies_beyond_a_plane_of_the_reach() {
    let cell = Bond::of([0.4, 0.2, 0.3], 3, 2).shifted(0.2, 2);
    let directions: Vec<Direction> = IN_PLANE.into_iter().chain(out_of_plane()).collect();
    let points = surface(&cell, &friction(0.6), contacts(), Method::Associative, 1.0, &directions);
    let analysis = Analysis::of_cell(&cell, &friction(0.6), contacts(), Settings::default(), 1.0);
    for rate in
        [[0.2, 0.0, 0.5, 1.0, 0.3, 0.1], [0.1, 0.0, 0.0, -0.4, 1.0, 0.5], [0.3, 0.0, -1.0, 0.2, 0.2, -2.0]]
    {
        let reach = analysis.reaches(1.0, &rate).unwrap().limit.multiplier;
        let mut nearest = f64::INFINITY;
        for point in &points {
            let Some(value) = point.found.value() else { continue };
            let units = [1.0, 1.0, 1.0, 0.3, 0.3, 0.3];
            let work: f64 = (0..6).map(|k| rate[k] * value * point.direction[k] * units[k]).sum();
            assert!(work <= reach * (1.0 + 1e-6), "{rate:?}: {work} beyond {reach}");
            nearest = nearest.min(reach - work);
        }
        // 34 points are a coarse hull, but the plane touches the set that they are of.
        assert!(nearest < 0.5 * reach, "{rate:?}: {nearest} of {reach}");
    }
}
