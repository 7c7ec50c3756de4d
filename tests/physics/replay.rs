//! The states of a wall over its load path, beside the run that they are noted of.

use pirca::generate::canonical;
use pirca::law::Coulomb;
use pirca::math::{Vec3, radians};
use pirca::model::{Level, Outcome, Replay, ReplayState, Wall};
use pirca::protocol::{
    Changes, Ends, Event, EventShares, Lateral, Protocol, Recorder, Restraint, Run, Tilting, Way, Witness,
    run, run_seen_by,
};
use pirca::solve::{Solver, explicit, implicit, limit};

use crate::fixture::{dry, irregular};

/// Height of the wall of three courses (m).
const HEIGHT: f64 = 0.125;

/// Until the first stone falls, so that there is one fall.
fn tilting() -> Protocol {
    let events = EventShares { capacity: Event::FirstStone, ..EventShares::default() };
    Protocol::Tilting(Tilting { step: radians(2.0), bracket: radians(0.1), events, ..Tilting::default() })
}

/// A pressure that the wall of three courses does not bear.
fn pushed() -> Protocol {
    Protocol::Lateral(Lateral { mean_pressure: 6000.0, base_over_top: 1.0, steps: 10, collapse_share: 0.5 })
}

fn seen(wall: &Wall, law: &Coulomb, protocol: &Protocol, solver: &Solver, most: usize) -> (Run, Replay) {
    let restraint = Restraint::at_ends(Ends::Free);
    let recorder = Recorder::new(most);
    let witness = Witness { tell: &|_| {}, recorder: Some(&recorder) };
    let way = Way { changes: &Changes::default(), witness };
    let seen = run_seen_by(wall, law, protocol, &restraint, [2, 2], way, solver);
    assert_eq!(
        format!("{seen:?}"),
        format!("{:?}", run(wall, law, protocol, &restraint, [2, 2], solver)),
        "what is looked at is the same as what is not"
    );
    (seen, recorder.replay(wall.blocks.len()))
}

fn furthest(state: &ReplayState, from: &ReplayState) -> f64 {
    let both = state.poses.iter().zip(&from.poses);
    both.map(|(now, then)| (now.shift - then.shift).norm()).fold(0.0, f64::max)
}

/// The states at rest and those of the fall.
fn parts(replay: &Replay) -> (&[ReplayState], &[ReplayState]) {
    let at = replay.states.iter().position(|state| !state.is_equilibrium).unwrap_or(replay.states.len());
    let (rest, fall) = replay.states.split_at(at);
    assert!(fall.iter().all(|state| !state.is_equilibrium), "who falls does not rest again");
    (rest, fall)
}

#[test]
fn a_replay_leads_from_rest_over_every_step_through_the_collapse() {
    let (wall, law) = (canonical::running_bond(3, 2), dry(1e8, 35.0));
    let solvers =
        [Solver::Implicit(implicit::Settings::default()), Solver::Explicit(explicit::Settings::default())];
    for (protocol, solver) in [tilting(), pushed()].iter().flat_map(|p| solvers.iter().map(move |s| (p, s))) {
        let (run, replay) = seen(&wall, &law, protocol, solver, 100);
        assert!(matches!(run.outcome, Outcome::Collapsed { .. }), "{:?}", run.outcome);
        let (rest, fall) = parts(&replay);
        // The last step of a wall that falls is the one that it did not bear.
        let borne: Vec<Level> = run.steps[..run.steps.len() - 1].iter().map(|step| step.level).collect();
        assert_eq!(rest.iter().map(|state| state.level).collect::<Vec<_>>(), borne);
        let last = rest.last().expect("it stands at first");
        for (id, pose) in last.poses.iter().enumerate() {
            assert_eq!((pose.shift, pose.turn), (run.displacements[id], run.turns[id]));
        }
        // The joints of the replay are those that were built: those that have opened wide are none to the solver any more.
        for (joint, reading) in replay.joints.iter().zip(&last.joints) {
            let Some(state) = run.joint_states.iter().find(|state| state.blocks == joint.blocks) else {
                assert!(reading.opening > 1e-4 && reading.normal_stress == 0.0, "{joint:?} {reading:?}");
                continue;
            };
            assert!((reading.opening - state.opening).abs() < 1e-6, "{reading:?} {state:?}");
            assert!((reading.slip - state.slip).abs() < 1e-6, "{reading:?} {state:?}");
            assert_eq!(reading.normal_stress, state.pressure);
            let across = state.pressure * state.area;
            let along = (state.force.norm_squared() - across * across).max(0.0).sqrt() / state.area;
            assert!((reading.shear_stress - along).abs() < 1e-6 * state.pressure.abs() + 1e-3);
        }
        // It falls to the end, further from state to state.
        let ways: Vec<f64> = fall.iter().map(|state| furthest(state, last)).collect();
        assert!(fall.len() > 10 && ways.is_sorted(), "{ways:?}");
        assert!(*ways.last().expect("it falls") > 0.29 * HEIGHT, "{ways:?}");
        assert!(fall[0].level.value() >= run.bracket.expect("bracketed")[1]);
        let parts =
            |state: &ReplayState| state.joints.iter().map(|j| j.opening.max(j.slip)).fold(0.0, f64::max);
        assert!(fall.last().map(parts) > Some(0.1 * HEIGHT), "{:?}", fall.last().map(parts));
    }
}

