//! A study shared out to shards, in any number, order and state of disorder, comes out as on one machine, byte for byte.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::time::{Duration, SystemTime};

use sha2::{Digest, Sha256};

use crate::fixture::{Folder, STUDY, stderr};
use crate::kill::kill_when;
use crate::threads::results;

/// The study of 18 evaluations, run on one machine.
fn reference() -> Folder {
    let folder = Folder::with_study(STUDY);
    done(&folder.pirca(&["run", "studies/tiny", "--threads", "2", "--out", "whole"]));
    folder
}

fn done(output: &Output) -> String {
    assert!(output.status.success(), "{}", stderr(output));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What a command that must fail says, with its exit code.
fn refused(output: &Output, code: i32) -> String {
    assert_eq!(output.status.code(), Some(code), "{}", stderr(output));
    stderr(output)
}

/// A shard's command.
fn shard<'a>(index: &'a str, of: &'a str, out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["shards", "run", "studies/tiny", "--index", index, "--of", of, "--out", out], more].concat()
}

fn file(folder: &Folder, out: &str, index: u32, of: u32) -> PathBuf {
    folder.path(out).join(format!("shards/{index:04}-of-{of:04}.jsonl"))
}

/// Whole lines in the longest part of a shard that is being computed in `out`.
fn lines_of_parts(folder: &Folder) -> usize {
    let entries = fs::read_dir(folder.path("out/shards")).into_iter().flatten().flatten();
    let parts = entries.filter(|entry| entry.path().extension().is_some_and(|ending| ending == "part"));
    let lines = |entry: fs::DirEntry| {
        fs::read(entry.path()).unwrap_or_default().iter().filter(|byte| **byte == b'\n').count()
    };
    parts.map(lines).max().unwrap_or(0)
}

fn compute_all(folder: &Folder, of: u32, out: &str, threads: &str) {
    // Neither their order nor their number of threads matters: the last one first.
    for index in (0..of).rev() {
        done(&folder.pirca(&shard(&index.to_string(), &of.to_string(), out, &["--threads", threads])));
    }
}

fn merged(folder: &Folder, out: &str) -> Vec<Vec<u8>> {
    done(&folder.pirca(&["shards", "merge", out]));
    results(folder, out)
}

#[test]
fn any_number_of_shards_gives_the_bytes_of_one_machine() {
    let folder = reference();
    let wanted = results(&folder, "whole");
    // More shards than evaluations leave some without a wall.
    for (of, threads) in [(1, "2"), (3, "1"), (7, "2"), (64, "1")] {
        let out = format!("of-{of}");
        compute_all(&folder, of, &out, threads);
        assert!(merged(&folder, &out) == wanted, "{of} shards, {threads} threads");
    }
    // The same shard computed elsewhere and with other threads is the same file.
    compute_all(&folder, 3, "again", "2");
    for index in 0..3 {
        assert_eq!(
            fs::read(file(&folder, "of-3", index, 3)).unwrap(),
            fs::read(file(&folder, "again", index, 3)).unwrap()
        );
    }
}

#[test]
fn walls_that_are_added_until_there_are_enough_stop_where_a_run_stops() {
    let text = include_str!("../peers/column/study.toml").replace(
        "members = 64",
        "members = { until = \"half_width\", of = \"mean\", below = 0.02, at_most = 1000 }",
    );
    let folder = Folder::with_study(&text);
    done(&folder.pirca(&["run", "studies/tiny", "--out", "whole"]));
    compute_all(&folder, 3, "shared", "2");
    done(&folder.pirca(&["shards", "merge", "shared"]));
    for name in ["members.parquet", "steps.parquet", "summary.json", "manifest.json"] {
        let [own, wanted] = ["shared", "whole"].map(|out| fs::read(folder.path(out).join(name)).unwrap());
        assert!(own == wanted, "{name}");
    }
}

#[test]
fn a_shard_that_is_complete_is_left_alone() {
    let folder = reference();
    compute_all(&folder, 3, "out", "2");
    let path = file(&folder, "out", 1, 3);
    let before = (fs::read(&path).unwrap(), fs::metadata(&path).unwrap().modified().unwrap());
    let said = done(&folder.pirca(&shard("1", "3", "out", &[])));
    assert!(said.contains("shard 1 of 3 was complete: 6 walls"), "{said}");
    assert!((fs::read(&path).unwrap(), fs::metadata(&path).unwrap().modified().unwrap()) == before);
    // No part is left behind.
    let parts = fs::read_dir(folder.path("out/shards"))
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|ending| ending == "part"));
    assert_eq!(parts.count(), 0);
}

