//! `studies/dry-shear-walls`: walls sheared in their plane.

use std::fs;
use std::path::Path;

use pirca::critic::{Ours, compare};
use pirca::ensemble::{Row, evaluate, plan};
use pirca::math::ln;
use pirca::model::Outcome;
use pirca::protocol::ShearMode;
use pirca::study::Study;
use pirca::verb::run::write_all;

fn study(variant: Option<&str>) -> Study {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/dry-shear-walls");
    Study::load(&folder, variant).unwrap_or_else(|faults| panic!("{faults}")).study
}

/// The base with some of its arms alone.
fn of_arms(mut study: Study, arms: &[&str]) -> Study {
    study.arms.retain(|arm| arms.contains(&arm.name.as_str()));
    study
}

fn rows(study: &Study) -> Vec<Row> {
    plan(study).into_iter().map(|task| evaluate(study, task)).collect()
}

/// Differences from the readings of a family over their standard deviations, at one stiffness.
fn differences(study: &Study, rows: &[Row], family: &str, kn: f64) -> Vec<f64> {
    let lines = compare(study, rows).into_iter().filter(|line| line.family == family);
    let of = |ours| match ours {
        Ours::Walls(walls) if walls.kn == kn => walls.difference.map(|difference| difference.in_sd()),
        _ => None,
    };
    lines.filter_map(|line| of(line.ours)).collect()
}

#[test]
#[ignore = "slow: 20 s of processor time"]
fn one_stiffness_fits_the_wall_that_it_was_read_off_and_not_those_under_more_load() {
    let base = of_arms(study(None), &["ws-100"]);
    let of_base = rows(&base);
    let square = |kn| differences(&base, &of_base, "ws-100", kn).iter().map(|z| z * z).sum::<f64>();
    // Eight readings.
    assert!(square(7e9) < 8.0 && square(5e9) > 25.0 && square(1e10) > 25.0, "{}", square(7e9));
    for row in &of_base {
        let shear = row.reading.shear.expect("it was sheared");
        assert_eq!((&row.outcome, shear.mode), (&Outcome::Equilibrium, Some(ShearMode::Rocking)));
    }
    let out = std::env::temp_dir().join(format!("pirca-force-drift-{}", std::process::id()));
    fs::create_dir_all(&out).expect("a folder for the report");
    write_all(&base, &of_base, &out, None).expect("it is written");
    let table = fs::read_to_string(out.join("force-drift.csv")).expect("walls are sheared");
    fs::remove_dir_all(&out).expect("it was ours");
    // A line for each arm, stiffness and drift.
    assert_eq!(table.lines().count(), 1 + base.arms.len() * 3 * 200);
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let names = cells(table.lines().next().expect("a header"));
    let last = cells(table.lines().last().expect("the last drift"));
    let at = |name: &str| last[names.iter().position(|own| own == name).expect("a column")].clone();
    assert_eq!([at("drift_percent"), at("walls"), at("fallen"), at("force_n_5")], ["2", "1", "0", ""]);
    let force: f64 = at("force_n_mean").parse().expect("a number");
    assert!((3e4..4e4).contains(&force), "{last:?}");
    // Some of the walls, to save time: the mean of three stands for that of all.
    let mut others = of_arms(study(Some("predict")), &["ws-175"]);
    others.arms[0].members = 3;
    let of_others = rows(&others);
    assert!(of_others[0].reading.shear != of_others[1].reading.shear);
    let off = differences(&others, &of_others, "ws-175", 7e9);
    // The joints under the larger load are stiffer: the readings lie above what is predicted.
    assert!(off.len() == 8 && off.iter().all(|z| *z < -0.5), "{off:?}");
}

#[test]
fn rigid_blocks_bear_more_than_any_wall_of_joints_does() {
    let study = study(Some("rigid"));
    for (row, stated) in rows(&study).iter().zip([39.4e3, 67.7e3]) {
        let capacity = row.reading.shear.and_then(|shear| shear.capacity_n).expect("it falls");
        assert!((capacity / stated - 1.0).abs() < 2e-3, "{capacity} against {stated}");
        let limit = row.limit.and_then(|limit| limit.multiplier).expect("it is limit analysis");
        assert!((0.3..0.5).contains(&limit), "{limit}");
    }
}

/// Push over drift (kN, %) at a third of the largest push, by straight lines from the unloaded wall on.
fn secant(curve: &[(f64, f64)]) -> f64 {
    let third = curve.iter().map(|(_, force)| *force).fold(0.0, f64::max) / 3.0;
    let whole: Vec<(f64, f64)> = std::iter::once((0.0, 0.0)).chain(curve.iter().copied()).collect();
    let two = whole.windows(2).find(|two| two[1].1 >= third).expect("it is reached");
    let [(from, below), (to, above)] = [two[0], two[1]];
    third / (from + (to - from) * (third - below) / (above - below))
}

/// Exponent of the vertical load in the secant, from the means of the logarithms under either load, and its standard error.
fn exponent(light: &[f64], heavy: &[f64]) -> (f64, f64) {
    let logs = |secants: &[f64]| secants.iter().map(|secant| ln(*secant)).collect::<Vec<f64>>();
    let (light, heavy) = (logs(light), logs(heavy));
    let per_log = 1.0 / ln(176.7 / 101.7);
    let mean = |logs: &[f64]| pirca::stats::mean(logs).expect("some");
    let variance =
        |logs: &[f64]| pirca::stats::sigma(logs).map_or(0.0, |sigma| sigma * sigma / logs.len() as f64);
    (per_log * (mean(&heavy) - mean(&light)), per_log * (variance(&light) + variance(&heavy)).sqrt())
}

#[test]
fn walls_are_the_stiffer_the_more_they_bear_and_constant_joints_do_not_make_them_so() {
    let all = study(None);
    let mut curves: std::collections::BTreeMap<(String, String), Vec<(f64, f64)>> = Default::default();
    for m in &all.measured {
        let drift = m.drift.expect("it was sheared");
        let own = curves.entry((m.family.clone(), m.specimen.clone())).or_default();
        own.push((100.0 * drift, 1e-3 * m.value));
    }
    let under = |load: &str| -> Vec<f64> {
        curves
            .iter()
            .filter(|((family, _), _)| family.starts_with(load))
            .map(|(_, own)| secant(own))
            .collect()
    };
    let (measured, error) = exponent(&under("ws-100"), &under("ws-175"));
    assert!((measured - 0.87).abs() < 0.01 && (error - 0.19).abs() < 0.01, "{measured} +- {error}");
    let mut base = of_arms(all, &["ws-100", "ws-175"]);
    base.arms.iter_mut().for_each(|arm| arm.kn_points = vec![7e9]);
    let ours: Vec<f64> = rows(&base)
        .iter()
        .map(|row| {
            let steps = row.pushes();
            secant(&steps.map(|(drift, force)| (drift, 1e-3 * force)).collect::<Vec<_>>())
        })
        .collect();
    let (base, _) = exponent(&ours[..1], &ours[1..]);
    assert!(base.abs() < 0.03, "{base}");
}
