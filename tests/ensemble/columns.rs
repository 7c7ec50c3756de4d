//! The columns of a run's tables: each is documented, each that is documented occurs, and CSV, Parquet and schema have the same ones.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};

use polars_io::SerReader;
use polars_io::prelude::ParquetReader;
use serde_json::Value;

use crate::fixture::{Folder, STUDY, stderr};
use crate::loads::{BASE_MOTION, LATERAL, SHEAR, TILTING, loaded};

/// Water that rises behind walls.
const RETAINING: &str = "protocol = \"retaining\"\nretained = \"water\"\nlifts = 4\nbracket_share = 0.01";

/// Studies of every kind.
fn studies() -> Vec<String> {
    let uncertain = "\n[uncertain]\n\"joint.phi_deg\" = { family = \"uniform\", low = 30, high = 40 }\n";
    // One stone a course, held at its sides by two blocks that need not press on it.
    let between_blocks = |load: &str| {
        loaded(load, "name = \"limit\"")
            .replace("ends = \"free\"", "ends = \"fixed_end_blocks\"")
            .replace("height_m = 0.3\n", "height_m = 0.6\n")
            .replace("length_m = 0.8\n", "length_m = 0.2\n")
    };
    let heavy =
        |shear: &str| shear.replace("2e3", "2e4").replace("0.32", "0.92").replace("\"turns\"", "\"level\"");
    let without_phi_variant = |text: String| text[..text.find("[[variant]]").expect("a variant")].to_owned();
    vec![
        STUDY.to_owned(),
        // A wall that a push brings down, by limit analysis, and a tilt.
        loaded(&LATERAL.replace("200", "5000"), "name = \"limit\""),
        loaded(&LATERAL.replace("200", "5000"), "name = \"limit\"\nflow = \"non-associative\""),
        loaded(TILTING, "name = \"limit\"\nflow = \"non-associative\""),
        loaded(&format!("{TILTING}\nremainders = true"), "name = \"implicit\"\nagreement = true"),
        loaded(SHEAR, "name = \"implicit\""),
        // Tall stacks that a heavy beam presses: friction between them takes thrust that only the push brings about.
        loaded(&heavy(SHEAR), "name = \"limit\"").replace("height_m = 0.3\n", "height_m = 0.9\n"),
        // Walls too thin to hold water up to their tops.
        loaded(RETAINING, "name = \"limit\"")
            .replace("= 0.2\ntop_thickness_m = 0.16", "= 0.09\ntop_thickness_m = 0.07"),
        loaded(BASE_MOTION, "name = \"explicit\""),
        between_blocks(
            "protocol = \"tilting\"\ntowards = \"y+\"\nstep_deg = 4\nbracket_deg = 0.5\nend_deg = 40",
        ),
        between_blocks(&LATERAL.replace("200", "4000")),
        without_phi_variant(STUDY.to_owned()) + uncertain,
    ]
}

/// Heads and lines of a table.
fn table(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    // No cell holds a comma but the last one, which says why a value is left open.
    let mut lines = text.lines();
    let heads: Vec<String> = lines.next().expect("heads").split(',').map(str::to_owned).collect();
    let cells = |line: &str| line.splitn(heads.len(), ',').map(str::to_owned).collect();
    (heads.clone(), lines.map(cells).collect())
}

