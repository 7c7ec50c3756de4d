//! Walls from meshes and workbooks: a file for each stone, stones of any shape, tables of spreadsheets.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;

use serde_json::{Value, json};
use zip::write::SimpleFileOptions;

use crate::fixture::stderr;
use crate::walls::Folder;

const ASKED: [&str; 5] = ["--phi-deg", "70", "--load", "lateral", "--json"];

fn answer(folder: &Folder, wall: &str, more: &[&str]) -> Result<Value, String> {
    let output = folder.pirca(&[&["analyse", wall], &ASKED[..], more].concat());
    let told: Value = serde_json::from_slice(&output.stdout).map_err(|_| stderr(&output))?;
    if output.status.success() { Ok(told) } else { Err(told.to_string()) }
}

/// A box as PLY with x up, in millimetres, its faces looking anywhere.
fn ply([low, high]: [f64; 2]) -> String {
    let mut text =
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n\
                    element face 6\nproperty list uchar int vertex_indices\nend_header\n"
            .to_owned();
    for x in [low, high] {
        for (y, z) in [(0, 0), (500, 0), (500, 300), (0, 300)] {
            writeln!(text, "{x} {y} {z}").expect("text");
        }
    }
    text + "4 0 1 2 3\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
}

#[test]
fn a_folder_of_meshes_is_a_wall() {
    let folder = Folder::new();
    fs::create_dir(folder.path("stones")).expect("a folder");
    for (number, heights) in [[0.0, 200.0], [200.0, 400.0], [400.0, 600.0]].into_iter().enumerate() {
        fs::write(folder.path(&format!("stones/stone_{}.ply", number + 8)), ply(heights)).expect("written");
    }
    let told =
        answer(&folder, "stones", &["--unit", "mm", "--up", "x", "--out", "answer"]).expect("an answer");
    // 0.3 m deep and 0.6 m high.
    assert!((told["collapse_multiplier"].as_f64().expect("it falls") - 0.5).abs() < 2e-3, "{told}");
    assert_eq!((told["blocks"].as_u64(), told["joints"].as_u64()), (Some(4), Some(3)));
    assert_eq!(told["mechanism"].to_string(), "[8,9,10]");
    // What it wrote is the same wall.
    let again = answer(&folder, "answer/wall.json", &[]).expect("an answer");
    assert_eq!(again["collapse_multiplier"], told["collapse_multiplier"]);
    let output = folder.pirca(&["analyse", "stones", "--phi-deg", "70", "--study", "mine"]);
    let refused = stderr(&output);
    assert!(refused.contains("an arm reads one file"), "{refused}");
    fs::create_dir(folder.path("nothing")).expect("a folder");
    let empty = answer(&folder, "nothing", &[]).expect_err("no meshes");
    assert!(empty.contains("the folder has no meshes"), "{empty}");
    fs::write(folder.path("stones/stone_9.ply"), "ply\nformat ascii 1.0\n").expect("written");
    let spoilt = answer(&folder, "stones", &["--unit", "mm", "--up", "x"]).expect_err("a file that is cut");
    assert!(spoilt.contains("stone_9.ply"), "{spoilt}");
}

/// A box of 0.5 x 0.3 x 0.2 m as STL, whose top is dented in the middle by half its height.
fn dented() -> String {
    let (low, high) = ([[0.0, 0.0], [0.5, 0.0], [0.5, 0.3], [0.0, 0.3]], 0.2);
    let mut text = "solid dented\n".to_owned();
    let mut triangle = |corners: [[f64; 3]; 3]| {
        text += "facet normal 0 0 0\nouter loop\n";
        corners.iter().for_each(|[x, y, z]| writeln!(text, "vertex {x} {y} {z}").expect("text"));
        text += "endloop\nendfacet\n";
    };
    let at = |k: usize, z: f64| [low[k % 4][0], low[k % 4][1], z];
    triangle([at(0, 0.0), at(2, 0.0), at(1, 0.0)]);
    triangle([at(0, 0.0), at(3, 0.0), at(2, 0.0)]);
    for k in 0..4 {
        triangle([at(k, 0.0), at(k + 1, 0.0), at(k + 1, high)]);
        triangle([at(k, 0.0), at(k + 1, high), at(k, high)]);
        triangle([at(k, high), at(k + 1, high), [0.25, 0.15, 0.1]]);
    }
    text + "endsolid dented\n"
}

