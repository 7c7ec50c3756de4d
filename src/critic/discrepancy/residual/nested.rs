//! Campaigns of the base model, several sets of stones under every truth, so that scatter and joints can be told apart.

use crate::critic::simulate::{Campaign, Design, Seen, World};
use crate::random::Streams;
use crate::study::MeasuredKind;

/// Truths. Many, with few sets of stones under each: what joints do is known by truths alone, what stones do by all sets.
const TRUTHS: u64 = 1000;
/// Sets of stones under every truth.
const SETS: u64 = 2;

/// A simulated campaign, in the order of [`Design::readings`]; `None` where a wall had fallen.
pub(super) struct Shown {
    /// What is there, before any error.
    pub values: Vec<Option<f64>>,
    /// What is read of it, values beyond a bound as well.
    pub read: Vec<Option<f64>>,
}

/// By truth and set of stones.
pub(super) struct Nested {
    truths: Vec<Vec<Shown>>,
}

impl Nested {
    /// A pure function of its arguments.
    pub fn new(world: &World<'_>, design: &Design, seed: u64) -> Nested {
        let mut open = design.clone();
        let walls = open.specimens.iter_mut().flat_map(|specimen| &mut specimen.readings);
        let readings = walls.chain(open.apart.iter_mut().map(|(_, reading)| reading));
        readings.filter(|m| m.kind.is_censored()).for_each(|m| m.kind = MeasuredKind::Exact);
        let one = |truth: u64| {
            let of_truth = world.stated(&Streams::new(seed, truth));
            let apart = world.values_apart(&open, &of_truth);
            let shown = |set: u64| {
                let streams = Streams::new(seed, TRUTHS + SETS * truth + set);
                let walls = world.values(&open, &of_truth, &streams);
                let read = Campaign::read(&open, &walls, &apart, &streams);
                let values = walls.concat().into_iter().chain(apart.iter().copied().map(Some));
                let value = |seen: Seen| if let Seen::Value(value) = seen { Some(value) } else { None };
                Shown { values: values.collect(), read: read.seen().map(value).collect() }
            };
            (0..SETS).map(shown).collect()
        };
        Nested { truths: (0..TRUTHS).map(one).collect() }
    }

    /// A number of every campaign, by truth; campaigns that have none are left out.
    pub fn each(&self, of: impl Fn(&Shown) -> Option<f64>) -> Vec<Vec<f64>> {
        self.truths.iter().map(|sets| sets.iter().filter_map(&of).collect()).collect()
    }

    /// A number of every campaign that has it.
    pub fn all(&self, of: impl Fn(&Shown) -> Option<f64>) -> Vec<f64> {
        self.truths.iter().flatten().filter_map(of).collect()
    }

    /// Number of campaigns.
    pub fn count(&self) -> usize {
        self.truths.iter().map(Vec::len).sum()
    }
}
