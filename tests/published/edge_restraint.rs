//! `studies/edge-restraint`: drift against length over height.

use std::path::Path;

use pirca::ensemble::{Task, evaluate};
use pirca::study::Study;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/edge-restraint");

/// Drift (mm/m) of the regular walls, 1 to 6 times as long as high.
fn drifts(variant: Option<&str>) -> Vec<f64> {
    let study = Study::load(Path::new(FOLDER), variant).unwrap_or_else(|faults| panic!("{faults}")).study;
    let arms = 0..study.arms.iter().filter(|arm| arm.members == 1).count() as u32;
    let drift =
        |arm| evaluate(&study, Task { arm, point: 0, member: 0 }).top_displacement_m().expect("it stands");
    arms.map(drift).map(|metres| 1e3 * metres).collect()
}

#[test]
fn the_restraint_fades_smoothly_and_still_holds_at_four() {
    let (held, free) = (drifts(None), drifts(Some("free-ends")));
    let shares: Vec<f64> = held.iter().zip(&free).map(|(h, f)| h / f).collect();
    println!("{shares:.3?}");
    assert!(shares.windows(2).all(|pair| pair[0] < pair[1]) && shares[5] < 1.0, "{shares:?}");
    // The README's row; a hundredth for its rounding.
    for (share, stated) in shares.iter().zip([0.09, 0.39, 0.69, 0.85, 0.93, 0.97]) {
        assert!((share - stated).abs() < 0.01, "{shares:?}");
    }
    // Free walls do not know how long they are; the last stone of a course is where they differ.
    assert!(free.iter().all(|drift| (drift / free[0] - 1.0).abs() < 0.01), "{free:?}");
}
