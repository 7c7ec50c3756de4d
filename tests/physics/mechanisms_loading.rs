//! Mechanisms of the surroundings and of the way against closed forms: a lean, a platform on springs, creep, lost wedges.

use pirca::contact;
use pirca::law::Coulomb;
use pirca::math::{Vec3, atan, cos, degrees, radians, sin};
use pirca::model::{Level, Outcome, Tag, Wall};
use pirca::protocol::{
    Base, Bounds, Changes, Compliance, Creep, Direction, Ends, Loss, Protocol, Restraint, Run, Tilting, run,
    run_changing,
};
use pirca::shape::Polyhedron;
use pirca::solve::explicit::{self, Simulation};
use pirca::solve::implicit::{self, Equilibrium};
use pirca::solve::{Assembly, Equilibrate, Mount, Solver, Status};

use crate::fixture::{AREA, SIZE, WEIGHT, dry, on_floor, resting, solvers, stone, tilted};

fn free(base: Base) -> Restraint {
    Restraint { base, ends: Ends::Free }
}

fn tilting(step_deg: f64, end_deg: f64) -> Protocol {
    let (step, end, bracket) = (radians(step_deg), radians(end_deg), radians(0.01));
    Protocol::Tilting(Tilting { step, end, bracket, collapse_share: 0.05, ..Tilting::default() })
}

#[test]
fn a_wall_that_leans_topples_earlier_by_its_lean() {
    let (b, h) = (0.2, 0.5);
    let wall = Wall { blocks: vec![resting([0.3, b, h], 2400.0)] };
    let law = dry(1e9, 60.0);
    for (lean, towards, sign) in
        [(2.0, Direction::YPlus, 1.0), (2.0, Direction::YMinus, -1.0), (-3.0, Direction::YPlus, 1.0)]
    {
        // The centroid has moved by h/2 tan(lean) towards the toe.
        let slope = pirca::math::tan(radians(lean));
        let protocol = Protocol::Tilting(Tilting { towards, ..Tilting::default() });
        let bounds =
            Bounds::of(&wall.clone().leaning(slope), &law, &protocol, &free(Base::default()), [2, 2]);
        let (found, exact) = (bounds.associative.map(degrees), degrees(atan(b / h - sign * slope)));
        println!("{lean} {towards:?}: {found:?} against {exact}");
        assert!((found.expect("it falls") - exact).abs() < 1e-5);
    }
}

#[test]
fn a_platform_on_springs_settles_and_turns_under_a_stiff_block() {
    let (settlement, rotation) = (1e6, 5e4);
    let law = dry(1e11, 60.0);
    let wall = on_floor(vec![resting(SIZE, 2400.0)]);
    let mut assembly = Assembly::new(&wall, &law, contact::Settings::for_size(0.2, [2, 2]));
    assembly.mount(Mount { body: 1, settlement, rotation }, &[]);
    fn rest<'a>(mut solver: impl Equilibrate<'a>) -> [Vec3; 2] {
        for load in [tilted(0.0), tilted(5.0)] {
            solver.set_loads(load, 1.0);
            assert_eq!(solver.settle(&mut |_| false).status, Status::Equilibrium);
        }
        [0, 1].map(|body| solver.assembly().bodies.all[body].position)
    }
    let slow = explicit::Settings { unbalanced_ratio: 1e-8, ..explicit::Settings::default() };
    for [block, platform] in [
        rest(Equilibrium::of(assembly.clone(), implicit::Settings::default())),
        rest(Simulation::of(assembly, slow)),
    ] {
        // The block's weight acts 0.15 m above the platform's middle; the platform's own does not act.
        let (across, down) = (WEIGHT * sin(radians(5.0)), WEIGHT * cos(radians(5.0)));
        let sunk = -0.05 - platform.z;
        assert!((sunk * settlement / down - 1.0).abs() < 1e-6, "{sunk:e}");
        // The weight leans over the middle as the platform turns: k t = W (sin a + cos a t) z.
        let turn = across * 0.15 / (rotation - down * 0.15);
        let found = block.y / 0.15;
        println!("turns by {found:e} against {turn:e}, sinks by {sunk:e}");
        // The joint turns as well, 3e-4 as much.
        assert!((found / turn - 1.0).abs() < 1e-3, "{found:e} against {turn:e}");
        assert_eq!(platform.y, 0.0);
    }
}

#[test]
fn a_platform_on_stiff_springs_is_a_fixed_one_and_takes_its_strip_along() {
    let wall = Wall { blocks: vec![resting(SIZE, 2400.0)] };
    let law = dry(1e8, 20.0);
    let points = |compliance, solver: &Solver| {
        let base = Base { strip_height: Some(0.03), compliance, ..Base::default() };
        let run = run(&wall, &law, &tilting(0.5, 25.0), &free(base), [2, 2], solver);
        assert_eq!(run.outcome, Outcome::Equilibrium);
        run.steps.last().and_then(|step| step.points).expect("it has a top")[1]
    };
    for solver in &solvers() {
        let stiff = Compliance { settlement: 1e10, rotation: 1e10 };
        let (fixed, stiff) = (points(None, solver), points(Some(stiff), solver));
        println!("{fixed:e} {stiff:e}");
        // The springs turn by 3e-9 rad under the block, and its top moves by 1e-9 m of 1e-4. In time it slides onto the strip
        // and bounces: where it comes to rest depends on the last place of its path, by some thousandths in steps as small as
        // these; in a step of 5 deg the bounce is anything that friction can hold.
        let allowed = if matches!(solver, Solver::Implicit(_)) { 1e-4 } else { 1e-2 };
        assert!((fixed - stiff).abs() < allowed * fixed, "{fixed:e} {stiff:e}");
        // Tilted beyond its friction the block leans on the strip. It turns with the platform and the strip as one: were the
        // strip left behind, the block would rub down on it.
        let kr = 1e5;
        let soft = points(Some(Compliance { settlement: 1e6, rotation: kr }), solver);
        let (across, down) = (WEIGHT * sin(radians(25.0)), WEIGHT * cos(radians(25.0)));
        let rigid = across * 0.15 / (kr - down * 0.15) * 0.25;
        println!("{} {soft:e} {rigid:e}", solver.name());
        assert!(((soft - fixed) / rigid - 1.0).abs() < 1e-2, "{soft:e} {rigid:e}");
    }
}

