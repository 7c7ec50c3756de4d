//! The sealed test, stage by stage: campaigns are solved and sealed, judged by their data, and only then are labels opened.
//!
//! Every campaign is written when it is done, and a run that was stopped goes on where it stood.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use pirca::critic::Bank;
use pirca::ensemble::replace_file;
use pirca::study::{Loaded, Measurement, Study, nuisances};
use rayon::prelude::*;

use crate::inference::{Judge, Known, Said};
use crate::printed;
use crate::sealed::Sealed;
use crate::table::{self, Judged};
use crate::truth::campaign::{campaign, planned};
use crate::truth::designs::Design;
use crate::truth::label::{Group, Label};
use crate::truth::readings::csv;
use crate::truth::roster::{catalogue, root, roster};

/// Seed of the roster, far from that of the bank.
const MASTER: u64 = 20_270_214;
/// Points of the bank.
const POINTS: u64 = 120;

/// What is said of a campaign, by design.
type Verdicts = BTreeMap<String, Said>;

/// Where a run lies.
struct Folders {
    out: PathBuf,
}

impl Folders {
    fn of(&self, kind: &str) -> PathBuf {
        let folder = self.out.join(kind);
        fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        folder
    }
}

/// The share of the full sizes that is run.
fn share() -> f64 {
    let Ok(text) = env::var("HIDDEN_EFFECT_SHARE") else { return 1.0 };
    let share = text.parse().ok().filter(|share| *share > 0.0 && *share <= 1.0);
    share.unwrap_or_else(|| panic!("HIDDEN_EFFECT_SHARE is {text}: a number above 0 and at most 1"))
}

fn path(variable: &str, default: &str) -> PathBuf {
    env::var_os(variable).map_or_else(|| root(default), PathBuf::from)
}

fn loaded() -> &'static Loaded {
    static LOADED: OnceLock<Loaded> = OnceLock::new();
    LOADED.get_or_init(|| {
        Study::load(&root("studies/tilting-table"), None).unwrap_or_else(|faults| panic!("{faults}"))
    })
}

