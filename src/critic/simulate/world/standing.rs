//! Truths under which walls stand at rest, before they are loaded: nobody measures walls that do not.

use std::collections::BTreeSet;

use crate::critic::simulate::bank::PRIOR_WIDENING;
use crate::critic::simulate::causes::Causes;
use crate::critic::simulate::truth::Truth;
use crate::critic::simulate::world::{World, standing_for, varying};
use crate::random::Streams;
use crate::random::standard_normal::quantile;

/// So many truths are drawn at most for one under which walls stand at rest. A cause under which few do has too few walls in the bank
/// to be searched for.
const DRAWN: usize = 100;

impl World<'_> {
    /// A draw as of [`Self::drawn`], with what is made of each truth before it is asked whether walls stand.
    pub(in crate::critic) fn drawn_as(
        &self,
        causes: Causes,
        streams: &Streams,
        made: impl Fn(Truth) -> Truth,
    ) -> Truth {
        let mut draws = streams.of("truth");
        let inputs = self.inputs(causes);
        let next = || {
            let scores: Vec<f64> = (0..inputs).map(|_| quantile(draws.uniform())).collect();
            made(self.truth(causes, &scores))
        };
        standing(next, |truth| self.stands(truth))
    }

    /// Whether walls stand at rest under a truth, as the nearest wall of the bank does, for each family and cause.
    pub fn stands(&self, truth: &Truth) -> bool {
        self.base.iter().all(|(&family, walls)| {
            let kinds: BTreeSet<usize> =
                standing_for(&self.stands_for, family).map(|arm| self.kinds[arm]).collect();
            kinds.into_iter().all(|kind| {
                let joints = truth.joints[kind].map(|score| score / PRIOR_WIDENING);
                walls.emulator.stands(&joints)
                    && self.acting(truth, kind).all(|(cause, parameters)| {
                        let parameters = varying(self.mechanisms, Some(cause), parameters.iter().copied());
                        let scores: Vec<f64> = joints.into_iter().chain(parameters).collect();
                        self.changes.get(&(family, cause)).is_none_or(|walls| walls.emulator.stands(&scores))
                    })
            })
        })
    }
}

/// The first draw under which walls stand, or the last of [`DRAWN`] ones.
pub(in crate::critic) fn standing<T>(mut next: impl FnMut() -> T, stands: impl Fn(&T) -> bool) -> T {
    let mut drawn = next();
    for _ in 1..DRAWN {
        if stands(&drawn) {
            break;
        }
        drawn = next();
    }
    drawn
}
