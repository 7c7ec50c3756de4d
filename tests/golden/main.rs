//! What users have: exit codes, JSON, CSV, Parquet and walls of every verb on small studies, as they were when they were last agreed on.
//!
//! A change of the house leaves them as they are, byte for byte. Words and figures may become better: of these only the names of the files are
//! kept. What changes on purpose is agreed on anew by
//!
//! ```text
//! PIRCA_GOLDEN=write cargo test --release --test golden
//! ```
//!
//! and the difference of `tests/golden/expected` says what users will notice.

mod cases;
#[path = "../ensemble/fixture.rs"]
#[expect(dead_code, reason = "other groups use more of it")]
mod fixture;
#[path = "../ensemble/loads.rs"]
mod loads;
mod state;

use std::fs;
use std::path::{Path, PathBuf};

use cases::{CASES, Case};
use fixture::Folder;
use rayon::prelude::*;

/// Where what was agreed on is kept.
fn kept(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/expected").join(name).with_extension("txt")
}

/// Runs a case's commands one after the other in a folder, and says what they left.
fn seen(case: &Case) -> String {
    let folder = Folder::with_study(&(case.study)());
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cli/fixtures");
    for (file, to) in case.files {
        fs::copy(from.join(file), folder.path(to)).expect("a fixture");
    }
    let mut text = String::new();
    let before = state::files(&folder.path("."));
    for command in case.commands {
        let words: Vec<&str> = command.split_whitespace().collect();
        let output = folder.pirca(&words);
        text.push_str(&format!("$ pirca {command}\nexit {}\n", output.status.code().unwrap_or(-1)));
        // Without --json it is words, and they may become better.
        if words.contains(&"--json") {
            text.push_str(&state::json(&output.stdout));
        }
    }
    for file in state::files(&folder.path(".")).difference(&before) {
        text.push_str(&state::file(&folder.path("."), file));
    }
    let here = folder.path("").canonicalize().expect("the folder");
    text.replace(&format!("{}/", here.display()), "")
}

/// The first lines in which two texts differ.
fn difference(kept: &str, now: &str) -> String {
    let missing = kept.lines().filter(|line| !now.lines().any(|other| other == *line)).take(12);
    let added = now.lines().filter(|line| !kept.lines().any(|other| other == *line)).take(12);
    let marked = missing.map(|line| format!("- {line}")).chain(added.map(|line| format!("+ {line}")));
    marked.collect::<Vec<_>>().join("\n")
}

#[test]
fn what_users_have_is_as_it_was() {
    let write = std::env::var("PIRCA_GOLDEN").is_ok_and(|own| own == "write");
    let mut faults = Vec::new();
    for (case, now) in CASES.par_iter().map(|case| (case, seen(case))).collect::<Vec<_>>() {
        let path = kept(case.name);
        if write {
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(&path, &now).expect("to write");
        }
        let before = fs::read_to_string(&path).unwrap_or_default();
        if now != before {
            faults.push(format!("{}:\n{}", case.name, difference(&before, &now)));
        }
    }
    assert!(faults.is_empty(), "{}\n(PIRCA_GOLDEN=write agrees on it anew)", faults.join("\n\n"));
}

#[test]
fn every_verb_has_a_case() {
    let folder = Folder::with_study(fixture::STUDY);
    let help = String::from_utf8(folder.pirca(&["--help"]).stdout).expect("UTF-8");
    let verbs = help.lines().take_while(|line| *line != "Options:").filter_map(|line| {
        let name = line.strip_prefix("  ")?.split_whitespace().next()?;
        (!line.starts_with("   ")).then_some(name)
    });
    let commands: Vec<&str> = CASES.iter().flat_map(|case| case.commands).copied().collect();
    let without: Vec<&str> =
        verbs.filter(|verb| !commands.iter().any(|own| own.split(' ').next() == Some(verb))).collect();
    assert!(without.is_empty(), "no case of {without:?}");
}

#[test]
fn what_is_kept_belongs_to_a_case() {
    let folder = kept("any");
    for entry in fs::read_dir(folder.parent().expect("a folder")).expect("the folder") {
        let path = entry.expect("a file").path();
        let name = path.file_stem().and_then(|own| own.to_str()).expect("a name").to_owned();
        assert!(CASES.iter().any(|case| case.name == name), "{name} is of no case");
    }
}