/// Displacement (m) of the block's top centre at every stop of a tilting table.
fn stops(law: &Coulomb, protocol: &Protocol, creep: Option<Creep>, solver: &Solver) -> Vec<f64> {
    let wall = Wall { blocks: vec![resting(SIZE, 2400.0)] };
    let changes = Changes { creep, ..Changes::default() };
    let run = run_changing(&wall, law, protocol, &free(Base::default()), [2, 2], &changes, solver);
    assert_eq!(run.outcome, Outcome::Equilibrium);
    run.steps.iter().map(|step| step.points.expect("it has a top")[1]).collect()
}

#[test]
fn a_block_that_sticks_creeps_as_the_platform_turns() {
    // ks du = d tau + r tau da with tau = W sin a / A: by creep the block has gone W r (1 - cos a) / (A ks) further.
    let (law, rate, end) = (dry(1e8, 60.0), 2.0, 12.0);
    let creep = Creep { rate, hold_share: 0.0, hold_every: radians(5.0) };
    let exact = WEIGHT * rate * (1.0 - cos(radians(end))) / (AREA * law.ks);
    for solver in &solvers() {
        let error = |step: f64| {
            let last = |creep| *stops(&law, &tilting(step, end), creep, solver).last().expect("it stops");
            (last(Some(creep)) - last(None)) / exact - 1.0
        };
        let (coarse, fine) = (error(2.0), error(1.0));
        println!("{} creep: {coarse:.4} {fine:.4} of {exact:e}", solver.name());
        // Of the first order in the step: from rest to rest the traction of the start relaxes, 1 / n of the way too little.
        assert!(coarse < 0.0 && coarse > -0.2, "{coarse}");
        assert!((fine / coarse - 0.5).abs() < 0.05, "{fine} of {coarse}");
    }
}

#[test]
fn a_hold_at_a_reading_stop_takes_its_share_whatever_the_steps() {
    // Held at 5 and 10 deg: tau / ks times the share is gone from the next stop on.
    let (law, share) = (dry(1e8, 60.0), 0.1);
    let creep = Creep { rate: 0.0, hold_share: share, hold_every: radians(5.0) };
    let shear = |a: f64| share * WEIGHT * sin(radians(a)) / (AREA * law.ks);
    for solver in &solvers() {
        for step in [0.5, 2.5] {
            let protocol = tilting(step, 12.5);
            let (with, without) =
                (stops(&law, &protocol, Some(creep), solver), stops(&law, &protocol, None, solver));
            for (k, (a, b)) in with.iter().zip(&without).enumerate() {
                let tilt = step * k as f64;
                let holds = if tilt > 10.0 {
                    shear(5.0) + shear(10.0)
                } else if tilt > 5.0 {
                    shear(5.0)
                } else {
                    0.0
                };
                // Displacements of 1e-5 m to the solvers' 1e-9.
                assert!((a - b - holds).abs() < 1e-9 * 10.0, "{tilt}: {:e} against {holds:e}", a - b);
            }
        }
    }
}

/// A block on two legs, the downhill one a wedge stone, 0.1 m wide and high enough for it to fall far.
fn on_legs() -> Wall {
    let leg = |from: f64, to: f64| Polyhedron::cuboid(Vec3::new(0.0, from, 0.0), Vec3::new(0.3, to, 0.3));
    let mut wedge = stone(leg(0.1, 0.2), 2400.0);
    wedge.tag = Tag::Wedge;
    let on_top = Polyhedron::cuboid(Vec3::new(0.0, -0.2, 0.3), Vec3::new(0.3, 0.2, 0.5));
    Wall { blocks: vec![stone(leg(-0.2, -0.1), 2400.0), wedge, stone(on_top, 2400.0)] }
}

#[test]
fn a_block_falls_when_the_leg_under_it_is_lost() {
    let law = dry(1e9, 40.0);
    let tilt = |loss, solver: &Solver| -> Run {
        let changes = Changes { loss, ..Changes::default() };
        run_changing(&on_legs(), &law, &tilting(1.0, 8.0), &free(Base::default()), [2, 2], &changes, solver)
    };
    for solver in &solvers() {
        assert_eq!(tilt(None, solver).outcome, Outcome::Equilibrium);
        let lost = |blocks, beyond_deg| Some(Loss { blocks, beyond: radians(beyond_deg) });
        let fell = tilt(lost(vec![1], 3.3), solver);
        let Outcome::Collapsed { at: Level::Tilt(at) } = fell.outcome else { panic!("{:?}", fell.outcome) };
        // Bracketed to 0.01 deg.
        println!("{} fell at {}", solver.name(), degrees(at));
        assert!(degrees(at) <= 3.3 + 1e-9 && degrees(at) > 3.28, "{}", degrees(at));
        assert!(fell.failure.expect("it was watched").moving.contains(&2));
        // None of them, or all of them after the end: nothing happens.
        for nothing in [lost(Vec::new(), 3.3), lost(vec![1], 8.0)] {
            assert_eq!(tilt(nothing, solver).steps, tilt(None, solver).steps);
        }
    }
}
