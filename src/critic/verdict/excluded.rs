//! What speaks against a cause, and which causes nothing speaks against.

use crate::critic::verdict::diagnosis::{Diagnosis, Verdict, fitting};
use crate::critic::verdict::limits::{Limits, POSSIBLE};

/// What speaks against a cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excluded {
    /// It fits the readings worse than nearly all campaigns that it predicts: the check.
    ByCheck,
    /// Nine in ten of its campaigns rank it higher: the ranking.
    ByRanking,
    /// All readings together leave it hardly any probability, or speak strongly for another one that fits.
    ByEvidence,
}

impl Diagnosis {
    /// What speaks against a cause, where something was found; `None` where nothing does.
    pub fn excluded(&self, cause: usize) -> Option<Excluded> {
        if self.verdict == Verdict::NothingFound {
            return None;
        }
        let ranked = &self.finding.ranked;
        match self.examined(cause).and_then(|own| own.check) {
            Some(p) if p < Limits::default().check => Some(Excluded::ByCheck),
            Some(_) if fitting(&self.examined, &Limits::default()).all(|own| own.cause != cause) => {
                Some(Excluded::ByEvidence)
            }
            Some(_) => None,
            None if !ranked.set.contains(&cause) => Some(Excluded::ByRanking),
            None if ranked.probability(cause) < POSSIBLE => Some(Excluded::ByEvidence),
            None => None,
        }
    }

    /// The causes that nothing speaks against, most likely first. Where nothing is explained, and these are many, the data
    /// separate too little; where there are none, it lies outside the catalogue.
    pub fn left_open(&self) -> Vec<usize> {
        let causes = self.finding.ranked.causes.iter().filter_map(|(cause, _)| *cause);
        causes.filter(|&cause| self.excluded(cause).is_none()).collect()
    }
}
