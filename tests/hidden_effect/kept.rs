//! A few campaigns of the published run, hidden, judged and opened anew: what is said of them is what was said.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::folders::Folders;
use crate::hide::{MASTER, hidden, opened};
use crate::inference::Word;
use crate::record;
use crate::run::{BANK, Judges, Verdicts, judged, known, loaded};
use crate::truth::designs::Design;
use crate::truth::label::Label;
use crate::truth::roster::{root, roster};

/// By their kinds, of which each is the first, with what is said of them by the designs.
const KEPT: [(&str, [Word; Design::ALL.len()]); 8] = [
    ("end_release strong", [Word::Ambiguous, Word::Named]),
    ("gauge_offset strong", [Word::Named, Word::NamedOutsidePrior]),
    ("joint_closure strong", [Word::Unexplained, Word::Named]),
    ("rope_slack strong", [Word::Ambiguous, Word::Named]),
    ("lean 4 out", [Word::NamedOutsidePrior, Word::Unexplained]),
    ("nothing", [Word::NothingFound, Word::NothingFound]),
    ("prior wrong", [Word::NothingFound, Word::NothingFound]),
    ("soft_left", [Word::NothingFound, Word::Unexplained]),
];

#[test]
#[ignore = "slow: eight campaigns of nine walls are solved and judged, three minutes of processor time"]
fn what_was_said_of_some_campaigns_of_nine_walls_is_still_said() {
    let folders =
        Folders { out: Path::new(env!("CARGO_TARGET_TMPDIR")).join("kept-campaigns"), is_whole: false };
    if folders.out.exists() {
        // Verdicts of another day are not today's.
        fs::remove_dir_all(&folders.out).expect("the folder is the test's own");
    }
    let kept = |label: &Label| KEPT.iter().find(|(kind, _)| *kind == label.kind());
    // The first of each kind.
    let mut labels = roster(&|_| 0.0, MASTER, &BTreeMap::new());
    labels.retain(|label| kept(label).is_some());
    let (names, _) = hidden(&folders, &loaded().study, &labels, "kept");
    assert_eq!(names.len(), KEPT.len(), "they are in the roster, and can be solved");
    let known = known(&root(BANK));
    let judges = Judges::new(&folders, &known);
    let verdicts = judged(&folders, "verdicts", &judges, &Design::ALL, &names);
    for (name, verdicts) in names.iter().zip(&verdicts) {
        let label = opened(&folders, name);
        let (_, words) = kept(&label).expect("it was kept");
        for (design, word) in Design::ALL.iter().zip(words) {
            let said = &verdicts[design.name()];
            assert_eq!(said.verdict, *word, "{}: {label:?} {said:?}", design.name());
            if matches!(word, Word::Named | Word::NamedOutsidePrior | Word::Ambiguous) {
                assert!(said.names.contains(&label.hidden[0].name), "{}: {label:?} {said:?}", design.name());
            }
        }
    }
    goes_on_elsewhere(&folders, &labels, &judges, &names, &verdicts);
}

/// From its record a run goes on elsewhere: nothing is solved or judged again but what is asked for anew.
fn goes_on_elsewhere(
    folders: &Folders,
    labels: &[Label],
    judges: &Judges<'_>,
    names: &[String],
    verdicts: &[Verdicts],
) {
    let (elsewhere, record) =
        (Folders { out: folders.out.join("elsewhere"), is_whole: false }, folders.out.join("record.parquet"));
    record::pack(&folders.out, &record);
    record::unpack(&record, &elsewhere.out);
    assert_eq!(hidden(&elsewhere, &loaded().study, labels, "kept").0, names);
    assert_eq!(judged(&elsewhere, "verdicts", judges, &Design::ALL, names), verdicts);
    let campaigns = elsewhere.out.join("campaigns");
    assert!(!campaigns.exists() || fs::read_dir(&campaigns).expect("a folder").next().is_none());
    // Judged once more, from data that are solved anew.
    let again = judged(&elsewhere, "again", judges, &Design::ALL[..1], &names[..1]);
    let design = Design::ALL[0].name();
    assert_eq!(again[0][design], verdicts[0][design]);
    let [first, second] = [&folders.out, &elsewhere.out].map(|out| {
        let file = out.join("campaigns").join(&names[0]).join(format!("{design}.csv"));
        fs::read_to_string(file).expect("it was solved")
    });
    assert_eq!(first, second);
}
