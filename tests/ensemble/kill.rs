//! A run killed with signal 9 goes on where it stood and ends with the same bytes.

use std::fs;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crate::fixture::{Folder, STUDY, stderr};
use crate::threads::results;

/// One wall and sixty at two points: 122 evaluations.
const RUN: [&str; 7] = ["run", "studies/tiny", "--threads", "1", "--out", "killed", "--members=60"];
/// Whole lines in the journal of the run to be killed.
fn lines(folder: &Folder) -> usize {
    let journal = fs::read(folder.path("killed/journal.jsonl")).unwrap_or_default();
    journal.iter().filter(|&&byte| byte == b'\n').count()
}

/// Starts the run and kills it as soon as `ripe` says so; false when it ended before.
fn kill_when(folder: &Folder, ripe: impl Fn() -> bool) -> bool {
    let mut child: Child = folder.command(&RUN).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
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
        killed += usize::from(kill_when(&folder, ripe));
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
    kill_when(&folder, || folder.path("killed/timing.csv").exists());
    // What a kill between two files leaves: one is new, another is not there, a third lies half-written beside it.
    let _ = fs::remove_file(folder.path("killed/summary.json"));
    fs::write(folder.path("killed/steps.parquet.partial"), "PAR1 and no end").unwrap();
    let last = folder.pirca(&RUN);
    assert!(last.status.success(), "{}", stderr(&last));
    assert!(stderr(&last).contains("122 of them recorded before"), "{}", stderr(&last));
    assert_eq!(results(&folder, "killed"), results(&folder, "whole"));
}