#[test]
fn a_killed_shard_is_gone_on_from_and_two_workers_on_one_shard_do_no_harm() {
    let folder = Folder::with_study(STUDY);
    done(&folder.pirca(&["run", "studies/tiny", "--out", "whole", "--members", "40"]));
    let command = shard("0", "2", "out", &["--members", "40", "--threads", "1"]);
    assert!(kill_when(&folder, &command, || lines_of_parts(&folder) >= 5));
    let status = done(&folder.pirca(&["shards", "status", "out"]));
    assert!(status.contains("begun: 0, ") && status.contains("stopped"), "{status}");
    assert!(status.contains("missing: 0-1"), "{status}");
    // Two at a time: an orphan that nobody killed, and the one that was started in its place.
    let workers: Vec<_> = (0..2).map(|_| folder.command(&command).spawn().unwrap()).collect();
    for mut worker in workers {
        assert!(worker.wait().unwrap().success());
    }
    let said = done(&folder.pirca(&command));
    assert!(said.contains("was complete"), "{said}");
    done(&folder.pirca(&shard("1", "2", "out", &["--members", "40"])));
    assert!(merged(&folder, "out") == results(&folder, "whole"));
}

#[test]
fn what_a_killed_worker_evaluated_is_not_evaluated_again() {
    let folder = Folder::with_study(STUDY);
    let command = shard("0", "1", "out", &["--members", "40", "--threads", "1"]);
    assert!(kill_when(&folder, &command, || lines_of_parts(&folder) >= 60));
    let said = done(&folder.pirca(&command));
    let before: u64 = said.split(' ').nth(6).and_then(|n| n.parse().ok()).unwrap_or(0);
    assert!((58..82).contains(&before), "{said}");
}

#[test]
fn shards_of_other_work_are_refused_and_nothing_is_changed() {
    let folder = reference();
    compute_all(&folder, 3, "out", "2");
    let before = fs::read(file(&folder, "out", 0, 3)).unwrap();
    for (more, said) in [
        (&["--seed", "8"][..], "study.seed: 7 recorded, 8 asked for"),
        (&["--members", "9"], "arm.random.members: 8 recorded, 9 asked for"),
        (&["--variant", "slippery"], "variant: none recorded, slippery asked for"),
        (&["--solver", "implicit"], "solver: explicit recorded, implicit asked for"),
    ] {
        let found = refused(&folder.pirca(&shard("0", "3", "out", more)), 1);
        assert!(found.contains(said) && found.contains("nothing was changed"), "{found}");
    }
    let found = refused(&folder.pirca(&shard("0", "4", "out", &[])), 1);
    assert!(found.contains("number of shards: 3 there, 4 asked for"), "{found}");
    assert!(fs::read(file(&folder, "out", 0, 3)).unwrap() == before);
    // The study itself has changed since.
    folder.write_study(&STUDY.replace("phi_deg = 35", "phi_deg = 34"));
    for command in [vec!["shards", "merge", "out"], shard("0", "3", "out", &[])] {
        let found = refused(&folder.pirca(&command), 1);
        assert!(found.contains("joint.phi_deg: ") && found.contains("34.0} asked for"), "{found}");
    }
}

/// The first line of a shard with its check, after a change.
fn with_head(text: &str, from: &str, to: &str) -> String {
    let (head, rest) = text.split_once('\n').unwrap();
    let json = head.split_once("\"entry\":").unwrap().1.strip_suffix('}').unwrap();
    assert!(json.contains(from), "{json}");
    let json = json.replace(from, to);
    let check: String =
        Sha256::digest(json.as_bytes()).iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    format!("{{\"check\":\"{check}\",\"entry\":{json}}}\n{rest}")
}

