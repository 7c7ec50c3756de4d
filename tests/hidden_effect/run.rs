//! The sealed test, stage by stage: campaigns are solved and sealed, judged by their data, and only then are labels opened.
//!
//! Every campaign is written when it is done, and a run that was stopped goes on where it stood.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use pirca::critic::{Bank, Plan};
use pirca::study::{Loaded, Measurement, Study};
use rayon::prelude::*;

use crate::conflict;
use crate::figure;
use crate::folders::{Folders, begun_with, read, told, write};
use crate::hide::{MASTER, hidden_share, opened, seals, solved_again};
use crate::inference::{Judge, Known, Said, Word};
use crate::laws;
use crate::looks::{LOOKS, Stopped};
use crate::printed;
use crate::record;
use crate::sealed::{self, Sealed};
use crate::shift::shift;
use crate::table::{self, Judged};
use crate::truth::campaign::planned;
use crate::truth::designs::Design;
use crate::truth::label::{Group, Label};
use crate::truth::readings::csv;
use crate::truth::roster::{root, roster};
use crate::wanted;

/// The study of the walls that effects are hidden in, and the bank of its walls.
const STUDY: &str = "studies/tilting-table";
pub const BANK: &str = "studies/tilting-table/bank.parquet";
/// What was said of the published run's campaigns.
pub const RECORD: &str = "studies/hidden-effects/record.parquet";
/// Files that tell what a run was begun with: the secret of its seals, and its bank's design.
pub const SECRET: &str = "secret.txt";
const DESIGN: &str = "design.txt";
/// What the published table begins with, before the share of the full sizes that it is of.
pub const SHARE: &str = "Share of the full sizes: ";
/// What it says before the number of looks that were made.
pub const MADE: &str = "Looks: ";
/// Points of the bank.
const POINTS: u64 = 60;
/// So many campaigns that were judged elsewhere are judged again before others are: what goes on must be the same inference.
const AGAIN: usize = 3;

/// What is said of a campaign, by design.
pub type Verdicts = BTreeMap<String, Said>;

/// The share of the full sizes that is run.
pub fn share() -> f64 {
    let Ok(text) = env::var("HIDDEN_EFFECT_SHARE") else { return 1.0 };
    let share = text.parse().ok().filter(|share| *share > 0.0 && *share <= 1.0);
    share.unwrap_or_else(|| panic!("HIDDEN_EFFECT_SHARE is {text}: a number above 0 and at most 1"))
}

pub fn path(variable: &str, default: &str) -> PathBuf {
    env::var_os(variable).map_or_else(|| root(default), PathBuf::from)
}

/// The study that effects are hidden in.
pub fn loaded() -> &'static Loaded {
    static LOADED: OnceLock<Loaded> = OnceLock::new();
    LOADED.get_or_init(|| Study::load(&root(STUDY), None).unwrap_or_else(|faults| panic!("{faults}")))
}

/// What the inference knows: the study and a bank of its walls.
pub fn known(bank: &Path) -> Known {
    let bytes = fs::read(bank).unwrap_or_else(|error| panic!("{}: {error}", bank.display()));
    let read = |plan: &Plan| Bank::read(&bytes, plan).unwrap_or_else(|error| panic!("{error}"));
    Known::new(loaded().study.clone(), POINTS, read)
}

/// The same without walls: enough to count what has been judged.
pub fn known_without_walls() -> Known {
    let none = |plan: &Plan| {
        let walls = plan.places.len();
        Bank { paths: vec![None; walls], endings: vec![String::new(); walls] }
    };
    Known::new(loaded().study.clone(), POINTS, none)
}

pub fn measured(path: &Path) -> Vec<Measurement> {
    loaded().clone().with_measured(path).unwrap_or_else(|faults| panic!("{faults}")).study.measured
}

/// The secret of a run: that of an earlier one if it is named, or one of its own.
fn secret(folders: &Folders) -> String {
    let named = env::var("HIDDEN_EFFECT_SECRET").ok();
    let path = folders.of("sealed").join(SECRET);
    let now = named.unwrap_or_else(|| if path.exists() { read(&path) } else { sealed::secret() });
    begun_with(folders, SECRET, now)
}

