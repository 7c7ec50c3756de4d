//! A capacity whose walls are evaluated as shards of batches ends with the files of one that evaluated them by itself.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::fixture::{Folder, stderr};
use crate::kill::columns;

const RESULTS: [&str; 8] = [
    "capacity.json",
    "probability.svg",
    "probability.csv",
    "evaluations.parquet",
    "draws.jsonl",
    "members.parquet",
    "steps.parquet",
    "manifest.json",
];

const ASKED: [&str; 8] =
    ["capacity", "studies/tiny", "--below-deg", "18.8", "--members", "64", "--walls", "1500"];

fn answer(folder: &Folder, more: &[&str]) -> Value {
    let output = folder.pirca(&[&ASKED[..], more, &["--json"]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Asks, computes the batches that it waits for as so many shards each, and asks again. Gives the number of batches.
fn batched(folder: &Folder, more: &[&str], shards: u32) -> usize {
    for batches in 0.. {
        let waiting = answer(folder, &[more, &["--batches", "--out", "batched"]].concat());
        let Some(batch) = waiting["batch"].as_str() else { return batches };
        assert!(waiting["walls"].as_u64().unwrap() > 0 && Path::new(batch).is_relative(), "{waiting}");
        // Asked again before it is complete, it waits for the same.
        if batches == 0 {
            let again = answer(folder, &[more, &["--batches", "--out", "batched"]].concat());
            assert_eq!(again, waiting);
        }
        for index in (0..shards).rev().map(|index| index.to_string()) {
            let of = shards.to_string();
            let output =
                folder.pirca(&["shards", "run", batch, "--index", &index, "--of", &of, "--threads", "2"]);
            assert!(output.status.success(), "{}", stderr(&output));
        }
        if batches == 0 {
            let merged = folder.pirca(&["shards", "merge", batch]);
            assert!(merged.status.success(), "{}", stderr(&merged));
        }
    }
    unreachable!()
}

#[test]
fn batches_end_with_the_files_of_one_machine() {
    let folder = Folder::with_study(&columns());
    for (method, most, shards) in [
        (&["--method", "plain"], 4, 3),
        (&["--method", "importance"], 4, 2),
        (&["--method", "subset"], 60, 1),
    ] {
        let whole = answer(&folder, &[&method[..], &["--out", "whole"]].concat());
        assert!(whole["batch"].is_null());
        let batches = batched(&folder, &method[..], shards);
        assert!((1..=most).contains(&batches), "{method:?}: {batches} batches");
        for name in RESULTS {
            let [own, wanted] =
                ["batched", "whole"].map(|out| fs::read(folder.path(out).join(name)).unwrap());
            assert!(own == wanted, "{method:?}: {name}");
        }
        ["batched", "whole"].iter().for_each(|out| fs::remove_dir_all(folder.path(out)).unwrap());
    }
}

#[test]
fn what_does_not_go_with_batches_is_told() {
    let folder = Folder::with_study(&columns());
    let said = |arguments: &[&str], code: i32, words: &str| {
        let output = folder.pirca(arguments);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        assert!(stderr(&output).contains(words), "{words}: {}", stderr(&output));
    };
    said(&["capacity", "studies/tiny", "--batches"], 2, "--walls");
    said(
        &["capacity", "studies/tiny", "--batches", "--walls", "200"],
        2,
        "--batches: it is for the walls of a level",
    );
    let waiting = answer(&folder, &["--batches", "--method", "plain", "--out", "out"]);
    let batch = waiting["batch"].as_str().unwrap();
    said(&["shards", "run", batch, "--index", "0", "--of", "2", "--seed", "4"], 2, "--seed is for a study");
    said(
        &["shards", "run", batch, "--index", "0", "--of", "2", "--out", "o"],
        2,
        "--out: the shards of a batch lie in its own folder",
    );
    let output = folder.pirca(&["shards", "run", batch, "--index", "0", "--of", "2"]);
    assert!(output.status.success(), "{}", stderr(&output));
    said(&["shards", "merge", batch], 1, "1 of 2 shards are missing: 1");
    // The study has changed since.
    folder.write_study(&columns().replace("high = 5", "high = 6"));
    said(&["shards", "run", batch, "--index", "1", "--of", "2"], 1, "dip_deg");
    fs::write(folder.path(batch).join("batch.json"), "{").unwrap();
    said(&["shards", "run", batch, "--index", "1", "--of", "2"], 1, "batch.json is damaged");
}
