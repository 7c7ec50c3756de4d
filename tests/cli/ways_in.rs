//! Which verb takes what: walls that are drawn, numbers that nobody knows exactly, a base that shakes, elements, walls from files. Each cell works,
//! or says which fact is in the way; the table of the manual says the same.

use std::fs;
use std::path::Path;

use crate::fixture::{Folder, stderr};
use crate::loads::{BASE_MOTION, TILTING, loaded};

/// What becomes of a verb on a kind of study: it works, or its message states a fact.
enum Cell {
    Works,
    Lacks(&'static str),
}
use Cell::{Lacks, Works};

const NO_WALL: Cell = Lacks("no wall to draw");

/// Verb, its arguments behind the study, and its cells: drawn walls, `[uncertain]`, base motion, elements, a wall from a file.
const TABLE: &[(&str, &str, [Cell; 5])] = &[
    ("check", "", [Works, Works, Works, Works, Works]),
    ("init", "copy --from", [Works, Works, Works, Works, Works]),
    ("run", "--out out", [Works, Works, Works, Works, Works]),
    ("report", "--out out", [Works, Works, Lacks("takes a wall another way"), Works, Works]),
    (
        "capacity",
        "--quantile 0.2 --out out",
        [Works, Works, Lacks("falls somewhere between two intensities"), NO_WALL, Works],
    ),
    ("compare", "--walls 20 --out out", [Works, Works, Works, NO_WALL, Works]),
    ("sensitivity", "--arm random --points 32 --out out", [Works, Works, Works, NO_WALL, Works]),
    ("plan-tests", "--specimens 4 --out out", [Works, Works, Works, NO_WALL, Works]),
    (
        "homogenise",
        "--arms random --cells 2 --stones 2",
        [Works, Works, Works, NO_WALL, Lacks("they repeat in no direction")],
    ),
    (
        "shards run",
        "--index 0 --of 2 --out out",
        [Works, Works, Works, Lacks("compares types of elements"), Works],
    ),
    ("wall", "--arm random --out wall.obj", [Works, Works, Works, NO_WALL, Works]),
    ("wall", "--arm random --out wall.svg", [Works, Works, Works, NO_WALL, Works]),
    (
        "init --measured",
        "measured.csv --specimens 2",
        [Works, Works, Lacks("is read on walls at rest"), NO_WALL, Works],
    ),
];

/// A course of four stones at one stiffness, few walls.
fn small(load: &str, solver: &str) -> String {
    let text = loaded(load, solver).replace("height_m = 0.3\n", "height_m = 0.1\n");
    let text = text.replace("[5e7, 1.75e8]", "[5e7]").replace("members = 8", "members = 4");
    let end = text.find("[[variant]]").expect("a variant");
    text[..end].replace("top_thickness_m = 0.16", "top_thickness_m = 0.2")
}

/// The study of each column, by its title in the manual.
fn studies() -> [(&'static str, String); 5] {
    let drawn = small(TILTING, "name = \"limit\"");
    let uncertain = "\n[uncertain]\n\"joint.phi_deg\" = { family = \"uniform\", low = 30, high = 40 }\n";
    let elements = include_str!("../../studies/element-types/study.toml");
    let from = |name: &str| elements.find(&format!("[[element]]\nname = \"{name}\"")).expect("an element");
    let end = drawn.find("\n[[arm]]").expect("an arm");
    let head = drawn[..drawn.find("[wall]").expect("a wall")].to_owned()
        + &drawn[drawn.find("[joint]").expect("joints")..end];
    let file = |name: &str| {
        format!(
            "\n[[arm]]\nname = \"{name}\"\nmembers = 4\narrangement = \"file\"\nfile = \"wall.json\"\njoint.phi_deg = {{ family = \"uniform\", low = 20, high = 40 }}\n"
        )
    };
    [
        ("walls that are drawn", drawn.clone()),
        ("`[uncertain]`", drawn.clone() + uncertain),
        ("base motion", small(BASE_MOTION, "name = \"explicit\"")),
        (
            "elements",
            elements[..from("aligned-spheres")].to_owned()
                + &elements[from("aligned-spheres")..from("sphere-cloud")],
        ),
        ("walls from files", head + &file("random") + &file("other")),
    ]
}

#[test]
fn every_verb_takes_every_kind_of_study_or_says_which_fact_is_in_the_way() {
    for (column, (title, text)) in studies().into_iter().enumerate() {
        for (verb, more, cells) in TABLE {
            let folder = Folder::with_study(&small(TILTING, "name = \"limit\""));
            let written = folder.pirca(&[
                "wall",
                "studies/tiny",
                "--arm",
                "random",
                "--with-base",
                "--out",
                "studies/tiny/wall.json",
            ]);
            assert!(written.status.success(), "{}", stderr(&written));
            folder.write_study(&text);
            let more: Vec<&str> = more.split_whitespace().collect();
            let command = match *verb {
                "init" => [&["init"][..], &more, &["studies/tiny"]].concat(),
                verb => [&verb.split(' ').collect::<Vec<_>>(), &["studies/tiny"][..], &more].concat(),
            };
            let output = folder.pirca(&command);
            let said = stderr(&output);
            match &cells[column] {
                Works => assert!(output.status.success(), "{title}: {command:?}: {said}"),
                Lacks(fact) => {
                    assert!(!output.status.success() && said.contains(fact), "{title}: {command:?}: {said}");
                }
            }
        }
    }
}

#[test]
fn the_manual_has_the_same_table() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/studies.md");
    let text = fs::read_to_string(page).expect("the page");
    let titles = studies().map(|(title, _)| title).join(" | ");
    assert!(text.contains(&format!("| | {titles} |")), "{titles}");
    for (verb, _, cells) in TABLE {
        let row = text.lines().find(|line| line.starts_with(&format!("| `{verb}` |")));
        let row = row.unwrap_or_else(|| panic!("{verb} has no row"));
        let stated: Vec<&str> =
            row.split('|').skip(2).map(str::trim).filter(|cell| !cell.is_empty()).collect();
        assert_eq!(stated.len(), cells.len(), "{row}");
        for (cell, stated) in cells.iter().zip(stated) {
            assert_eq!(matches!(cell, Works), stated == "yes", "{row}");
        }
    }
}