#[test]
fn a_concave_mesh_touches_as_its_hull_and_weighs_as_itself() {
    let folder = Folder::new();
    fs::write(folder.path("stone.stl"), dented()).expect("written");
    let told = answer(&folder, "stone.stl", &[]).expect("an answer");
    // The dent is a pyramid with a third of its base times its depth: a sixth of the box.
    let warnings = told["warnings"].to_string();
    assert!(
        warnings.contains("convex hull, which has 20.0 % more volume, and weighs as its mesh"),
        "{warnings}"
    );
    // It topples about its edge: half its depth over the height of its centroid, which the dent lowers.
    let centroid = (0.1 - 0.175 / 6.0) / (1.0 - 1.0 / 6.0);
    assert!(
        (told["collapse_multiplier"].as_f64().expect("it falls") - 0.15 / centroid).abs() < 2e-3,
        "{told}"
    );
    let parts = answer(&folder, "stone.stl", &["--parts"]).expect("an answer");
    assert!(parts["warnings"].to_string().contains("convex parts of one stone"), "{parts}");
    // A mesh with a hole weighs as its hull.
    let open = dented().replacen("facet normal", "facet  normal", 1);
    let first = open.find("facet  normal").expect("a facet");
    let end = open[first..].find("endfacet\n").expect("its end") + first + "endfacet\n".len();
    fs::write(folder.path("open.stl"), format!("{}{}", &open[..first], &open[end..])).expect("written");
    let told = answer(&folder, "open.stl", &[]).expect("an answer");
    assert!(told["warnings"].to_string().contains("does not close"), "{told}");
}

/// Three slabs of 0.5 x 0.3 m and 0.2 m high on each other as glTF: one mesh at three nodes, y up, its numbers in the file `bin`.
fn slabs(bin: &str) -> (Value, Vec<u8>) {
    let mut bytes = Vec::new();
    for y in [0.0_f32, 0.2] {
        for (x, z) in [(0.0_f32, 0.0_f32), (0.5, 0.0), (0.5, 0.3), (0.0, 0.3)] {
            [x, y, z].iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        }
    }
    let quads = [[0_u8, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]];
    quads.iter().for_each(|[a, b, c, d]| bytes.extend([a, b, c, a, c, d]));
    let nodes: Vec<Value> = ["ground", "lower", "upper"]
        .iter()
        .enumerate()
        .map(|(k, name)| json!({ "name": name, "mesh": 0, "translation": [0.0, 0.2 * k as f64, 0.0] }))
        .collect();
    let description = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 1, 2] }],
        "nodes": nodes,
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5121, "count": 36, "type": "SCALAR" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 96 },
            { "buffer": 0, "byteOffset": 96, "byteLength": 36 }
        ],
        "buffers": [{ "uri": bin, "byteLength": 132 }]
    });
    (description, bytes)
}

#[test]
fn a_scene_of_gltf_is_a_wall_with_the_files_beside_it() {
    let folder = Folder::new();
    let (scene, bytes) = slabs("more/its%20numbers.bin");
    fs::write(folder.path("slabs.gltf"), scene.to_string()).expect("written");
    let missing = answer(&folder, "slabs.gltf", &[]).expect_err("no numbers");
    assert!(missing.contains("buffer 0") && missing.contains("cannot be read"), "{missing}");
    fs::create_dir(folder.path("more")).expect("a folder");
    fs::write(folder.path("more/its numbers.bin"), bytes).expect("written");
    let told = answer(&folder, "slabs.gltf", &[]).expect("an answer");
    // The two upper ones move, 0.3 m deep and 0.4 m high.
    assert!((told["collapse_multiplier"].as_f64().expect("it falls") - 0.75).abs() < 2e-3, "{told}");
    assert_eq!((told["blocks"].as_u64(), told["joints"].as_u64()), (Some(3), Some(2)));
    assert_eq!(told["mechanism"].to_string(), "[1,2]");
    // With the file's x up they lie beside each other, held on one side by friction alone.
    let lying = answer(&folder, "slabs.gltf", &["--up", "x"]).expect("an answer");
    assert_eq!(lying["outcome"], "unstable_at_rest", "{lying}");
    assert!(lying["warnings"].to_string().contains("ask with --up y"), "{lying}");
    // The copy in a study has the numbers in it.
    let output = folder.pirca(&["analyse", "slabs.gltf", "--phi-deg", "70", "--study", "mine"]);
    assert!(output.status.success(), "{}", stderr(&output));
    fs::remove_dir_all(folder.path("more")).expect("removed");
    let copied = answer(&folder, "mine/slabs.gltf", &[]).expect("an answer");
    assert_eq!(copied["collapse_multiplier"], told["collapse_multiplier"]);
    for bin in ["../its.bin", "/its.bin", "http://a.org/its.bin"] {
        fs::write(folder.path("away.gltf"), slabs(bin).0.to_string()).expect("written");
        let away = answer(&folder, "away.gltf", &[]).expect_err("elsewhere");
        assert!(away.contains("a file in the folder of the .gltf file"), "{bin}: {away}");
    }
}

