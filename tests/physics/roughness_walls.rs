//! Walls of hollow clumps on a tilting table, beside the same walls of polyhedra.

use crate::regular_rows::RegularRows;
use pirca::generate::canonical::{COURSE_HEIGHT, DENSITY, THICKNESS};
use pirca::law::Frictional;
use pirca::math::{Vec3, asin, atan, degrees, radians};
use pirca::model::{Block, Heap, Hollow, Support, Wall};
use pirca::protocol::{
    Contacts, Direction, Ends, Protocol, Restraint, Run, TiltedHeap, Tilting, run, tilt_heap,
};
use pirca::shape::{Polyhedron, Rows};
use pirca::solve::{Solver, grains, implicit};

use crate::fixture::{dry, stone};

/// Depth of the columns along y (m): a whole stone of the canonical walls.
const DEPTH: f64 = 0.2;
const KS_OVER_KN: f64 = 0.5;
/// A column in its plane.
pub const IN_PLANE: (Hollow, Direction) = (Hollow::Plane, Direction::XPlus);

/// A stone of the column with its thickness along x, between two heights (m).
fn course(low: f64, high: f64) -> Block {
    let [x, y] = [0.5 * THICKNESS, 0.5 * DEPTH];
    stone(Polyhedron::cuboid(Vec3::new(-x, -y, low), Vec3::new(x, y, high)), DENSITY)
}

/// A column of whole stones of the canonical wall, its thickness along x. It tilts towards x, so that the plane of the model is
/// its section.
pub fn column(courses: u32) -> Wall {
    let height = |k: u32| COURSE_HEIGHT * f64::from(k);
    Wall { blocks: (0..courses).map(|k| course(height(k), height(k + 1))).collect() }
}

/// The wall with a fixed course like its lowest one below that, to be made of clumps; of polyhedra it stands on a platform.
pub fn on_its_like(wall: &Wall) -> Wall {
    let low = wall.bounds().0.z;
    let lowest = wall.blocks.iter().filter(|block| block.shape.bounds().0.z == low);
    let below = |block: &Block| {
        let shape = block.shape.translated(&(-Vec3::z() * block.shape.width(&Vec3::z())));
        Block { shape, support: Support::Fixed, ..block.clone() }
    };
    Wall { blocks: wall.blocks.iter().cloned().chain(lowest.map(below)).collect() }
}

/// Rows of a radius (m), at a distance over it, ball on ball or in the hollows.
pub fn rows(radius: f64, spacing_share: f64, in_hollows: bool) -> Rows {
    Rows { radius, spacing: spacing_share * radius, phase: if in_hollows { 0.5 } else { 0.0 } }
}

/// The balls whose joints have `kn` (Pa/m) as they are laid: in the hollows each counts for more than ball on ball.
pub fn material(rows: &Rows, model: Hollow, kn: f64, phi_deg: f64) -> Frictional {
    let Rows { radius, spacing, phase } = *rows;
    let (contacts, between) = match model {
        Hollow::Plane => (1.0 / (spacing * DEPTH), false),
        Hollow::Space => (1.0 / (spacing * spacing), true),
    };
    let regular = RegularRows { radius, spacing, between, phi: radians(phi_deg) };
    let stiffening = if phase > 0.0 { regular.stiffening(true, KS_OVER_KN) } else { 1.0 };
    Frictional::for_joint(kn / stiffening, KS_OVER_KN, radians(phi_deg), radius, contacts)
}

pub fn table(towards: Direction) -> Tilting {
    Tilting { towards, step: radians(1.0), end: radians(60.0), bracket: radians(0.05), ..Tilting::default() }
}

/// A wall in hollow clumps; joints of `kn` (Pa/m), balls of `phi_deg`.
pub fn in_clumps(
    wall: &Wall,
    (model, towards): (Hollow, Direction),
    rows: &Rows,
    [kn, phi_deg]: [f64; 2],
) -> TiltedHeap {
    let material = material(rows, model, kn, phi_deg);
    let heap =
        Heap::hollow(&on_its_like(wall), model, rows, material).unwrap_or_else(|fault| panic!("{fault}"));
    tilt_heap(&heap, grains::Settings::default(), &table(towards).path(), 1e-4, 0.1 * THICKNESS)
}

