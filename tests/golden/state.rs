//! A file as lines that are read beside one another: a number that changed is one line that changed.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;
use sha2::{Digest, Sha256};

/// Keys whose values say when, where and how fast a command ran, or which state of the program it was.
const PASSING: [&str; 14] = [
    "seconds",
    "host",
    "processor",
    "processors",
    "threads",
    "begun",
    "ended",
    "written",
    "date",
    "commit",
    "version",
    "program",
    "check",
    "created",
];
/// A list with more leaves than this is one line, and so is an object that stands this deep in a document of many more.
const LONG: usize = 24;
const MANY: usize = 400;
const DEEP: usize = 4;
/// Files that say how long something took, or in which order it was done.
const PASSING_FILES: [&str; 6] =
    ["timing.csv", "journal.jsonl", "draws.jsonl", "sensitivity.jsonl", "cells.jsonl", "walls.jsonl"];

/// All files below a folder, with / between the parts of a name.
pub fn files(folder: &Path) -> BTreeSet<String> {
    fn below(folder: &Path, name: &str, all: &mut BTreeSet<String>) {
        for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry")) {
            let own = format!("{name}{}", entry.file_name().to_string_lossy());
            match entry.path().is_dir() {
                true => below(&entry.path(), &format!("{own}/"), all),
                false => drop(all.insert(own)),
            }
        }
    }
    let mut all = BTreeSet::new();
    below(folder, "", &mut all);
    all
}

/// What is kept of a file: its numbers, or of words and figures the name alone.
pub fn file(folder: &Path, name: &str) -> String {
    let bytes = fs::read(folder.join(name)).expect("a file");
    let head = format!("file {name}\n");
    let last = name.rsplit('/').next().unwrap_or(name);
    if PASSING_FILES.contains(&last) {
        return head;
    }
    match name.rsplit('.').next() {
        Some("json") => head + &json(&bytes),
        Some("csv") => head + &csv(&bytes),
        Some("parquet" | "vtu" | "obj") => head + &format!("  {}\n", digest(&bytes)),
        _ => head,
    }
}

/// The leaves of a JSON object, each on its line; of long lists a digest.
pub fn json(bytes: &[u8]) -> String {
    let mut text = String::new();
    match serde_json::from_slice::<Value>(bytes) {
        Ok(value) => leaves(&value, "", if count(&value) > MANY { DEEP } else { usize::MAX }, &mut text),
        Err(_) if bytes.is_empty() => text.push_str("  nothing\n"),
        Err(fault) => text.push_str(&format!("  no JSON: {fault}\n")),
    }
    text
}

/// Whether the value of a key, or of a column, says when, where or how fast.
fn is_passing(name: &str) -> bool {
    PASSING.iter().any(|own| name == *own || name.ends_with(&format!("_{own}")))
}

fn leaves(value: &Value, path: &str, deeper: usize, text: &mut String) {
    match value {
        Value::Object(fields) if deeper == 0 && fields.len() > 1 => {
            let mut own = String::new();
            leaves(value, "", usize::MAX, &mut own);
            text.push_str(&format!("  {path} {} keys {}\n", fields.len(), digest(own.as_bytes())));
        }
        Value::Object(fields) if !fields.is_empty() => {
            for (key, value) in fields {
                if is_passing(key) {
                    text.push_str(&format!("  {path}.{key} *\n"));
                } else {
                    leaves(value, &format!("{path}.{key}"), deeper.saturating_sub(1), text);
                }
            }
        }
        Value::Array(items) if count(value) > LONG => {
            text.push_str(&format!(
                "  {path}[] {} items {}\n",
                items.len(),
                digest(without_passing(value).as_bytes())
            ));
        }
        Value::Array(items) if !items.is_empty() => {
            items
                .iter()
                .enumerate()
                .for_each(|(k, item)| leaves(item, &format!("{path}[{k}]"), deeper, text));
        }
        // A sentence may become better; a word is a name.
        Value::String(words) if words.contains(' ') => text.push_str(&format!("  {path} words\n")),
        leaf => text.push_str(&format!("  {path} {leaf}\n")),
    }
}

/// The leaves of a list without what passes, as one text.
fn without_passing(value: &Value) -> String {
    let Value::Array(items) = value else { return String::new() };
    let mut text = String::new();
    items.iter().for_each(|item| match item {
        Value::Array(_) => text.push_str(&without_passing(item)),
        item => leaves(item, "", usize::MAX, &mut text),
    });
    text
}

fn count(value: &Value) -> usize {
    match value {
        Value::Array(items) => items.iter().map(count).sum(),
        Value::Object(fields) => fields.values().map(count).sum(),
        _ => 1,
    }
}

/// A line for each column of a table: its head, its first cell and a digest of all.
fn csv(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let heads: Vec<String> = lines.next().map(cells).unwrap_or_default();
    let rows: Vec<Vec<String>> = lines.map(cells).collect();
    let mut text = format!("  {} rows\n", rows.len());
    for (k, head) in heads.iter().enumerate() {
        let column: Vec<&str> = rows.iter().map(|row| row.get(k).map_or("", String::as_str)).collect();
        let first = column.first().copied().unwrap_or_default();
        // As above: sentences are words.
        let said = if first.contains(' ') {
            "words".to_owned()
        } else {
            format!("{first} {}", digest(column.join("\n").as_bytes()))
        };
        text.push_str(&if is_passing(head) { format!("  {head} *\n") } else { format!("  {head} {said}\n") });
    }
    text
}

/// Cells between commas that stand in no quotes.
fn cells(line: &str) -> Vec<String> {
    let mut quoted = false;
    let split = line.split(|c: char| {
        quoted ^= c == '"';
        c == ',' && !quoted
    });
    split.map(str::to_owned).collect()
}

fn digest(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}
