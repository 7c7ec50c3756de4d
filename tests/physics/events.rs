//! A wall falls in parts, each at its own angle of friction; the stone that slips first is not the wall.

use pirca::law::Coulomb;
use pirca::math::{Vec3, degrees, radians, tan};
use pirca::model::{Block, JointLaws, Level, Outcome, Support, Tag, Wall};
use pirca::protocol::{Event, EventShares, Protocol, Restraint, Run, Tilting, run};
use pirca::shape::Polyhedron;
use pirca::solve::{Solver, implicit};

use crate::fixture::{dry, stone};

/// Each block has its own angle of friction against what it lies on (deg).
struct Apart([f64; 4]);

impl JointLaws for Apart {
    fn of(&self, a: u32, _b: u32) -> Coulomb {
        dry(1e9, self.0[a as usize])
    }
}

/// Flat blocks beside one another that do not touch: 0.3, 20 and 79.7 % of the weight; with the small one on a fixed wedge, whose
/// slope it cannot hold even at rest, if asked.
fn wall(small_on_a_wedge: bool) -> Wall {
    let flat = |x: f64, length: f64, z: f64| {
        Polyhedron::cuboid(Vec3::new(x, 0.0, z), Vec3::new(x + length, 1.0, z + 0.1))
    };
    let mut small = stone(flat(0.0, 0.003 * 4.0, 0.0), 2400.0);
    let mut blocks =
        vec![stone(flat(1.0, 0.2 * 4.0, 0.0), 2400.0), stone(flat(2.0, 0.797 * 4.0, 0.0), 2400.0)];
    if small_on_a_wedge {
        // 20 deg down towards y+, the stone on it by as much.
        let slope = tan(radians(20.0));
        let lift = |p: &Vec3| Vec3::new(p.x, p.y, p.z + slope * (1.0 - p.y) + 0.05);
        small.shape.vertices = small.shape.vertices.iter().map(lift).collect();
        let mut wedge = flat(0.0, 0.012, 0.0);
        for v in &mut wedge.vertices {
            v.z = if v.z > 0.0 { slope * (1.0 - v.y) + 0.05 } else { 0.0 };
        }
        // No base, which would take the platform's place.
        let fixed = Block { support: Support::Fixed, tag: Tag::End, ..Block::stone(wedge, 2400.0) };
        blocks.insert(0, small);
        blocks.push(fixed);
    } else {
        blocks.insert(0, small);
    }
    Wall { blocks }
}

fn tilted(wall: &Wall, events: EventShares) -> Run {
    let tilting = Tilting { step: radians(1.0), events, ..Tilting::default() };
    let solver = Solver::Implicit(implicit::Settings::default());
    let restraint = Restraint::at_ends(pirca::protocol::Ends::Free);
    run(wall, &Apart([5.0, 12.0, 25.0, 25.0]), &Protocol::Tilting(tilting), &restraint, [2, 2], &solver)
}

fn angle(level: Option<Level>) -> f64 {
    degrees(level.expect("it came").value())
}

#[test]
fn each_part_falls_at_its_angle_of_friction_and_the_capacity_is_the_one_asked_for() {
    let wall = wall(false);
    for (capacity, exact) in [(Event::FirstStone, 5.0), (Event::Part, 12.0), (Event::Most, 25.0)] {
        let run = tilted(&wall, EventShares { capacity, ..EventShares::default() });
        let Outcome::Collapsed { at } = run.outcome else { panic!("{:?}", run.outcome) };
        // The bracket is 0.01 deg; sliding on a closed joint has no elastic loss.
        assert!((degrees(at.value()) - exact).abs() < 0.02, "{capacity:?}: {at}");
        assert!((angle(run.events.first_stone) - 5.0).abs() < 0.02);
        assert_eq!(run.events.part.is_some(), capacity != Event::FirstStone);
        assert_eq!(run.events.most.is_some(), capacity == Event::Most);
        // Every level borne is there once, in order, and the fall at the end.
        let levels: Vec<f64> = run.steps.iter().map(|step| step.level.value()).collect();
        assert!(levels.windows(2).all(|pair| pair[0] < pair[1]), "{levels:?}");
    }
}

#[test]
fn a_stone_that_slips_at_rest_does_not_make_the_capacity_nothing() {
    let run = tilted(&wall(true), EventShares::default());
    let Outcome::Collapsed { at } = run.outcome else { panic!("{:?}", run.outcome) };
    assert!((degrees(at.value()) - 25.0).abs() < 0.02, "{at}");
    assert_eq!(run.events.first_stone, Some(Level::Tilt(0.0)));
    let strict = tilted(&wall(true), EventShares { capacity: Event::FirstStone, ..EventShares::default() });
    assert_eq!(strict.outcome, Outcome::UnstableAtRest);
}