#[test]
fn a_shard_of_another_version_or_study_is_never_mixed_with_others() {
    let folder = reference();
    compute_all(&folder, 3, "out", "2");
    let path = file(&folder, "out", 2, 3);
    let own = fs::read_to_string(&path).unwrap();
    for (from, to, said) in [
        (
            "\"version\":\"0.1.0\"",
            "\"version\":\"0.0.9\"",
            "it is of pirca 0.0.9, and the others are of pirca 0.1.0",
        ),
        ("\"seed\":7", "\"seed\":8", "it has the seed 8, and the others have 7"),
        ("\"index\":2", "\"index\":1", "it is shard 1 of 3, which its name does not say"),
    ] {
        let other = with_head(&own, from, to);
        fs::write(&path, &other).unwrap();
        for command in [vec!["shards", "merge", "out"], shard("2", "3", "out", &[])] {
            let found = refused(&folder.pirca(&command), 1);
            assert!(found.contains(said) && found.contains("remove it"), "{found}");
        }
        let status = done(&folder.pirca(&["shards", "status", "out"]));
        assert!(status.contains("of other work: 2") && status.contains(said), "{status}");
        assert!(fs::read_to_string(&path).unwrap() == other, "it stays for its owner");
    }
    // Work that an older version began is not gone on with.
    let work = folder.path("out/shards/work.json");
    let text = fs::read_to_string(&work).unwrap().replace("\"version\": \"0.1.0\"", "\"version\": \"0.0.9\"");
    fs::write(&work, text).unwrap();
    for command in
        [vec!["shards", "merge", "out"], vec!["shards", "status", "out"], shard("0", "3", "out", &[])]
    {
        let found = refused(&folder.pirca(&command), 1);
        assert!(found.contains("version of pirca: 0.0.9 there, 0.1.0 here"), "{found}");
    }
}

#[test]
fn a_damaged_shard_is_told_and_computed_again() {
    let folder = reference();
    let wanted = results(&folder, "whole");
    compute_all(&folder, 3, "out", "2");
    let path = file(&folder, "out", 1, 3);
    let own = fs::read(&path).unwrap();
    let (half, mut flipped, mut headless) = (own[..own.len() / 2].to_vec(), own.clone(), own.clone());
    *flipped.last_mut().unwrap() = b'\n';
    let at = flipped.len() - 200;
    flipped[at] ^= 1;
    headless[20] ^= 1;
    let mut swapped: Vec<&[u8]> = own.split_inclusive(|byte| *byte == b'\n').collect();
    swapped.swap(2, 4);
    let cases = [
        (half, true, "was written with", "was written with"),
        (Vec::new(), true, "its first line is damaged", "its first line is damaged"),
        (headless, true, "its first line is damaged", "its first line is damaged"),
        (flipped, false, "the line of a wall is damaged", "the line of its wall 6 of 6 is damaged"),
        (swapped.concat(), false, "a line is of another wall", "the line of its wall 3 of 6 is out of order"),
    ];
    for (bytes, is_seen_at_once, said, of_status) in cases {
        fs::write(&path, bytes).unwrap();
        let status = done(&folder.pirca(&["shards", "status", "out"]));
        assert!(status.contains("2 of 3 shards complete, 12 of 18 evaluations"), "{status}");
        assert!(status.contains("damaged: 1, ") && status.contains("missing: 1"), "{status}");
        assert!(status.contains(of_status), "{status}");
        // What is refused has written nothing.
        let _ = fs::remove_file(folder.path("out/timing.csv"));
        let found = refused(&folder.pirca(&["shards", "merge", "out"]), 1);
        assert!(!folder.path("out/timing.csv").exists());
        let wanted_words = if is_seen_at_once { "1 of 3 shards are missing: 1" } else { said };
        assert!(found.contains(wanted_words), "{found}");
        done(&folder.pirca(&shard("1", "3", "out", &[])));
        // Lines in another order are all there, and are put in order.
        assert!(fs::read(&path).unwrap() == own, "{said}");
        assert!(merged(&folder, "out") == wanted, "{said}");
    }
}

