//! The truth's side of a run: labels are sealed, their campaigns solved, and in the end they are opened.

use std::collections::BTreeMap;
use std::fs;

use pirca::study::{Study, nuisances};
use rayon::prelude::*;

use crate::folders::{Folders, put, read, told, write};
use crate::sealed::Sealed;
use crate::truth::campaign::campaign;
use crate::truth::label::{Group, Label};
use crate::truth::readings::csv;
use crate::truth::roster::{root, roster};

/// Seed of the roster, far from that of the bank, and none that the inference was made better by.
pub const MASTER: u64 = 20_361_128;
/// At most so many others of a kind are drawn in the place of campaigns that cannot be solved: where these cannot either, walls with
/// that hidden in them do not stand, and the kind is short of campaigns.
const OTHERS: u64 = 8;
/// What a campaign's folder holds besides its data, when these are whole.
const SEAL: &str = "seal.txt";

/// Seals labels, in their order.
pub fn seals(folders: &Folders, labels: &[Label], secret: &str) -> Vec<Sealed> {
    let folder = folders.of("sealed");
    let seal = |label: &Label| {
        let own = Sealed::new(secret, serde_json::to_string(label).expect("a label has string keys only"));
        let text = serde_json::to_string(&own).expect("two texts");
        put(&folder.join(format!("{}.json", own.name())), &text);
        own
    };
    labels.iter().map(seal).collect()
}

/// Seals labels, and solves what has neither been solved nor judged yet. Gives the names of the campaigns that could be solved, which
/// tell nothing, in an order that tells nothing and is the same for every secret; and how many of each kind could not.
pub fn hidden(
    folders: &Folders,
    study: &Study,
    labels: &[Label],
    secret: &str,
) -> (Vec<String>, BTreeMap<String, u64>) {
    let (folder, verdicts) = (folders.of("sealed"), folders.of("verdicts"));
    let seals = seals(folders, labels, secret);
    let solved: Vec<Option<(u64, String)>> = labels
        .par_iter()
        .zip(&seals)
        .map(|(label, own)| {
            let name = own.name();
            let unsolved = folder.join(format!("{name}.unsolved"));
            if unsolved.exists() {
                return None;
            }
            if !verdicts.join(format!("{name}.json")).exists() && !solve(folders, study, label, own) {
                write(&unsolved, &format!("{label:?}\n"));
                return None;
            }
            Some((label.seed, name))
        })
        .collect();
    let mut unsolved: BTreeMap<String, u64> = BTreeMap::new();
    for (label, _) in labels.iter().zip(&solved).filter(|(_, solved)| solved.is_none()) {
        *unsolved.entry(label.kind()).or_default() += 1;
    }
    let mut names: Vec<(u64, String)> = solved.into_iter().flatten().collect();
    names.sort();
    (names.into_iter().map(|(_, name)| name).collect(), unsolved)
}

/// Solves a campaign that is not there yet; `false` where it cannot be solved.
fn solve(folders: &Folders, study: &Study, label: &Label, sealed: &Sealed) -> bool {
    let folder = folders.of("campaigns").join(sealed.name());
    if folder.join(SEAL).exists() {
        return true;
    }
    folders.lack(&format!("what was said of {}, and so its data", sealed.name()));
    let nuisances = nuisances(&root("distributions")).unwrap_or_else(|lacks| panic!("{lacks}"));
    let Some(files) = campaign(study, &nuisances, label) else { return false };
    fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for (design, rows) in files {
        write(&folder.join(format!("{}.csv", design.name())), &csv(&rows));
    }
    write(&folder.join(SEAL), &sealed.seal());
    true
}

/// Solves campaigns that are to be judged once more and were solved elsewhere. Their labels may be opened: verdicts on them are written.
pub fn solved_again(folders: &Folders, study: &Study, names: &[&String]) {
    let campaigns = folders.of("campaigns");
    let lost = names.par_iter().filter(|name| !campaigns.join(name).join(SEAL).exists());
    lost.for_each(|name| {
        let (sealed, label) = unsealed(folders, name);
        assert!(solve(folders, study, &label, &sealed), "{name} was solved before");
    });
}

/// Solves and seals a share of the full size of each group, with others of its kind in the place of each that cannot be solved. What
/// could not is counted, by kind.
pub fn hidden_share(
    folders: &Folders,
    study: &Study,
    share: &dyn Fn(Group) -> f64,
    secret: &str,
) -> (Vec<String>, BTreeMap<String, u64>) {
    let mut more = BTreeMap::new();
    loop {
        let (names, unsolved) = hidden(folders, study, &roster(share, MASTER, &more), secret);
        let drawn = unsolved.iter().map(|(kind, count)| (kind.clone(), (*count).min(OTHERS))).collect();
        if drawn == more {
            return (names, unsolved);
        }
        more = drawn;
    }
}

/// The label of a campaign, which must be the one that was sealed.
pub fn opened(folders: &Folders, name: &str) -> Label {
    unsealed(folders, name).1
}

fn unsealed(folders: &Folders, name: &str) -> (Sealed, Label) {
    let sealed: Sealed = told(&folders.of("sealed").join(format!("{name}.json")));
    let seal = folders.of("campaigns").join(name).join(SEAL);
    assert!(!seal.exists() || read(&seal) == sealed.seal(), "{} is of another label", seal.display());
    let label = sealed.opened(name).unwrap_or_else(|why| panic!("{why}"));
    let label = serde_json::from_str(label).unwrap_or_else(|error| panic!("{name}: {error}"));
    (sealed, label)
}
