//! Contact dynamics on random walls that are tilted until they fall, against limit analysis without dilatancy: the same rigid joints, another way.

use pirca::contact;
use pirca::math::{Vec3, atan, degrees, radians};
use pirca::model::{Level, Outcome};
use pirca::protocol::{Changes, Confirmation, Criterion, Direction, LoadPath, Task, drive};
use pirca::solve::limit::{self, Analysis, Flow};
use pirca::solve::{Solver, nonsmooth};

use crate::fixture::{dry, irregular};

/// The angles (deg) at which a wall falls, by contact dynamics to 0.01 deg and by limit analysis; `None` where no fall was found.
fn angles(member: u64) -> (Option<f64>, f64) {
    let (wall, law) = (irregular(member, 2.0, 1.2), dry(1e9, 35.0));
    let contact = contact::Settings::for_size(0.25, [2, 2]);
    let task = Task {
        wall: &wall,
        laws: &law,
        contact,
        loads: Vec::new(),
        ties: Vec::new(),
        platform: None,
        changes: Changes::default(),
        path: LoadPath::tilt(Direction::YPlus, radians(2.0), radians(60.0), radians(0.01)),
        piles: Vec::new(),
        criterion: Criterion::AnyBlock(0.04),
        confirmation: Confirmation::for_thickness(0.45),
    };
    let run = drive(&task, &Solver::Nonsmooth(nonsmooth::Settings::default()));
    let found = match run.outcome {
        Outcome::Collapsed { at: Level::Tilt(angle) } => Some(degrees(angle)),
        _ => None,
    };
    let settings = limit::Settings { flow: Flow::NonAssociative, ..limit::Settings::default() };
    let limit = Analysis::new(&wall, &law, contact, settings).tilt(Vec3::y(), &[]);
    (found, degrees(atan(limit.multiplier)))
}

/// Whether a wall is solved, and falls within 0.05 deg of limit analysis: the bracket, and what a wall leans by as it is tilted step by step.
fn agrees(member: u64) -> bool {
    let start = std::time::Instant::now();
    let (found, limit) = angles(member);
    let seconds = start.elapsed().as_secs_f64();
    println!("wall {member}: {found:.3?} deg, limit analysis {limit:.3}, {seconds:.1} s");
    found.is_some_and(|found| (found - limit).abs() < 0.05)
}

#[test]
fn random_walls_fall_where_limit_analysis_without_dilatancy_says() {
    // Two that are quick: most take ten times as long.
    assert!([13, 46].map(agrees).iter().all(|agrees| *agrees));
}

#[test]
#[ignore = "fifty walls: twenty minutes on one core"]
fn fifty_random_walls_are_solved_and_46_fall_where_limit_analysis_without_dilatancy_says() {
    // Several states may be in balance without dilatancy: the one that motion finds is not always that of limit analysis. Members 1, 17, 22 and 29
    // fall 0.07, 0.17, 0.49 and 1.18 deg earlier; the others within 0.022 deg. Elastic joints are no third
    // witness: by the implicit solver these four and member 0 fall 0.4 to 2 deg earlier at 1e10 and 1e11 Pa/m, as joints slip one after another.
    let agree = (0..50).filter(|member| agrees(*member)).count();
    assert!(agree >= 46, "{agree} of 50");
}
