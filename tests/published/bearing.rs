//! `studies/bearing`: walls of the tilting table whose stones bear on few points.

use std::path::Path;

use pirca::ensemble::{Row, evaluate, plan};
use pirca::study::Study;
use pirca::verb::run::{Verdict, summarise};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/bearing");

fn study(variant: Option<&str>) -> Study {
    Study::load(Path::new(FOLDER), variant).unwrap_or_else(|faults| panic!("{faults}")).study
}

#[test]
fn blocks_that_are_alike_scatter_by_where_they_bear() {
    let study = study(None);
    let rows: Vec<Row> =
        plan(&study).into_iter().filter(|task| task.arm == 0).map(|task| evaluate(&study, task)).collect();
    let summary = summarise(&study, &rows);
    let cbl = summary.arms.iter().find(|arm| arm.arm == "cbl").expect("it was run");
    let (mean, cov) = (cbl.mean.expect("all fall"), cbl.cov.expect("they differ"));
    // The README's row, to its digits.
    assert!((mean - 14.36).abs() < 0.005 && (cov - 0.0465).abs() < 5e-5, "{mean} {cov}");
    let verdict = |words: &str| {
        &summary.published.iter().find(|p| p.claim.contains(words)).expect("it is stated").verdict
    };
    assert_eq!(*verdict("family CBL fall at"), Verdict::NotReproduced);
    assert_eq!(*verdict("family CBL has a COV"), Verdict::Reproduced);
}

#[test]
fn every_variant_is_sound() {
    let loaded = Study::load(Path::new(FOLDER), None).expect("the study is sound");
    for variant in &loaded.variants {
        let stated = study(Some(&variant.name)).arms[0].joint.bearing.expect("it is stated");
        assert!(stated.points >= 2.0 && stated.share >= 0.1, "{}: {stated:?}", variant.name);
    }
}