/// The judges of what is known, one for each design, from the first time on that it is asked: by one thread alone, as what
/// trains it hands out work to all threads, which would wait for it.
pub struct Judges<'k> {
    folders: Folders,
    known: &'k Known,
    made: [OnceLock<Judge<'k>>; Design::ALL.len()],
}

impl<'k> Judges<'k> {
    pub fn new(folders: &Folders, known: &'k Known) -> Judges<'k> {
        Judges { folders: folders.clone(), known, made: [const { OnceLock::new() }; Design::ALL.len()] }
    }

    /// The study that they know.
    pub fn study(&self) -> &'k Study {
        &self.known.study
    }

    /// The judge of a design.
    pub fn of(&self, design: Design) -> &Judge<'k> {
        self.made[design as usize].get_or_init(|| {
            self.folders.lack(&format!("something that was said in {}", design.name()));
            let path = self.folders.of("planned").join(format!("{}.csv", design.name()));
            write(&path, &csv(&planned(design)));
            Judge::new(self.known, measured(&path))
        })
    }
}

/// Judges what has not been judged yet in some designs. Judges come into being when there is something for them.
pub fn judged(
    folders: &Folders,
    kind: &str,
    judges: &Judges<'_>,
    designs: &[Design],
    names: &[String],
) -> Vec<Verdicts> {
    let (campaigns, verdicts) = (folders.of("campaigns"), folders.of(kind));
    let path = |name: &String| verdicts.join(format!("{name}.json"));
    let open: Vec<&String> = names.iter().filter(|name| !path(name).exists()).collect();
    solved_again(folders, &judges.known.study, &open);
    if !open.is_empty() {
        for design in designs {
            judges.of(*design);
        }
    }
    open.into_par_iter().for_each(|name| {
        let one = |design: &Design| {
            let file = campaigns.join(name).join(format!("{}.csv", design.name()));
            (design.name().to_owned(), judges.of(*design).said(&measured(&file)))
        };
        let said: Verdicts = designs.iter().map(one).collect();
        write(&path(name), &record::json(&said));
    });
    names.iter().map(|name| told(&path(name))).collect()
}

/// Judges a few campaigns again that were judged before, if possible some in which something was named: what is said must be the same.
fn judged_again(folders: &Folders, judges: &Judges<'_>, names: &[String]) {
    let verdicts = folders.of("verdicts");
    let path = |name: &String| verdicts.join(format!("{name}.json"));
    let mut before: Vec<String> = names.iter().filter(|name| path(name).exists()).cloned().collect();
    let said = |name: &String| told::<Verdicts>(&path(name));
    let speaks = |name: &String| said(name).values().any(|said| said.verdict == Word::Named);
    before.sort_by_key(|name| !speaks(name));
    before.truncate(AGAIN);
    let kind = "again";
    fs::remove_dir_all(folders.of(kind)).expect("it is the run's own");
    for (name, again) in before.iter().zip(judged(folders, kind, judges, &Design::ALL, &before)) {
        for (design, first) in said(name) {
            let again = &again[&design];
            assert!(
                *again == first,
                "{name}, {design}: another inference has said {first:?}, this one says {again:?}: what the two say does not mix"
            );
        }
    }
}

/// Adds how far hidden mechanisms of our code move what a design sees.
fn shifted(folders: &Folders, judges: &Judges<'_>, design: Design, all: &mut [(String, Judged)]) {
    let shifts = folders.of(&format!("shifts/{}", design.name()));
    let path = |name: &String| shifts.join(format!("{name}.json"));
    let asked = all
        .iter_mut()
        .filter(|(_, judged)| judged.design == design.name() && judged.label.group == Group::Mechanism);
    let mut asked: Vec<&mut (String, Judged)> = asked.collect();
    if asked.iter().any(|(name, _)| !path(name).exists()) {
        judges.of(design);
    }
    asked.par_iter_mut().for_each(|(name, judged)| {
        if !path(name).exists() {
            let shift = shift(judges.of(design), &judged.label);
            write(&path(name), &record::json(&shift));
        }
        judged.shift = Some(told(&path(name)));
    });
}

