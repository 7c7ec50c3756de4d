//! The verdict: nothing found, one cause named, a few that cannot be told apart, or something that no known cause explains.

use crate::critic::diagnose::design::{Campaign, Design};
use crate::critic::diagnose::guard::{Guarded, guarded};
use crate::critic::diagnose::ranking::{Ranked, Ranking};
use crate::critic::diagnose::world::World;
use crate::critic::diagnose::wrong::{Reference, Wrong};

/// A set of more causes than this separates nothing.
pub const MOST_AMBIGUOUS: usize = 3;

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
    /// What is off.
    pub wrong: Wrong,
    /// The causes with their probabilities.
    pub ranked: Ranked,
    /// What the guard says of the causes that were in question, most likely first.
    pub guarded: Vec<(usize, Guarded)>,
    /// The verdict.
    pub verdict: Verdict,
}

/// Judges a campaign; a pure function of its arguments.
pub fn diagnosed(
    world: &World<'_>,
    design: &Design,
    (reference, ranking): (&Reference, &Ranking),
    campaign: &Campaign,
    limits: &Limits,
    seed: u64,
) -> Diagnosis {
    let wrong = reference.judge(design, campaign);
    let ranked = ranking.of(&wrong);
    if wrong.p_value >= limits.found {
        return Diagnosis { wrong, ranked, guarded: Vec::new(), verdict: Verdict::NothingFound };
    }
    let named = ranked.named(limits.named);
    let likely = ranked.causes.iter().filter_map(|(cause, _)| *cause);
    let in_question: Vec<usize> =
        likely.filter(|cause| named == Some(*cause) || ranked.set.contains(cause)).collect();
    let guarded: Vec<(usize, Guarded)> = match in_question.len() {
        // The guard of many would choose among them by chance.
        n if n > 2 * MOST_AMBIGUOUS && named.is_none() => Vec::new(),
        _ => in_question
            .iter()
            .map(|&cause| (cause, guarded(world, design, reference, Some(cause), campaign, seed)))
            .collect(),
    };
    let passes = |cause: usize| guarded.iter().any(|(own, g)| *own == cause && g.p_value >= limits.guard);
    let explain: Vec<usize> = in_question.iter().copied().filter(|&cause| passes(cause)).collect();
    let verdict = match (named, explain.len()) {
        (Some(cause), _) if passes(cause) => Verdict::Named(cause),
        // What was as good as certain, and does not fit, speaks against the catalogue.
        (Some(_), _) => Verdict::Unexplained,
        (None, 1..=MOST_AMBIGUOUS) => Verdict::Ambiguous(explain),
        (None, _) => Verdict::Unexplained,
    };
    Diagnosis { wrong, ranked, guarded, verdict }
}
