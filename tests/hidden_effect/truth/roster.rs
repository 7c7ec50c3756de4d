//! Which campaigns there are: all groups in their full sizes, or a share of each.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pirca::math::{exp, ln};
use pirca::random::{Stream, Streams};
use pirca::study::{Described, described};

use super::decoys::DECOYS;
use super::effect::normal;
use super::label::{Group, Hidden, Label};
use super::laws::{KNEE_PA, LAWS, SOFT_SHARE};
use super::strength::{Strength, Within, drawn, drawn_outside, outside};
use super::unknown::UNKNOWN;
use super::variants::WRITTEN_TWICE;

/// Full sizes: campaigns of a group, or of each kind in it.
const NOTHING: u64 = 150;
const PRIOR_WRONG: u64 = 80;
const PER_STRENGTH: u64 = 4;
const PER_OTHER_CODE: u64 = 4;
const PER_SPREADS: u64 = 6;
const PER_LAW: u64 = 8;
const PAIRS: u64 = 24;
const PER_UNKNOWN: u64 = 5;
const PER_DECOY: u64 = 6;
/// Standard deviations of the physical prior at which mechanisms are hidden outside of it.
pub const SPREADS: [u32; 3] = [2, 3, 4];
/// Where nothing in the catalogue is wrong but the priors: so many standard deviations.
const FAR: [f64; 2] = [1.5, 2.5];

/// So many mechanisms of the catalogue, the first, are hidden: those that there were when the record was made. One more is another roster, which
/// asks for a record made anew.
const RECORDED: usize = 18;

/// What is hidden in a campaign of a kind, by its number and with draws of its own.
type Make<'m> = dyn Fn(u64, &mut Stream) -> Vec<Hidden> + 'm;

/// The catalogue with its priors.
pub fn catalogue() -> Vec<Described> {
    described(&root("distributions")).unwrap_or_else(|lacks| panic!("{lacks}"))
}

/// Those of them that are hidden.
pub fn recorded() -> Vec<Described> {
    catalogue().into_iter().take(RECORDED).collect()
}

