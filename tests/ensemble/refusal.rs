//! Results of different runs never mix, and a disk that takes no more is told.

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

use crate::fixture::{Folder, STUDY, changed, stderr};
use crate::threads::results;

#[test]
fn a_changed_study_is_refused_by_name_and_changes_nothing() {
    let folder = Folder::with_study(STUDY);
    let run = |more: &[&str]| folder.pirca(&[&["run", "studies/tiny", "--out", "out"], more].concat());
    assert!(run(&[]).status.success());
    let before = (results(&folder, "out"), fs::read(folder.path("out/journal.jsonl")).unwrap());

    for (text, more, said) in [
        (STUDY.to_string(), &["--seed", "8"][..], "seed: 7 recorded, 8 asked for"),
        (STUDY.to_string(), &["--variant", "slippery"][..], "variant: none recorded, slippery asked for"),
        (changed("base_over_top = 2", "base_over_top = 3"), &[][..], "load.base_over_top: 2"),
    ] {
        folder.write_study(&text);
        let output = run(more);
        assert_eq!(output.status.code(), Some(1), "{said}");
        let error = stderr(&output);
        assert!(error.contains(said), "{said} in: {error}");
        assert!(error.contains("--out") && error.contains("remove out"), "how to proceed: {error}");
        let after = (results(&folder, "out"), fs::read(folder.path("out/journal.jsonl")).unwrap());
        assert!(after == before, "nothing is overwritten");
    }
}

#[test]
fn a_comment_is_no_change() {
    let folder = Folder::with_study(STUDY);
    assert!(folder.pirca(&["run", "studies/tiny", "--out", "out"]).status.success());
    let before = results(&folder, "out");
    folder.write_study(&format!("# Looked at again.\n{STUDY}"));
    let output = folder.pirca(&["run", "studies/tiny", "--out", "out"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).contains("18 of them recorded before"), "{}", stderr(&output));
    // The manifest alone says that the file has other bytes now.
    let but_manifest = |all: Vec<Vec<u8>>| [&all[..3], &all[4..]].concat();
    assert!(but_manifest(results(&folder, "out")) == but_manifest(before));
}

#[test]
fn a_full_disk_is_a_clear_error() {
    let folder = Folder::with_study(STUDY);
    fs::create_dir(folder.path("out")).unwrap();
    symlink("/dev/full", folder.path("out/journal.jsonl")).unwrap();
    let output = folder.pirca(&["run", "studies/tiny", "--out", "out"]);
    assert_eq!(output.status.code(), Some(1));
    let error = stderr(&output);
    assert!(error.contains("cannot write out/journal.jsonl: No space left on device"), "{error}");
}

/// Also when the journal could be written and one of the results cannot.
#[test]
fn a_result_that_cannot_be_written_is_a_clear_error() {
    let folder = Folder::with_study(STUDY);
    fs::create_dir(folder.path("out")).unwrap();
    symlink("/dev/full", folder.path("out/members.parquet.partial")).unwrap();
    let output = folder.pirca(&["run", "studies/tiny", "--out", "out"]);
    assert_eq!(output.status.code(), Some(1));
    let error = stderr(&output);
    assert!(error.contains("cannot write out/members.parquet: No space left on device"), "{error}");
    let again = folder.pirca(&["run", "studies/tiny", "--out", "out"]);
    assert!(again.status.success(), "{}", stderr(&again));
    assert!(stderr(&again).contains("18 of them recorded before"), "nothing was lost: {}", stderr(&again));
}

#[test]
fn a_file_size_limit_is_a_clear_error_and_loses_nothing() {
    let folder = Folder::with_study(STUDY);
    // 8 blocks of 1024 bytes: the head and a few members.
    let output = Command::new("bash")
        .args(["-c", "ulimit -f 8; exec \"$0\" run studies/tiny --out out", env!("CARGO_BIN_EXE_pirca")])
        .current_dir(folder.path(""))
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("cannot write out/journal.jsonl: File too large"),
        "{}",
        stderr(&output)
    );
    let whole = fs::read(folder.path("out/journal.jsonl")).unwrap().iter().filter(|&&b| b == b'\n').count();
    assert!(whole > 1, "the limit must let some members through");
    let again = folder.pirca(&["run", "studies/tiny", "--out", "out"]);
    assert!(again.status.success(), "{}", stderr(&again));
    assert!(stderr(&again).contains(&format!("{} of them recorded before", whole - 1)), "{}", stderr(&again));
    assert!(folder.pirca(&["run", "studies/tiny", "--out", "whole"]).status.success());
    assert!(results(&folder, "out") == results(&folder, "whole"));
}

#[test]
fn a_folder_below_a_file_is_a_clear_error() {
    let folder = Folder::with_study(STUDY);
    let output = folder.pirca(&["run", "studies/tiny", "--out", "studies/tiny/study.toml/out"]);
    assert_eq!(output.status.code(), Some(1));
    let error = stderr(&output);
    assert!(error.contains("cannot create the folder studies/tiny/study.toml/out"), "{error}");
}
