//! How a verdict is come to: the examined causes in question are checked, and what is left is named or left open.

use crate::critic::causes::{Ranked, softmax};
use crate::critic::conflict::PriorPredictive;
use crate::critic::simulate::{Campaign, Causes, Scope};
use crate::critic::verdict::diagnosis::{Diagnosis, Examined, Verdict};
use crate::critic::verdict::examine::Examination;
use crate::critic::verdict::judge::Judge;
use crate::critic::verdict::limits::{Limits, MOST_AMBIGUOUS, POSSIBLE};
use crate::math::ln;
use crate::stats;

/// So many pairs are examined, those that have most of the rough evidence.
const PAIRS: usize = 4;
/// A cause that the ranking puts aside is not put aside where the evidence leaves it this probability or more.
const LIKELY: f64 = 0.1;
/// Causes are left open only where those that fit have together so large a share of the probability that something is off: where the
/// likely ones are refused, and an unlikely one is not, or where it is likely unmodelled, none explains it.
const MOST: f64 = 0.5;

impl Judge<'_> {
    /// Diagnoses a campaign; a pure function of the judge and the arguments.
    pub fn diagnosed(&self, campaign: &Campaign, limits: &Limits, seed: u64) -> Diagnosis {
        let examination = self.rank(self.compare(campaign), campaign, limits, seed);
        self.check(examination, campaign, limits, seed)
    }

    /// Checks the causes in question, and comes to a verdict; a pure function of the judge and the arguments.
    pub fn check(
        &self,
        examination: Examination,
        campaign: &Campaign,
        limits: &Limits,
        seed: u64,
    ) -> Diagnosis {
        let logs = examination.logs();
        let Examination { finding, shortlist, evidences, components } = examination;
        if finding.p_value >= limits.found {
            let (examined, pairs) = (Vec::new(), Vec::new());
            return Diagnosis { finding, examined, pairs, components, verdict: Verdict::NothingFound };
        }
        let shares = softmax(&logs, 1.0);
        let (named, few) = (finding.named(limits), finding.leaves_few());
        // What all readings make likely is checked, however the ranking sees it.
        let possible = |cause: &usize| {
            let p = finding.ranked.probability(*cause);
            few && p >= if finding.ranked.set.contains(cause) { POSSIBLE } else { LIKELY }
        };
        let check = self.posterior_check();
        let in_question = |cause: &usize| named == Some(*cause) || possible(cause);
        let mut examined: Vec<Examined<usize>> = shortlist
            .iter()
            .zip(evidences.into_iter().zip(&shares).skip(1))
            .map(|(&cause, (found, share))| Examined {
                cause,
                scope: found.causes.scoped().next().map_or(Scope::All, |(_, scope)| scope),
                scope_share: found.share,
                check: in_question(&cause).then(|| check.p_value(&found.draws, campaign, seed)),
                conflict: None,
                evidence: *share,
                draws: found.draws,
            })
            .collect();
        let place = |own: &Examined<usize>| {
            finding.ranked.causes.iter().position(|(cause, _)| *cause == Some(own.cause))
        };
        examined.sort_by_key(place);
        let fits = |own: &&Examined<usize>| own.check.is_some_and(|p| p >= limits.check);
        let explain: Vec<usize> = examined.iter().filter(fits).map(|own| own.cause).collect();
        let first = examined.iter().fold(None, |first: Option<&Examined<usize>>, own| match first {
            Some(first) if first.evidence >= own.evidence => Some(first),
            _ => Some(own),
        });
        // The base model with other joints may have more of the evidence than any cause.
        let agreed = named
            .filter(|cause| first.is_some_and(|first| first.cause == *cause && first.evidence > shares[0]));
        let verdict = match agreed.filter(|cause| explain.contains(cause)) {
            Some(cause) => Verdict::Named(cause),
            // What was as good as certain, and does not fit, speaks against the catalogue.
            None if named.is_some_and(|cause| !explain.contains(&cause)) || !few => Verdict::Unexplained,
            None => unnamed(&finding.ranked, explain),
        };
        let mut diagnosis = Diagnosis { finding, examined, pairs: Vec::new(), components, verdict };
        if diagnosis.verdict == Verdict::Unexplained {
            diagnosis.pairs = self.pairs(campaign, &shortlist, &logs, limits, seed);
            let fits = |pair: &&Examined<[usize; 2]>| pair.check.is_some_and(|p| p >= limits.pair.check);
            let named = diagnosis.pairs.iter().find(fits).filter(|_| diagnosis.finding.allows_pair(limits));
            diagnosis.verdict = named.map_or(Verdict::Unexplained, |pair| Verdict::NamedPair(pair.cause));
        }
        self.set_beside_priors(&mut diagnosis, campaign, limits, seed.wrapping_add(3));
        diagnosis
    }

    /// Tests of every cause that the verdict speaks of whether it acts as its physical prior expects.
    fn set_beside_priors(&self, diagnosis: &mut Diagnosis, campaign: &Campaign, limits: &Limits, seed: u64) {
        let conflict = |causes: Causes| {
            let expected = self.predictions.of((causes, seed), || {
                PriorPredictive::of(self.world, &self.design, &self.reference, causes, seed)
            });
            expected.p_value(&self.design, &self.reference, campaign)
        };
        match diagnosis.verdict.clone() {
            Verdict::NamedPair(pair) => {
                let own = diagnosis.pairs.iter_mut().filter(|own| own.cause == pair);
                own.for_each(|own| own.conflict = Some(conflict(Causes::pair(pair[0], pair[1]))));
            }
            verdict => {
                let own = diagnosis.examined.iter_mut().filter(|own| verdict.causes().contains(&own.cause));
                own.for_each(|own| own.conflict = Some(conflict(Causes::one(own.cause, own.scope))));
            }
        }
        if let Verdict::Named(cause) = diagnosis.verdict
            && diagnosis.examined(cause).and_then(|own| own.conflict).is_some_and(|p| p < limits.conflict)
        {
            diagnosis.verdict = Verdict::NamedOutsidePrior(cause);
        }
    }

    /// The most promising pairs of the cause that has most of the evidence with another, where none explains a campaign alone;
    /// `logs` are the logarithms of the evidence of the base model and of each cause examined. A second cause is as likely
    /// beforehand as one in all that there are. A pair that has nearly all of the evidence is checked.
    fn pairs(
        &self,
        campaign: &Campaign,
        shortlist: &[usize],
        logs: &[f64],
        limits: &Limits,
        seed: u64,
    ) -> Vec<Examined<[usize; 2]>> {
        let singles = logs[1..].iter().zip(shortlist);
        let Some((_, &best)) = singles.reduce(|best, own| if own.0 > best.0 { own } else { best }) else {
            return Vec::new();
        };
        let causes = self.world.causes();
        let mechanisms = self.world.mechanisms();
        let others = causes
            .iter()
            .filter(|other| **other != best && mechanisms[best].goes_with(mechanisms[**other].name));
        let pairs: Vec<[usize; 2]> = others.map(|&other| [best.min(other), best.max(other)]).collect();
        let models = |pairs: &[[usize; 2]]| -> Vec<Causes> {
            pairs.iter().map(|&[one, other]| Causes::pair(one, other)).collect()
        };
        let rough = self.rough(campaign, &models(&pairs), seed);
        let promising = stats::smallest(rough.iter().map(|found| -found.log).zip(0..), PAIRS);
        let pairs: Vec<[usize; 2]> = promising.into_iter().map(|at| pairs[at]).collect();
        let evidences = self.evidences(campaign, &models(&pairs), seed);
        let rare = ln(causes.len() as f64);
        let all: Vec<f64> =
            logs.iter().copied().chain(evidences.iter().map(|evidence| evidence.log - rare)).collect();
        let shares = softmax(&all, 1.0);
        let check = self.posterior_check();
        let rows = pairs.into_iter().zip(evidences).zip(&shares[logs.len()..]);
        let mut pairs: Vec<Examined<[usize; 2]>> = rows
            .map(|((cause, found), &evidence)| Examined {
                cause,
                scope: Scope::All,
                scope_share: 1.0,
                check: (evidence >= limits.pair.named).then(|| check.p_value(&found.draws, campaign, seed)),
                conflict: None,
                evidence,
                draws: found.draws,
            })
            .collect();
        pairs.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        pairs
    }
}

