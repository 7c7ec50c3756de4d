//! A finished run grows: more members, another stiffness, another arm compute only what is new, and give the bytes of a fresh run.

use std::fs;

use crate::fixture::{Folder, STUDY, changed, stderr};
use crate::threads::results;

/// The study with a third arm before the others.
fn with_arm() -> String {
    let arm = "[[arm]]\nname = \"wide\"\nmembers = 4\narrangement = \"coursed\"\n\
               length_m = { family = \"uniform\", low = 0.2, high = 0.3 }\n\
               height_m = { family = \"uniform\", low = 0.09, high = 0.11 }\ndip_deg = 0\n\n";
    STUDY.replacen("[[arm]]", &format!("{arm}[[arm]]"), 1)
}

/// Runs a study in a folder and says what it printed on the way.
fn run(folder: &Folder, out: &str, threads: &str) -> String {
    let output = folder.pirca(&["run", "studies/tiny", "--out", out, "--threads", threads]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    stderr(&output)
}

#[test]
fn what_is_new_is_computed_alone_and_the_bytes_are_those_of_a_fresh_run() {
    let more = changed("members = 8", "members = 12");
    let stiffer = changed("kn_pa_per_m = [5e7, 1.75e8]", "kn_pa_per_m = [2.5e7, 5e7, 1.75e8]");
    for (text, taken, evaluations, recorded) in [
        (more, "taken over: stack 2 of 2, random 16 of 24", 26, 18),
        (stiffer, "taken over: stack 2 of 3, random 16 of 24", 27, 18),
        (with_arm(), "taken over: wide 0 of 8, stack 2 of 2, random 16 of 16", 26, 18),
    ] {
        let folder = Folder::with_study(STUDY);
        run(&folder, "out", "2");
        folder.write_study(&text);
        let said = run(&folder, "out", "2");
        assert!(said.contains("goes on from another run in this folder"), "{said}");
        assert!(said.contains(taken), "{taken}: {said}");
        let counted = format!("{evaluations} evaluations, {recorded} of them recorded before");
        assert!(said.contains(&counted), "{counted}: {said}");
        for threads in ["1", "2", "7"] {
            run(&folder, &format!("fresh-{threads}"), threads);
            assert!(results(&folder, "out") == results(&folder, &format!("fresh-{threads}")), "{taken}");
        }
        // It is this run now: nothing is said of another one, and nothing is evaluated.
        let again = run(&folder, "out", "1");
        assert!(!again.contains("another run"), "{again}");
        assert!(again.contains(&format!("{evaluations} of them recorded before")), "{again}");
        // The smaller study is answered from the record as well.
        folder.write_study(STUDY);
        let back = run(&folder, "out", "2");
        assert!(back.contains("18 evaluations, 18 of them recorded before"), "{back}");
        assert!(back.contains("are not part of this run and stay aside"), "{back}");
        run(&folder, "small", "2");
        assert!(results(&folder, "out") == results(&folder, "small"));
    }
}

#[test]
fn a_changed_wall_is_computed_anew_and_the_others_are_taken_over() {
    let folder = Folder::with_study(STUDY);
    run(&folder, "out", "2");
    folder.write_study(&changed("low = 0.15, high = 0.25", "low = 0.16, high = 0.25"));
    let said = run(&folder, "out", "2");
    assert!(said.contains("arm.random.length_m: "), "{said}");
    assert!(
        said.contains("taken over: stack 2 of 2, random 0 of 16; 16 recorded walls are not part"),
        "{said}"
    );
    run(&folder, "fresh", "2");
    assert!(results(&folder, "out") == results(&folder, "fresh"));
}

/// A record of before walls had hashes is gone on from by what its head says.
#[test]
fn a_record_without_hashes_of_its_walls_grows_as_well() {
    let folder = Folder::with_study(STUDY);
    run(&folder, "out", "2");
    let path = folder.path("out/journal.jsonl");
    let text = fs::read_to_string(&path).unwrap();
    let older: String = text.lines().map(without_hash).collect();
    assert!(!older.contains("\"wall\":"));
    fs::write(&path, older).unwrap();
    folder.write_study(&changed("members = 8", "members = 9"));
    let said = run(&folder, "out", "2");
    assert!(said.contains("taken over: stack 2 of 2, random 16 of 18"), "{said}");
}

/// A line of a journal as it was before: its check is of the JSON without the hash.
fn without_hash(line: &str) -> String {
    use sha2::{Digest, Sha256};
    let entry = &line[line.find("\"entry\":").unwrap() + 8..line.len() - 1];
    let json = match entry.find("\"wall\":\"") {
        Some(at) => {
            let end = at + entry[at + 8..].find('"').unwrap() + 10;
            format!("{}{}", &entry[..at], &entry[end..])
        }
        None => entry.to_owned(),
    };
    let check: String =
        Sha256::digest(json.as_bytes()).iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    format!("{{\"check\":\"{check}\",\"entry\":{json}}}\n")
}
