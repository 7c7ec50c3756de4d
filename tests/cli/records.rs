//! The benches' records: a scene that has become slower is told, and stands in the changelog.

#[path = "../../benches/record/history.rs"]
mod history;
#[path = "../../benches/record/machine.rs"]
mod machine;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use history::{COLUMNS, Dated, History, Row, dated, rows, warning, written};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/history")
}

fn row(scene: &str, median: f64, unit: &str) -> Row {
    let text =
        format!("scene,quantity,median,low,high,unit\n{scene},tilt,{median},{median},{median},{unit}\n");
    rows(&text).expect("it is a record").remove(0)
}

fn history(rows: &[(&str, Row)]) -> History {
    let dated = |(date, row): &(&str, Row)| Dated { date: (*date).to_owned(), row: row.clone() };
    History { rows: rows.iter().map(dated).collect() }
}

#[test]
fn a_scene_that_takes_longer_than_its_last_record_is_reported() {
    let records = history(&[
        ("2026-01-01", row("wall", 1.0, "s")),
        ("2026-01-02", row("wall", 100.0, "ms")),
        ("2026-01-02", row("heap", 1000.0, "1/s")),
    ]);
    // 121 ms beside 100 ms, and not beside the second of the day before; a rate that falls is slower, too.
    let slow = [row("wall", 0.121, "s"), row("heap", 800.0, "1/s")];
    let text = warning(&records, &slow).expect("both are slower");
    assert!(text.contains("wall, tilt: 0.121 s, 1.21 times the cost of 2026-01-02 (100 ms)"), "{text}");
    assert!(text.contains("heap, tilt: 800 1/s, 1.25 times the cost of 2026-01-02 (1000 1/s)"), "{text}");
    assert!(text.starts_with("SLOWER than 1.2 times the last record: 2 of 2 scenes. "), "{text}");
    assert!(text.find("heap,") < text.find("wall,"), "the worst first: {text}");
    // 119 ms, a rate that grows, and a scene without a record are no reason to shout.
    let fine = [row("wall", 119.0, "ms"), row("heap", 2000.0, "1/s"), row("new", 9.0, "s")];
    assert_eq!(warning(&records, &fine), None);
    // Seconds do not compare with pieces per second.
    assert_eq!(row("wall", 9.0, "s").ratio_to(&row("wall", 9.0, "1/s")), None);
}

#[test]
fn a_record_is_read_as_it_was_written_and_a_second_one_replaces_what_was_run_again() {
    let mut first = row("wall", 3.25e6, "1/s");
    first.note = "half of the joints, \"open\"".to_owned();
    first.runs = "11".to_owned();
    let others = [row("heap", 0.35, "ms"), row("tower", 12.5, "s")];
    let text = written(vec![first.clone()], &others);
    assert!(text.starts_with(&COLUMNS.join(",")), "{text}");
    let again = rows(&text).expect("it was written");
    assert_eq!(again, [&[first.clone()], &others[..]].concat());
    let faster = row("heap", 0.25, "ms");
    let later = rows(&written(again, std::slice::from_ref(&faster))).expect("it was written");
    assert_eq!(later, [first, others[1].clone(), faster]);
    for (text, fault) in [
        ("scene,quantity,median,low,high\n", "no column `unit`"),
        ("scene,quantity,median,low,high,unit\nwall,tilt,1,1,1,min\n", "line 2: unit is `min`"),
        ("scene,quantity,median,low,high,unit\n\nwall,tilt,-1,1,1,s\n", "line 3: median is `-1`"),
    ] {
        let found = rows(text).expect_err("it is no record");
        assert!(found.starts_with(fault), "{found}");
    }
}

#[test]
fn machines_and_days_have_names() {
    let cpuinfo = |model: &str| format!("processor : 0\nmodel\t\t: 167\nmodel name\t: {model}\n");
    for (cores, model, kind) in [
        (2, "Intel(R) Xeon(R) Processor", "2-core-xeon"),
        (8, "Intel(R) Xeon(R) Platinum 8481C CPU @ 2.70GHz", "8-core-xeon-platinum-8481c"),
        (16, "AMD EPYC 7763 64-Core Processor", "16-core-epyc-7763"),
    ] {
        assert_eq!(machine::kind(cores, &cpuinfo(model)), kind);
    }
    assert_eq!(machine::kind(4, ""), format!("4-core-{}", std::env::consts::ARCH));
    assert_eq!(machine::processor(&cpuinfo("X")), "X family ? model 167 stepping ?");
    for (days, date) in
        [(0, "1970-01-01"), (11_016, "2000-02-29"), (19_722, "2023-12-31"), (20_513, "2026-03-01")]
    {
        assert_eq!(machine::date(days), date);
    }
    assert_eq!(dated("2026-11-21-2-core-xeon.csv"), Some(("2026-11-21", "2-core-xeon")));
    assert_eq!((dated("2026-11-21.csv"), dated("README.md"), dated("2026-1-210-x.csv")), (None, None, None));
}

/// Every row that is slower than the one recorded before it, with that one.
fn slowed(history: &History) -> Vec<[&Dated; 2]> {
    let mut slowed = Vec::new();
    for (at, now) in history.rows.iter().enumerate() {
        let before = history.rows[..at].iter().rev().find(|before| before.row.name() == now.row.name());
        slowed
            .extend(before.filter(|before| now.row.is_slower_than(&before.row)).map(|before| [before, now]));
    }
    slowed
}

/// Every scene that was recorded as slower than before stands in the changelog by its name.
#[test]
fn what_has_become_slower_stands_in_the_changelog() {
    let names =
        fs::read_dir(folder()).expect("there are records").map(|entry| entry.expect("a file").file_name());
    let names: Vec<String> = names.map(|name| name.to_string_lossy().into_owned()).collect();
    let machine = |name: &String| {
        dated(name).unwrap_or_else(|| panic!("{name} is no <date>-<machine>.csv")).1.to_owned()
    };
    let machines: BTreeSet<String> = names.iter().map(machine).collect();
    let changelog = include_str!("../../CHANGELOG.md").split_whitespace().collect::<Vec<_>>().join(" ");
    let mut count = 0;
    for machine in machines {
        let history = History::read(&folder(), &machine).unwrap_or_else(|fault| panic!("{fault}"));
        for [before, now] in slowed(&history) {
            count += 1;
            assert!(
                changelog.contains(&format!("`{}`", now.row.name())),
                "`{}` took {} {} on {} and takes {} {} on {}: CHANGELOG.md must say why",
                now.row.name(),
                before.row.median,
                before.row.unit,
                before.date,
                now.row.median,
                now.row.unit,
                now.date
            );
        }
    }
    // The tilting test of the stiffest joints became eight times slower on 22 November.
    assert!(count > 0, "the records are not read");
}
