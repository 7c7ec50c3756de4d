//! Strength of cells that are strained step by step: against stiffness, limit analysis and closed forms of friction without dilatancy.

use pirca::contact;
use pirca::homogenise::{
    Border, Direction, Ending, Method, Moduli, Path, Springs, Strained, strained, surface,
};
use pirca::law::{Coulomb, NormalLaw};
use pirca::model::Cell;

use crate::cells::Bond;
use crate::fixture::dry;

const STONE: [f64; 3] = [0.4, 0.2, 0.3];
const PRESSURE: f64 = 1000.0;
const PULL: Direction = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
const SHEAR: Direction = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
const SQUEEZED_SHEAR: Direction = [-1.0, 0.0, 1.0, 0.0, 0.0, 0.0];
const BEND_ALONG: Direction = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
const BEND_UP: Direction = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
const TWIST: Direction = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0];

fn contacts() -> contact::Settings {
    contact::Settings::for_size(0.1, [2, 2])
}

fn friction(mu: f64) -> Coulomb {
    Coulomb { tan_phi: mu, ..dry(1e9, 30.0) }
}

fn path(cell: &Cell, law: &Coulomb, direction: Direction, settings: Strained) -> Path {
    strained(cell, law, &contacts(), PRESSURE, &direction, settings)
}

/// The strength of a path that ends on a plateau or softens.
fn strength(cell: &Cell, law: &Coulomb, direction: Direction) -> f64 {
    let path = path(cell, law, direction, Strained::default());
    path.strength()
        .unwrap_or_else(|| panic!("{direction:?}: {:?} after {:?}", path.ending, path.points.last()))
}

fn associative(cell: &Cell, law: &Coulomb, direction: Direction) -> f64 {
    let points = surface(cell, law, contacts(), Method::Associative, PRESSURE, &[direction]);
    points[0].found.value().unwrap_or_else(|| panic!("{:?}", points[0]))
}

/// Strain per multiplier of a direction by the moduli of the cell.
fn compliance(cell: &Cell, law: &Coulomb, direction: Direction) -> f64 {
    let springs = Springs::of_cell(cell, law, &contacts(), PRESSURE / cell.thickness);
    let stiffness = Moduli::of(&springs, Border::Periodic).unwrap().stiffness;
    let units = [1.0, 1.0, 1.0, cell.thickness, cell.thickness, cell.thickness];
    let stress = nalgebra::Vector6::from_fn(|k, _| direction[k] * units[k]);
    let matrix = nalgebra::Matrix6::from_fn(|i, j| stiffness[i][j]);
    PRESSURE * stress.dot(&matrix.lu().solve(&stress).unwrap())
}

#[test]
fn a_cell_that_neither_opens_nor_slips_is_as_stiff_as_its_moduli() {
    let cell = Bond::of(STONE, 3, 4).shifted(0.2, 3);
    let bonded = Coulomb { bonded: true, ..friction(0.6) };
    let settings = Strained { largest: 1.0, ..Strained::default() };
    let all = [PULL, SHEAR, BEND_ALONG, BEND_UP, TWIST, [0.3, -0.2, 0.5, 0.1, 0.7, -0.4]];
    // The last one presses on every joint along the wall, and sticks by friction alone.
    let cases = all.map(|direction| (bonded, direction)).into_iter();
    for (law, direction) in cases.chain([(friction(20.0), [-1.0, 0.0, 0.2, 0.0, 0.0, 0.0])]) {
        let path = path(&cell, &law, direction, settings);
        assert_eq!(path.ending, Ending::Rising, "{direction:?}");
        let exact = compliance(&cell, &law, direction);
        for (strain, multiplier) in &path.points[1..] {
            // The balance of forces, 1e-9 of the pressure, over the least multiplier, 0.05.
            assert!((strain / multiplier / exact - 1.0).abs() < 1e-6, "{direction:?}: {strain} {multiplier}");
        }
    }
}

#[test]
fn running_bond_bears_in_its_plane_what_its_closed_form_says() {
    // De Buhan and de Felice's facets are mechanisms that do not dilate, and what presses on the beds is known.
    for cell in [1, 2].map(|n| Bond::of(STONE, n, n).cell(|_, _| 0.0)) {
        for (direction, exact) in
            [(PULL, 0.6), (SHEAR, 0.375), ([1.0, 0.0, 1.0, 0.0, 0.0, 0.0], 0.6 / 2.6), (SQUEEZED_SHEAR, 0.6)]
        {
            let law = friction(0.6);
            let found = strength(&cell, &law, direction);
            // The plateau is known to 1e-4.
            assert!((found - exact).abs() < 1e-4 * exact, "{direction:?}: {found} {exact}");
            assert!(found <= associative(&cell, &law, direction) * (1.0 + 1e-6), "{direction:?}: {found}");
        }
    }
}

#[test]
fn beds_slide_at_their_cohesion_and_friction() {
    for (mu, cohesion) in [(0.2, 0.0), (0.6, 0.0), (0.6, 2e3)] {
        let (cell, law) = (Bond::of(STONE, 2, 2).cell(|_, _| 0.0), Coulomb { cohesion, ..friction(mu) });
        let found = strength(&cell, &law, SQUEEZED_SHEAR);
        let exact = mu + cohesion * STONE[2] / PRESSURE;
        assert!((found - exact).abs() < 1e-4 * exact, "{found} {exact}");
    }
}

