//! The verdict: nothing found, one cause named, a few that cannot be told apart, or something that no known cause explains.

use rayon::prelude::*;

use crate::critic::diagnose::design::Campaign;
use crate::critic::diagnose::discrepancy::{Bent, Discrepancy};
use crate::critic::diagnose::evidence::{Evidence, evidence};
use crate::critic::diagnose::guard::guarded;
use crate::critic::diagnose::judge::{Judge, Seeming};
use crate::critic::diagnose::network::softmax;
use crate::critic::diagnose::predicted::Predicted;
use crate::critic::diagnose::world::Truth;

/// A set of more causes than this separates nothing.
pub const MOST_AMBIGUOUS: usize = 3;
/// So many causes, the most likely, are looked at closely.
const CLOSELY: usize = 5;

/// The limits of a verdict.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Something is wrong below this p-value.
    pub found: f64,
    /// A cause is named at this probability or above.
    pub named: f64,
    /// A cause that fits a campaign worse than all but so large a share of its own does not explain it.
    pub guard: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { found: 0.05, named: 0.8, guard: 0.05 }
    }
}

/// What a campaign says of the base model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing is wrong beyond error and natural scatter, or nothing that these data can see.
    NothingFound,
    /// Something is wrong, and this cause explains it.
    Named(usize),
    /// Something is wrong, and each of these, at most [`MOST_AMBIGUOUS`], explains it.
    Ambiguous(Vec<usize>),
    /// Something is wrong, and no cause of the catalogue explains it, or too many do.
    Unexplained,
}

impl Verdict {
    /// The causes that it speaks of.
    pub fn causes(&self) -> &[usize] {
        match self {
            Verdict::Named(cause) => std::slice::from_ref(cause),
            Verdict::Ambiguous(causes) => causes,
            Verdict::NothingFound | Verdict::Unexplained => &[],
        }
    }
}

/// A verdict with what it rests on.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// What is off, and how likely that is by chance.
    pub seeming: Seeming,
    /// The causes that were looked at closely, most likely first; none where nothing was found.
    pub looked_at: Vec<LookedAt>,
    /// What the base model, its joints fitted, lacks, if it is anything smooth; empty where nothing was found.
    pub form: Vec<Bent>,
    /// The verdict.
    pub verdict: Verdict,
}

/// A cause that was looked at closely.
#[derive(Clone, Debug, PartialEq)]
pub struct LookedAt {
    /// Index of the mechanism.
    pub cause: usize,
    /// Share of the cause's own campaigns that fit no better; `None` where the guard was not asked, as the cause was not in
    /// question.
    pub guard: Option<f64>,
    /// Its share of the evidence of all causes looked at and of the base model.
    pub evidence: f64,
    /// What its parameters and the joints may be: draws, equally likely.
    pub draws: Vec<Truth>,
}

impl Diagnosis {
    /// What was seen of a cause that was looked at closely.
    pub fn looked_at(&self, cause: usize) -> Option<&LookedAt> {
        self.looked_at.iter().find(|own| own.cause == cause)
    }

    /// The causes that were looked at closely, each with its probability and draws of what is true under it.
    pub fn possible(&self) -> Vec<(f64, Vec<Truth>)> {
        let probability = |cause: usize| {
            let own = self.seeming.ranked.causes.iter().find(|(other, _)| *other == Some(cause));
            own.map_or(0.0, |(_, probability)| *probability)
        };
        self.looked_at.iter().map(|own| (probability(own.cause), own.draws.clone())).collect()
    }
}

impl Judge<'_> {
    /// Judges a campaign; a pure function of the judge and the arguments.
    pub fn diagnosed(&self, campaign: &Campaign, limits: &Limits, seed: u64) -> Diagnosis {
        let seeming = self.seeming(campaign);
        if seeming.p_value >= limits.found {
            return Diagnosis {
                seeming,
                looked_at: Vec::new(),
                form: Vec::new(),
                verdict: Verdict::NothingFound,
            };
        }
        let ranked = &seeming.ranked;
        let named = ranked.named(limits.named);
        let likely: Vec<usize> = ranked.causes.iter().filter_map(|(cause, _)| *cause).collect();
        let mut in_question: Vec<usize> = likely
            .iter()
            .copied()
            .filter(|cause| named == Some(*cause) || ranked.set.contains(cause))
            .collect();
        if in_question.len() > 2 * MOST_AMBIGUOUS && named.is_none() {
            // The guard of many would choose among them by chance.
            in_question.clear();
        }
        let closely = likely.iter().enumerate();
        let closely = closely.filter(|(rank, cause)| *rank < CLOSELY || in_question.contains(cause));
        let closely: Vec<usize> = closely.map(|(_, cause)| *cause).collect();
        let models: Vec<Option<usize>> =
            std::iter::once(None).chain(closely.iter().copied().map(Some)).collect();
        let evidences: Vec<Evidence> = models
            .par_iter()
            .map(|cause| evidence(self.world, &self.design, campaign, *cause, seed.wrapping_add(1)))
            .collect();
        let logs: Vec<f64> = evidences.iter().map(|evidence| evidence.log).collect();
        let shares = softmax(&logs, 1.0);
        let base = shares[0];
        let form = self.form(campaign, &evidences[0].draws, seed.wrapping_add(2));
        let looked_at: Vec<LookedAt> = closely
            .iter()
            .zip(evidences.into_iter().zip(shares).skip(1))
            .map(|(&cause, (found, share))| LookedAt {
                cause,
                guard: in_question.contains(&cause).then(|| guarded(self, Some(cause), campaign, seed)),
                evidence: share,
                draws: found.draws,
            })
            .collect();
        let passes = |cause: usize| {
            looked_at.iter().any(|own| own.cause == cause && own.guard.is_some_and(|p| p >= limits.guard))
        };
        let first = looked_at.iter().fold(None, |first: Option<&LookedAt>, own| match first {
            Some(first) if first.evidence >= own.evidence => Some(first),
            _ => Some(own),
        });
        // The base model with other joints may have more of the evidence than any cause.
        let agreed =
            named.filter(|cause| first.is_some_and(|first| first.cause == *cause && first.evidence > base));
        let explain: Vec<usize> = in_question.iter().copied().filter(|&cause| passes(cause)).collect();
        let verdict = match (named, agreed, explain.len()) {
            (_, Some(cause), _) if passes(cause) => Verdict::Named(cause),
            // What was as good as certain, and does not fit, speaks against the catalogue.
            (Some(cause), _, _) if !passes(cause) => Verdict::Unexplained,
            (_, _, 1..=MOST_AMBIGUOUS) => Verdict::Ambiguous(explain),
            _ => Verdict::Unexplained,
        };
        Diagnosis { seeming, looked_at, form, verdict }
    }

    /// What the base model lacks with these joints.
    fn form(&self, campaign: &Campaign, joints: &[Truth], seed: u64) -> Vec<Bent> {
        let base = Predicted::of(self.world, &self.design, joints, seed);
        let known: Vec<Vec<bool>> =
            self.design.specimens.iter().map(|specimen| vec![true; specimen.readings.len()]).collect();
        let units = self.reference.scale.units();
        Discrepancy::new(&self.design, campaign, &known, &base, &units)
            .map_or_else(Vec::new, |free| free.form())
    }
}
