//! Assemblies of COMPAS, and concave blocks in convex parts: read, fixed by their ids, solved.

use std::fs;

use serde_json::{Value, json};

use crate::fixture::stderr;
use crate::walls::Folder;

/// A prism of 1 m along y over an outline in x and z, which runs clockwise seen along y, as a mesh of COMPAS.
fn prism(outline: &[[f64; 2]]) -> Value {
    let n = outline.len();
    let mut vertices = serde_json::Map::new();
    for (k, y) in [0.0, 1.0].into_iter().enumerate() {
        for (i, [x, z]) in outline.iter().enumerate() {
            vertices.insert((k * n + i).to_string(), json!({ "x": x, "y": y, "z": z }));
        }
    }
    let mut faces = serde_json::Map::new();
    faces.insert("0".to_owned(), json!((0..n).collect::<Vec<_>>()));
    faces.insert("1".to_owned(), json!((n..2 * n).rev().collect::<Vec<_>>()));
    for i in 0..n {
        let next = (i + 1) % n;
        faces.insert((2 + i).to_string(), json!([i, i + n, next + n, next]));
    }
    json!({ "dtype": "compas_assembly.datastructures/Block", "data": { "vertex": vertices, "face": faces } })
}

fn assembly(blocks: &[(&str, Value)], key: &str) -> String {
    let nodes: serde_json::Map<String, Value> =
        blocks.iter().map(|(id, block)| ((*id).to_owned(), json!({ "block": block }))).collect();
    let text = json!({
        "dtype": "compas_assembly.datastructures/Assembly",
        key: { "graph": { "dtype": "compas.datastructures/Graph", key: { "node": nodes } } },
    });
    text.to_string()
}

/// A ground with an upright at each end (a frame, concave), and a block that stands on it: 0.5 m wide and 1 m high.
fn frame() -> [(&'static str, Value); 2] {
    let outline =
        [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.8, 2.0], [2.8, 0.2], [0.2, 0.2], [0.2, 2.0], [0.0, 2.0]];
    [("1", prism(&[[1.0, 0.2], [1.5, 0.2], [1.5, 1.2], [1.0, 1.2]])), ("0", prism(&outline))]
}

fn analysed(text: &str, more: &[&str]) -> Result<Value, String> {
    let folder = Folder::new();
    fs::write(folder.path("wall.json"), text).expect("written");
    let asked = [
        &["analyse", "wall.json", "--phi-deg", "40", "--load", "lateral", "--direction", "x+", "--json"],
        more,
    ]
    .concat();
    let output = folder.pirca(&asked);
    let told: Value = serde_json::from_slice(&output.stdout).map_err(|_| stderr(&output))?;
    if output.status.success() { Ok(told) } else { Err(told.to_string()) }
}

fn multiplier(told: &Value) -> f64 {
    told["collapse_multiplier"].as_f64().expect("it falls")
}

#[test]
fn an_assembly_with_a_concave_support_is_divided_fixed_and_solved() {
    let text = assembly(&frame(), "data");
    let told = analysed(&text, &["--parts", "--fixed", "0"]).expect("an answer");
    // It topples over its edge: half its width over half its height.
    assert!((multiplier(&told) - 0.5).abs() < 1e-3, "{told}");
    // The frame in three parts, and the block.
    assert_eq!((told["blocks"].as_u64(), &told["mechanism"]), (Some(4), &json!([1])));
    assert!(told["warnings"].to_string().contains("block 0: concave; taken as 3 convex parts of one stone"));
}

#[test]
fn what_an_assembly_lacks_is_told_with_what_to_do() {
    let text = assembly(&frame(), "data");
    let whole = analysed(&text, &["--fixed", "0"]).expect_err("concave");
    assert!(whole.contains("not convex") && whole.contains("--parts"), "{whole}");
    let loose = analysed(&text, &["--parts"]).expect_err("nothing is fixed");
    assert!(loose.contains("there is no support") && loose.contains("--fixed"), "{loose}");
    let unknown = analysed(&text, &["--parts", "--fixed", "7"]).expect_err("no such block");
    assert!(unknown.contains("there is no block with the id 7") && unknown.contains("0, 1"), "{unknown}");
    let cut = analysed(&text[..text.len() / 2], &["--fixed", "0"]).expect_err("cut off");
    assert!(cut.contains("truncated"), "{cut}");
}

#[test]
fn older_assemblies_and_other_units_are_read() {
    let text = assembly(&frame(), "value");
    let told =
        analysed(&text, &["--parts", "--fixed", "0", "--density-kg-per-m3", "2600"]).expect("an answer");
    assert!((multiplier(&told) - 0.5).abs() < 1e-3);
    let small = analysed(&text, &["--parts", "--fixed", "0", "--unit", "cm"]).expect("an answer");
    assert!((multiplier(&small) - multiplier(&told)).abs() < 1e-6);
}
