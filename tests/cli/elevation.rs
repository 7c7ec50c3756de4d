//! An elevation as a table: what of a sketch is read, what is passed over, and what is wrong with a row.

use std::fs;

use serde_json::{Value, json};

use crate::fixture::stderr;
use crate::walls::Folder;

/// A column of three stones as a mason writes it down: 0.5 m long, 0.2 m high, measured 4 mm apart.
const COLUMN: &str = "North wall, 12 May\n\nStone;x (cm);z (cm);Length (cm);Height (cm);remark\n\
    A;0;0;50;20;\nB;0;20,4;50;19,6;cracked\n;;;;;second lift\nC;0;40,2;50;19,8;\nSum;;;;59,4;\n";

fn asked(text: &str, more: &[&str]) -> Result<Value, String> {
    let folder = Folder::new();
    fs::write(folder.path("wall.csv"), text).expect("written");
    let command = [&["analyse", "wall.csv", "--phi-deg", "40", "--load", "lateral", "--json"], more].concat();
    let output = folder.pirca(&command);
    let told: Value = serde_json::from_slice(&output.stdout).map_err(|_| stderr(&output))?;
    if output.status.success() { Ok(told) } else { Err(told.to_string()) }
}

#[test]
fn a_sketch_stands_on_the_ground_and_topples_over_its_edge() {
    let told = asked(COLUMN, &["--thickness", "30cm", "--mend", "1cm"]).expect("an answer");
    // 0.3 m deep and 0.6 m high: half the depth over half the height.
    assert!((told["collapse_multiplier"].as_f64().expect("it falls") - 0.5).abs() < 2e-3, "{told}");
    // The platform and three stones.
    assert_eq!((told["blocks"].as_u64(), told["joints"].as_u64()), (Some(4), Some(3)));
    let warnings = told["warnings"].to_string();
    assert!(warnings.contains("2 line(s) of the table are no stones"), "{warnings}");
    assert!(warnings.contains("density of 3 object(s) not stated"), "{warnings}");
    assert!(!warnings.contains("no unit is said"), "{warnings}");
}

#[test]
fn gaps_of_a_sketch_are_told_where_they_are_not_mended() {
    let told = asked(COLUMN, &["--thickness", "30cm"]).expect_err("it floats");
    assert!(told.contains("stone B and stone C, are 2 mm apart"), "{told}");
}

#[test]
fn depth_dip_and_density_of_each_stone_are_read() {
    let text =
        "name,x,z,length,height,depth,dip,density\n1,0,0,0.5,0.2,0.4,0,2000\n2,0,0.2,0.5,0.4,0.2,0,2600\n";
    let told = asked(text, &[]).expect("an answer");
    // The upper stone, 0.2 m deep and 0.4 m high, topples alone: half the depth over half the height.
    assert!((told["collapse_multiplier"].as_f64().expect("it falls") - 0.5).abs() < 1e-3, "{told}");
    assert_eq!(told["mechanism"], json!([1]));
    assert!(
        told["warnings"]
            .to_string()
            .contains("no unit is said of x, z, length, height, depth: metres are taken")
    );
    let leaning = asked(&text.replace("0.2,0,2600", "0.2,3,2600"), &[]);
    assert_ne!(
        leaning.map(|own| own["collapse_multiplier"].clone()),
        Ok(told["collapse_multiplier"].clone())
    );
}

#[test]
fn what_a_row_lacks_is_told_with_its_line() {
    let deep = asked(COLUMN, &[]).expect_err("no depth");
    assert!(deep.contains("nothing says how deep it is") && deep.contains("--thickness 45cm"), "{deep}");
    let cut = asked(&COLUMN.replace("50;19,6", "half a metre;19,6"), &["--thickness", "30cm"])
        .expect_err("no length");
    assert!(cut.contains("stone B") && cut.contains("length is") && cut.contains("\"line\":5"), "{cut}");
    let thin = asked(&COLUMN.replace(";19,6;", ";-19,6;"), &["--thickness", "30cm"]).expect_err("below 0");
    assert!(thin.contains("its height is"), "{thin}");
    let headless = asked("0,0,0.5,0.2\n0,0.2,0.5,0.2\n", &[]).expect_err("no head");
    assert!(headless.contains("no line names the columns"), "{headless}");
    let empty = asked("x,z,length,height\n", &["--thickness", "30cm"]).expect_err("no stones");
    assert!(empty.contains("the table has no stones"), "{empty}");
}
