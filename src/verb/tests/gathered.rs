//! Rows taken one by one: the same results as from all rows at once, and no row kept that is not needed.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::figure::folder;
use super::{claim, collected, failed, standing, stood};
use crate::critic::tests::{fallen, measurement, study};
use crate::ensemble::{Mechanism, Quantity, Row};
use crate::math::radians;
use crate::model::Outcome;
use crate::study::{ClaimTest, MeasuredQuantity, Study};
use crate::verb::run::answer::files::{write_all, write_gathered};
use crate::verb::run::answer::gathered::Gathered;
use crate::verb::run::answer::summary::{describe, summarise, summary_of};

const KN: [f64; 3] = [2e7, 5e7, 1e8];

/// Walls at three stiffnesses; a few are lost or stood, and what falls rocks but for every third.
fn rows() -> Vec<Row> {
    let wall = |point: u32, member: u64| {
        let mode = if member.is_multiple_of(3) { "sliding" } else { "rocking" };
        let mechanism: Mechanism = serde_json::from_value(serde_json::json!({
            "mode": mode, "moving": 3, "weight_share": 0.5, "hinge_height_m": 0.1, "turning_share": 0.7,
            "length_share": 0.9, "place": 0.5
        }))
        .unwrap();
        let angle = 12.0 + f64::from(point) + 0.1 * ((member * 7) % 13) as f64;
        match (point, member) {
            (0, 4) | (2, 0 | 7 | 8) => Row { point, ..failed(member, Outcome::UnstableAtRest) },
            (1, 5) => Row { point, ..stood(member, 40.0) },
            _ => Row { mechanism: Some(mechanism), ..fallen(member, point, angle) },
        }
    };
    (0..3).flat_map(|point| (0..20).map(move |member| wall(point, member))).collect()
}

/// The study with a statement about how its walls fall.
fn stated() -> Study {
    let mut study = study(&KN, 20);
    let test = |mode: &str, least_share| ClaimTest::Mechanism {
        arm: "irregular".into(),
        stated: "the upper part topples".into(),
        mode: Some(serde_json::from_value(serde_json::json!(mode)).unwrap()),
        weight_share: [0.4, 0.6],
        length_share: [0.8, 1.0],
        place: [0.4, 0.6],
        least_share,
    };
    study.published.extend([claim(test("rocking", 0.5)), claim(test("sliding", 0.3))]);
    study
}

fn gathered(study: &Study, rows: &[Row]) -> Gathered {
    let mut gathered = Gathered::new(study);
    rows.iter().for_each(|row| gathered.take(row));
    gathered
}

/// All files of a folder, by name.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .map(|path| (path.file_name().unwrap().to_string_lossy().into(), fs::read(&path).unwrap()))
        .collect()
}

#[test]
fn rows_taken_one_by_one_make_the_same_files_as_all_at_once() {
    let mut study = stated();
    for measured in [false, true] {
        if measured {
            let angle = |(specimen, angle): (&str, f64)| {
                measurement(specimen, MeasuredQuantity::CollapseAngle, None, radians(angle))
            };
            study.measured.extend([("a", 13.5), ("b", 14.5), ("c", 15.0)].map(angle));
        }
        let (once, streamed) = (folder("at-once"), folder("streamed"));
        let whole = write_all(&study, &rows(), &once, None).unwrap();
        let summary = write_gathered(&study, gathered(&study, &rows()), &streamed, None).unwrap();
        assert_eq!((&summary, summary.measured.is_some()), (&whole, measured));
        let names = files(&once);
        assert!(names.len() >= 7 && names.contains_key("fragility.svg"), "{:?}", names.keys());
        assert_eq!(files(&streamed), names);
        [once, streamed].into_iter().for_each(|folder| fs::remove_dir_all(folder).unwrap());
    }
}

#[test]
fn rows_are_kept_only_where_readings_or_curves_need_them() {
    let plain = study(&KN, 20);
    assert_eq!(gathered(&plain, &rows()).end(&plain).1, []);
    let mut read = plain.clone();
    read.measured.push(measurement("a", MeasuredQuantity::CollapseAngle, None, radians(13.5)));
    assert_eq!(gathered(&read, &rows()).end(&read).1, rows());
    let sheared = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/dry-shear-walls");
    let mut sheared =
        Study::load(&sheared, Some("predict")).unwrap_or_else(|faults| panic!("{faults}")).study;
    sheared.measured.clear();
    assert_eq!(gathered(&sheared, &rows()[..5]).end(&sheared).1.len(), 5);
}

#[test]
fn walls_are_planned_by_the_number_that_an_arm_came_to() {
    let mut study = study(&KN[..1], 100);
    let rows: Vec<Row> = (0..20).map(|member| fallen(member, 0, 12.0 + 0.1 * member as f64)).collect();
    let gathered = gathered(&study, &rows);
    study.arms[0].members = 20;
    let (populations, kept) = gathered.end(&study);
    let summary = summary_of(&study, populations, &kept);
    assert_eq!((summary.arms[0].members, &summary.arms[0].note), (20, &None));
    assert_eq!(summary, summarise(&study, &rows));
}

#[test]
fn very_many_walls_have_every_interval_but_the_bootstraps() {
    let values = |count: u64| (0..count).map(|member| standing(member, 1e-3 + 1e-9 * member as f64));
    let of = |count| {
        let rows: Vec<Row> = values(count).collect();
        let own = collected(("irregular", false), (KN[0], count), Quantity::TopDisplacement, &rows);
        describe(own, 1, BTreeMap::new())
    };
    let many = of(200_001);
    assert_eq!((many.in_mean, many.sigma_bootstrap_ci, many.cov_bootstrap_ci), (200_001, None, None));
    assert!(many.sigma_ci.is_some() && many.cov_ci.is_some() && many.quantiles[0].ci.is_some());
    assert!(of(200).sigma_bootstrap_ci.is_some());
}
