//! Joints that are soft until they have closed: how many steps the implicit solver takes for a wall that is tilted to its fall.

use std::path::Path;

use pirca::ensemble::{Row, Task, evaluate, plan};
use pirca::math::degrees;
use pirca::model::Outcome;
use pirca::study::Study;

/// Stiffness of the closed joint (Pa/m).
const KN: [f64; 3] = [5e7, 2e8, 1e9];
/// Initial stiffness (Pa/m) and maximum closure (m) of the hyperbola.
const INITIAL: [f64; 3] = [1e5, 1e6, 5e6];
const CLOSURE: [f64; 3] = [2e-5, 2e-4, 1e-3];

/// A wall of the tilting-table study to its fall, with linear joints or with a hyperbola (initial stiffness, closure).
fn tilted(family: &str, kn: f64, hyperbola: Option<(f64, f64)>) -> Row {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-table");
    let mut study = Study::load(&folder, None).unwrap_or_else(|faults| panic!("{faults}")).study;
    for arm in &mut study.arms {
        arm.kn_points = vec![kn];
    }
    if let Some((initial, closure)) = hyperbola {
        let parameters = [("initial_pa_per_m", initial), ("closure_m", closure)];
        let switched = study.with_mechanism("joint_closure", &parameters);
        study = switched.unwrap_or_else(|faults| panic!("{faults}")).study;
    }
    let of = |task: &Task| study.arms[task.arm as usize].name == family && task.member == 0;
    let task = plan(&study).into_iter().find(of).expect("the study has the family");
    evaluate(&study, task)
}

fn angle(row: &Row) -> f64 {
    let Outcome::Collapsed { at } = row.outcome else { panic!("{:?}", row.outcome) };
    degrees(at.value())
}

/// Steps under gravity alone.
fn under_gravity(row: &Row) -> u64 {
    row.load_steps[0].solver_steps
}

/// A soft closure of a wall of irregular stones against the linear wall: steps in all, and under gravity alone.
fn compare(family: &str, kn: f64, initial: f64, closure: f64, linear: &Row) -> [f64; 2] {
    let soft = tilted(family, kn, Some((initial, closure)));
    let of_linear = |steps: u64| steps as f64 / linear.solver_steps as f64;
    let ratios = [of_linear(soft.solver_steps), of_linear(under_gravity(&soft))];
    println!(
        "{family} kn {kn:.0e} initial {initial:.0e} closure {closure:.0e}: {} steps, {} under gravity, {:.1} and {:.1} times {}; {:.3} deg",
        soft.solver_steps,
        under_gravity(&soft),
        ratios[0],
        ratios[1],
        linear.solver_steps,
        angle(&soft)
    );
    ratios
}

#[test]
fn a_soft_closure_takes_at_most_three_times_the_steps_of_the_linear_wall() {
    // The softest and the stiffest against one another, where Newton's method used to lose the wall under its own weight.
    for (kn, initial, closure) in [(2e8, 1e5, 2e-5), (1e9, 1e5, 2e-5), (5e7, 1e5, 1e-3)] {
        let linear = tilted("sbl", kn, None);
        let [all, _] = compare("sbl", kn, initial, closure, &linear);
        assert!(all <= 3.0, "{all} times the steps of the linear wall");
    }
}

#[test]
#[ignore = "27 walls to their fall: minutes"]
fn every_soft_closure_comes_to_rest_under_gravity_in_the_steps_of_a_linear_wall_to_its_fall() {
    let mut far = Vec::new();
    for kn in KN {
        let linear = tilted("sbl", kn, None);
        for (initial, closure) in INITIAL.into_iter().flat_map(|i| CLOSURE.map(|c| (i, c))) {
            let [all, gravity] = compare("sbl", kn, initial, closure, &linear);
            assert!(gravity <= 1.5, "{gravity} times the steps of the linear wall under gravity alone");
            if all > 3.0 {
                far.push((kn, initial, closure));
            }
        }
    }
    println!("more than three times the steps: {far:?}");
}
