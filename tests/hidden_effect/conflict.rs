//! Whether a hidden mechanism is seen to lie outside its physical prior, whatever the verdict: the test of prior against data on the
//! cause that is the true one.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::folders::{Folders, told, write};
use crate::hide::solved_again;
use crate::record;
use crate::run::{Judges, measured};
use crate::table::Judged;
use crate::truth::designs::Design;
use crate::truth::label::Group;

/// Adds it to the campaigns of a design that hide one mechanism of our code.
pub fn add(folders: &Folders, judges: &Judges<'_>, design: Design, all: &mut [(String, Judged)]) {
    let (campaigns, told_in) = (folders.of("campaigns"), folders.of(&format!("conflicts/{}", design.name())));
    let path = |name: &str| told_in.join(format!("{name}.json"));
    let is_asked = |judged: &Judged| {
        judged.design == design.name() && matches!(judged.label.group, Group::Mechanism | Group::Outside)
    };
    let mut open: BTreeMap<&str, Vec<&String>> = BTreeMap::new();
    for (name, judged) in all.iter().filter(|(name, judged)| is_asked(judged) && !path(name).exists()) {
        open.entry(&judged.label.hidden[0].name).or_default().push(name);
    }
    let names: Vec<&String> = open.values().flatten().copied().collect();
    solved_again(folders, judges.study(), &names);
    for (mechanism, names) in open {
        let judge = judges.of(design);
        let expects = judge.expects(judge.index(mechanism));
        names.into_par_iter().for_each(|name| {
            let file = campaigns.join(name).join(format!("{}.csv", design.name()));
            let p = judge.conflict(&expects, &measured(&file));
            write(&path(name), &record::json(&p));
        });
    }
    for (name, judged) in all.iter_mut().filter(|(_, judged)| is_asked(judged)) {
        judged.conflict = Some(told(&path(name)));
    }
}
