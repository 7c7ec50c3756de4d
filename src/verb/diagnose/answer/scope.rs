//! On which joints a cause acts.

use crate::critic::{Causes, Scope, World};
use crate::render::number::significant;

/// On which joints a cause acts, where that is not on all alike.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ScopeEntry {
    /// The families on whose joints it acts.
    pub acts_on: Vec<String>,
    /// Probability of this, if the cause acts.
    pub share: f64,
    /// The same in words: which joints.
    #[serde(skip)]
    pub(crate) words: String,
}

impl ScopeEntry {
    /// Of a cause among those that act; `None` where it acts on all joints alike.
    pub fn of(world: &World<'_>, cause: usize, causes: Causes, share: f64) -> Option<ScopeEntry> {
        let (_, scope) = causes.scoped().find(|(acting, _)| *acting == cause)?;
        let acted = acted_on(world, &world.kinds_of(cause, scope)?);
        let names: Vec<String> = acted.iter().map(|arms| enumerated(arms)).collect();
        let acts_on = acted.concat();
        let families = world.study().measured_arms().into_iter().map(|arm| &world.study().arms[arm].name);
        let others: Vec<String> = families.filter(|name| !acts_on.contains(name)).cloned().collect();
        let words = match scope {
            Scope::Each => format!("the joints of {}, each by parameters of their own", names.join("; of ")),
            _ => format!("the joints of {}, not those of {}", names.concat(), enumerated(&others)),
        };
        Some(ScopeEntry { acts_on, share, words })
    }

    /// On which joints, and how likely that is.
    pub(crate) fn with_share(&self) -> String {
        format!("{} (probability, if it acts: {})", self.words, significant(self.share, 2))
    }
}

/// Names of the measured families with joints of each of these kinds.
pub(super) fn acted_on(world: &World<'_>, kinds: &[usize]) -> Vec<Vec<String>> {
    let study = world.study();
    let names = |kind: &usize| {
        let arms = study.measured_arms().into_iter().filter(|arm| world.kind(*arm) == *kind);
        arms.map(|arm| study.arms[arm].name.clone()).collect()
    };
    kinds.iter().map(names).collect()
}

/// Names as a sentence has them.
pub fn enumerated(names: &[String]) -> String {
    match names {
        [others @ .., one, last] => {
            let others: String = others.iter().map(|name| format!("{name}, ")).collect();
            format!("{others}{one} and {last}")
        }
        names => names.concat(),
    }
}
