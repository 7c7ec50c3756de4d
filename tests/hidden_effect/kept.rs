//! A few campaigns of the published run, hidden, judged and opened anew: what was found is still found, and what was named still
//! named, and where nothing is hidden nothing is.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::inference::Word;
use crate::run::{Folders, Judges, PLAIN, hidden, judged, known, loaded, opened};
use crate::truth::label::Label;

/// A campaign, with what was said of it.
#[derive(Deserialize)]
struct Kept {
    paper: Word,
    rich: Word,
    label: Label,
}

#[test]
fn what_was_said_of_some_campaigns_of_nine_walls_is_still_said() {
    let kept: Vec<Kept> = serde_json::from_str(include_str!("kept.json")).expect("campaigns with verdicts");
    let folders = Folders { out: Path::new(env!("CARGO_TARGET_TMPDIR")).join("kept-campaigns") };
    if folders.out.exists() {
        // Verdicts of another day are not today's.
        fs::remove_dir_all(&folders.out).expect("the folder is the test's own");
    }
    let labels: Vec<Label> = kept.iter().map(|one| one.label.clone()).collect();
    let names = hidden(&folders, &loaded().study, &labels);
    assert_eq!(names.len(), kept.len(), "not all could be solved");
    let known = known();
    let verdicts = judged(&folders, "verdicts", &Judges::new(&folders, &known), &PLAIN, &names);
    for (name, verdicts) in names.iter().zip(&verdicts) {
        let label = opened(&folders, name);
        let one = kept.iter().find(|one| one.label == label).expect("it was kept");
        for (design, word) in PLAIN.into_iter().zip([one.paper, one.rich]) {
            let said = &verdicts[design.name()];
            assert_eq!(said.verdict, word, "{}: {label:?} {said:?}", design.name());
            if word == Word::Named {
                assert_eq!(said.names, [label.hidden[0].name.as_str()], "{}: {said:?}", design.name());
            }
        }
    }
}
