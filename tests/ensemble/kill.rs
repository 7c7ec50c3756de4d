//! A program killed with signal 9 goes on where it stood and ends with the same bytes: `run`, and the verbs that keep what they
//! evaluated in files of their own.

use std::fs;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crate::fixture::{Folder, STUDY, stderr};
use crate::threads::results;

/// One wall and sixty at two points: 122 evaluations.
const RUN: [&str; 7] = ["run", "studies/tiny", "--threads", "1", "--out", "killed", "--members=60"];

/// Whole lines in a file of the folder `killed`, of the program to be killed.
fn lines_of(folder: &Folder, file: &str) -> usize {
    let text = fs::read(folder.path("killed").join(file)).unwrap_or_default();
    text.iter().filter(|&&byte| byte == b'\n').count()
}

/// The same of the journal of the run.
fn lines(folder: &Folder) -> usize {
    lines_of(folder, "journal.jsonl")
}

/// Starts the program and kills it as soon as `ripe` says so; false when it ended before.
pub fn kill_when(folder: &Folder, arguments: &[&str], ripe: impl Fn() -> bool) -> bool {
    let mut child: Child =
        folder.command(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begun = Instant::now();
    while !ripe() {
        assert!(begun.elapsed() < Duration::from_secs(120), "the run hangs");
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_micros(200));
    }
    child.kill().unwrap();
    let status = child.wait().unwrap();
    !status.success()
}

#[test]
fn kills_at_many_moments_leave_the_results_as_they_were() {
    let folder = Folder::with_study(STUDY);
    let whole = folder.pirca(&["run", "studies/tiny", "--threads", "2", "--out", "whole", "--members=60"]);
    assert!(whole.status.success(), "{}", stderr(&whole));
    let wanted = results(&folder, "whole");

    // Each round goes on from the journal that the one before left behind: before the head, at the head, after some
    // members, and a moment after a member, when the next one is under way.
    let mut killed = 0;
    let mut seen = 0;
    for (more, wait) in [(0, 0), (0, 3), (1, 0), (3, 2), (9, 1), (8, 0)] {
        let target = seen + more;
        let ripe = || {
            lines(&folder) >= target && {
                std::thread::sleep(Duration::from_millis(wait));
                true
            }
        };
        killed += usize::from(kill_when(&folder, &RUN, ripe));
        let now = lines(&folder);
        assert!(now >= seen, "a kill loses no recorded member");
        seen = now;
    }
    assert!(killed >= 3, "only {killed} kills met a run that was going on");

    let last = folder.pirca(&RUN);
    assert!(last.status.success(), "{}", stderr(&last));
    let recorded = format!("{} of them recorded before", seen.saturating_sub(1));
    assert!(stderr(&last).contains(&recorded), "{recorded}: {}", stderr(&last));
    assert_eq!(results(&folder, "killed"), wanted);
}

#[test]
fn a_kill_while_results_are_written_leaves_whole_files() {
    let folder = Folder::with_study(STUDY);
    let whole = folder.pirca(&["run", "studies/tiny", "--threads", "2", "--out", "whole", "--members=60"]);
    assert!(whole.status.success(), "{}", stderr(&whole));
    kill_when(&folder, &RUN, || folder.path("killed/timing.csv").exists());
    // What a kill between two files leaves: one is new, another is not there, a third lies half-written beside it.
    let _ = fs::remove_file(folder.path("killed/summary.json"));
    fs::write(folder.path("killed/steps.parquet.partial"), "PAR1 and no end").unwrap();
    let last = folder.pirca(&RUN);
    assert!(last.status.success(), "{}", stderr(&last));
    assert!(stderr(&last).contains("122 of them recorded before"), "{}", stderr(&last));
    assert_eq!(results(&folder, "killed"), results(&folder, "whole"));
}

/// Columns of full-width courses that slide on random beds, solved in a fraction of a millisecond, in two arms that are alike.
pub fn columns() -> String {
    let text = include_str!("../peers/column/study.toml");
    let twin = text[text.find("[[arm]]").unwrap()..].replace("\"column\"", "\"twin\"");
    format!("{text}\n{twin}")
}

/// A verb, the file that it goes on from, the lines of it that each kill waits for, and what it writes.
struct Killed {
    verb: &'static str,
    arguments: &'static [&'static str],
    kept: &'static str,
    ripe: [usize; 3],
    results: &'static [&'static str],
}

const VERBS: [Killed; 3] = [
    Killed {
        verb: "sensitivity",
        arguments: &["--points", "256"],
        kept: "sensitivity.jsonl",
        ripe: [1, 300, 700],
        results: &[
            "sensitivity.json",
            "sensitivity.csv",
            "sensitivity.svg",
            "sensitivity.png",
            "sensitivity.parquet",
        ],
    },
    Killed {
        verb: "capacity",
        arguments: &["--below-deg", "18.8", "--members", "64", "--walls", "1500"],
        kept: "draws.jsonl",
        ripe: [1, 400, 900],
        results: &[
            "capacity.json",
            "probability.svg",
            "probability.png",
            "probability.csv",
            "evaluations.parquet",
            "members.parquet",
            "steps.parquet",
            "manifest.json",
        ],
    },
    Killed {
        verb: "compare",
        arguments: &["--below-deg", "21", "--same-within-share", "0.001", "--walls", "400"],
        kept: "journal.jsonl",
        ripe: [1, 100, 250],
        results: &[
            "compare.json",
            "compare.csv",
            "compare.svg",
            "compare.png",
            "distributions.csv",
            "distributions.svg",
            "members.parquet",
            "steps.parquet",
            "manifest.json",
        ],
    },
];

#[test]
fn sensitivity_capacity_and_compare_go_on_after_kills() {
    let folder = Folder::with_study(&columns());
    for Killed { verb, arguments, kept, ripe, results } in VERBS {
        let of = |out: &'static str, threads: &'static str| {
            [&[verb, "studies/tiny"], arguments, &["--out", out, "--threads", threads]].concat()
        };
        let bytes = |out: &str| -> Vec<Vec<u8>> {
            results.iter().map(|name| fs::read(folder.path(out).join(name)).unwrap()).collect()
        };
        let whole = folder.pirca(&of("whole", "2"));
        assert!(whole.status.success(), "{verb}: {}", stderr(&whole));
        let all = fs::read_to_string(folder.path("whole").join(kept)).unwrap().lines().count();
        let mut seen = 0;
        for target in ripe {
            let was_killed = kill_when(&folder, &of("killed", "1"), || lines_of(&folder, kept) >= target);
            let now = lines_of(&folder, kept);
            assert!(was_killed && now >= seen && now < all, "{verb}: {seen} {now} {all}");
            seen = now;
        }
        let last = folder.pirca(&of("killed", "1"));
        assert!(last.status.success(), "{verb}: {}", stderr(&last));
        // What was kept is not evaluated again.
        assert_eq!(lines_of(&folder, kept), all, "{verb}");
        assert!(bytes("killed") == bytes("whole"), "{verb}");
        for out in ["killed", "whole"] {
            fs::remove_dir_all(folder.path(out)).unwrap();
        }
    }
}