#[test]
fn a_gap_is_refused_unless_some_are_enough() {
    let folder = reference();
    for index in ["0", "1", "2", "4"] {
        done(&folder.pirca(&shard(index, "7", "out", &[])));
    }
    let found = refused(&folder.pirca(&["shards", "merge", "out"]), 1);
    assert!(found.contains("3 of 7 shards are missing: 3,5-6") && found.contains("--array=3,5-6"), "{found}");
    assert!(!folder.path("out/members.parquet").exists());
    let status: serde_json::Value =
        serde_json::from_str(&done(&folder.pirca(&["shards", "status", "out", "--json"]))).unwrap();
    assert_eq!((&status["missing"], &status["complete"]), (&"3,5-6".into(), &4.into()));
    let partial = folder.pirca(&["shards", "merge", "out", "--partial"]);
    done(&partial);
    assert!(stderr(&partial).contains("shards 3,5-6 of 7 are missing"), "{}", stderr(&partial));
    let partial = done(&folder.pirca(&["shards", "merge", "out", "--partial", "--json"]));
    let summary: serde_json::Value = serde_json::from_str(&partial).unwrap();
    assert_eq!(summary["missing"], "3,5-6");
    let arms = summary["arms"].as_array().unwrap();
    let walls: u64 = arms.iter().map(|arm| arm["in_mean"].as_u64().unwrap()).sum();
    assert_eq!(walls, 11, "of the walls of shards 0, 1, 2 and 4: 3 + 3 + 3 + 2");
    assert!(arms[2]["note"].as_str().unwrap().contains("not in the numbers: 3 not computed"), "{arms:?}");
    let missing: u64 = arms.iter().filter_map(|arm| arm["missing"].as_u64()).sum();
    assert_eq!(missing, 7, "of the walls of shards 3, 5 and 6: 3 + 2 + 2");
    // What has not been computed has not failed.
    let text = done(&folder.pirca(&["shards", "merge", "out", "--partial"]));
    assert!(text.contains("11 evaluations, 7 of 18 not computed yet, none failed."), "{text}");
    // A run in the same folder computes the rest, and no wall twice.
    let rest = folder.pirca(&["run", "studies/tiny", "--out", "out"]);
    done(&rest);
    assert!(stderr(&rest).contains("18 evaluations, 11 of them recorded before"), "{}", stderr(&rest));
    assert!(results(&folder, "out") == results(&folder, "whole"));
    for (arguments, said) in [
        (["shards", "status", "nowhere"], "there is no such folder"),
        (["shards", "merge", "whole"], "holds no shards"),
    ] {
        let found = refused(&folder.pirca(&arguments), 1);
        assert!(found.contains(said), "{found}");
    }
}

/// The name of a folder decides no result. Other values do, and nobody is advised to remove shards for them.
#[test]
fn shards_of_a_study_whose_folder_was_renamed_are_merged() {
    let folder = reference();
    compute_all(&folder, 3, "out", "2");
    fs::rename(folder.path("studies/tiny"), folder.path("studies/renamed")).unwrap();
    let found = refused(&folder.pirca(&["shards", "merge", "out"]), 3);
    assert!(found.contains("name its folder with --study"), "{found}");
    done(&folder.pirca(&["shards", "merge", "out", "--study", "studies/renamed"]));
    assert!(results(&folder, "out") == results(&folder, "whole"));
    let other = STUDY.replacen("phi_deg = 35", "phi_deg = 36", 1);
    fs::write(folder.path("studies/renamed/study.toml"), other).unwrap();
    let found = refused(&folder.pirca(&["shards", "merge", "out", "--study", "studies/renamed"]), 1);
    assert!(found.contains("studies/renamed is not the study that the shards in out are of"), "{found}");
    assert!(found.contains("joint.phi_deg") && !found.contains("remove"), "{found}");
}

#[test]
fn a_full_disk_loses_nothing_but_the_wall_that_was_being_written() {
    let folder = reference();
    done(&folder.pirca(&shard("1", "2", "out", &[])));
    // 8 blocks of 512 bytes: the head of a part fits, all its walls do not.
    let full = Command::new("sh")
        .current_dir(folder.path(""))
        .args([
            "-c",
            "ulimit -f 16; exec \"$0\" shards run studies/tiny --index 0 --of 2 --threads 1 --out out",
            env!("CARGO_BIN_EXE_pirca"),
        ])
        .output()
        .unwrap();
    let found = refused(&full, 1);
    assert!(found.contains("cannot write") && found.contains(".part"), "{found}");
    let status = done(&folder.pirca(&["shards", "status", "out"]));
    assert!(status.contains("1 of 2 shards complete") && status.contains("missing: 0"), "{status}");
    done(&folder.pirca(&shard("0", "2", "out", &[])));
    assert!(merged(&folder, "out") == results(&folder, "whole"));
}

