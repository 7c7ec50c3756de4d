//! Which campaigns there are: all groups in their full sizes, or a share of each.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pirca::random::{Stream, Streams};
use pirca::study::{Described, described};

use super::decoys::DECOYS;
use super::effect::normal;
use super::label::{Group, Hidden, Label};
use super::strength::{self, Strength};
use super::unknown::UNKNOWN;
use super::variants::WRITTEN_TWICE;

/// Full sizes: campaigns of each group, for mechanisms at each strength, for pairs and decoys in all.
const NOTHING: u64 = 600;
const PRIOR_WRONG: u64 = 400;
const PER_STRENGTH: u64 = 60;
const PAIRS: u64 = 300;
const PER_UNKNOWN: u64 = 100;
const PER_DECOY: u64 = 50;
/// One in so many campaigns of a mechanism is written in another code, where there is one.
const OTHER_CODE: u64 = 3;
/// Where nothing in the catalogue is wrong but the priors: so many standard deviations.
const FAR: [f64; 2] = [1.5, 2.5];

/// What is hidden in a campaign of a kind, by its number and with draws of its own.
type Make<'m> = dyn Fn(u64, &mut Stream) -> (Group, Vec<Hidden>) + 'm;

/// Came into the catalogue after the record of the sealed test was made.
pub const LATER: &str = "stress_stiffening";

/// The catalogue with its priors, as the record of the sealed test has it.
pub fn catalogue() -> Vec<Described> {
    let mut all = described(&root("distributions")).unwrap_or_else(|lacks| panic!("{lacks}"));
    all.retain(|mechanism| mechanism.name != LATER);
    all
}

/// A folder of the repository.
pub fn root(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

/// The campaigns of a share of the full sizes, at least one of each [kind](Label::kind), and so many more of a kind, in the place of
/// those that cannot be solved. A larger share holds those of a smaller one.
pub fn roster(share: f64, master: u64, more: &BTreeMap<String, u64>) -> Vec<Label> {
    let some = |full: u64| ((full as f64 * share).round() as u64).max(1);
    let mechanisms = catalogue();
    let mut labels = Vec::new();
    let mut add = |kind: String, count: u64, make: &Make<'_>| {
        for k in 0..count + more.get(&kind).copied().unwrap_or(0) {
            let streams = Streams::new(master, k);
            let mut stream = streams.of(&format!("roster {kind}"));
            let seed = (stream.uniform() * (1_u64 << 52) as f64) as u64;
            let (group, hidden) = make(k, &mut stream);
            let mut joints = std::array::from_fn(|_| std::array::from_fn(|_| normal(&mut stream)));
            if group == Group::PriorWrong {
                joints.iter_mut().for_each(|scores| far(scores, &mut stream));
            }
            let label = Label { group, seed, joints, hidden };
            assert_eq!(label.kind(), kind);
            labels.push(label);
        }
    };
    add("nothing".into(), some(NOTHING), &|_, _| (Group::Nothing, Vec::new()));
    add("prior wrong".into(), some(PRIOR_WRONG), &|_, _| (Group::PriorWrong, Vec::new()));
    for mechanism in &mechanisms {
        for strength in Strength::ALL {
            let twice = WRITTEN_TWICE.contains(&mechanism.name);
            let kind = format!("{} {}", mechanism.name, strength.name());
            add(kind, some(PER_STRENGTH), &|k, stream| {
                let other_code = twice && k % OTHER_CODE == OTHER_CODE - 1;
                (Group::Mechanism, vec![hidden(mechanism, strength, other_code, stream)])
            });
        }
    }
    add("pair".into(), some(PAIRS), &|_, stream| {
        let first = stream.below(mechanisms.len());
        let second = (first + 1 + stream.below(mechanisms.len() - 1)) % mechanisms.len();
        let pair = [first, second].map(|index| {
            // What is weak on its own is not looked for in company.
            let strength = Strength::ALL[1 + stream.below(2)];
            hidden(&mechanisms[index], strength, false, stream)
        });
        (Group::Pair, pair.to_vec())
    });
    for unknown in &UNKNOWN {
        add(unknown.name.to_owned(), some(PER_UNKNOWN), &|_, stream| {
            let value = |(key, low, high): &(&str, f64, f64)| {
                ((*key).to_owned(), low + (high - low) * stream.uniform())
            };
            let parameters = unknown.parameters.iter().map(value).collect();
            (Group::Unknown, vec![plain(unknown.name, parameters)])
        });
    }
    for name in DECOYS {
        add(name.to_owned(), some(PER_DECOY), &|_, stream| {
            (Group::Decoy, vec![plain(name, vec![("which".to_owned(), stream.uniform())])])
        });
    }
    labels
}

fn hidden(mechanism: &Described, strength: Strength, other_code: bool, stream: &mut Stream) -> Hidden {
    Hidden {
        strength: Some(strength),
        other_code,
        ..plain(mechanism.name, strength::drawn(mechanism, strength, stream))
    }
}

fn plain(name: &str, parameters: Vec<(String, f64)>) -> Hidden {
    Hidden { name: name.to_owned(), strength: None, other_code: false, parameters }
}

/// Moves kn and the friction angle away from where they are thought to be.
fn far(scores: &mut [f64; 3], stream: &mut Stream) {
    for score in &mut scores[..2] {
        let size = FAR[0] + (FAR[1] - FAR[0]) * stream.uniform();
        *score = size.copysign(stream.uniform() - 0.5);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_full_roster_has_its_sizes_and_a_share_is_part_of_it() {
        let full = roster(1.0, 5, &BTreeMap::new());
        let count = |group: Group| full.iter().filter(|label| label.group == group).count();
        assert_eq!((count(Group::Nothing), count(Group::PriorWrong)), (600, 400));
        assert_eq!((count(Group::Mechanism), count(Group::Pair)), (17 * 3 * 60, 300));
        assert_eq!((count(Group::Unknown), count(Group::Decoy)), (1400, 200));
        let other = full.iter().filter(|label| label.hidden.iter().any(|hidden| hidden.other_code)).count();
        assert_eq!(other, WRITTEN_TWICE.len() * 3 * 20);
        let more = BTreeMap::from([("pair".to_owned(), 3)]);
        let [share, with_more] = [BTreeMap::new(), more].map(|more| roster(0.02, 5, &more));
        assert!(with_more.len() == share.len() + 3 && with_more.iter().all(|label| full.contains(label)));
        assert!(share.iter().all(|label| full.contains(label)) && share.len() < full.len() / 40);
        let mut seeds: Vec<u64> = full.iter().map(|label| label.seed).collect();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), full.len());
        assert!(
            full.iter()
                .filter(|label| label.group == Group::Pair)
                .all(|pair| pair.hidden[0].name != pair.hidden[1].name)
        );
    }
}
