//! Limit analysis as a study's solver: a tilting table and a lateral load, in the words of the other solvers.

use pirca::generate::canonical;
use pirca::math::{atan, degrees, radians};
use pirca::model::{Level, Outcome};
use pirca::protocol::{Bounds, Ends, FailureMode, Lateral, Protocol, Restraint, Run, Tilting, run};
use pirca::solve::Solver;
use pirca::solve::limit::{Flow, Settings};

use crate::fixture::dry;

fn by_limit(protocol: &Protocol, phi: f64, flow: Flow) -> Run {
    let solver = Solver::Limit(Settings { flow, ..Settings::default() });
    let restraint = Restraint::at_ends(Ends::Free);
    run(&canonical::wall_72(), &dry(1e9, phi), protocol, &restraint, [2, 2], &solver)
}

#[test]
fn a_tilting_table_ends_at_the_angle_of_collapse_with_its_mechanism() {
    for flow in [Flow::Associative, Flow::NonAssociative] {
        let fell = by_limit(&Protocol::Tilting(Tilting::default()), 40.0, flow);
        let Outcome::Collapsed { at: Level::Tilt(angle) } = fell.outcome else {
            panic!("{:?}", fell.outcome)
        };
        // The search without dilatancy is accurate to 1e-5 of the multiplier.
        assert!((degrees(angle) - degrees(atan(0.114 / 0.375))).abs() < 5e-4, "{flow:?}: {}", degrees(angle));
        assert_eq!(fell.bracket, Some([angle, angle]));
        assert_eq!((fell.steps.len(), fell.joints), (3, 128));
        assert!(fell.steps.iter().all(|step| step.top_displacement.is_nan() && step.points.is_none()));
        let failure = fell.failure.expect("it falls in some way");
        assert_eq!((failure.mode, failure.moving.len()), (FailureMode::Rocking, 72));
        assert!(failure.hinge_height.abs() < 1e-9 && (failure.weight_share - 1.0).abs() < 1e-9);
        assert_eq!(fell.displacements.len(), 72);
    }
    // It slides first where friction is less than that.
    let slid = by_limit(&Protocol::Tilting(Tilting::default()), 12.0, Flow::Associative);
    let Outcome::Collapsed { at } = slid.outcome else { panic!("{:?}", slid.outcome) };
    assert!((degrees(at.value()) - 12.0).abs() < 1e-5);
    // Dilating as it slides: along the joints and away from them, and no turn.
    assert_eq!(slid.failure.expect("it slides").mode, FailureMode::Sliding);
}

#[test]
fn a_table_that_does_not_go_far_enough_leaves_the_wall_standing() {
    let tilting = Tilting { end: radians(10.0), ..Tilting::default() };
    let stood = by_limit(&Protocol::Tilting(tilting), 40.0, Flow::Associative);
    assert_eq!((&stood.outcome, stood.bracket), (&Outcome::Equilibrium, None));
    let last = stood.steps.last().expect("two steps").level;
    assert!(matches!(last, Level::Tilt(tilt) if (degrees(tilt) - 10.0).abs() < 1e-12), "{last:?}");
    assert!(stood.failure.is_none());
}

#[test]
fn a_lateral_load_is_borne_to_the_factor_of_collapse() {
    let restraint = Restraint::at_ends(Ends::Free);
    let (wall, law) = (canonical::wall_72(), dry(1e9, 40.0));
    let of = |mean_pressure| {
        Protocol::Lateral(Lateral { mean_pressure, base_over_top: 1.0, steps: 1, collapse_share: 0.5 })
    };
    // A uniform pressure p on a height h topples a wall of weight W and thickness b over its length l at p l h^2 / 2 = W b / 2.
    let weight = 2100.0 * 0.114 * 0.375 * (1.5 - 0.007) * pirca::solve::STANDARD_GRAVITY;
    let toppling = weight * 0.114 / ((1.5 - 0.007) * 0.375 * 0.375);
    for (pressure, stands) in [(0.8 * toppling, true), (1.25 * toppling, false)] {
        let run = by_limit(&of(pressure), 40.0, Flow::Associative);
        let bound = Bounds::of(&wall, &law, &of(pressure), &restraint, [2, 2]).associative.expect("found");
        // The slots of 1 mm do not reach to the top of the stones beside them.
        assert!((bound * pressure / toppling - 1.0).abs() < 1e-6, "{}", bound * pressure / toppling);
        let last = run.steps.last().expect("steps").level;
        assert!(matches!(last, Level::Factor(factor) if (factor - bound).abs() < 1e-9), "{last:?} {bound}");
        assert_eq!(run.outcome == Outcome::Equilibrium, stands, "{:?}", run.outcome);
        assert_eq!(run.failure.is_some(), !stands);
    }
}
