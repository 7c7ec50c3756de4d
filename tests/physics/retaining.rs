//! Walls that hold back earth or water, against closed forms of statics.

use approx::assert_relative_eq;
use pirca::contact;
use pirca::law::Coulomb;
use pirca::math::{Vec3, cbrt, cos, radians, sin, tan};
use pirca::model::{Block, JointLaws, Level, Outcome, Support, Wall};
use pirca::protocol::{
    Behind, Direction, Ends, Fill, Highest, Lifts, Protocol, Restraint, Retained, Retaining, WATER, highest,
    run,
};
use pirca::shape::Polyhedron;
use pirca::solve::limit::{Analysis, Flow, Loads, PointLoad, Settings, When};
use pirca::solve::{Solver, explicit, implicit, limit, nonsmooth};

use crate::fixture::{G, dry, on_floor, stone};

/// The wall of the closed forms: 1.02 m thick, 6.1 m high, 22.3 kN/m^3, before a fill of 15.3 kN/m^3 and 35 deg.
const THICK: f64 = 1.02;
const HIGH: f64 = 6.1;
const WALL: f64 = 22.3e3 / G;
const FILL: f64 = 15.3e3 / G;

fn fill(phi_deg: f64, wall_friction: f64) -> Fill {
    Fill { density: FILL, phi: radians(phi_deg), wall_friction, slope: 0.0, surcharge: 0.0, drained: true }
}

fn cuboid(low: [f64; 3], high: [f64; 3], density: f64) -> Block {
    stone(Polyhedron::cuboid(Vec3::from(low), Vec3::from(high)), density)
}

/// Blocks of 1 m along the wall: `wythes` one behind the other and `courses` one on the other.
fn blocks([thick, high]: [f64; 2], density: f64, [wythes, courses]: [u32; 2]) -> Wall {
    let (deep, tall) = (thick / f64::from(wythes), high / f64::from(courses));
    let each =
        (0..courses).flat_map(|course| (0..wythes).map(move |wythe| (f64::from(course), f64::from(wythe))));
    let block = |(course, wythe): (f64, f64)| {
        cuboid(
            [0.0, deep * wythe, tall * course],
            [1.0, deep * (wythe + 1.0), tall * (course + 1.0)],
            density,
        )
    };
    on_floor(each.map(block).collect())
}

/// Joints that stand upright have no friction where blocks lie on one level.
struct SmoothSides<'w>(&'w Wall, Coulomb);

impl JointLaws for SmoothSides<'_> {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        let foot = |id: u32| self.0.blocks[id as usize].shape.bounds().0.z;
        let tan_phi = if (foot(a) - foot(b)).abs() < 1e-9 { 0.0 } else { self.1.tan_phi };
        Coulomb { tan_phi, ..self.1 }
    }
}

fn found(wall: &Wall, laws: &dyn JointLaws, retained: &Retained, flow: Flow) -> (Behind, Highest) {
    let behind = Behind::new(wall, Direction::YPlus, retained).expect("it has a back");
    let contact = contact::Settings::for_size(1.0, [2, 2]);
    let analysis = Analysis::new(wall, laws, contact, Settings { flow, ..Settings::default() });
    let found = highest(&analysis, &behind, Lifts::default());
    (behind, found)
}

/// The height (m) at which it falls.
fn height(wall: &Wall, laws: &dyn JointLaws, retained: &Retained) -> f64 {
    let (_, found) = found(wall, laws, retained, Flow::Associative);
    let Outcome::Collapsed { at: Level::Height(height) } = found.limit.outcome else { panic!("{found:?}") };
    let [low, high] = found.bracket.expect("it falls");
    assert!(low == height && high > low && high - low <= 1.001e-4 * HIGH, "{low} to {high}");
    height
}

