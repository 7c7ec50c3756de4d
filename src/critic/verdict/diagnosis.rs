//! What is said of a campaign: nothing found, one cause or a pair named, a few that cannot be separated, or something that no known
//! cause explains; and what that rests on.

use crate::critic::discrepancy::ComponentEstimate;
use crate::critic::simulate::Truth;
use crate::critic::verdict::judge::Finding;

/// What a campaign says of the base model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No discrepancy beyond error and natural scatter, or none that these data can see.
    NothingFound,
    /// There is a discrepancy, and this cause explains it.
    Named(usize),
    /// There is a discrepancy, and this cause explains it, at a strength that its physical prior does not expect.
    NamedOutsidePrior(usize),
    /// There is a discrepancy, no one cause explains it, and these two together do.
    NamedPair([usize; 2]),
    /// There is a discrepancy, and each of these, at most [`MOST_AMBIGUOUS`](crate::critic::MOST_AMBIGUOUS), explains it.
    Ambiguous(Vec<usize>),
    /// There is a discrepancy, and no cause of the catalogue explains it, or too many do.
    Unexplained,
}

impl Verdict {
    /// The causes that it names, one alone or two together.
    pub fn named(&self) -> &[usize] {
        match self {
            Verdict::Ambiguous(_) => &[],
            verdict => verdict.causes(),
        }
    }

    /// The causes that it speaks of.
    pub fn causes(&self) -> &[usize] {
        match self {
            Verdict::Named(cause) | Verdict::NamedOutsidePrior(cause) => std::slice::from_ref(cause),
            Verdict::NamedPair(causes) => causes,
            Verdict::Ambiguous(causes) => causes,
            Verdict::NothingFound | Verdict::Unexplained => &[],
        }
    }
}

/// A verdict with what it rests on.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// What is off, and how likely that is by chance.
    pub finding: Finding,
    /// The causes that were looked at closely, most likely first; none where nothing was found.
    pub looked_at: Vec<LookedAt<usize>>,
    /// Pairs of causes that were looked at as no one explains the discrepancy, that with most of the evidence first.
    pub pairs: Vec<LookedAt<[usize; 2]>>,
    /// What the base model with fitted joints misses, as components of a smooth discrepancy; empty where nothing was found.
    pub components: Vec<ComponentEstimate>,
    /// The verdict.
    pub verdict: Verdict,
}

/// A cause, or two together, that was looked at closely.
#[derive(Clone, Debug, PartialEq)]
pub struct LookedAt<C> {
    /// Index of the mechanism; of both, ascending.
    pub cause: C,
    /// Share of its own campaigns that fit no better; `None` where the guard was not asked, as it was not in question.
    pub guard: Option<f64>,
    /// Share of the campaigns that the physical priors predict which are as far out, along what the data pin down; `None` where it
    /// was not asked, as the verdict does not speak of it.
    pub conflict: Option<f64>,
    /// Its share of the evidence: a cause's of all causes looked at and of the base model, a pair's of these and of all pairs.
    pub evidence: f64,
    /// What its parameters and the joints may be: draws, equally likely.
    pub draws: Vec<Truth>,
}

impl Diagnosis {
    /// The causes of the verdict, together or each on its own, with draws of what is true under them.
    pub fn explained_by(&self) -> Vec<(Vec<usize>, &[Truth])> {
        match &self.verdict {
            Verdict::NamedPair(pair) => {
                let own = self.pairs.iter().filter(|own| own.cause == *pair);
                own.map(|own| (pair.to_vec(), &own.draws[..])).collect()
            }
            verdict => {
                let own = verdict.causes().iter().filter_map(|&cause| self.looked_at(cause));
                own.map(|own| (vec![own.cause], &own.draws[..])).collect()
            }
        }
    }

    /// What was seen of a cause that was looked at closely.
    pub fn looked_at(&self, cause: usize) -> Option<&LookedAt<usize>> {
        self.looked_at.iter().find(|own| own.cause == cause)
    }

    /// The causes that the next measurement should tell apart, each with its probability and draws of what is true under it: those
    /// that were looked at closely and that nothing [speaks against](Self::excluded); where fewer than two are left, all that were
    /// looked at closely, as what speaks against them may be chance. And whether they are left.
    pub fn possible(&self) -> (Vec<(f64, Vec<Truth>)>, bool) {
        let left: Vec<&LookedAt<usize>> =
            self.looked_at.iter().filter(|own| self.excluded(own.cause).is_none()).collect();
        let are_left = left.len() >= 2;
        let all = if are_left { left } else { self.looked_at.iter().collect() };
        let probability = |own: &LookedAt<usize>| self.finding.ranked.probability(own.cause);
        (all.into_iter().map(|own| (probability(own), own.draws.clone())).collect(), are_left)
    }
}