#[test]
fn a_written_animation_is_the_wall_as_it_was_built() {
    let folder = Folder::new();
    fs::create_dir(folder.path("stones")).expect("a folder");
    for (number, heights) in [[0.0, 200.0], [200.0, 400.0], [400.0, 600.0]].into_iter().enumerate() {
        fs::write(folder.path(&format!("stones/stone_{number}.ply")), ply(heights)).expect("written");
    }
    let told = answer(&folder, "stones", &["--unit", "mm", "--up", "x", "--out", "answer"]);
    let told = told.expect("an answer");
    let again = answer(&folder, "answer/wall.glb", &[]).expect("an answer");
    let [one, other] = [&told, &again].map(|own| own["collapse_multiplier"].as_f64().expect("it falls"));
    assert!((one - other).abs() < 1e-6, "{one} {other}");
    // The platform is held there by the name of its material.
    assert_eq!((again["blocks"].as_u64(), again["joints"].as_u64()), (Some(4), Some(3)));
    assert_eq!(again["mechanism"].to_string(), "[0,1,2]");
}

/// A slab on its base, by commands of two versions of 3DEC, and one on it by its faces, which run clockwise seen from outside.
const THREE_DEC: &str = "; three slabs\nnew\n\
poly brick 0,0.5 0,0.3 -0.2,0 region 1\n\
block create prism face-1 (0 0 0) (0.5 0 0) (0.5 0.3 0) (0 0.3 0) ...\n  face-2 (0 0 0.2) (0.5 0 0.2) (0.5 0.3 0.2) (0 0.3 0.2) region 2\n\
poly region 2 face 0,0,.2 .5,0,.2 .5,.3,.2 0,.3,.2 &\n face 0,0,.4 0,.3,.4 .5,.3,.4 .5,0,.4 &\n face 0,0,.2 0,0,.4 .5,0,.4 .5,0,.2 &\n\
 face .5,0,.2 .5,0,.4 .5,.3,.4 .5,.3,.2 face .5,.3,.2 .5,.3,.4 0,.3,.4 0,.3,.2 face 0,.3,.2 0,.3,.4 0,0,.4 0,0,.2\n\
prop mat 1 dens 2400\ngravity 0 0 -9.81\nfix region 1\nhist unbal\nreturn\n";

#[test]
fn blocks_of_3dec_are_a_wall_that_its_fix_holds() {
    let folder = Folder::new();
    fs::write(folder.path("slabs.3ddat"), THREE_DEC).expect("written");
    let told = answer(&folder, "slabs.3ddat", &[]).expect("an answer");
    // 0.3 m deep and 0.4 m high.
    assert!((told["collapse_multiplier"].as_f64().expect("it falls") - 0.75).abs() < 2e-3, "{told}");
    assert_eq!((told["blocks"].as_u64(), told["joints"].as_u64()), (Some(3), Some(2)));
    assert_eq!(told["mechanism"].to_string(), "[1,2]");
    let warnings = told["warnings"].to_string();
    assert!(warnings.contains("3 commands that make no blocks were passed over: gravity (1)"), "{warnings}");
    assert!(!warnings.contains("hull") && !warnings.contains("may hold"), "{warnings}");
    fs::write(folder.path("ids.DAT"), THREE_DEC.replace("fix region 1", "fix range id 1")).expect("written");
    let told = answer(&folder, "ids.DAT", &["--fixed", "0"]).expect("an answer");
    assert!(told["warnings"].to_string().contains("line 12 (fix range id 1)"), "{told}");
    assert_eq!(told["mechanism"].to_string(), "[1,2]");
    fs::write(folder.path("cut.3ddat"), THREE_DEC.replace("hist unbal", "jset dip 30")).expect("written");
    let refused = answer(&folder, "cut.3ddat", &[]).expect_err("blocks that are cut");
    assert!(refused.contains("jset dip 30") && refused.contains("\"line\":13"), "{refused}");
}

