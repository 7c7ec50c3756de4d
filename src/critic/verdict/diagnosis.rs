//! What is said of a campaign: nothing found, one cause or a pair named, a few that cannot be separated, or something that no known
//! cause explains; and what that rests on.

use crate::critic::discrepancy::ComponentEstimate;
use crate::critic::simulate::{Causes, Truth};
use crate::critic::verdict::judge::Finding;
use crate::critic::verdict::limits::{Limits, far_behind};

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
    /// The causes that were examined, most likely first; none where nothing was found.
    pub examined: Vec<Examined<usize>>,
    /// Pairs of causes that were examined as no one explains the discrepancy, that with most of the evidence first.
    pub pairs: Vec<Examined<[usize; 2]>>,
    /// By how much the logarithm of the evidence of something that is in no catalogue, a smooth discrepancy, exceeds the largest of the
    /// base model's and of the causes that were examined; `None` where nothing was found.
    pub outside: Option<f64>,
    /// What the base model with fitted joints misses, as components of a smooth discrepancy; empty where nothing was found.
    pub components: Vec<ComponentEstimate>,
    /// The verdict.
    pub verdict: Verdict,
}

/// A cause, or two together, that was examined.
#[derive(Clone, Debug, PartialEq)]
pub struct Examined<C> {
    /// Index of the mechanism; of both, ascending.
    pub cause: C,
    /// What acts, and on which joints, as the readings make likeliest. Of a pair the one acts where it does alone.
    pub acting: Causes,
    /// Probability of this, if the cause acts.
    pub scope_share: f64,
    /// By how much the logarithm of its evidence exceeds that of the base model, over all scopes; of a pair beside how much rarer
    /// pairs are.
    pub log: f64,
    /// Standard error of the logarithm of its evidence, by several runs.
    pub spread: f64,
    /// Share of the campaigns that it predicts which fit no better; `None` where it was not checked, as it was not in question.
    pub check: Option<f64>,
    /// Share of the campaigns that the physical priors predict which are as far out, along what the data pin down; `None` where it
    /// was not tested, as the verdict does not speak of it.
    pub conflict: Option<f64>,
    /// Its share of the evidence, over all scopes: a cause's of all causes examined and of the base model, a pair's of these and of all
    /// pairs.
    pub evidence: f64,
    /// What its parameters and the joints may be with this scope: draws, equally likely.
    pub draws: Vec<Truth>,
}

/// The causes that fit, and whose evidence is not far behind that of another one that does.
pub(super) fn fitting<'e>(
    examined: &'e [Examined<usize>],
    limits: &Limits,
) -> impl Iterator<Item = &'e Examined<usize>> {
    let check = limits.check;
    let fits = move |own: &&Examined<usize>| own.check.is_some_and(|p| p >= check);
    let evidence = |own: &Examined<usize>| [own.log, own.spread];
    let is_behind = move |own: &&Examined<usize>| {
        examined.iter().filter(fits).any(|other| far_behind(evidence(own), evidence(other)))
    };
    examined.iter().filter(fits).filter(move |own| !is_behind(own))
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
                let own = verdict.causes().iter().filter_map(|&cause| self.examined(cause));
                own.map(|own| (vec![own.cause], &own.draws[..])).collect()
            }
        }
    }

    /// The causes of the verdict, the one with most of the evidence where there are several; where it has none, the cause that was
    /// examined and has most of it, though it does not explain the readings. `None` where nothing was found.
    pub fn best(&self) -> Option<(Vec<usize>, &[Truth])> {
        if let Verdict::NamedPair(_) = self.verdict {
            return self.explained_by().into_iter().next();
        }
        let spoken = self.verdict.causes();
        let open = self.examined.iter().filter(|own| spoken.is_empty() || spoken.contains(&own.cause));
        let best = open.max_by(|a, b| a.evidence.total_cmp(&b.evidence))?;
        Some((vec![best.cause], &best.draws[..]))
    }

    /// What was seen of a cause that was examined.
    pub fn examined(&self, cause: usize) -> Option<&Examined<usize>> {
        self.examined.iter().find(|own| own.cause == cause)
    }

    /// The causes that the next measurement should tell apart, each with its probability and draws of what is true under it: those
    /// that were examined and that nothing [speaks against](Self::excluded); where fewer than two are left, all that were
    /// examined, as what speaks against them may be chance. And whether they are left.
    pub fn possible(&self) -> (Vec<(f64, Vec<Truth>)>, bool) {
        let left: Vec<&Examined<usize>> =
            self.examined.iter().filter(|own| self.excluded(own.cause).is_none()).collect();
        let are_left = left.len() >= 2;
        let all = if are_left { left } else { self.examined.iter().collect() };
        let probability = |own: &Examined<usize>| self.finding.ranked.probability(own.cause);
        (all.into_iter().map(|own| (probability(own), own.draws.clone())).collect(), are_left)
    }
}