#[test]
fn beds_open_at_a_face_under_half_the_thickness_whatever_their_stiffness() {
    let cell = Bond::of(STONE, 2, 2).shifted(0.2, 7);
    for (kn, closure) in [(1e7, 0.0), (1e9, 0.0), (1e9, 1e-5)] {
        let normal = NormalLaw::Hyperbolic { kn, initial: 0.2 * kn, closure };
        for direction in [BEND_UP, BEND_UP.map(|x| -x)] {
            let law = Coulomb { normal, ks: 0.5 * kn, ..friction(0.6) };
            let found = strength(&cell, &law, direction);
            // Only the points on the edge press at last.
            assert!((found - 0.5).abs() < 1e-6, "{kn} {closure}: {found}");
        }
    }
}

#[test]
fn beds_without_head_joints_turn_under_uniform_pressure() {
    // The friction of a rectangle that turns about its middle, of which limit analysis takes the corners alone.
    // Within the reach of the search for contacts, 0.5 mm, and beyond.
    for (length, slot) in [(0.302, 1e-3), (0.602, 1e-3), (0.902, 1e-3), (0.302, 1e-6), (0.602, 4e-4)] {
        let [_, height, _] = STONE;
        let thickness = 0.3;
        let bond = Bond { slot, ..Bond::of([length, height, thickness], 1, 1) };
        let (a, b) = (0.5 * (0.5 * length - slot), 0.5 * thickness);
        let across = (a * a + b * b).sqrt();
        let asinh = |x: f64| pirca::math::ln(x + (x * x + 1.0).sqrt());
        let turned = a * b * across / 3.0 + a * a * a / 6.0 * asinh(b / a) + b * b * b / 6.0 * asinh(a / b);
        let mean = 4.0 * turned / (4.0 * a * b);
        // One overlap for each course of every head joint, under half of what presses on a stone.
        let exact = 0.6 * mean * 0.5 * length / height / thickness;
        let cell = bond.cell(|_, _| 0.0);
        let found = strength(&cell, &friction(0.6), BEND_ALONG);
        assert!((found / exact - 1.0).abs() < 3e-3, "{length}, {slot}: {found} {exact}");
        // A push along the wall slides the beds as a pull does, by all methods: heads that are open press on nothing.
        let exact = 0.6 * length / (2.0 * height);
        for found in [strength, associative].map(|of| of(&cell, &friction(0.6), PULL.map(|x| -x))) {
            assert!((found / exact - 1.0).abs() < 2e-4, "{length}, {slot}: {found} {exact}");
        }
    }
}

/// The least pull of a crack through head joints that crosses the beds under uniform pressure: friction on what it follows of
/// them, by dynamic programming over the courses.
fn weakest_crack(cell: &Cell, n: usize, mu: f64) -> f64 {
    let [length, height, _] = STONE;
    let period = n as f64 * length;
    let heads: Vec<Vec<f64>> = (0..n)
        .map(|course| {
            let own = cell.blocks[n * course..n * (course + 1)].iter().map(|b| b.shape.bounds().0.x);
            own.flat_map(|x| [x - period, x, x + period]).collect()
        })
        .collect();
    let closed = |start: usize| {
        let mut ways: Vec<f64> = (0..3 * n).map(|k| if k == start { 0.0 } else { f64::INFINITY }).collect();
        for course in 0..n {
            let (here, next) = (&heads[course], &heads[(course + 1) % n]);
            let least = |to: &f64| {
                let all = here.iter().zip(&ways).map(|(from, way)| way + (to - from).abs());
                all.fold(f64::INFINITY, f64::min)
            };
            ways = next.iter().map(least).collect();
        }
        ways[start]
    };
    mu * (0..3 * n).map(closed).fold(f64::INFINITY, f64::min) / (n as f64 * height)
}

#[test]
fn a_wall_that_does_not_dilate_cracks_along_the_weakest_way_through_its_head_joints() {
    let (law, n) = (friction(0.6), 4);
    assert!((weakest_crack(&Bond::of(STONE, n, n).cell(|_, _| 0.0), n, 0.6) - 0.6).abs() < 1e-12);
    for member in 0..6 {
        let cell = Bond::of(STONE, n, n).shifted(0.2, member);
        let (found, crack) = (strength(&cell, &law, PULL), weakest_crack(&cell, n, 0.6));
        // Stones that are pulled by friction turn a little, and press more on one end.
        assert!((found / crack - 1.0).abs() < 0.02, "{member}: {found} {crack}");
        // Limit analysis lets the pressure go where dilatancy wants it.
        assert!((associative(&cell, &law, PULL) - 0.6).abs() < 1e-6);
        let [turned, most] = [strength(&cell, &law, BEND_ALONG), associative(&cell, &law, BEND_ALONG)];
        assert!(turned < 0.7 * most, "{member}: {turned} {most}");
    }
}

#[test]
fn half_the_increments_lead_to_the_same_strength_and_twice_the_same_to_the_same_bits() {
    let (cell, law) = (Bond::of(STONE, 3, 2).shifted(0.2, 5), friction(0.6));
    let finer = Strained { first: 0.025, growth: 0.1, ..Strained::default() };
    for direction in [PULL, SHEAR, BEND_ALONG, BEND_UP, TWIST] {
        let [coarse, again, fine] = [Strained::default(), Strained::default(), finer]
            .map(|settings| path(&cell, &law, direction, settings));
        assert_eq!(coarse, again);
        let (found, finer) = (coarse.strength().unwrap(), fine.strength().unwrap());
        assert!((found - finer).abs() < 1e-3 * finer, "{direction:?}: {found} {finer}");
        for path in [coarse, fine] {
            let rises = path.points.windows(2).all(|pair| pair[1].1 > pair[0].1 - 1e-4 * path.largest());
            assert!(rises, "{direction:?}: {:?}", path.points);
        }
    }
}
