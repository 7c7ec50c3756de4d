//! `pirca analyse` of walls that hold back earth or water, or bear a pressure or a load on their crest; studies of such walls.

use std::fs;

use pirca::exchange::write_wall_json;
use pirca::math::{Vec3, cbrt, radians, tan};
use pirca::model::{Block, Support, Wall};
use pirca::shape::Polyhedron;
use serde_json::Value;

use crate::walls::Folder;

const GRAVITY: f64 = 9.806_65;

/// A block 1 m long, 0.6 m deep and 2 m high of 1600 kg/m^3 on a wide fixed one, in so many courses.
fn column(courses: u32) -> Wall {
    let block = |support, low: [f64; 3], high: [f64; 3]| {
        let shape = Polyhedron::cuboid(Vec3::from(low), Vec3::from(high));
        Block { support, ..Block::stone(shape, 1600.0) }
    };
    let each = 2.0 / f64::from(courses);
    let stone =
        |k: u32| block(Support::Free, [0.0, 0.0, each * f64::from(k)], [1.0, 0.6, each * f64::from(k + 1)]);
    let floor = block(Support::Fixed, [-1.0, -1.0, -0.2], [2.0, 2.0, 0.0]);
    Wall { blocks: [floor].into_iter().chain((0..courses).map(stone)).collect() }
}

fn said(more: &[&str]) -> (String, Option<i32>) {
    let folder = Folder::new();
    fs::write(folder.path("wall.json"), write_wall_json(&column(4))).unwrap();
    let output = folder.pirca(&[&["analyse", "wall.json", "--phi-deg", "60"], more].concat());
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    (text, output.status.code())
}

fn analysed(more: &[&str]) -> Value {
    let (text, code) = said(&[more, &["--json"]].concat());
    assert_eq!(code, Some(0), "{more:?}: {text}");
    serde_json::Deserializer::from_str(&text).into_iter().next().expect("a JSON object").expect("JSON")
}

fn close(found: &Value, expected: f64, share: f64) {
    let found = found.as_f64().unwrap_or_else(|| panic!("no number: {found}"));
    assert!((found - expected).abs() <= share * expected.abs(), "{found} instead of {expected}");
}

#[test]
fn water_and_fill_bring_a_wall_down_at_the_heights_of_statics() {
    let water = analysed(&["--load", "water"]);
    let known = cbrt(3.0 * 1.6 * 0.36 * 2.0);
    close(&water["held"]["collapse_height_m"], known, 2e-4);
    close(&water["collapse_multiplier"], known, 2e-4);
    assert_eq!((&water["outcome"], &water["bracket_unit"]), (&"collapsed".into(), &"m".into()), "{water}");
    // Ka = 1/3 of a fill of the same density as the wall's over three.
    let fill = analysed(&["--load", "fill", "--fill-density", "3000", "--fill-phi-deg", "30"]);
    close(&fill["held"]["pressure_coefficient"], 1.0 / 3.0, 1e-12);
    close(&fill["held"]["collapse_height_m"], cbrt(3.0 * 1.6 * 0.36 * 2.0), 2e-4);
    // From the other side the wall is the same.
    let back = analysed(&["--load", "water", "--direction", "y-"]);
    close(&back["held"]["collapse_height_m"], known, 2e-4);
    let implicit = ["--load", "water", "--solver", "implicit", "--kn", "1e11"];
    let soft = analysed(&implicit);
    // Within the bracket of a hundredth of the wall's height, and what stiff joints close by.
    close(&soft["held"]["collapse_height_m"], known, 0.03);
}

#[test]
fn a_wall_that_stands_to_its_top_says_so_with_its_margin() {
    let arguments = ["--load", "fill", "--fill-density", "1500", "--fill-phi-deg", "40"];
    let coefficient = {
        let tangent = tan(radians(25.0));
        tangent * tangent
    };
    let margin = 3.0 * 1600.0 * 0.36 * 2.0 / (coefficient * 1500.0 * 8.0);
    let answer = analysed(&arguments);
    assert_eq!((&answer["outcome"], &answer["held"]["collapse_height_m"]), (&"stable".into(), &Value::Null));
    close(&answer["held"]["margin"], margin, 1e-5);
    let (text, _) = said(&arguments);
    let expected = format!(
        "stands with fill up to the top of its back, 2.000 m, towards y+; it bears {margin:.2} times that pressure"
    );
    assert!(text.contains(&expected), "{text}");
    assert!(text.contains("no friction on the back"), "{text}");
}

#[test]
fn a_pressure_and_loads_on_the_crest_grow_to_the_factors_of_statics() {
    let weight = 1600.0 * 0.6 * 2.0 * GRAVITY;
    let pressure = analysed(&["--load", "pressure", "--pressure-pa", "1000"]);
    close(&pressure["multiplier"], weight * 0.3 / (1000.0 * 2.0 * 1.0), 1e-6);
    for crest in ["--crest-force", "--crest-line"] {
        let push = analysed(&["--load", "point", crest, "1000"]);
        close(&push["multiplier"], weight * 0.3 / (1000.0 * 2.0), 1e-6);
    }
    // A weight in the middle brings nothing down.
    let down = analysed(&["--load", "point", "--crest-force", "1000", "--crest-down-deg", "90"]);
    assert_eq!(down["outcome"], "unbounded", "{down}");
}

