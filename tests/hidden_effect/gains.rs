//! What extended models gain on readings held out, measured on some of the campaigns.
//!
//! Each takes minutes: the table tells of as many as have been measured. Which these are is decided by the names of their folders, which
//! are hashes, and not by anything that they show.

use rayon::prelude::*;

use crate::folders::{Folders, told, write};
use crate::hide::solved_again;
use crate::inference::{Gains, Word};
use crate::record;
use crate::run::{Judges, measured};
use crate::table::Judged;
use crate::truth::designs::Design;
use crate::truth::label::Group;

/// They are measured on so many campaigns of either kind in a design, in full.
pub const GAINS: f64 = 60.0;
/// So many more of either kind are measured before they are told.
const ROUND: usize = 6;

/// Where those of a design lie.
fn kind(design: Design) -> String {
    format!("gains/{}", design.name())
}

/// Adds the gains of a design's campaigns that have been measured.
pub fn add(folders: &Folders, design: Design, all: &mut [(String, Judged)]) {
    let gains = folders.of(&kind(design));
    for (name, judged) in all.iter_mut().filter(|(_, judged)| judged.design == design.name()) {
        let path = gains.join(format!("{name}.json"));
        judged.gains = path.exists().then(|| told::<Gains>(&path));
    }
}

/// Measures those of a few more of a design's campaigns, to so many of either kind; `false` where there are no more.
pub fn measure_more(
    folders: &Folders,
    judges: &Judges<'_>,
    design: Design,
    all: &[(String, Judged)],
    count: usize,
) -> bool {
    let next = next(design, all, count);
    if next.is_empty() {
        return false;
    }
    let (campaigns, gains) = (folders.of("campaigns"), folders.of(&kind(design)));
    solved_again(folders, judges.study(), &next);
    judges.of(design).folds();
    next.into_par_iter().for_each(|name| {
        let file = campaigns.join(name).join(format!("{}.csv", design.name()));
        let found = judges.of(design).gains(&measured(&file));
        write(&gains.join(format!("{name}.json")), &record::json(&found));
    });
    true
}

/// The campaigns of a design that come next, of those in which a mechanism is hidden and something was named, and of those in which
/// nothing is hidden, until so many of either have been measured.
fn next(design: Design, all: &[(String, Judged)], count: usize) -> Vec<&String> {
    let named =
        |judged: &Judged| judged.label.group == Group::Mechanism && judged.said.verdict == Word::Named;
    let nothing = |judged: &Judged| judged.label.group == Group::Nothing;
    let of = |is_own: &dyn Fn(&Judged) -> bool| {
        let own = all.iter().filter(|(_, judged)| judged.design == design.name() && is_own(judged));
        let (known, open): (Vec<_>, Vec<_>) = own.partition(|(_, judged)| judged.gains.is_some());
        let left = count.saturating_sub(known.len()).min(ROUND);
        open.into_iter().map(|(name, _)| name).take(left).collect::<Vec<_>>()
    };
    [of(&named), of(&nothing)].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::tests::told;

    #[test]
    fn those_that_were_measured_count_and_a_few_of_either_kind_come_next() {
        let mut all: Vec<(String, Judged)> =
            told().into_iter().enumerate().map(|(k, judged)| (format!("{k:06}"), judged)).collect();
        let is_named =
            |judged: &Judged| judged.label.group == Group::Mechanism && judged.said.verdict == Word::Named;
        let of = |all: &[(String, Judged)], nothing: bool| {
            let own = all.iter().filter(|(_, judged)| {
                if nothing { judged.label.group == Group::Nothing } else { is_named(judged) }
            });
            own.map(|(name, _)| name.clone()).collect::<Vec<_>>()
        };
        let [named, nothing] = [false, true].map(|kind| of(&all, kind));
        assert!(named.len() > 6 && nothing.len() > 6, "{} {}", named.len(), nothing.len());
        let asked = |all: &[(String, Judged)], count| -> Vec<String> {
            next(Design::Rich, all, count).into_iter().cloned().collect()
        };
        assert_eq!(asked(&all, 60), [&named[..ROUND], &nothing[..ROUND]].concat());
        assert!(next(Design::Paper, &all, 60).is_empty());
        // The last of the named have been measured, by a smaller share.
        let last = &named[named.len() - 2..];
        for (_, judged) in all.iter_mut().filter(|(name, _)| last.contains(name)) {
            judged.gains = Some(Gains { specimens: None, tilts: None });
        }
        assert_eq!(asked(&all, 3), [&named[..1], &nothing[..3]].concat());
        assert!(asked(&all, 0).is_empty());
    }
}