/// The documented columns of each table with their types.
fn documented() -> BTreeMap<String, Vec<(String, String)>> {
    let folder = Folder::with_study(STUDY);
    let output = folder.pirca(&["reference", "columns"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut tables = BTreeMap::new();
    for part in text.split("\n\n").filter(|part| part.contains(".parquet, ")) {
        let mut lines = part.lines();
        let name = lines.next().expect("a head").split('.').next().expect("a name").to_owned();
        let column = |line: &str| {
            // A name of two words is followed by at least two blanks, like all others.
            let (name, rest) = line.trim_start().split_once("  ").expect("columns");
            let words: Vec<&str> = rest.split_whitespace().collect();
            assert!(words.len() > 4 && words[0].len() < 6, "unit, type and meaning: {line}");
            (name.to_owned(), words[1].to_owned())
        };
        tables.insert(name, lines.map(column).collect());
    }
    tables
}

#[test]
fn every_column_that_a_study_writes_is_documented_and_every_documented_one_occurs() {
    let documented = documented();
    assert_eq!(documented.keys().collect::<Vec<_>>(), ["members", "steps"]);
    let mut filled: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for (number, study) in studies().into_iter().enumerate() {
        let folder = Folder::with_study(&study);
        let members = if study.contains("[uncertain]") { "16" } else { "3" };
        let arguments = ["run", "studies/tiny", "--members", members, "--out", "out", "--csv"];
        let output = folder.pirca(&arguments);
        assert!(output.status.success(), "study {number}: {}", stderr(&output));
        for name in ["members", "steps"] {
            let read =
                |ending: &str| fs::read_to_string(folder.path(format!("out/{name}.{ending}"))).unwrap();
            let (heads, lines) = table(&read("csv"));
            let parquet = ParquetReader::new(File::open(folder.path(format!("out/{name}.parquet"))).unwrap());
            let parquet = parquet.finish().unwrap();
            let own: Vec<String> =
                parquet.schema().iter_names_cloned().map(|name| name.to_string()).collect();
            assert_eq!((&own, parquet.height()), (&heads, lines.len()), "study {number}");
            let schema: Value = serde_json::from_str(&read("schema.json")).unwrap();
            let fields = schema["fields"].as_array().expect("fields");
            for (head, field) in heads.iter().zip(fields) {
                assert_eq!(field["name"], head.as_str());
                let known = if head.starts_with("drawn ") { "drawn KEY" } else { head };
                let of = documented[name].iter().find(|(name, _)| name == known);
                let (_, kind) = of.unwrap_or_else(|| panic!("{head} of {name} is not documented"));
                assert_eq!(field["type"], kind.as_str(), "{head}");
            }
            assert_eq!(fields.len(), heads.len());
            for line in &lines {
                let full = heads.iter().zip(line).filter(|(_, cell)| !cell.is_empty());
                filled.entry(name).or_default().extend(full.map(|(head, _)| head.clone()));
                for (field, cell) in fields.iter().zip(line).filter(|(_, cell)| !cell.is_empty()) {
                    let fits = match field["type"].as_str() {
                        Some("integer") => cell.parse::<u64>().is_ok(),
                        Some("number") => cell.parse::<f64>().is_ok(),
                        _ => true,
                    };
                    assert!(fits, "{field}: {cell}");
                }
            }
        }
    }
    for (name, columns) in &documented {
        for (column, _) in columns {
            let occurs = match column.strip_suffix("KEY") {
                Some(stem) => filled[name.as_str()].iter().any(|own| own.starts_with(stem)),
                None => filled[name.as_str()].contains(column),
            };
            assert!(occurs, "{column} of {name} is documented, and no study brings a value");
        }
    }
}

#[test]
fn a_csv_has_the_numbers_of_the_parquet_to_the_last_bit() {
    let folder = Folder::with_study(STUDY);
    assert!(
        folder.pirca(&["run", "studies/tiny", "--members", "3", "--out", "out", "--csv"]).status.success()
    );
    let (heads, lines) = table(&fs::read_to_string(folder.path("out/members.csv")).unwrap());
    let at = heads.iter().position(|head| head == "top_displacement_m").expect("the column");
    let parquet =
        ParquetReader::new(File::open(folder.path("out/members.parquet")).unwrap()).finish().unwrap();
    let wanted: Vec<Option<f64>> =
        parquet.column("top_displacement_m").unwrap().f64().unwrap().iter().collect();
    assert_eq!(lines.iter().map(|line| line[at].parse().ok()).collect::<Vec<_>>(), wanted);
}