#[test]
fn what_is_missing_or_asked_in_vain_is_one_error() {
    let refused = [
        (&["--load", "fill", "--fill-phi-deg", "30"][..], "--load fill needs --fill-density"),
        (&["--load", "fill", "--fill-density", "1800"], "--load fill needs --fill-phi-deg"),
        (
            &["--load", "water", "--fill-density", "1800"],
            "--fill-density is for --load fill, and the load is water",
        ),
        (
            &["--load", "fill", "--fill-density", "1800", "--fill-phi-deg", "30", "--fill-slope-deg", "31"],
            "no soil without cohesion lies steeper",
        ),
        (
            &["--load", "fill", "--fill-density", "900", "--fill-phi-deg", "30", "--undrained"],
            "heavier than water",
        ),
        (&["--load", "point"], "--load point needs --crest-force"),
        (&["--load", "pressure"], "--load pressure needs --pressure-pa"),
        (&["--load", "water", "--worst-direction"], "--worst-direction is not for --load water"),
        (&["--load", "water", "--study", "mine"], "load.protocol = \"retaining\""),
        (&["--load", "water", "--vertical", "0.1"], "--vertical is for --load lateral"),
    ];
    for (arguments, expected) in refused {
        let (text, code) = said(arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {text}");
        assert!(text.contains(expected), "{arguments:?}: {text}");
        assert_eq!(text.matches("error:").count(), 1, "{text}");
    }
}

const STUDY: &str = r#"
[study]
question = "How high may the fill rise?"
seed = 1

[wall]
height_m = 0.6
length_m = 0.8
base_thickness_m = 0.16
top_thickness_m = 0.16
battered_face = "both"

[block]
density_kg_per_m3 = 2000

[joint]
kn_pa_per_m = [1e9]
kn_over_ks = 2
phi_deg = 60
cohesion_pa = 0

[load]
protocol = "retaining"
retained = "fill"
fill_density_kg_per_m3 = 2000
fill_phi_deg = 30

[restraint]
base = "fixed"
ends = "free"

[solver]
name = "limit"

[[arm]]
name = "stack"
members = 1
arrangement = "continuous"
block_length_m = 0.2
course_height_m = 0.1
"#;

/// What a verb says of the study with one line exchanged.
fn of_study(verb: &[&str], from: &str, to: &str) -> (String, Option<i32>, Folder) {
    let folder = Folder::new();
    fs::create_dir(folder.path("mine")).unwrap();
    assert!(STUDY.contains(from), "{from}");
    fs::write(folder.path("mine/study.toml"), STUDY.replace(from, to)).unwrap();
    let output = folder.pirca(verb);
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    (text, output.status.code(), folder)
}

#[test]
fn a_study_finds_the_height_at_which_its_walls_fall() {
    let run = ["run", "mine", "--out", "out", "--json"];
    // Stacks of stones of one thickness overturn as one: h^3 = 3 b^2 H / Ka at equal densities, Ka = 1/3.
    let known = cbrt(9.0 * 0.16 * 0.16 * 0.6);
    let height = |from: &str, to: &str, within: f64| {
        let (text, code, _folder) = of_study(&run, from, to);
        assert_eq!(code, Some(0), "{text}");
        let summary: Value =
            serde_json::Deserializer::from_str(&text).into_iter().next().expect("JSON").expect("JSON");
        let arm = &summary["arms"][0];
        assert_eq!((&arm["quantity"], &arm["in_mean"]), (&"retained_height".into(), &1.into()), "{arm}");
        close(&arm["mean"], known, within);
    };
    height("seed = 1", "seed = 1", 2e-3);
    // Elastic joints sink at the toe, so that the stack leans before it falls: at 1e9 Pa/m some 4 % earlier.
    height("name = \"limit\"", "name = \"implicit\"\n", 0.06);
    let (text, _, _folder) =
        of_study(&["run", "mine", "--out", "out"], "fill_phi_deg = 30", "fill_phi_deg = 45");
    assert!(text.contains("1 stood to the end of the load path"), "{text}");
}

#[test]
fn a_study_with_a_faulty_fill_is_told_its_line_and_key() {
    let check = ["check", "mine"];
    let faults = [
        ("fill_density_kg_per_m3 = 2000\n", "", "load.fill_density_kg_per_m3"),
        ("fill_phi_deg = 30", "fill_phi_deg = 30\nfill_slope_deg = 31", "load.fill_slope_deg"),
        (
            "= 2000\nfill_phi_deg = 30",
            "= 900\nfill_phi_deg = 30\ndrained = false",
            "load.fill_density_kg_per_m3",
        ),
        ("\"fill\"", "\"water\"", "load.fill_density_kg_per_m3"),
        ("fill_phi_deg = 30", "fill_phi_deg = 30\nmean_pressure_pa = 10", "load.mean_pressure_pa"),
    ];
    for (from, to, key) in faults {
        let (text, code, _folder) = of_study(&check, from, to);
        assert_eq!(code, Some(3), "{to}: {text}");
        assert!(text.contains("1 fault in") && text.contains(key), "{to}: {text}");
    }
    let drawn = "name = \"limit\"\n\n[uncertain]\n\"load.fill_phi_deg\" = { family = \"uniform\", low = 28, high = 34 }\n";
    let (text, code, _folder) = of_study(&check, "name = \"limit\"", drawn);
    assert_eq!(code, Some(0), "{text}");
}