#[test]
fn clocks_decide_nothing() {
    let folder = reference();
    compute_all(&folder, 3, "out", "2");
    let times = [SystemTime::UNIX_EPOCH, SystemTime::now() + Duration::from_secs(400 * 86_400)];
    for (number, entry) in fs::read_dir(folder.path("out/shards")).unwrap().enumerate() {
        fs::File::open(entry.unwrap().path()).unwrap().set_modified(times[number % 2]).unwrap();
    }
    let said = done(&folder.pirca(&shard("1", "3", "out", &[])));
    assert!(said.contains("was complete"), "{said}");
    assert!(merged(&folder, "out") == results(&folder, "whole"));
}

#[test]
fn a_worker_without_the_studys_distributions_computes_nothing() {
    let text = STUDY.replace(
        "length_m = { family = \"uniform\", low = 0.15, high = 0.25 }",
        "length_m = \"stone/size:length\"",
    );
    let folder = Folder::with_study(&text);
    fs::create_dir_all(folder.path("distributions/stone")).unwrap();
    let stone = "quantity = \"length of a stone\"\nsymbol = \"l\"\nunit = \"m\"\n\n[length]\nfamily = \"uniform\"\nlow = 0.15\n\
                 high = 0.25\nstatus = \"assumed\"\nsource = \"a quarry\"\n";
    fs::write(folder.path("distributions/stone/size.toml"), stone).unwrap();
    done(&folder.pirca(&shard("0", "2", "out", &[])));
    // Another machine has another table, or none.
    fs::write(folder.path("distributions/stone/size.toml"), stone.replace("0.25", "0.26")).unwrap();
    let found = refused(&folder.pirca(&shard("1", "2", "out", &[])), 1);
    assert!(found.contains("recorded") && found.contains("0.26"), "{found}");
    fs::remove_dir_all(folder.path("distributions")).unwrap();
    let found = refused(&folder.pirca(&shard("1", "2", "out", &[])), 3);
    assert!(found.contains("stone/size"), "{found}");
    assert!(!file(&folder, "out", 1, 2).exists());
}

#[test]
fn a_plan_says_how_many_shards_and_what_starts_them() {
    let folder = reference();
    let said = done(&folder.pirca(&["shards", "plan", "studies/tiny", "--out", "o'ut", "--seed", "3"]));
    assert!(said.contains("tiny: 18 evaluations of") && said.contains("1 shards of 18"), "{said}");
    assert!(said.contains("--script slurm > shards.sh") && said.contains("--seed 3"), "{said}");
    let plan = done(&folder.pirca(&["shards", "plan", "studies/tiny", "--minutes", "0.0001", "--json"]));
    let plan: serde_json::Value = serde_json::from_str(&plan).unwrap();
    assert_eq!(plan["evaluations"], 18);
    assert!(plan["shards"].as_u64().unwrap() > 1, "{plan}");
    // Places that are spread fall together where there are few walls.
    assert!((12..=18).contains(&plan["timed"]["walls"].as_u64().unwrap()), "{plan}");
    for engine in ["dask", "slurm", "parallel"] {
        let script = done(&folder.pirca(&[
            "shards",
            "plan",
            "studies/tiny",
            "--script",
            engine,
            "--of",
            "5",
            "--out",
            "o'ut",
        ]));
        assert!(script.contains("studies/tiny") && script.contains("ut"), "{script}");
        // No placeholder is left.
        let words = script.split(|c: char| !(c.is_ascii_uppercase() || c == '@' || c == '_'));
        let left: Vec<&str> =
            words.filter(|word| word.len() > 2 && word.starts_with('@') && word.ends_with('@')).collect();
        assert!(left.is_empty(), "{engine}: {left:?}");
        assert!(script.starts_with(if engine == "dask" { "\"\"\"" } else { "#!" }), "{script}");
    }
    for (arguments, said) in [
        (&["run", "--index", "3", "--of", "3", "--out", "out"][..], "numbered from 0 to 2"),
        (&["run", "--index", "3", "--out", "out"], "--of"),
        (&["run", "--out", "out"], "--index"),
        (&["plan", "--points", "30"], "--points is for the walls of a --bank"),
        (&["plan", "--bank", "--seed", "3"], "--seed is for a study's own walls"),
    ] {
        let found = refused(&folder.pirca(&[&["shards"], arguments, &["studies/tiny"]].concat()), 2);
        assert!(found.contains(said), "{found}");
    }
}
