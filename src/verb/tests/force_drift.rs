//! The push over the drift: which walls are in the numbers, and what is said of one more.

use std::path::Path;

use super::failed;
use crate::ensemble::{Row, ShearStep, StepRow};
use crate::model::{Level, Outcome};
use crate::study::Study;
use crate::verb::run::answer::force_drift::{force_curves, force_drift, force_drift_csv};

/// A wall that bears this at every drift (%), and was pushed so far; it falls there, or ends as it is said.
fn pushed(member: u64, force: f64, to: f64, outcome: Outcome) -> Row {
    let at = |drift: f64, force: f64| {
        let jack = ShearStep { drift_percent: Some(drift), force_n: Some(force) };
        StepRow { jack, solver_steps: 1, ..StepRow::default() }
    };
    let load_steps = vec![at(0.0, 0.0), at(0.005, force), at(to, force)];
    Row { arm: "ws-175".into(), kn_pa_per_m: 7e9, load_steps, ..failed(member, outcome) }
}

fn study() -> Study {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/dry-shear-walls");
    let mut study = Study::load(&folder, Some("predict")).unwrap_or_else(|faults| panic!("{faults}")).study;
    study.arms.retain(|arm| arm.name == "ws-175");
    study
}

#[test]
fn a_wall_that_fell_earlier_is_counted_and_in_no_mean() {
    let fell = || Outcome::Collapsed { at: Level::Drift(0.01) };
    let lost = Outcome::NonFinite { at: Level::Drift(0.0) };
    let mut rows: Vec<Row> = (0..19).map(|k| pushed(k, 1e4 + k as f64, 2.0, Outcome::Equilibrium)).collect();
    rows.push(pushed(19, 9e4, 1.0, fell()));
    rows.push(pushed(20, 9e4, 0.01, lost));
    let curves = force_curves(&study(), &rows);
    let points = &curves[0].points;
    assert_eq!((curves.len(), points.len(), points[79].drift_percent), (1, 80, 2.0));
    // At 1 % the one that falls there still stands; at the next step it does not.
    let counts = |k: usize| (points[k].walls, points[k].fallen, points[k].lost);
    assert_eq!((counts(39), counts(40), counts(79)), ((20, 0, 1), (19, 1, 1), (19, 1, 1)));
    assert_eq!(points[40].mean.value, Some(10_009.0));
    assert!(points[39].mean.value.expect("they stand") > 13_000.0);
    // One more wall is as likely to be the lowest of twenty as each of these nineteen.
    assert_eq!((points[40].low.value, points[40].high.value), (Some(10_000.0), Some(10_018.0)));
    assert_eq!(points[40].low.interval, None);
    let few = force_curves(&study(), &rows[..3]);
    assert_eq!((few[0].points[40].mean.value, few[0].points[40].low.value), (Some(10_001.0), None));
    let gone = force_curves(&study(), &rows[19..20]);
    assert_eq!((gone[0].points[40].mean.value, gone[0].points[40].fallen), (None, 1));
    let text = force_drift_csv(&gone);
    assert!(text.ends_with("ws-175,7000000000,2,0,1,0,,,,,,,,,\n") && !text.contains("NaN"), "{text}");
}

#[test]
fn the_figure_shows_band_mean_and_readings() {
    let study = study();
    let rows: Vec<Row> = (0..19).map(|k| pushed(k, 1e4 + k as f64, 2.0, Outcome::Equilibrium)).collect();
    let curves = force_curves(&study, &rows);
    let drawn = force_drift("hand-made", &curves, &study.measured).unwrap().svg().unwrap();
    for text in ["drift (%)", "push (kN)", "19 walls, band: 5 to 95 %; marks: measured"] {
        assert!(drawn.contains(text), "{text}");
    }
    assert!(drawn.contains("<polygon"));
    let limit = force_curves(&study, &[failed(0, Outcome::Equilibrium)]);
    assert_eq!(limit, []);
}
