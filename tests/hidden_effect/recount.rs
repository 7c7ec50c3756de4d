//! The published table is what the record says, counted anew.

use std::env;
use std::fs;
use std::path::Path;

use crate::folders::{Folders, read};
use crate::record;
use crate::run::{
    Judges, MADE, Printed, RECORD, SECRET, SHARE, TABLES, known_without_walls, path, share, stages,
};
use crate::truth::roster::root;

#[test]
fn the_published_table_is_what_the_record_says() {
    let folders = Folders { out: Path::new(env!("CARGO_TARGET_TMPDIR")).join("recount"), is_whole: true };
    if folders.out.exists() {
        fs::remove_dir_all(&folders.out).expect("the folder is the test's own");
    }
    record::unpack(&root(RECORD), &folders.out);
    let [text, csv, figure] = TABLES.map(|path| read(&root(path)));
    let after = |what: &str, end: &str| text.split_once(what)?.1.split(end).next();
    let share = after(SHARE, ". ").and_then(|text| text.parse().ok());
    let share = share.unwrap_or_else(|| panic!("{} begins with its share", TABLES[0]));
    let looks = after(MADE, " of ").and_then(|text| text.parse().ok());
    let looks = looks.unwrap_or_else(|| panic!("{} says how many looks were made", TABLES[0]));
    let secret = read(&folders.of("sealed").join(SECRET));
    let mut counted = None;
    let known = known_without_walls();
    stages(&folders, &Judges::new(&folders, &known), share, looks, &secret, &mut |printed| {
        counted = Some(printed.clone())
    });
    let (counted, published) = (counted.expect("it is told"), Printed { text, csv, figure });
    for (own, other) in [
        (&counted.text, &published.text),
        (&counted.csv, &published.csv),
        (&counted.figure, &published.figure),
    ] {
        own.lines().zip(other.lines()).for_each(|(own, other)| assert_eq!(own, other));
    }
    assert_eq!(counted, published);
}

/// A run that was stopped after a look: what it has come to is published.
#[test]
#[ignore = "by hand: publishes the looks of a run that was stopped (HIDDEN_EFFECT_LOOKS)"]
fn hidden_effect_campaigns_of_a_run_are_published() {
    let folders = Folders { out: path("HIDDEN_EFFECT_OUT", "runs/hidden-effects"), is_whole: true };
    let looks = env::var("HIDDEN_EFFECT_LOOKS").ok().and_then(|text| text.parse().ok());
    let looks = looks.expect("HIDDEN_EFFECT_LOOKS says how many looks were made");
    record::pack(&folders.out, &path("HIDDEN_EFFECT_RECORD", RECORD));
    let secret = read(&folders.of("sealed").join(SECRET));
    let known = known_without_walls();
    stages(&folders, &Judges::new(&folders, &known), share(), looks, &secret, &mut |printed| {
        printed.publish()
    });
}