/// Every campaign under every design, with its name.
fn together(names: &[String], labels: &[Label], verdicts: Vec<Verdicts>) -> Vec<(String, Judged)> {
    let all = names.iter().zip(labels).zip(verdicts);
    all.flat_map(|((name, label), verdicts)| {
        verdicts.into_iter().map(|(design, said)| {
            (name.clone(), Judged { label: label.clone(), design, said, conflict: None, shift: None })
        })
    })
    .collect()
}

/// A table with its head, as text; its numbers as a file; what was asked for as a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Printed {
    pub text: String,
    pub csv: String,
    pub figure: String,
}

/// Where the table is published.
pub const TABLES: [&str; 3] = [
    "studies/hidden-effects/table.md",
    "studies/hidden-effects/table.csv",
    "studies/hidden-effects/figures/rates.svg",
];

#[test]
#[ignore = "the sealed test: more than an hour; see studies/hidden-effects"]
fn hidden_effect_campaigns_are_sealed_judged_and_opened() {
    let folders = Folders { out: path("HIDDEN_EFFECT_OUT", "runs/hidden-effects"), is_whole: false };
    let record = path("HIDDEN_EFFECT_RECORD", RECORD);
    record::unpack(&record, &folders.out);
    let known = known(&path("HIDDEN_EFFECT_BANK", BANK));
    let (share, secret) = (share(), secret(&folders));
    begun_with(&folders, DESIGN, known.plan.study.hash.clone());
    let judges = Judges::new(&folders, &known);
    let seals = seals(&folders, &roster(&|_| share, MASTER, &BTreeMap::new()), &secret);
    judged_again(&folders, &judges, &seals.iter().map(Sealed::name).collect::<Vec<_>>());
    // What a run that was stopped has left.
    record::pack(&folders.out, &record);
    stages(&folders, &judges, share, LOOKS.len(), &secret, &mut |printed| {
        record::pack(&folders.out, &record);
        printed.publish();
    });
}

impl Printed {
    /// Writes it where it is published.
    pub fn publish(&self) {
        for (path, text) in TABLES.iter().zip([&self.text, &self.csv, &self.figure]) {
            let path = root(path);
            fs::create_dir_all(path.parent().expect("it lies in a folder")).expect("it can be made");
            write(&path, text);
        }
    }
}

/// Leads through the stages, once for each of so many looks. What comes of a look is told.
pub fn stages(
    folders: &Folders,
    judges: &Judges<'_>,
    share: f64,
    looks: usize,
    secret: &str,
    tell: &mut dyn FnMut(&Printed),
) {
    let mut stopped = Stopped::default();
    for now in 0..looks {
        let sizes = |group: Group| share * LOOKS[stopped.look(group, now)];
        let (names, unsolved) = hidden_share(folders, judges.study(), &sizes, secret);
        let verdicts = judged(folders, "verdicts", judges, &Design::ALL, &names);
        // All verdicts of the look are written: its labels may be opened.
        let labels: Vec<Label> = names.iter().map(|name| opened(folders, name)).collect();
        let mut all = together(&names, &labels, verdicts);
        for design in Design::ALL {
            shifted(folders, judges, design, &mut all);
            conflict::add(folders, judges, design, &mut all);
        }
        let learnt = laws::stage(folders, stopped.look(Group::Law, now));
        let all: Vec<Judged> = all.into_iter().map(|(_, judged)| judged).collect();
        let table = table::of(&all, &learnt);
        stopped.decide(&table, now);
        let unsolved: Vec<String> = unsolved.iter().map(|(kind, count)| format!("{kind} {count}")).collect();
        let text = format!(
            "{SHARE}{share}. {MADE}{} of {}. Groups that stopped before the last: {}. Campaigns judged: {}; laws learnt: {}; \
             not solved, and up to eight others of a kind drawn in their place: {}. Bank: {POINTS} points, design {}. Secret of the seals: {secret}.\n\n\
             What is as wanted is in bold; the README says how to read it.\n\n{}\n## All lines\n\n{}",
            now + 1,
            LOOKS.len(),
            stopped.words(),
            names.len(),
            learnt.len(),
            unsolved.join(", "),
            &read(&folders.of("sealed").join(DESIGN))[..12],
            wanted::markdown(&table),
            printed::markdown(&table),
        );
        tell(&Printed { text, csv: printed::csv(&table), figure: figure::svg(&table) });
        if stopped.all() {
            return;
        }
    }
}