#[test]
fn a_replay_has_no_more_states_than_asked_for_with_the_ends_among_them() {
    let (wall, law) = (canonical::running_bond(3, 2), dry(1e8, 35.0));
    let tilting = Protocol::Tilting(Tilting { step: radians(0.25), ..Tilting::default() });
    let solver = Solver::Implicit(implicit::Settings::default());
    let (run, replay) = seen(&wall, &law, &tilting, &solver, 50);
    assert!(run.steps.len() > 100, "{}", run.steps.len());
    assert_eq!(replay.states.len(), 50);
    let (rest, _) = parts(&replay);
    assert_eq!(rest[0].level, Level::Tilt(0.0));
    let last = rest.last().expect("some rest");
    assert_eq!(Some([last.level.value(), run.steps.last().unwrap().level.value()]), run.bracket);
}

#[test]
fn a_wall_that_stands_to_the_end_has_no_fall() {
    let (wall, law) = (canonical::running_bond(3, 2), dry(1e8, 35.0));
    let short = Protocol::Tilting(Tilting { end: radians(8.0), step: radians(2.0), ..Tilting::default() });
    let (run, replay) = seen(&wall, &law, &short, &Solver::Implicit(implicit::Settings::default()), 100);
    assert_eq!(run.outcome, Outcome::Equilibrium);
    assert_eq!((replay.states.len(), parts(&replay).1.len()), (5, 0));
}

#[test]
fn parts_that_fell_before_are_gone_and_what_was_borne_until_then_stays() {
    // Walls of irregular stones lose some before they fall.
    let law = dry(2e8, 32.0);
    let events = EventShares { most: 0.9, ..EventShares::default() };
    let tilting = Tilting { step: radians(1.0), bracket: radians(0.25), events, ..Tilting::default() };
    let mut lost = 0;
    for member in 0..6 {
        let mut wall = irregular(member, 1.0, 0.7);
        wall.blocks.pop();
        let (run, replay) = seen(
            &wall,
            &law,
            &Protocol::Tilting(tilting),
            &Solver::Implicit(implicit::Settings::default()),
            100,
        );
        let (rest, _) = parts(&replay);
        let levels: Vec<f64> = rest.iter().map(|state| state.level.value()).collect();
        assert!(levels.is_sorted(), "{levels:?}");
        assert!(replay.states.windows(2).all(|pair| pair[0].gone.len() <= pair[1].gone.len()));
        let last = replay.states.last().expect("some states");
        if let (Some(first), true) = (run.events.first_stone, !last.gone.is_empty()) {
            lost += 1;
            let whole: Vec<&ReplayState> = rest.iter().filter(|state| state.gone.is_empty()).collect();
            assert!(whole.iter().all(|state| state.level.value() <= first.value()));
            for (joint, reading) in replay.joints.iter().zip(&last.joints) {
                if joint.blocks.iter().any(|id| last.gone.contains(id)) {
                    assert_eq!(reading.normal_stress, 0.0);
                }
            }
        }
    }
    assert!(lost > 0, "no wall fell in parts");
}

#[test]
fn the_replay_of_limit_analysis_is_its_mechanism_further_and_further() {
    let (wall, law) = (canonical::running_bond(3, 2), dry(1e8, 35.0));
    let (run, replay) = seen(&wall, &law, &tilting(), &Solver::Limit(limit::Settings::default()), 100);
    let Outcome::Collapsed { at } = run.outcome else { panic!("{:?}", run.outcome) };
    assert!(replay.is_mechanism);
    let (rest, fall) = parts(&replay);
    assert_eq!((rest.len(), fall.len(), rest[0].level), (1, 20, at));
    let failure = run.failure.expect("a mechanism");
    let scale = |pose: Vec3, motion: Vec3| pose.norm() / motion.norm();
    let fastest = (0..wall.blocks.len())
        .max_by(|a, b| failure.motion[*a].norm().total_cmp(&failure.motion[*b].norm()))
        .expect("blocks");
    let ratio = scale(fall[19].poses[fastest].shift, failure.motion[fastest]);
    for (id, pose) in fall[19].poses.iter().enumerate() {
        assert!((pose.shift - failure.motion[id] * ratio).norm() < 1e-6, "{id}");
    }
    // Something is pressed; nothing is lifted before it falls.
    assert!(rest[0].joints.iter().all(|joint| joint.opening == 0.0));
    assert!(rest[0].joints.iter().any(|joint| joint.normal_stress > 100.0));
}
