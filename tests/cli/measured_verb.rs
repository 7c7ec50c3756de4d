//! `pirca init --measured` and `pirca check --measured`: the template is read when filled in; what is said of a file, and what looks odd
//! about one.

use std::fs;
use std::path::Path;
use std::process::Output;

use pirca::math::{atan, degrees};
use pirca::protocol::Direction;
use pirca::study::Study;
use serde_json::Value;

use crate::fixture::{Folder, STUDY, stderr};

/// Towers of 80 mm by 200 mm, and the tests on six of them.
const TOWERS: &str = include_str!("../../studies/hidden-effects/example/study.toml");
const MEASURED: &str = include_str!("../../studies/hidden-effects/example/measured.csv");

fn ends_with(folder: &Folder, code: i32, arguments: &[&str]) -> Output {
    let output = folder.pirca(arguments);
    assert_eq!(output.status.code(), Some(code), "pirca {}: {}", arguments.join(" "), stderr(&output));
    output
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Fills in a template as somebody would whose walls fall at 14 deg: displacements of a tenth of a millimetre per degree.
fn filled(template: &str) -> String {
    let mut header: Vec<String> = Vec::new();
    let mut lines = Vec::new();
    for line in template.lines() {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if line.starts_with("sep=") || line.starts_with('#') {
            lines.push(line.to_owned());
            continue;
        }
        if header.is_empty() {
            header = cells.clone();
            lines.push(line.to_owned());
            continue;
        }
        let at = |name: &str| header.iter().position(|own| own == name);
        let tilt: f64 = cells[at("tilt_deg").unwrap()].parse().unwrap_or(0.0);
        let moved = format!("{:.3}", 0.1 * tilt);
        if let Some(value) = at("value") {
            let is_fall = cells[at("quantity").unwrap()] == "collapse_angle";
            cells[value] = if is_fall {
                "14".to_owned()
            } else if tilt < 14.0 {
                moved
            } else {
                String::new()
            };
            cells[at("error").unwrap()] = "0.02".to_owned();
        } else {
            let points = header
                .iter()
                .enumerate()
                .filter(|(_, name)| name.ends_with("_mm") && !name.starts_with("error"));
            points.filter(|_| tilt < 14.0).for_each(|(point, _)| cells[point].clone_from(&moved));
            cells[at("error_mm").unwrap()] = "0.02".to_owned();
            if tilt == 2.5 {
                cells[at("collapse_angle_deg").unwrap()] = "14".to_owned();
                cells[at("collapse_angle_error").unwrap()] = "0.02".to_owned();
            }
        }
        lines.push(cells.join(","));
    }
    lines.join("\n") + "\n"
}

#[test]
fn a_filled_template_is_read_without_a_fault_or_a_note() {
    for (study, arms) in
        [(TOWERS.to_owned(), 1), (TOWERS.replace("step_deg = 2.5", "step_deg = 2.5\nremainders = true"), 1)]
    {
        let folder = Folder::with_study(&study);
        let mut told = Vec::new();
        for shape in [&[][..], &["--wide"]] {
            let write = ["init", "empty.csv", "--measured", "studies/tiny", "--specimens", "4"];
            ends_with(&folder, 0, &[&write[..], shape].concat());
            let template = fs::read_to_string(folder.path("empty.csv")).unwrap();
            fs::rename(folder.path("empty.csv"), folder.path("unfilled.csv")).unwrap();
            let refused =
                stderr(&ends_with(&folder, 3, &["check", "studies/tiny", "--measured", "unfilled.csv"]));
            assert!(refused.contains("unfilled.csv: has no rows with a value"), "{refused}");
            let filled = filled(&template);
            // As a spreadsheet in Germany saves it.
            let german: String = filled
                .lines()
                .map(|line| if line.starts_with('#') { line.to_owned() } else { line.replace(',', ";").replace('.', ",") } + "\r\n")
                .collect();
            for (text, separator) in [(filled, ","), (german, ";")] {
                fs::write(folder.path("tests.csv"), text).unwrap();
                let output =
                    ends_with(&folder, 0, &["check", "studies/tiny", "--measured", "tests.csv", "--json"]);
                assert_eq!(stderr(&output), "");
                let read = json(&output);
                assert_eq!(
                    (&read["separator"], &read["specimens"].as_array().unwrap().len()),
                    (&separator.into(), &(4 * arms))
                );
                // Tilts of 2.5 to 12.5 deg of the 8 below the 21.8 deg at which a tower overturns.
                let per_wall = if study.contains("remainders") { 1 + 6 * 5 } else { 1 + 3 * 5 };
                assert_eq!(read["readings"], 4 * per_wall);
                assert!(!read["lines_without_value"].as_array().unwrap().is_empty());
                let quantities = read["quantities"].as_array().unwrap().clone();
                let of = |q: &Value| ["quantity", "exact", "range", "tilts_deg"].map(|key| q[key].clone());
                let mut quantities: Vec<_> = quantities.iter().map(of).collect();
                quantities.sort_by_key(|q| q[0].to_string());
                told.push(quantities);
            }
        }
        assert!(told.len() == 4 && told.iter().all(|other| other == &told[0]), "{told:?}");
    }
}

#[test]
fn a_template_is_of_the_study_and_never_written_over_a_file() {
    let tilting = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-table");
    let folder = Folder::with_study(STUDY);
    let template = ["init", "new.csv", "--measured", tilting.to_str().unwrap()];
    ends_with(&folder, 0, &template);
    let text = fs::read_to_string(folder.path("new.csv")).unwrap();
    for arm in ["cbl", "sbl", "sbr"] {
        for row in [
            format!("\n{arm}_3,{arm},,collapse_angle,,deg,,exact"),
            format!("\n{arm}_1,{arm},2.5,displacement_left,,mm,"),
        ] {
            assert!(text.contains(&row), "{row} in {text}");
        }
    }
    assert!(!text.contains("free-20") && !text.contains("_4,"), "{text}");
    fs::write(folder.path("new.csv"), "my tests").unwrap();
    let refused = stderr(&ends_with(&folder, 1, &template));
    assert!(refused.contains("new.csv is there already, and may hold measurements"), "{refused}");
    assert_eq!(fs::read_to_string(folder.path("new.csv")).unwrap(), "my tests");
    // Nothing is tilted, or nothing was measured.
    let refused = stderr(&ends_with(&folder, 3, &["init", "new.csv", "--measured", "studies/tiny"]));
    assert!(refused.contains("the study tilts no platform"), "{refused}");
    let refused = stderr(&ends_with(&folder, 3, &["check", "studies/tiny", "--measured"]));
    assert!(
        refused.contains("there is no measured.csv")
            && refused.contains("pirca init measured.csv --measured studies/tiny"),
        "{refused}"
    );
}

#[test]
fn what_was_read_is_said() {
    let folder = Folder::with_study(TOWERS);
    fs::write(folder.path("studies/tiny/measured.csv"), MEASURED).unwrap();
    let said = ends_with(&folder, 0, &["check", "studies/tiny", "--measured"]);
    let said = String::from_utf8(said.stdout).unwrap();
    for part in [
        "measured.csv: 96 readings on 6 specimens; nothing looks odd\n",
        "a row per value, separated by commas, decimals with a point\n",
        "  tower: T0, T1, T2, T3, T4, T5\n",
        "  tower collapse_angle: 6 exact; 15.7 to 16.13 deg, written in deg\n",
        "  tower displacement_left: 30 exact; 0.41 to 3.132 mm, written in mm; at 2.5, 5, 7.5, 10, 12.5 deg\n",
    ] {
        assert!(said.contains(part), "{part} in {said}");
    }
    // Another file in its place, with faults of its own.
    fs::write(folder.path("bad.csv"), MEASURED.replacen("0.462,mm", "0,462,mm", 1)).unwrap();
    let refused = stderr(&ends_with(&folder, 3, &["check", "studies/tiny", "--measured", "bad.csv"]));
    assert!(refused.contains("bad.csv:3: has 9 cells"), "{refused}");
    fs::write(folder.path("gap.csv"), MEASURED.replacen("0.462,mm", ",mm", 1)).unwrap();
    let warned = ends_with(&folder, 0, &["check", "studies/tiny", "--measured", "gap.csv", "--json"]);
    assert!(
        stderr(&warned).contains("warning: gap.csv:3: has no value and is read over"),
        "{}",
        stderr(&warned)
    );
    assert_eq!(
        (&json(&warned)["readings"], &json(&warned)["lines_without_value"][0]),
        (&95.into(), &3.into())
    );
}

/// The notes on a file of towers.
fn notes(folder: &Folder, text: &str) -> Vec<String> {
    fs::write(folder.path("odd.csv"), text).unwrap();
    let output = ends_with(folder, 0, &["check", "studies/tiny", "--measured", "odd.csv", "--json"]);
    let notes = json(&output)["notes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|note| note.as_str().unwrap().to_owned())
        .collect();
    for note in &notes {
        assert!(stderr(&output).contains(&format!("note: {note}\n")), "{note}");
    }
    notes
}

/// The example with the values of some rows multiplied, to six digits.
fn multiplied(factor: f64, is: impl Fn(&[&str]) -> bool) -> String {
    let row = |line: &str| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if let Ok(value) = cells[4].parse::<f64>()
            && is(&line.split(',').collect::<Vec<_>>())
        {
            cells[4] = format!("{}", format!("{:.5e}", value * factor).parse::<f64>().unwrap());
        }
        cells.join(",") + "\n"
    };
    MEASURED.lines().map(row).collect()
}

/// One specimen in another unit, or a part of its readings, is told by its ratio to the others, whichever the unit.
#[test]
fn a_specimen_in_another_unit_is_told_by_its_fellows() {
    let folder = Folder::with_study(TOWERS);
    let moved = |cells: &[&str]| cells[0] == "T0" && cells[3] != "collapse_angle";
    let text = multiplied(1e-3, moved);
    let found = notes(&folder, &text);
    assert_eq!(
        found,
        [
            "lines 3 to 17: T0 alone is off by a factor of about 1000 on all 15 readings, which are too small (displacement_left of T0 is \
          4.62e-4 mm at 2.5 deg, where 0.424 mm is usual): was it meant in another unit?"
        ]
    );
    for (factor, said) in [
        (0.1, "a factor of about 10 on all 15 readings, which are too small"),
        (1.0 / 25.4, "a factor of about 25.4 on all 15 readings, which are too small"),
        (0.01, "a factor of about 100 on"),
        (10.0, "a factor of about 10 on all 15 readings, which are too large"),
    ] {
        let found = notes(&folder, &multiplied(factor, moved));
        assert!(
            found.len() == 1 && found[0].contains(&format!("T0 alone is off by {said}")),
            "{factor}: {found:?}"
        );
    }
    // Two of the six, the fall in radians, a column, a row, and a reading of a wide table.
    let two = notes(
        &folder,
        &multiplied(1e-3, |cells| ["T0", "T4"].contains(&cells[0]) && cells[3] != "collapse_angle"),
    );
    assert!(two.len() == 2 && two[1].starts_with("lines 67 to 81: T4 alone"), "{two:?}");
    // Where displacements are read as well, these are above such an angle, which is a fault.
    let fell = |cells: &[&str]| cells[0] == "T2" && cells[3] == "collapse_angle";
    let falls = multiplied(1.0 / degrees(1.0), fell);
    let falls: Vec<&str> = falls.lines().filter(|line| !line.contains("displacement")).collect();
    let fall = notes(&folder, &(falls.join("\n") + "\n"));
    assert!(
        fall.len() == 1
            && fall[0].starts_with("line 4: T2 alone is off by a factor of about 57.3 on collapse_angle"),
        "{fall:?}"
    );
    let column =
        notes(&folder, &multiplied(0.1, |cells| cells[0] == "T1" && cells[3] == "displacement_left"));
    assert!(
        column.len() == 1
            && column[0].starts_with(
                "lines 19, 22, 25, 28, 31: T1 is off by a factor of about 10 on 5 readings alone"
            ),
        "{column:?}"
    );
    let row = notes(&folder, &multiplied(0.1, |cells| cells[0] == "T1" && cells[2] == "7.5"));
    assert!(
        row.len() == 1
            && row[0].starts_with("lines 25, 26, 27: T1 is off by a factor of about 10 on 3 readings alone"),
        "{row:?}"
    );
    let one = notes(
        &folder,
        &multiplied(0.01, |cells| cells[0] == "T1" && cells[2] == "7.5" && cells[3] == "displacement_right"),
    );
    assert!(
        one.len() == 1
            && one[0].starts_with("line 27: T1 is off by a factor of about 100 on displacement_right alone"),
        "{one:?}"
    );
    // Three specimens with two readings each, one of them in mm where the others are in cm: the source paper's own table.
    let tilting = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-table");
    let table = fs::read_to_string(tilting.join("measured.csv")).unwrap();
    let slip = table.replace("SBL2,SBL,5,displacement_mean,1.2,cm", "SBL2,SBL,5,displacement_mean,1.2,mm");
    let slip = slip.replace("SBL2,SBL,10,displacement_mean,2.0,cm", "SBL2,SBL,10,displacement_mean,2.0,mm");
    assert_ne!(slip, table);
    fs::write(folder.path("slip.csv"), slip).unwrap();
    let output =
        ends_with(&folder, 0, &["check", tilting.to_str().unwrap(), "--measured", "slip.csv", "--json"]);
    let found = &json(&output)["notes"];
    assert!(
        found[0].as_str().unwrap().contains("SBL2 alone is off by a factor of about 10 on all 2 readings")
            && found[1].is_null(),
        "{found}"
    );
    // Of two specimens neither is the odd one.
    let of_two: String = text
        .lines()
        .filter(|line| !["T2", "T3", "T4", "T5"].contains(&&line[..2]))
        .map(|line| format!("{line}\n"))
        .collect();
    let found = notes(&folder, &of_two);
    assert!(
        found.len() == 1
            && found[0]
                .contains("T0 is off by a factor of about 1000 from the other specimen on all 15 readings"),
        "{found:?}"
    );
}

/// What walls do is no slip of the pen: three times softer, further by half, or lost in the error.
#[test]
fn walls_that_differ_are_not_taken_for_another_unit() {
    let folder = Folder::with_study(TOWERS);
    assert_eq!(notes(&folder, MEASURED), [""; 0]);
    let moved = |cells: &[&str]| cells[0] == "T3" && cells[3] != "collapse_angle";
    for factor in [0.3, 0.5, 1.5, 3.0, 5.0] {
        assert_eq!(notes(&folder, &multiplied(factor, moved)), [""; 0], "{factor}");
    }
    // A gauge of an error that hides all movements says nothing of units.
    let blind = multiplied(0.1, moved).replace(",mm,0.02,", ",mm,4,");
    assert_eq!(notes(&folder, &blind), [""; 0]);
    let tilting = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/tilting-table");
    let output = ends_with(&folder, 0, &["check", tilting.to_str().unwrap(), "--measured", "--json"]);
    assert_eq!(
        (json(&output)["notes"].as_array().unwrap().len(), json(&output)["readings"].clone()),
        (0, 33.into())
    );
    assert_eq!(stderr(&output), "");
}

/// Angles and displacements that cannot belong to one wall.
#[test]
fn readings_that_cannot_belong_to_one_wall_are_told() {
    let folder = Folder::with_study(TOWERS);
    // atan(80 / 200) is 21.8 deg.
    let late = notes(&folder, &MEASURED.replacen("collapse_angle,15.78", "collapse_angle,23", 1));
    assert!(
        late.len() == 1
            && late[0].starts_with("line 2: collapse_angle of T0 is 23 deg, and a wall with free ends as the study draws it overturns as a whole at 21.8 deg"),
        "{late:?}"
    );
    let mean = |value: f64| format!("{MEASURED}T0,tower,5,displacement_mean,{value},mm,0.02,exact\n");
    // (0.944 + 0.943 + 0.937) / 3 is 0.941.
    assert_eq!(notes(&folder, &mean(0.96)), [""; 0]);
    let found = notes(&folder, &mean(1.4));
    assert!(
        found.len() == 1
            && found[0].starts_with("lines 6, 7, 8, 98: displacement_mean of T0 is 1.4 mm at 5 deg, where left, centre and right make it 0.941"),
        "{found:?}"
    );
    let bent =
        notes(&folder, &format!("{MEASURED}T0,tower,5,displacement_centre_minus_ends,0.4,mm,0.02,exact\n"));
    assert!(
        bent.len() == 1 && bent[0].contains("where left, centre and right make it 2.5e-3 mm")
            || bent[0].contains("make it 0.0025 mm"),
        "{bent:?}"
    );
    // Further than the wall is thick; read after it fell, which is a fault.
    let far = notes(&folder, &MEASURED.replacen("0.462,mm", "462,mm", 1));
    assert!(far.iter().any(|note| note.contains("more than the wall's thickness of 80 mm")), "{far:?}");
    fs::write(folder.path("odd.csv"), MEASURED.replacen("T0,tower,12.5,", "T0,tower,17.5,", 1)).unwrap();
    let refused = stderr(&ends_with(&folder, 3, &["check", "studies/tiny", "--measured", "odd.csv"]));
    assert!(refused.contains("odd.csv:15: tilt_deg 17.5 deg is above the collapse angle of T0"), "{refused}");
}

/// The overturning of a trapezoid about its foot, by its parts: a rectangle and triangles.
#[test]
fn a_wall_overturns_where_its_weight_passes_over_its_foot() {
    let angle = |from: &str, to: &str, towards: Direction| {
        let shape = TOWERS.replace("top_thickness_m = 0.08", "top_thickness_m = 0.04").replace(from, to);
        let folder = Folder::with_study(&shape);
        let study =
            Study::load(&folder.path("studies/tiny"), None).unwrap_or_else(|faults| panic!("{faults}")).study;
        degrees(study.arms[0].overturning_angle(towards))
    };
    // A rectangle of 40 and triangles of 40 by 200 in all: areas 8000 and 4000 mm2, centroids at 100 and 66.7 mm.
    let up = (8.0 * 100.0 + 4.0 * 200.0 / 3.0) / 12.0;
    let both = "battered_face = \"both\"";
    let near = |found: f64, along: f64, up: f64| {
        assert!((found - degrees(atan(along / up))).abs() < 1e-9, "{found} {along} {up}")
    };
    near(angle(both, both, Direction::YPlus), 40.0, up);
    // The vertical face 40 mm from the middle: the rectangle's centroid 20 mm from it, the triangle's 40 + 40 / 3.
    let from_vertical = (8.0 * 20.0 + 4.0 * (40.0 + 40.0 / 3.0)) / 12.0;
    near(angle(both, "battered_face = \"back\"", Direction::YPlus), from_vertical, up);
    near(angle(both, "battered_face = \"front\"", Direction::YPlus), 80.0 - from_vertical, up);
    near(angle(both, "battered_face = \"front\"", Direction::YMinus), from_vertical, up);
    near(angle(both, "battered_face = \"back\"\nturned = true", Direction::YPlus), 80.0 - from_vertical, up);
    near(angle(both, both, Direction::XMinus), 150.0, up);
    // A strip of 50 mm: its edge lies where the face has leaned in by 5 mm.
    near(
        angle("base = \"fixed\"", "base = \"strip\"\nstrip_height_m = 0.05", Direction::YPlus),
        35.0,
        up - 50.0,
    );
}