/// A workbook of one sheet.
fn workbook(rows: &[&[&str]]) -> Vec<u8> {
    let mut sheet = String::new();
    for (r, row) in (1..).zip(rows) {
        write!(sheet, "<row r=\"{r}\">").expect("text");
        for (column, cell) in ('A'..).zip(row.iter()) {
            match cell.parse::<f64>() {
                Ok(number) => write!(sheet, "<c r=\"{column}{r}\"><v>{number}</v></c>"),
                Err(_) => write!(sheet, "<c r=\"{column}{r}\" t=\"inlineStr\"><is><t>{cell}</t></is></c>"),
            }
            .expect("text");
        }
        sheet += "</row>";
    }
    let main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
    let relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let package = "http://schemas.openxmlformats.org/package/2006";
    let files = [
        (
            "[Content_Types].xml",
            format!(
                "<Types xmlns=\"{package}/content-types\"><Default Extension=\"xml\" ContentType=\"application/xml\"/></Types>"
            ),
        ),
        (
            "_rels/.rels",
            format!(
                "<Relationships xmlns=\"{package}/relationships\"><Relationship Id=\"r1\" Type=\"{relations}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/workbook.xml",
            format!(
                "<workbook xmlns=\"{main}\" xmlns:r=\"{relations}\"><sheets><sheet name=\"North\" sheetId=\"1\" r:id=\"r1\"/></sheets></workbook>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels",
            format!(
                "<Relationships xmlns=\"{package}/relationships\"><Relationship Id=\"r1\" Type=\"{relations}/worksheet\" Target=\"worksheets/sheet1.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/worksheets/sheet1.xml",
            format!("<worksheet xmlns=\"{main}\"><sheetData>{sheet}</sheetData></worksheet>"),
        ),
    ];
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, text) in files {
        zip.start_file(name, SimpleFileOptions::default()).expect("begun");
        zip.write_all(text.as_bytes()).expect("written");
    }
    zip.finish().expect("a workbook").into_inner()
}

#[test]
fn a_workbook_is_read_as_its_table() {
    let folder = Folder::new();
    let rows: [&[&str]; 6] = [
        &["North wall"],
        &["Stone", "x (cm)", "z (cm)", "Length (cm)", "Height (cm)"],
        &["A", "0", "0", "50", "20"],
        &["B", "0", "20.4", "50", "19.6"],
        &["C", "0", "40.2", "50", "19.8"],
        &["Sum", "", "", "", "59.4"],
    ];
    fs::write(folder.path("wall.xlsx"), workbook(&rows)).expect("written");
    let csv: Vec<String> = rows.iter().map(|row| row.join(";")).collect();
    fs::write(folder.path("wall.csv"), csv.join("\n")).expect("written");
    let more = ["--thickness", "30cm", "--mend", "1cm"];
    let (one, other) = (answer(&folder, "wall.xlsx", &more), answer(&folder, "wall.csv", &more));
    let (one, other) = (one.expect("an answer"), other.expect("an answer"));
    assert_eq!(one["collapse_multiplier"], other["collapse_multiplier"]);
    assert!((one["collapse_multiplier"].as_f64().expect("it falls") - 0.5).abs() < 2e-3, "{one}");
    fs::write(folder.path("wall.xlsx"), "no workbook").expect("written");
    let said = answer(&folder, "wall.xlsx", &more).expect_err("a text");
    assert!(said.contains("workbook"), "{said}");
}
