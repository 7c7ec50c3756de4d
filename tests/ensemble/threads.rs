//! The number of worker threads changes no byte of a result.

use std::fs;

use crate::fixture::{Folder, STUDY, stderr};

/// The files of a run that must not depend on threads, kills or time.
pub const RESULTS: [&str; 7] = [
    "members.parquet",
    "steps.parquet",
    "summary.json",
    "manifest.json",
    "figure-10.svg",
    "figure-10.png",
    "figure-10.csv",
];

/// Their bytes.
pub fn results(folder: &Folder, out: &str) -> Vec<Vec<u8>> {
    RESULTS.iter().map(|name| fs::read(folder.path(out).join(name)).unwrap()).collect()
}

#[test]
fn one_two_and_seven_threads_write_the_same_bytes() {
    let folder = Folder::with_study(STUDY);
    let of = |threads: &str| {
        let output = folder.pirca(&["run", "studies/tiny", "--threads", threads, "--out", threads]);
        assert!(output.status.success(), "{}", stderr(&output));
        results(&folder, threads)
    };
    let one = of("1");
    assert_eq!(one, of("2"));
    assert_eq!(one, of("7"));
}
