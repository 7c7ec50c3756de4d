//! Curves of walls whose formula is known.

use super::*;
use crate::ensemble::{ShearStep, StepRow};

/// The widest drift.
const WIDEST: f64 = 0.02;

/// What a wall bears at a drift (N): in proportion at first, 60 kN in the end.
fn push(drift: f64) -> f64 {
    1.0 / (1.0 / (2.5e7 * drift) + 1.0 / 6e4)
}

/// The wall pushed to a drift (%) in steps of 0.01 %; it falls there, or has come to the end.
fn row(to: f64, outcome: Outcome) -> Row {
    let step = |k: u32| {
        let drift = 0.01 * f64::from(k);
        let nothing = crate::critic::tests::fallen(0, 0, 5.0).load_steps[0].clone();
        let jack = ShearStep { drift_percent: Some(drift), force_n: Some(push(0.01 * drift)) };
        StepRow { tilt_deg: None, jack, ..nothing }
    };
    let steps = (to / 0.01).round() as u32;
    Row { load_steps: (0..=steps).map(step).collect(), outcome, ..crate::critic::tests::fallen(0, 0, 5.0) }
}

#[test]
fn nine_places_tell_what_a_wall_bears_at_every_drift() {
    let path = Path::pushed(&row(2.0, Outcome::Equilibrium), WIDEST).expect("it was pushed");
    assert!(path.numbers[PUSHED..].iter().all(|number| *number == 0.0));
    let pushes = Pushes::of(&path.adding(), WIDEST);
    for drift in [2.5e-4, 3.5e-4, 5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 1.5e-2, 2e-2] {
        let shown = pushes.at(drift).expect("it stands");
        assert!((shown / push(drift) - 1.0).abs() < 0.004, "{drift}: {shown}");
    }
    // In proportion before the first place.
    assert!((pushes.last_at(1e-4) / pushes.last_at(2.5e-4) - 0.4).abs() < 1e-12);
}

#[test]
fn a_wall_that_fell_bears_nothing_beyond_and_one_that_never_stood_has_no_path() {
    let fell = row(1.0, Outcome::Collapsed { at: Level::Drift(0.01) });
    let path = Path::pushed(&fell, WIDEST).expect("it was pushed");
    let pushes = Pushes::of(&path.adding(), WIDEST);
    assert!(pushes.at(9.9e-3).is_some() && pushes.at(1.01e-2).is_none());
    assert!((pushes.last_at(0.02) / push(0.01) - 1.0).abs() < 0.01);
    assert_eq!(Path::pushed(&row(2.0, Outcome::UnstableAtRest), WIDEST), None);
    let lost = Outcome::NotConverged { at: Level::Drift(0.01), unbalanced_ratio: 1.0, why: String::new() };
    assert_eq!(Path::pushed(&row(1.0, lost), WIDEST), None);
}
