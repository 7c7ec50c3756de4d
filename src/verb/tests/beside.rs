//! An earlier run beside a new one.

use std::fs;

use super::figure::folder;
use super::{fixed_arm, random_arm, summary_of, three_arms};
use crate::ensemble::Quantity;
use crate::verb::run::answer::beside::{Earlier, Mean};
use crate::verb::run::answer::figure::curves;
use crate::verb::run::answer::files::{SUMMARY_JSON, write_summary};
use crate::verb::run::answer::plot::over_kn;

const LABEL: &str = "variant two-wythes, implicit solver";

fn earlier(arms: &[(&str, &[[f64; 2]])]) -> Earlier {
    let means = |means: &[[f64; 2]]| means.iter().map(|&[kn, shown]| Mean { kn, shown }).collect();
    let arms = arms.iter().map(|(arm, values)| (arm.to_string(), means(values))).collect();
    Earlier { label: LABEL.to_owned(), arms }
}

/// The figure of two arms, 1 mm and 2 mm at one kn.
fn drawn(beside: &Earlier) -> String {
    let summary = summary_of(&[fixed_arm("stack", &[1e-3]), random_arm("rubble", &[2e-3])].concat(), &[]);
    assert!(over_kn("hand-made", &curves(&summary), None).is_none(), "one point alone is no figure");
    over_kn("hand-made", &curves(&summary), Some(beside)).unwrap().svg().unwrap()
}

#[test]
fn the_summary_of_an_earlier_run_is_read_back_in_the_unit_of_the_figure() {
    let dir = folder("earlier");
    let mut populations = three_arms();
    populations[1].values = Default::default();
    let summary = summary_of(&populations, &[]);
    write_summary(&summary, &dir, None).unwrap();
    let read = Earlier::read(&dir, "hand-made", Quantity::TopDisplacement).unwrap();
    assert_eq!(read.label, LABEL);
    let names: Vec<&str> = read.arms.iter().map(|(arm, _)| arm.as_str()).collect();
    assert_eq!(names, ["continuous", "discontinuous", "irregular"]);
    assert_eq!(read.arms[0].1.len(), 2, "a kn without a mean is left out");
    for (entry, mean) in summary.arms[6..].iter().zip(&read.arms[2].1) {
        assert_eq!(
            (entry.kn_pa_per_m, entry.mean.map(|x| x * 1e3)),
            (mean.kn, Some(mean.shown)),
            "bit for bit"
        );
    }
    fs::remove_dir_all(dir).unwrap();
}

#[test]
fn a_folder_that_is_no_such_run_is_refused_with_the_reason() {
    let dir = folder("refused");
    let told = |study: &str, quantity: Quantity| {
        format!("{:#}", Earlier::read(&dir, study, quantity).expect_err("it is refused"))
    };
    assert!(
        told("hand-made", Quantity::TopDisplacement).contains("give the output folder of an earlier run")
    );
    write_summary(&summary_of(&three_arms(), &[]), &dir, None).unwrap();
    let other = told("tilting-block", Quantity::TopDisplacement);
    assert!(other.contains("of the study hand-made; only runs of tilting-block"), "{other}");
    let angle = told("hand-made", Quantity::CollapseAngle);
    assert!(
        angle.contains("about the top_displacement; the study now asks for the collapse_angle"),
        "{angle}"
    );
    write_summary(&summary_of(&[], &[]), &dir, None).unwrap();
    assert!(told("hand-made", Quantity::TopDisplacement).contains("none of its arms has a mean"));
    fs::write(dir.join(SUMMARY_JSON), "{\"study\": 3}").unwrap();
    assert!(told("hand-made", Quantity::TopDisplacement).contains("is no summary"));
    fs::remove_dir_all(dir).unwrap();
}

#[test]
fn its_means_are_hollow_markers_with_legend_entries_of_their_own() {
    let plain = drawn(&earlier(&[]));
    let both = drawn(&earlier(&[("stack", &[[7.5e7, 1.0]]), ("rubble", &[[7.5e7, 2.0], [7.5e7, 1.9]])]));
    for arm in ["stack", "rubble"] {
        assert!(both.contains(&format!("{arm}: mean of an earlier run ({LABEL})")), "{arm}");
    }
    // One outline per mean and one per legend entry: a square has four edges, a triangle three, each a line of two points.
    let edges = |text: &str, colour: &str| {
        let points =
            |line: &str| line.split("points=").nth(1).map_or(0, |points| points.matches(',').count());
        let lines = text.lines().filter(|line| line.starts_with("<polyline") && line.contains(colour));
        lines.filter(|line| points(line) == 2).count()
    };
    let more = |colour: &str| edges(&both, colour) - edges(&plain, colour);
    assert_eq!([more("#0072B2"), more("#D55E00")], [4 * (1 + 1), 3 * (2 + 1)]);
    // What was before higher, at another kn, or of another arm is in the figure: the axes reach further.
    let further = drawn(&earlier(&[("gone", &[[1.5e8, 6.0]])]));
    assert!(further.contains("gone: mean of an earlier run"));
    assert!(further.contains("\n6.0\n") && !plain.contains("\n6.0\n"), "the vertical axis reaches 6 mm");
}