/// The same in polyhedra.
pub fn in_polyhedra(wall: &Wall, towards: Direction, [kn, phi_deg, inset]: [f64; 3], solver: &Solver) -> Run {
    let contacts = Contacts { inset, ..Contacts::from([2, 8]) };
    let restraint = Restraint::at_ends(Ends::Free);
    run(wall, &dry(kn, phi_deg), &Protocol::Tilting(table(towards)), &restraint, contacts, solver)
}

/// Middle of a bracket (deg).
pub fn middle(bracket: Option<[f64; 2]>) -> f64 {
    bracket.map_or(f64::NAN, |[low, high]| degrees(0.5 * (low + high)))
}

#[test]
fn a_stone_in_the_hollows_slides_at_the_friction_of_its_balls_and_their_slope() {
    // Balls half a diameter apart: sin(theta) = 1/4.
    let tilted = |in_hollows| in_clumps(&column(1), IN_PLANE, &rows(0.0095, 1.0, in_hollows), [1e10, 10.5]);
    let expected = 10.5 + degrees(asin(0.25));
    let slides = tilted(true);
    println!("slides at {:.2} deg, closed form {expected:.2}", middle(slides.bracket));
    // Half the bracket, and the springs' lean: closures of 1e-7 m on arcs of 2 cm.
    assert!((middle(slides.bracket) - expected).abs() < 0.03, "{:?} against {expected}", slides.outcome);
    // On the crests it slips at the friction of the balls, into the next hollow half a spacing on, and stands there.
    let slips = tilted(false);
    let on_crests: Vec<bool> = slips.steps.iter().map(|step| step.moved < 0.1 * 0.0095).collect();
    assert_eq!(on_crests.iter().filter(|on| **on).count(), 11, "up to 10 deg");
    assert!((slips.steps[11].moved / (0.5 * 0.0095) - 1.0).abs() < 0.05, "{:?}", slips.steps[11]);
    // It has come to stand a little up the far side.
    assert!((middle(slips.bracket) - expected).abs() < 0.1, "{:?} against {expected}", slips.outcome);
}

#[test]
fn a_stiff_stone_topples_over_its_last_contact() {
    let height = 0.3;
    let wall = Wall { blocks: vec![course(0.0, height)] };
    let radius = 0.0095;
    // Five spacings of two radii. Ball on ball it turns over the corner ball. In the hollows the last ball is half a spacing
    // within that, and its contact with the one ahead half of that back, half as deep below the bed as the ball reaches.
    let deep = radius * (2.0 - 3.0_f64.sqrt());
    for (in_hollows, inset, below) in [(false, radius, 0.0), (true, 1.5 * radius, 0.5 * deep)] {
        let tilted = in_clumps(&wall, IN_PLANE, &rows(radius, 2.0, in_hollows), [1e12, 40.0]);
        let expected = degrees(atan((0.5 * THICKNESS - inset) / (0.5 * height + below)));
        println!(
            "in hollows {in_hollows}: topples at {:.2} deg, rigid {expected:.2}",
            middle(tilted.bracket)
        );
        // Half the bracket and the closures, some 1e-8 m.
        assert!((middle(tilted.bracket) - expected).abs() < 0.03, "{:?} against {expected}", tilted.outcome);
    }
}

#[test]
fn a_soft_wall_ball_on_ball_falls_as_one_of_polyhedra() {
    let (kn, phi) = (5e7, 30.0);
    let implicit = Solver::Implicit(implicit::Settings::default());
    let polyhedra =
        |inset| middle(in_polyhedra(&column(9), Direction::XPlus, [kn, phi, inset], &implicit).bracket);
    let clumps = |in_hollows| {
        middle(in_clumps(&column(9), IN_PLANE, &rows(0.005, 2.0, in_hollows), [kn, phi]).bracket)
    };
    let [on_balls, in_hollows] = [false, true].map(clumps);
    let [full, inset, rigid] = [0.0, 0.005, 0.0075].map(polyhedra);
    println!("clumps {on_balls:.2} and {in_hollows:.2} deg; polyhedra {full:.2}, {inset:.2}, {rigid:.2} deg");
    // On a soft bed a ball stands for its spacing: ball on ball the width is full; in hollows it lacks a radius at either end.
    assert!(on_balls < full && on_balls > full - 0.2);
    assert!((in_hollows - inset).abs() < 0.1 && in_hollows > rigid);
}
