//! The figure's bytes, its CSV, and the files on disk.

use std::fs;
use std::path::PathBuf;

use super::{fixed_arm, random_arm, summary_of, three_arms};
use crate::render::document::Captioned;
use crate::verb::run::answer::csv::csv;
use crate::verb::run::answer::figure::curves;
use crate::verb::run::answer::files::{SUMMARY_JSON, write_summary};
use crate::verb::run::answer::plot::over_kn;
use crate::verb::run::answer::population::Population;

/// An empty folder of this test's own.
pub fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("pirca-report-{}-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn figure<'a>(populations: &[Population]) -> Captioned<'a> {
    over_kn("hand-made", &curves(&summary_of(populations, &[])), None).unwrap()
}

fn drawn(populations: &[Population]) -> String {
    figure(populations).svg().unwrap()
}

/// All arms with every wall failed.
fn nothing_stands() -> Vec<Population> {
    let mut all = three_arms();
    for population in &mut all {
        population.values = Default::default();
        population.outcomes = [("collapsed".to_string(), population.planned)].into();
    }
    all
}

#[test]
fn the_same_numbers_give_the_same_files_whole_and_nothing_else() {
    let summary = summary_of(&three_arms(), &[]);
    let (first, second) = (folder("first"), folder("second"));
    write_summary(&summary, &first, None).unwrap();
    write_summary(&summary, &second, None).unwrap();
    write_summary(&summary, &second, None).unwrap();
    let mut names: Vec<String> = fs::read_dir(&second)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["figure-10.csv", "figure-10.png", "figure-10.svg", SUMMARY_JSON]);
    for name in &names {
        assert!(
            fs::read(first.join(name)).unwrap() == fs::read(second.join(name)).unwrap(),
            "{name} differs"
        );
    }
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(first.join(SUMMARY_JSON)).unwrap()).unwrap();
    assert_eq!(json["arms"].as_array().unwrap().len(), 9);
    assert_eq!(json["arms"][6]["mean"].as_f64(), summary.arms[6].mean);
    let other = drawn(&random_arm("irregular", &[0.28e-3, 0.2e-3, 0.16e-3]));
    assert_ne!(
        other,
        drawn(&random_arm("irregular", &[0.27e-3, 0.2e-3, 0.16e-3])),
        "the figure shows the numbers"
    );
    fs::remove_dir_all(first).unwrap();
    fs::remove_dir_all(second).unwrap();
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let fault =
        write_summary(&summary_of(&three_arms(), &[]), &folder("gone").join("missing"), None).unwrap_err();
    assert!(format!("{fault:#}").contains(SUMMARY_JSON), "{fault:#}");
    fs::remove_dir_all(folder("gone")).unwrap();
}

#[test]
fn an_image_shows_what_the_svg_shows_at_twice_its_size() {
    let figure = figure(&three_arms());
    let svg = figure.svg().unwrap();
    let image = image::load_from_memory(&figure.png().unwrap()).unwrap().to_rgb8();
    let size = format!("width=\"{}\" height=\"{}\"", image.width() / 2, image.height() / 2);
    assert!(svg.starts_with(&format!("<svg {size}")), "{}", &svg[..80]);
    let inked = image.pixels().filter(|pixel| pixel.0 != [255; 3]).count();
    assert!(inked > 1000, "{inked} pixels are not white");
}

#[test]
fn the_csv_holds_the_numbers_of_the_summary() {
    let summary = summary_of(&three_arms(), &[]);
    let text = csv(&curves(&summary));
    let number = |cell: &str| cell.parse::<f64>().ok();
    assert_eq!(text.lines().count(), 1 + summary.arms.len());
    for (line, arm) in text.lines().skip(1).zip(&summary.arms) {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[0], arm.arm);
        assert_eq!(number(cells[1]), Some(arm.kn_pa_per_m));
        assert_eq!(
            (number(cells[2]), number(cells[3])),
            (Some(arm.members as f64), Some(arm.in_mean as f64))
        );
        // Bit for bit: the one operation between them is the change from m to mm.
        assert_eq!(number(cells[4]), arm.mean.map(|x| x * 1e3));
        assert_eq!(number(cells[5]), arm.mean_ci.map(|ci| ci[0] * 1e3));
        assert_eq!(number(cells[6]), arm.mean_ci.map(|ci| ci[1] * 1e3));
        assert_eq!(number(cells[7]), arm.sigma.map(|x| x * 1e3));
        assert_eq!(number(cells[8]), arm.mean.zip(arm.sigma).map(|(m, s)| m * 1e3 - s * 1e3));
        assert_eq!(number(cells[9]), arm.mean.zip(arm.sigma).map(|(m, s)| m * 1e3 + s * 1e3));
    }
    let named = csv(&curves(&summary_of(&fixed_arm("a, \"b\"", &[1e-3]), &[])));
    assert!(named.ends_with("\"a, \"\"b\"\"\",75000000,1,1,1,,,,,\n"), "{named}");
}

#[test]
fn the_figure_names_its_arms_units_and_losses() {
    let text = drawn(&three_arms());
    for words in [
        "hand-made",
        "normal stiffness of the joints kn (10\u{2077} Pa/m)",
        "out-of-plane displacement at the top (mm)",
        "continuous: 1 wall, nothing random",
        "irregular: mean of 7 to 8 walls, bars: 95 % interval of the mean",
        "irregular: mean \u{b1} one standard deviation of the walls",
        "! irregular: 1 of 24 analyses failed; they are not in the means",
    ] {
        assert!(text.contains(words), "{words} is missing");
    }
}

#[test]
fn studies_of_other_shapes_are_drawn_too() {
    let empty = drawn(&nothing_stands());
    assert!(empty.contains("no wall brings a value: there is nothing to draw"));
    assert!(empty.contains("! irregular: no wall brings a value at any stiffness"));
    assert!(empty.contains("irregular: no wall\n"), "the legend claims nothing");
    let two = drawn(&[fixed_arm("regular", &[1e-3]), random_arm("rubble & rough", &[2e-3, 1e-3])].concat());
    assert!(two.contains("rubble &amp; rough: mean of 8 walls"), "names are escaped");
    // A gap in the middle: no line crosses it. Points per line of the arm's colour, that of the legend included.
    let mut gap = fixed_arm("regular", &[3e-3, 2e-3, 1e-3]);
    let lines = |text: &str| -> Vec<usize> {
        let own = text.lines().filter(|line| line.starts_with("<polyline") && line.contains("#0072B2"));
        own.map(|line| line.split("points=").nth(1).map_or(0, |points| points.matches(',').count())).collect()
    };
    assert_eq!(lines(&drawn(&gap)), [3, 2]);
    gap[1].values = Default::default();
    gap[1].outcomes = [("not_converged".to_string(), 1)].into();
    let cut = drawn(&gap);
    assert_eq!(lines(&cut), [1, 1, 2]);
    assert!(cut.contains(
        "! regular: 1 of 3 analyses failed; they are not in the means; none is left at 1 of 3 stiffnesses"
    ));
    // No arm at all, and more arms than colours.
    assert!(over_kn("empty", &[], None).is_none());
    let many: Vec<Population> =
        (0..9).flat_map(|i| fixed_arm(&format!("arm {i}"), &[1e-3, 0.8e-3, 0.6e-3])).collect();
    assert!(drawn(&many).contains("arm 8: 1 wall"));
}