/// The verdict where none can be named, and these causes fit.
fn unnamed(ranked: &Ranked, fit: Vec<usize>) -> Verdict {
    let causes = ranked.causes.iter().filter(|(cause, _)| cause.is_some());
    let whole = causes.fold(ranked.unmodelled, |sum, (_, p)| sum + p);
    let theirs = fit.iter().fold(0.0, |sum, cause| sum + ranked.probability(*cause));
    match fit.len() {
        1..=MOST_AMBIGUOUS if theirs >= MOST * whole => Verdict::Ambiguous(fit),
        _ => Verdict::Unexplained,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::critic::discrepancy::Discrepancy;
    use crate::critic::verdict::judge::Finding;

    #[test]
    fn few_causes_are_left_open_if_the_likely_ones_are_among_them() {
        let causes = [(Some(3), 0.5), (Some(1), 0.2), (None, 0.1), (Some(2), 0.1), (Some(4), 0.1)];
        let ranked = Ranked::new(causes.to_vec(), 0.0, vec![1, 2, 3]);
        assert_eq!(unnamed(&ranked, vec![3]), Verdict::Ambiguous(vec![3]));
        assert_eq!(unnamed(&ranked, vec![3, 1, 2]), Verdict::Ambiguous(vec![3, 1, 2]));
        // The likeliest was refused, or there are too many.
        assert_eq!(unnamed(&ranked, vec![1, 2]), Verdict::Unexplained);
        assert_eq!(unnamed(&ranked, vec![3, 1, 2, 4]), Verdict::Unexplained);
        assert_eq!(unnamed(&ranked, Vec::new()), Verdict::Unexplained);
        // Half of it is unmodelled: the same causes have less than half of what is off.
        let ranked = Ranked::new(causes.to_vec(), 0.5, vec![1, 2, 3]);
        assert_eq!(unnamed(&ranked, vec![3, 1, 2]), Verdict::Unexplained);
    }

    #[test]
    fn what_is_perhaps_unmodelled_or_chance_is_no_pair() {
        let limits = Limits::default();
        let allows = |p_value: f64, unmodelled: f64| {
            let discrepancy = Discrepancy { excess: BTreeMap::new(), joints: Vec::new(), distance: 0.0 };
            let ranked = Ranked::new(vec![(Some(3), 1.0), (None, 0.0)], unmodelled, vec![3]);
            Finding { discrepancy, ranked, p_value, p_by_statistic: [p_value; 3] }.allows_pair(&limits)
        };
        assert!(allows(0.001, 0.04) && !allows(0.001, 0.06) && !allows(0.02, 0.04));
    }

    #[test]
    fn what_is_possible_is_what_nothing_speaks_against() {
        let examined = |cause: usize, check: Option<f64>| Examined {
            cause,
            scope: Scope::All,
            scope_share: 1.0,
            check,
            conflict: None,
            evidence: 0.3,
            draws: Vec::new(),
        };
        let discrepancy = Discrepancy { excess: BTreeMap::new(), joints: Vec::new(), distance: 0.0 };
        let causes = [(Some(3), 0.5), (Some(1), 0.3), (Some(2), 0.1), (None, 0.1)];
        let ranked = Ranked::new(causes.to_vec(), 0.0, vec![1, 2, 3]);
        let mut diagnosis = Diagnosis {
            finding: Finding { discrepancy, ranked, p_value: 0.001, p_by_statistic: [0.001; 3] },
            // The likeliest does not fit.
            examined: vec![examined(3, Some(0.0)), examined(1, Some(0.4)), examined(2, None)],
            pairs: Vec::new(),
            components: Vec::new(),
            verdict: Verdict::Unexplained,
        };
        assert_eq!(diagnosis.possible(), (vec![(0.3, Vec::new()), (0.1, Vec::new())], true));
        assert_eq!(diagnosis.left_open(), [1, 2]);
        // One is left: the others were perhaps excluded by chance.
        diagnosis.examined[2].check = Some(0.0);
        let all = vec![(0.5, Vec::new()), (0.3, Vec::new()), (0.1, Vec::new())];
        assert_eq!(diagnosis.possible(), (all, false));
    }
}