/// A folder of the repository.
pub fn root(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

/// The campaigns of a share of the full size of each group, at least one of each [kind](Label::kind), and so many more of a kind, in
/// the place of those that cannot be solved. A larger share holds those of a smaller one.
pub fn roster(share: &dyn Fn(Group) -> f64, master: u64, more: &BTreeMap<String, u64>) -> Vec<Label> {
    let mechanisms = recorded();
    let mut labels = Vec::new();
    let mut add = |group: Group, kind: String, full: u64, make: &Make<'_>| {
        let count = ((full as f64 * share(group)).round() as u64).max(1);
        for k in 0..count + more.get(&kind).copied().unwrap_or(0) {
            let streams = Streams::new(master, k);
            let mut stream = streams.of(&format!("roster {kind}"));
            let seed = (stream.uniform() * (1_u64 << 52) as f64) as u64;
            let hidden = make(k, &mut stream);
            let mut joints = std::array::from_fn(|_| std::array::from_fn(|_| normal(&mut stream)));
            if group == Group::PriorWrong {
                joints.iter_mut().for_each(|scores| far(scores, &mut stream));
            }
            let label = Label { group, seed, joints, hidden };
            assert_eq!(label.kind(), kind);
            labels.push(label);
        }
    };
    add(Group::Nothing, "nothing".into(), NOTHING, &|_, _| Vec::new());
    add(Group::PriorWrong, "prior wrong".into(), PRIOR_WRONG, &|_, _| Vec::new());
    for mechanism in &mechanisms {
        for strength in Strength::ALL {
            let kind = format!("{} {}", mechanism.name, strength.name());
            add(Group::Mechanism, kind, PER_STRENGTH, &|k, stream| {
                // Every second one as a user expects it, the others as a diagnosis searches.
                let within = if k % 2 == 0 { Within::Prior } else { Within::Search };
                vec![of_strength(mechanism, (strength, within), stream)]
            });
        }
    }
    for mechanism in mechanisms.iter().filter(|mechanism| WRITTEN_TWICE.contains(&mechanism.name)) {
        let kind = format!("{} in another code", mechanism.name);
        add(Group::OtherCode, kind, PER_OTHER_CODE, &|_, stream| {
            let strength = Strength::ALL[1 + stream.below(2)];
            vec![of_strength(mechanism, (strength, Within::Prior), stream)]
        });
    }
    for mechanism in mechanisms.iter().filter(|mechanism| outside().contains(&mechanism.name)) {
        for spreads in SPREADS {
            let kind = format!("{} {spreads} out", mechanism.name);
            add(Group::Outside, kind, PER_SPREADS, &|_, stream| {
                let parameters = drawn_outside(mechanism, spreads, stream);
                vec![Hidden { spreads: Some(spreads), ..plain(mechanism.name, parameters) }]
            });
        }
    }
    for law in &LAWS {
        add(Group::Law, law.name.to_owned(), PER_LAW, &|_, stream| {
            let [share, place] = [0; 2].map(|_| stream.uniform());
            let soft_share = SOFT_SHARE[0] + share * (SOFT_SHARE[1] - SOFT_SHARE[0]);
            let knee = KNEE_PA[0] * exp(place * ln(KNEE_PA[1] / KNEE_PA[0]));
            vec![plain(law.name, vec![("soft_share".to_owned(), soft_share), ("knee_pa".to_owned(), knee)])]
        });
    }
    add(Group::Pair, "pair".into(), PAIRS, &|_, stream| {
        let first = stream.below(mechanisms.len());
        let second = (first + 1 + stream.below(mechanisms.len() - 1)) % mechanisms.len();
        let pair = [first, second].map(|index| {
            // What is weak on its own is not looked for in company.
            let strength = Strength::ALL[1 + stream.below(2)];
            of_strength(&mechanisms[index], (strength, Within::Prior), stream)
        });
        pair.to_vec()
    });
    for unknown in &UNKNOWN {
        add(Group::Unknown, unknown.name.to_owned(), PER_UNKNOWN, &|_, stream| {
            let value = |(key, low, high): &(&str, f64, f64)| {
                ((*key).to_owned(), low + (high - low) * stream.uniform())
            };
            vec![plain(unknown.name, unknown.parameters.iter().map(value).collect())]
        });
    }
    for name in DECOYS {
        add(Group::Decoy, name.to_owned(), PER_DECOY, &|_, stream| {
            vec![plain(name, vec![("which".to_owned(), stream.uniform())])]
        });
    }
    labels
}

fn of_strength(mechanism: &Described, strength: (Strength, Within), stream: &mut Stream) -> Hidden {
    Hidden { strength: Some(strength), ..plain(mechanism.name, drawn(mechanism, strength, stream)) }
}

fn plain(name: &str, parameters: Vec<(String, f64)>) -> Hidden {
    Hidden { name: name.to_owned(), strength: None, spreads: None, parameters }
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
        let full = roster(&|_| 1.0, 5, &BTreeMap::new());
        let count = |group: Group| full.iter().filter(|label| label.group == group).count();
        assert_eq!((count(Group::Nothing), count(Group::PriorWrong)), (150, 80));
        assert_eq!((count(Group::Mechanism), count(Group::OtherCode)), (RECORDED * 3 * 4, 13 * 4));
        assert_eq!((count(Group::Outside), count(Group::Law), count(Group::Pair)), (5 * 3 * 6, 24, 24));
        assert_eq!((count(Group::Unknown), count(Group::Decoy)), (14 * 5, 4 * 6));
        assert!(full.len() <= 900);
        let some = |group: Group| if group == Group::Pair { 0.5 } else { 0.02 };
        let more = BTreeMap::from([("pair".to_owned(), 3)]);
        let [share, with_more] = [BTreeMap::new(), more].map(|more| roster(&some, 5, &more));
        assert!(with_more.len() == share.len() + 3 && with_more.iter().all(|label| full.contains(label)));
        assert_eq!(share.iter().filter(|label| label.group == Group::Pair).count(), 12);
        assert!(share.iter().all(|label| full.contains(label)) && share.len() < full.len() / 4);
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