/// `gs h^2/2 (Ka cos d h/3 - Ka sin d b) = n gw b^2 H/2`: n wythes without friction between them turn each about its own edge, the first of them pushed
/// by the fill and dragged down by its friction.
fn overturns(phi_deg: f64, wall_friction: f64, wythes: u32) -> f64 {
    let coefficient = pirca::protocol::Wedge {
        phi: radians(phi_deg),
        delta: wall_friction * radians(phi_deg),
        lean: 0.0,
        slope: 0.0,
    }
    .coefficient()
    .expect("level ground");
    let (n, delta) = (f64::from(wythes), wall_friction * radians(phi_deg));
    let b = THICK / n;
    let excess = |h: f64| {
        let thrust = 15.3 * h * h / 2.0 * coefficient;
        thrust * (cos(delta) * h / 3.0 - sin(delta) * b) - n * 22.3 * b * b * HIGH / 2.0
    };
    let (mut low, mut high) = (0.0, 20.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Wythes are pushed apart by nothing but the fill, and turn about their own edges.
#[test]
fn a_monolith_and_untied_wythes_overturn_at_the_heights_of_statics() {
    let rough = dry(1e9, 80.0);
    for (wythes, wall_friction, known) in
        [(1, 0.0, 4.678), (1, 2.0 / 3.0, 5.463), (2, 2.0 / 3.0, 4.187), (3, 2.0 / 3.0, 3.607)]
    {
        let wall = blocks([THICK, HIGH], WALL, [wythes, 1]);
        let height = height(&wall, &SmoothSides(&wall, rough), &Retained::Fill(fill(35.0, wall_friction)));
        assert_relative_eq!(overturns(35.0, wall_friction, wythes), known, max_relative = 2e-4);
        // The bracket is 1e-4 of the height of the back, the published numbers have four digits.
        assert_relative_eq!(height, known, max_relative = 5e-4);
    }
}

/// Where the back is of many stones, each with the pressure at its depth, what turns about the edge at the foot is the same body.
#[test]
fn courses_that_do_not_slide_overturn_as_the_monolith() {
    let rough = dry(1e9, 80.0);
    let retained = Retained::Fill(fill(35.0, 2.0 / 3.0));
    let known = overturns(35.0, 2.0 / 3.0, 1);
    for courses in [4, 13] {
        let wall = blocks([THICK, HIGH], WALL, [1, courses]);
        assert_relative_eq!(height(&wall, &rough, &retained), known, max_relative = 2e-4);
    }
}

#[test]
fn a_block_before_water_slides_or_overturns() {
    let (b, h, gw, water) = (0.6, 2.0, 15.7e3, 9.81e3);
    let wall = blocks([b, h], gw / G, [1, 1]);
    let retained = Retained::Water(water / G);
    let known = [cbrt(3.0 * gw / water * b * b * h), (2.0 * gw / water * b * h * tan(radians(25.0))).sqrt()];
    assert_relative_eq!(known[0], 1.512, max_relative = 3e-4);
    assert_relative_eq!(known[1], 1.338, max_relative = 3e-4);
    for (phi, known) in [(80.0, known[0]), (25.0, known[1])] {
        assert_relative_eq!(height(&wall, &dry(1e9, phi), &retained), known, max_relative = 2e-4);
        // Neither way to fall dilates where the block slides on level ground or turns.
        let (_, found) = found(&wall, &dry(1e9, phi), &retained, Flow::NonAssociative);
        assert_relative_eq!(found.height, known, max_relative = 2e-4);
    }
}

/// Force and moment of fill on a back of several stones, leaning and upright, are those of the triangle, and of the surcharge's rectangle.
#[test]
fn the_forces_add_up_to_coulombs_thrust() {
    let lean = 0.1;
    let slices = |k: f64| {
        let [low, high] = [k / 3.0, (k + 1.0) / 3.0];
        // The back goes away from the fill by a tenth of the height.
        let corner = |x: f64, front: bool, z: f64| Vec3::new(x, if front { 1.0 } else { lean * z }, z);
        let at = |z: f64| {
            [corner(0.0, false, z), corner(2.0, false, z), corner(2.0, true, z), corner(0.0, true, z)]
        };
        let corners: Vec<Vec3> = [at(low), at(high)].concat();
        stone(Polyhedron::hexahedron(corners.try_into().expect("eight corners")), 2000.0)
    };
    let wall = on_floor([0.0, 1.0, 2.0].map(slices).to_vec());
    let soil = Fill { surcharge: 3e3, ..fill(35.0, 2.0 / 3.0) };
    let behind = Behind::new(&wall, Direction::YPlus, &Retained::Fill(soil)).expect("it has a back");
    assert_relative_eq!(tan(behind.lean), lean, max_relative = 1e-12);
    let coefficient = behind.coefficient.expect("soil");
    assert_relative_eq!(coefficient, 0.28724, max_relative = 2e-5);
    for h in [0.2, 0.5, 1.0] {
        let loads = behind.loads(h);
        let force: Vec3 = loads.iter().map(|load| load.force).sum();
        let (own, surcharge) = (coefficient * FILL * G * h * h / 2.0, coefficient * 3e3 * h);
        assert_relative_eq!(force.norm(), 2.0 * (own + surcharge), max_relative = 1e-12);
        assert_relative_eq!(-force.z / force.y, tan(behind.lean + soil.delta()), max_relative = 1e-12);
        let moment: f64 = loads.iter().map(|load| load.force.y * load.point.z).sum();
        let lever = (own * h / 3.0 + surcharge * h / 2.0) / (own + surcharge);
        assert_relative_eq!(moment / force.y, lever, max_relative = 1e-12);
        // All of it acts on the back, in the middle of its length.
        assert!(loads.iter().all(|load| (load.point.y - lean * load.point.z).abs() < 1e-12));
        assert!(loads.iter().all(|load| (load.point.x - 1.0).abs() < 1e-12));
    }
}

/// Water in an undrained fill presses by itself, and the soil under it weighs what is left of it.
#[test]
fn water_in_the_fill_adds_its_pressure_and_takes_from_the_soil() {
    let wall = blocks([1.0, 2.0], 2000.0, [1, 2]);
    let soil = Fill { density: 2000.0, drained: false, ..fill(30.0, 0.0) };
    let behind = Behind::new(&wall, Direction::YPlus, &Retained::Fill(soil)).expect("it has a back");
    let force: f64 = behind.loads(1.5).iter().map(|load| load.force.y).sum();
    let known = (1.0 / 3.0 * (2000.0 - WATER) + WATER) * G * 1.5 * 1.5 / 2.0;
    assert_relative_eq!(force, known, max_relative = 1e-12);
}

/// A wall that holds a fill up to its top says so, and how many times the pressure it bears there: of overturning without friction on the back, the cube of the heights' ratio.
#[test]
fn a_wall_that_stands_to_its_top_says_how_much_more_it_bears() {
    let wall = blocks([THICK, 3.0], WALL, [1, 3]);
    let (behind, found) = found(&wall, &dry(1e9, 80.0), &Retained::Fill(fill(35.0, 0.0)), Flow::Associative);
    assert_eq!((&found.limit.outcome, found.height), (&Outcome::Equilibrium, behind.height));
    let coefficient = behind.coefficient.expect("soil");
    let margin = 22.3 * THICK * THICK * 3.0 / 2.0 / (15.3 * coefficient * 27.0 / 6.0);
    assert!(margin > 1.0);
    assert_relative_eq!(found.limit.multiplier, margin, max_relative = 1e-6);
}

/// Whatever pushes towards y- is behind the other face, and pushes as hard.
#[test]
fn the_same_wall_turned_round_holds_as_much() {
    let (wall, retained) = (blocks([0.6, 2.0], 1600.0, [1, 4]), Retained::Water(WATER));
    let analysis =
        Analysis::new(&wall, &dry(1e9, 35.0), contact::Settings::for_size(1.0, [2, 2]), Settings::default());
    let towards = |direction| {
        let behind = Behind::new(&wall, direction, &retained).expect("it has a back");
        highest(&analysis, &behind, Lifts::default()).height
    };
    assert_relative_eq!(towards(Direction::YPlus), towards(Direction::YMinus), max_relative = 1e-9);
    assert!(
        Behind::new(
            &on_floor(vec![Block { support: Support::Fixed, ..wall.blocks[0].clone() }]),
            Direction::YPlus,
            &retained
        )
        .is_err()
    );
}

/// Friction of soil on its ground and on the wall (rad); the floor under the wall is smooth. Blocks: 0 the wedge, 1 the wall, 2 the ground, 3 the floor.
struct Rubs(f64, f64);
impl JointLaws for Rubs {
    fn of(&self, a: u32, b: u32) -> Coulomb {
        let angle = match (a.min(b), a.max(b)) {
            (0, 1) => self.1,
            (0, 2) => self.0,
            _ => 0.0,
        };
        Coulomb { tan_phi: tan(angle), ..dry(1e9, 0.0) }
    }
}

/// The formula by the solver: a wedge of soil is a block on a plane and against a wall that can only go outwards. Least push that holds it, over all planes the largest.
#[test]
fn a_wedge_of_soil_as_a_block_presses_as_coulombs_formula() {
    let (phi, delta) = (radians(35.0), radians(20.0));
    let push = |angle: f64| {
        let run = 1.0 / tan(angle);
        let prism = |outline: [[f64; 2]; 4]| {
            let at = |x: f64, [y, z]: [f64; 2]| Vec3::new(x, y, z);
            let [a, b, c, d] = outline;
            Polyhedron::hexahedron([
                at(0.0, a),
                at(1.0, a),
                at(1.0, b),
                at(0.0, b),
                at(0.0, d),
                at(1.0, d),
                at(1.0, c),
                at(0.0, c),
            ])
        };
        // The wedge is cut off a little above its edge, so that it has six faces; its weight is taken with that.
        let cut = 1e-3;
        let wedge = prism([[-cut * run, cut], [0.0, cut], [0.0, 1.0], [-run, 1.0]]);
        let ground = prism([[-run - 0.5, -0.5], [0.0, -0.5], [0.0, 0.0], [-run - 0.5, 1.0 + 0.5 / run]]);
        let weight = 0.5 * run * (1.0 - cut * cut) * 1000.0 * G;
        let fixed = |shape| Block { support: Support::Fixed, ..stone(shape, 1000.0) };
        let wall = Wall {
            blocks: vec![
                stone(wedge, 1000.0),
                cuboid([0.0, 0.0, 0.0], [1.0, 5.0, 1.0], 1000.0),
                fixed(ground),
                fixed(Polyhedron::cuboid(Vec3::new(0.0, 0.0, -1.0), Vec3::new(1.0, 6.0, 0.0))),
            ],
        };
        let analysis = Analysis::new(
            &wall,
            &Rubs(phi, delta),
            contact::Settings::for_size(1.0, [2, 2]),
            Settings::default(),
        );
        // The wall is held by a force at the wedge's third, which is let go by a share.
        let held = |when: When, force: f64| PointLoad {
            block: 1,
            point: Vec3::new(0.5, 5.0, 1.0 / 3.0),
            force: Vec3::y() * force,
            when,
        };
        let loads =
            Loads { points: vec![held(When::Dead, -weight), held(When::Live, weight)], ..Loads::weight() };
        let limit = analysis.multiplier(&loads);
        let Outcome::Collapsed { at } = limit.outcome else { panic!("{angle}: {:?}", limit.outcome) };
        weight * (1.0 - at.value())
    };
    let most = (40..80).map(|deg| push(radians(f64::from(deg)))).fold(0.0, f64::max);
    let formula =
        pirca::protocol::Wedge { phi, delta, lean: 0.0, slope: 0.0 }.coefficient().expect("level ground");
    // The wall takes the horizontal part; planes are tried degree by degree.
    assert_relative_eq!(most, formula * cos(delta) * 1000.0 * G / 2.0, max_relative = 5e-3);
}

/// The same heights by the solvers that go by steps: a wall of three courses before water.
#[test]
fn solvers_that_go_by_steps_find_the_same_height() {
    let each = |k: u32| cuboid([0.0, 0.0, 0.5 * f64::from(k)], [1.0, 0.5, 0.5 * f64::from(k + 1)], 2000.0);
    let wall = Wall { blocks: (0..3).map(each).collect() };
    // It overturns at 1.31 m and would slide at 1.73 m.
    let known = cbrt(3.0 * 2000.0 / WATER * 0.5 * 0.5 * 1.5);
    let retaining = Retaining {
        retained: Retained::Water(WATER),
        lifts: Lifts { count: 5, bracket: 0.01 },
        collapse_share: 0.1,
    };
    let law = dry(1e10, 45.0);
    let solvers = [
        (Solver::Limit(limit::Settings::default()), 0.01),
        // Joints that close let the wall lean: 1.5 % with such stiff ones.
        (Solver::Implicit(implicit::Settings::default()), 0.03),
        (Solver::Explicit(explicit::Settings::default()), 0.03),
        (Solver::Nonsmooth(nonsmooth::Settings::default()), 0.02),
    ];
    for (solver, within) in solvers {
        let run = run(
            &wall,
            &law,
            &Protocol::Retaining(retaining),
            &Restraint::at_ends(Ends::Free),
            [2, 2],
            &solver,
        );
        let Outcome::Collapsed { at: Level::Height(height) } = run.outcome else {
            panic!("{}: {:?}", solver.name(), run.outcome)
        };
        println!("{}: {height} of {known}, {:?}", solver.name(), run.bracket);
        assert!(
            height < known * 1.0001 && height > known * (1.0 - within),
            "{}: {height} of {known}",
            solver.name()
        );
        assert!(run.steps.iter().all(|step| matches!(step.level, Level::Height(_))));
    }
}