fn write(path: &Path, text: &str) {
    replace_file(path, text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn measured(path: &Path) -> Vec<Measurement> {
    loaded().clone().with_measured(path).unwrap_or_else(|faults| panic!("{faults}")).study.measured
}

/// Solves and seals what is not there yet. Gives the names of the campaigns that could be solved, which tell nothing.
fn hidden(folders: &Folders, study: &Study, labels: &[Label]) -> Vec<String> {
    let nuisances = nuisances(&root("distributions")).unwrap_or_else(|lacks| panic!("{lacks}"));
    let (campaigns, sealed) = (folders.of("campaigns"), folders.of("sealed"));
    let mut names: Vec<String> = labels
        .par_iter()
        .filter_map(|label| {
            let secret = Sealed::new(serde_json::to_string(label).expect("a label has string keys only"));
            let seal = secret.seal();
            let name = seal[..16].to_owned();
            let (folder, unsolved) = (campaigns.join(&name), sealed.join(format!("{name}.unsolved")));
            if unsolved.exists() {
                return None;
            }
            if !folder.join("seal.txt").exists() {
                let Some(files) = campaign(study, &nuisances, label) else {
                    write(&unsolved, &format!("{label:?}\n"));
                    return None;
                };
                let json = serde_json::to_string(&secret).expect("two texts");
                write(&sealed.join(format!("{name}.json")), &json);
                let folder = folders.of(&format!("campaigns/{name}"));
                for (design, rows) in files {
                    write(&folder.join(format!("{}.csv", design.name())), &csv(&rows));
                }
                write(&folder.join("seal.txt"), &seal);
            }
            Some(name)
        })
        .collect();
    names.sort();
    names
}

/// One judge for each design.
fn judges<'k>(folders: &Folders, known: &'k Known) -> Vec<(Design, Judge<'k>)> {
    let plans = folders.of("planned");
    let one = |design: Design| {
        let path = plans.join(format!("{}.csv", design.name()));
        write(&path, &csv(&planned(&known.study, design)));
        (design, Judge::new(known, measured(&path)))
    };
    Design::ALL.into_par_iter().map(one).collect()
}

/// Judges what has not been judged yet. Judges come into being when there is something for them.
fn judged(folders: &Folders, kind: &str, known: &Known, names: &[String]) -> Vec<Verdicts> {
    let (campaigns, verdicts) = (folders.of("campaigns"), folders.of(kind));
    let path = |name: &String| verdicts.join(format!("{name}.json"));
    let open: Vec<&String> = names.iter().filter(|name| !path(name).exists()).collect();
    if !open.is_empty() {
        let judges = judges(folders, known);
        open.into_par_iter().for_each(|name| {
            let one = |(design, judge): &(Design, Judge<'_>)| {
                let file = campaigns.join(name).join(format!("{}.csv", design.name()));
                (design.name().to_owned(), judge.said(&measured(&file)))
            };
            let said: Verdicts = judges.iter().map(one).collect();
            write(&path(name), &serde_json::to_string(&said).expect("verdicts have string keys only"));
        });
    }
    let read =
        |name| serde_json::from_str(&read(&path(name))).unwrap_or_else(|error| panic!("{name}: {error}"));
    names.iter().map(read).collect()
}

/// The label of a campaign, which must be the one that was sealed.
fn opened(folders: &Folders, name: &str) -> Label {
    let sealed: Sealed = serde_json::from_str(&read(&folders.of("sealed").join(format!("{name}.json"))))
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    let seal = read(&folders.of("campaigns").join(name).join("seal.txt"));
    assert!(seal.starts_with(name), "the folder {name} has another seal");
    let label = sealed.opened(&seal).unwrap_or_else(|why| panic!("{why}"));
    serde_json::from_str(label).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn together(labels: &[Label], verdicts: Vec<Verdicts>) -> Vec<Judged> {
    let all = labels.iter().zip(verdicts);
    all.flat_map(|(label, verdicts)| {
        verdicts.into_iter().map(|(design, said)| Judged { label: label.clone(), design, said })
    })
    .collect()
}

#[test]
#[ignore = "the sealed test: hours; see studies/hidden-effects"]
fn hidden_effect_campaigns_are_sealed_judged_and_opened() {
    let folders = Folders { out: path("HIDDEN_EFFECT_OUT", "runs/hidden-effects") };
    let share = share();
    let study = loaded().study.clone();
    let all = roster(share, MASTER);
    let names = hidden(&folders, &study, &all);
    let bank = path("HIDDEN_EFFECT_BANK", "studies/tilting-table/bank.parquet");
    let bytes = fs::read(&bank).unwrap_or_else(|error| panic!("{}: {error}", bank.display()));
    let known =
        Known::new(study, POINTS, |plan| Bank::read(&bytes, plan).unwrap_or_else(|error| panic!("{error}")));
    let verdicts = judged(&folders, "verdicts", &known, &names);
    // All verdicts are written: the labels may be opened.
    let labels: Vec<Label> = names.iter().map(|name| opened(&folders, name)).collect();
    let judged_all = together(&labels, verdicts);
    let unsolved = all.len() - names.len();
    let head = format!(
        "Share of the full sizes: {share}. Campaigns judged: {}; not solved: {unsolved}. Bank: {POINTS} points, design {}.\n",
        names.len(),
        &known.plan.study.hash[..12]
    );
    let results = root("studies/hidden-effects");
    let published = |removed: &[Judged]| {
        let table = table::of(&judged_all, removed);
        write(&results.join("table.csv"), &printed::csv(&table));
        write(&results.join("table.md"), &format!("{head}\n{}", printed::markdown(&table)));
    };
    // What takes mechanisms out of the catalogue takes as long again: the rest is published before.
    published(&[]);
    let removed: Vec<Judged> = catalogue()
        .iter()
        .enumerate()
        .flat_map(|(index, mechanism)| {
            let own =
                |label: &&Label| label.group == Group::Mechanism && label.hidden[0].name == mechanism.name;
            let (names, labels): (Vec<String>, Vec<Label>) =
                names.iter().cloned().zip(labels.iter().cloned()).filter(|(_, label)| own(&label)).unzip();
            let kind = format!("verdicts-without/{}", mechanism.name);
            together(&labels, judged(&folders, &kind, &known.without(index), &names))
        })
        .collect();
    published(&removed);
}
