//! Measured beside simulated: in summary.json, in the tables, in the text and in the figure.

use std::fs;

use super::figure::folder;
use crate::critic::tests::{fallen, measurement, study};
use crate::ensemble::Row;
use crate::math::{ln, radians};
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};
use crate::verb::run::answer::files::{SUMMARY_JSON, write_summary};
use crate::verb::run::answer::summary::{Summary, summarise};
use crate::verb::run::answer::table::terminal_table;

/// Four stiffnesses (Pa/m), and walls that fall at 14 deg at 5e7 and 2 deg more for every factor e, 0.5 deg either way.
const KN: [f64; 4] = [2e7, 5e7, 1e8, 2e8];

fn rows() -> Vec<Row> {
    let walls = |(point, kn): (usize, &f64)| {
        let mean = 14.0 + 2.0 * ln(kn / 5e7);
        [(0, -0.5), (1, 0.5)].map(|(member, apart)| fallen(member, point as u32, mean + apart))
    };
    KN.iter().enumerate().flat_map(walls).collect()
}

/// Angles of Table 2's SBL, a displacement, a bound and a joint test.
fn summary() -> Summary {
    let mut study = study(&KN, 2);
    for (specimen, angle) in [("a", 13.5), ("b", 14.5), ("c", 15.0)] {
        let reading = measurement(specimen, MeasuredQuantity::CollapseAngle, None, radians(angle));
        study.measured.push(Measurement { kind: MeasuredKind::Rounded, resolution: radians(0.5), ..reading });
    }
    let moved = |specimen, tilt| measurement(specimen, MeasuredQuantity::DisplacementMean, Some(tilt), 0.019);
    study.measured.push(Measurement { error: 2e-3, ..moved("a", 5.0) });
    study.measured.push(Measurement { kind: MeasuredKind::Below, ..moved("b", 5.5) });
    study.measured.push(measurement("d", MeasuredQuantity::JointKn, None, 5e7));
    summarise(&study, &rows())
}

#[test]
fn summary_json_holds_the_comparison_and_the_calibration() {
    let summary = summary();
    let json = serde_json::to_value(&summary).unwrap();
    let lines = json["measured"]["comparison"].as_array().unwrap();
    // Four points each of the angle, the displacement and the bound, and the joint test.
    assert_eq!(lines.len(), 13);
    let angle = &lines[1];
    assert_eq!((angle["quantity"].as_str(), angle["unit"].as_str()), (Some("collapse_angle"), Some("deg")));
    assert_eq!((angle["kn_pa_per_m"].as_f64(), angle["measured"]["n"].as_u64()), (Some(5e7), Some(3)));
    assert_eq!(angle["measured"]["mean"].as_f64(), Some(14.333333333));
    assert_eq!(
        (angle["simulated"]["mean"].as_f64(), angle["difference"].as_f64()),
        (Some(14.0), Some(-0.333333333))
    );
    let displacement = &lines[5];
    assert_eq!((displacement["tilt_deg"].as_f64(), displacement["unit"].as_str()), (Some(5.0), Some("m")));
    // The hand-made walls move by 3 mm per degree in the mean, all alike.
    assert!((displacement["difference"].as_f64().unwrap() - (-0.004)).abs() < 1e-12);
    assert!((displacement["difference_in_sd"].as_f64().unwrap() - (-2.0)).abs() < 1e-9);
    assert_eq!(
        (lines[9]["agreeing_share"].as_f64(), lines[9]["measured_below"].as_u64()),
        (Some(1.0), Some(1))
    );
    assert_eq!(lines[12]["note"].as_str(), Some("the simulation does not give it"));
    let calibration = &json["measured"]["calibration"][0];
    assert_eq!(
        (calibration["arm"].as_str(), calibration["specimens"].as_u64()),
        (Some("irregular"), Some(3))
    );
    let kn = calibration["kn_pa_per_m"].as_f64().unwrap();
    // The mean of the angles is a third of a degree above 14: a factor of exp(1/6).
    assert!((ln(kn / 5e7) - 1.0 / 6.0).abs() < 0.01, "{kn:e}");
    // Two walls at each point have a mean that is too uncertain to bound kn from below within these points.
    assert!(calibration["kn_95_pa_per_m"][0].is_null());
    assert!(calibration["kn_68_pa_per_m"][0].as_f64().unwrap() < kn);
}

#[test]
fn the_text_says_what_was_compared_and_how_uncertain_it_is() {
    let table = terminal_table(&summary());
    assert!(table.lines().all(|line| line.chars().count() <= 110), "{table}");
    let text = table.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "Measured beside these numbers",
        "The 95 % interval of a sigma is wide: from 3 values it is 0.52 to 6.28 times the value.",
        "irregular, displ. mean, 5.5 deg: only bounds are known of 1 specimen; walls that agree: 100 % at kn 2e7",
        "! irregular, joint kn: not compared: the simulation does not give it",
        "Calibration irregular: kn = 5.9e7 Pa/m by 3 measured collapse angles",
        "95 % below the points to",
        "cannot tell them apart",
    ] {
        assert!(text.contains(part), "no `{part}` in\n{text}");
    }
}

#[test]
fn the_files_are_written_and_the_same_each_time() {
    let summary = summary();
    let (first, second) = (folder("measured-first"), folder("measured-second"));
    write_summary(&summary, &first, None).unwrap();
    write_summary(&summary, &second, None).unwrap();
    for name in ["comparison.csv", "calibration.csv", "calibration.svg", "calibration.png", SUMMARY_JSON] {
        assert!(
            fs::read(first.join(name)).unwrap() == fs::read(second.join(name)).unwrap(),
            "{name} differs"
        );
    }
    let table = fs::read_to_string(first.join("comparison.csv")).unwrap();
    let width = table.lines().next().unwrap().split(',').count();
    assert_eq!((table.lines().count(), width), (14, 39));
    assert!(table.lines().all(|line| line.split(',').count() == width), "{table}");
    assert!(table.contains("\nirregular,collapse_angle,,deg,50000000,3,14.333333333,"));
    let curve = fs::read_to_string(first.join("calibration.csv")).unwrap();
    assert_eq!(
        (curve.lines().next(), curve.lines().count()),
        (Some("arm,kn_pa_per_m,mean_deg,sigma_deg,deviance"), 122)
    );
    let picture = fs::read_to_string(first.join("calibration.svg")).unwrap();
    for part in ["collapse angle (deg)", "kn by profile likelihood", "tilting-block: irregular"] {
        assert!(picture.contains(part), "no `{part}` in the figure");
    }
    // A study without measurements has none of these.
    let bare = folder("measured-none");
    write_summary(&Summary { measured: None, ..summary }, &bare, None).unwrap();
    assert!(!bare.join("comparison.csv").exists() && !bare.join("calibration.svg").exists());
    assert!(!fs::read_to_string(bare.join(SUMMARY_JSON)).unwrap().contains("\"measured\""));
    for folder in [first, second, bare] {
        fs::remove_dir_all(folder).unwrap();
    }
}

/// With three points there is no calibration, and the comparison is made all the same.
#[test]
fn too_few_points_give_no_calibration() {
    let mut study = study(&KN[..3], 2);
    study.measured.push(measurement("a", MeasuredQuantity::CollapseAngle, None, radians(14.0)));
    let rows: Vec<Row> = rows().into_iter().filter(|row| row.point < 3).collect();
    let measured = summarise(&study, &rows).measured.expect("something was measured");
    assert_eq!((measured.comparison.len(), measured.calibration.len()), (3, 0));
}
