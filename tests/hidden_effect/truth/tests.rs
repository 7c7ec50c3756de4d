//! Every effect does something, to what it says and not to the rest; and nobody looks where he must not.

use std::collections::BTreeMap;
use std::fs;

use pirca::ensemble::build;
use pirca::model::JointLaws;
use pirca::random::Streams;
use pirca::study::{DrawnJoints, Study};

use super::designs::{Design, FAMILIES, PER_FAMILY, order};
use super::effect::{Effect, Specimen};
use super::label::{Group, Label};
use super::readings::{Series, csv};
use super::roster::{root, roster};
use super::walls::{Laws, Way};

/// All that an effect can reach, on a wall between ropes that is not solved: its way is a made-up one.
fn reached(effects: &[Box<dyn Effect>]) -> [String; 5] {
    let loaded =
        Study::load(&root("studies/tilting-table"), None).unwrap_or_else(|faults| panic!("{faults}"));
    let study = effects.iter().fold(loaded.study, |study, effect| effect.study(study));
    let streams = Streams::new(study.seed, 0);
    let arm = &study.arms[2];
    let built = build(&study, 2, 0).unwrap_or_else(|fault| panic!("{fault}")).wall;
    let wall = effects.iter().fold(built, |wall, effect| effect.wall(wall, &streams));
    let base =
        DrawnJoints::new(&arm.joint, arm.kn_points[0], streams.clone()).altered(&arm.mechanisms, &wall);
    let laws = Laws::new(base, &wall, effects, streams);
    let blocks = wall.blocks.len() as u32;
    let pairs = (0..blocks).flat_map(|a| [(a, a + 1), (a, blocks)]);
    let laws: Vec<_> = pairs.map(|(a, b)| laws.of(a, b)).collect();
    let restraint = effects.iter().fold(arm.restraint, |restraint, effect| effect.restraint(restraint));
    let rests = [0.0, 0.1, 0.2, 0.3].map(|tilt| (tilt, [1.0, 1.1, 0.8].map(|x| 0.05 * x * tilt)));
    let way = Way { collapse: 0.31, rests: rests.to_vec() };
    let series: Vec<Series> = (0..FAMILIES.len() * PER_FAMILY)
        .map(|index| {
            let streams = Streams::new(3, index as u64);
            let specimen = Specimen { number: index as u64, order: order(index), streams };
            Series::of(&way, |x| arm.mechanisms.reading(x), effects, &specimen)
        })
        .collect();
    let rows = Design::Rich.rows(Some(&series), effects, &Streams::new(3, 0));
    [
        format!("{:?} {:?}", arm.layout, arm.mechanisms),
        format!("{wall:?}"),
        format!("{laws:?}"),
        format!("{restraint:?}"),
        csv(&rows),
    ]
}

#[test]
fn every_effect_does_something_and_the_same_each_time() {
    let without = reached(&[]);
    let mut seen: Vec<(String, bool)> = Vec::new();
    let labels = roster(&|_| 1.0, 1, &BTreeMap::new());
    let hiding = labels.iter().filter(|label| !matches!(label.group, Group::Nothing | Group::PriorWrong));
    for label in hiding.filter(|label| label.hidden.len() == 1) {
        let kind = (label.hidden[0].name.clone(), label.group == Group::OtherCode);
        if seen.contains(&kind) {
            continue;
        }
        let with = reached(&label.effects());
        let changed: Vec<bool> = with.iter().zip(&without).map(|(a, b)| a != b).collect();
        assert!(changed.contains(&true), "{kind:?} does nothing");
        if label.group == Group::Decoy {
            assert_eq!(changed, [false, false, false, false, true], "{kind:?}");
        }
        assert_eq!(with, reached(&label.effects()), "{kind:?}");
        seen.push(kind);
    }
    // 18 mechanisms, 13 of them twice, 3 laws, 14 unknown effects, 4 decoys.
    assert_eq!(seen.len(), 52);
}

#[test]
fn the_two_sides_do_not_know_each_other() {
    let code = |path: &str| {
        let text = fs::read_to_string(root("tests/hidden_effect").join(path)).expect("a source is text");
        text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
    };
    let mut folders = vec!["truth".to_owned()];
    let mut seen = 0;
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(root("tests/hidden_effect").join(&folder)).expect("the folder is there");
        for entry in entries {
            let name = entry.expect("it can be read").file_name().into_string().expect("a plain name");
            let path = format!("{folder}/{name}");
            if !name.ends_with(".rs") {
                folders.push(path);
            } else if path != "truth/tests.rs" {
                let text = code(&path);
                assert!(!text.contains("critic") && !text.contains("inference"), "{path} knows its judge");
                seen += 1;
            }
        }
    }
    assert!(seen > 12, "{seen} files were looked at");
    let text = code("hide.rs");
    assert!(!text.contains("critic") && !text.contains("inference"), "who hides knows the judge");
    let text = code("inference.rs");
    assert!(!text.contains("crate::"), "the inference knows of the test");
}

#[test]
fn a_label_reads_back_as_it_was_written() {
    let labels = roster(&|_| 0.05, 9, &BTreeMap::new());
    assert!(labels.iter().any(|label| label.group == Group::OtherCode));
    for label in labels {
        let text = serde_json::to_string(&label).expect("it has string keys only");
        let back: Label = serde_json::from_str(&text).expect("it is a label");
        assert_eq!(back, label);
    }
}
