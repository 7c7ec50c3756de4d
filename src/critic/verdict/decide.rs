//! How a verdict is come to: the examined causes in question are checked, and what is left is named or left open.

use crate::critic::causes::{self, OverScopes, Ranked, softmax};
use crate::critic::conflict::PriorPredictive;
use crate::critic::simulate::{Campaign, Causes};
use crate::critic::verdict::diagnosis::{Diagnosis, Examined, Verdict, fitting};
use crate::critic::verdict::examine::Examination;
use crate::critic::verdict::judge::{Finding, Judge};
use crate::critic::verdict::limits::{Limits, MOST_AMBIGUOUS, NOISE, POSSIBLE, far_behind, of_difference};
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
        let Examination { mut finding, shortlist, evidences, outside, components } = examination;
        if finding.p_value >= limits.found {
            let (examined, pairs, verdict) = (Vec::new(), Vec::new(), Verdict::NothingFound);
            return Diagnosis { finding, examined, pairs, outside: None, components, verdict };
        }
        let (shares, spread) = (softmax(&logs, 1.0), evidences[0].spread);
        let few = finding.leaves_few();
        // What all readings make likely is checked, however the ranking sees it, and however likely something outside is.
        let inside = Finding { ranked: finding.ranked.beside(0.0), ..finding.clone() };
        let strongest = evidences[1..].iter().map(|own| [own.log, own.spread]);
        let strongest =
            strongest.fold([f64::NEG_INFINITY, 0.0], |best, own| if own[0] > best[0] { own } else { best });
        let in_question = |cause: &usize, found: &OverScopes, share: f64| {
            let p = inside.ranked.probability(*cause);
            let is_possible = p >= if inside.ranked.set.contains(cause) { POSSIBLE } else { LIKELY };
            inside.named(limits) == Some(*cause)
                || few && (is_possible || share >= LIKELY)
                || !far_behind([found.log, found.spread], strongest)
        };
        let check = self.posterior_check();
        let mut examined: Vec<Examined<usize>> = shortlist
            .iter()
            .zip(evidences.into_iter().zip(&shares).skip(1))
            .map(|(&cause, (found, share))| Examined {
                cause,
                acting: found.causes,
                scope_share: found.share,
                log: found.log - logs[0],
                spread: found.spread,
                check: in_question(&cause, &found, *share)
                    .then(|| check.p_value(&found.draws, campaign, seed)),
                conflict: None,
                evidence: *share,
                draws: found.draws,
            })
            .collect();
        let place = |own: &Examined<usize>| {
            finding.ranked.causes.iter().position(|(cause, _)| *cause == Some(own.cause))
        };
        examined.sort_by_key(place);
        let explain: Vec<usize> = fitting(&examined, limits).map(|own| own.cause).collect();
        // What looks like no cause to the ranking is no veto: where one fits, what is outside has the probability of its evidence.
        if let (Some(outside), false) = (outside, explain.is_empty()) {
            finding.ranked = finding.ranked.beside(causes::outside(&logs, outside));
        }
        let named = finding.named(limits);
        // The base model with other joints, or another cause, may have more of the evidence.
        let agreed = named.filter(|cause| {
            let own = examined.iter().find(|own| own.cause == *cause);
            let is_first = |own: &Examined<usize>| examined.iter().all(|other| !other.exceeds(own));
            own.is_some_and(|own| own.log > NOISE * of_difference(own.spread, spread) && is_first(own))
        });
        let verdict = match agreed.filter(|cause| explain.contains(cause)) {
            Some(cause) => named_or_level(cause, &examined, &explain, &finding.ranked),
            // What was as good as certain, and does not fit, speaks against the catalogue.
            None if named.is_some_and(|cause| !explain.contains(&cause)) => Verdict::Unexplained,
            None => unnamed(&finding.ranked, explain),
        };
        let best = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let outside = outside.map(|outside| outside - best);
        let pairs = Vec::new();
        let mut diagnosis = Diagnosis { finding, examined, pairs, outside, components, verdict };
        if diagnosis.verdict == Verdict::Unexplained {
            diagnosis.pairs = self.pairs(campaign, &diagnosis.examined, &logs, limits, seed);
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
                own.for_each(|own| own.conflict = Some(conflict(own.acting)));
            }
            verdict => {
                let own = diagnosis.examined.iter_mut().filter(|own| verdict.causes().contains(&own.cause));
                own.for_each(|own| own.conflict = Some(conflict(own.acting)));
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
        examined: &[Examined<usize>],
        logs: &[f64],
        limits: &Limits,
        seed: u64,
    ) -> Vec<Examined<[usize; 2]>> {
        let Some(best) = examined.iter().reduce(|best, own| if own.log > best.log { own } else { best })
        else {
            return Vec::new();
        };
        let causes = self.world.causes();
        let mechanisms = self.world.mechanisms();
        let goes_with = |other: &usize| mechanisms[best.cause].goes_with(mechanisms[*other].name);
        let others: Vec<usize> =
            causes.iter().copied().filter(|other| *other != best.cause && goes_with(other)).collect();
        // The one acts where it does alone, the other with every scope.
        let own = best.acting.scoped().next();
        let models = |other: &usize| -> Vec<(Causes, f64)> {
            let scopes = self.world.scopes(*other).into_iter();
            let both = |(scope, p)| Some((Causes::both([own?, (*other, scope)]), p));
            scopes.filter_map(both).collect()
        };
        let rough = self.roughly(campaign, others.iter().map(models).collect(), seed);
        let promising = stats::smallest(rough.iter().map(|found| -found.log).zip(0..), PAIRS);
        let rough: Vec<&OverScopes> = promising.iter().map(|at| &rough[*at]).collect();
        let others: Vec<usize> = promising.iter().map(|at| others[*at]).collect();
        let evidences = self.closely(campaign, &rough, seed);
        let rare = ln(causes.len() as f64);
        let all: Vec<f64> =
            logs.iter().copied().chain(evidences.iter().map(|evidence| evidence.log - rare)).collect();
        let shares = softmax(&all, 1.0);
        let check = self.posterior_check();
        let rows = others.into_iter().zip(evidences).zip(&shares[logs.len()..]);
        let mut pairs: Vec<Examined<[usize; 2]>> = rows
            .map(|((other, found), &evidence)| Examined {
                cause: [best.cause.min(other), best.cause.max(other)],
                acting: found.causes,
                scope_share: found.share,
                log: found.log - rare - logs[0],
                spread: found.spread,
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

impl<C> Examined<C> {
    /// Whether it has more of the evidence than another by more than noise.
    fn exceeds(&self, other: &Examined<C>) -> bool {
        self.log - other.log > NOISE * of_difference(self.spread, other.spread)
    }
}

/// The verdict where one cause is named. Those that fit as well are left open beside it, where its evidence does not exceed theirs by
/// more than noise and the ranking cannot put them aside.
fn named_or_level(cause: usize, examined: &[Examined<usize>], explain: &[usize], ranked: &Ranked) -> Verdict {
    let own = examined.iter().find(|own| own.cause == cause);
    let is_level = |other: &&Examined<usize>| {
        let possible = ranked.set.contains(&other.cause) && ranked.probability(other.cause) >= POSSIBLE;
        explain.contains(&other.cause) && possible && own.is_some_and(|own| !own.exceeds(other))
    };
    let level = examined.iter().filter(|other| other.cause != cause).filter(is_level);
    let all: Vec<usize> = std::iter::once(cause).chain(level.map(|other| other.cause)).collect();
    match all.len() {
        1 => Verdict::Named(cause),
        2..=MOST_AMBIGUOUS => Verdict::Ambiguous(all),
        _ => Verdict::Unexplained,
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
    fn a_name_stands_alone_only_where_no_other_has_as_much_of_the_evidence() {
        let ranked = Ranked::new(vec![(Some(3), 0.9), (Some(1), 0.05), (Some(2), 0.05)], 0.0, vec![1, 2, 3]);
        let own = |cause: usize, log: f64| Examined {
            cause,
            acting: Some(cause).into(),
            scope_share: 1.0,
            log,
            spread: 0.3,
            check: Some(0.5),
            conflict: None,
            evidence: 0.3,
            draws: Vec::new(),
        };
        // Two spreads of the difference are 0.85.
        let verdict = |second: f64, explain: &[usize], ranked: &Ranked| {
            named_or_level(3, &[own(3, 5.0), own(1, second), own(2, 1.0)], explain, ranked)
        };
        assert_eq!(verdict(4.1, &[3, 1, 2], &ranked), Verdict::Named(3));
        assert_eq!(verdict(4.3, &[3, 1, 2], &ranked), Verdict::Ambiguous(vec![3, 1]));
        // What does not fit, or cannot be, is no rival.
        assert_eq!(verdict(4.3, &[3, 2], &ranked), Verdict::Named(3));
        let put_aside = Ranked { set: vec![3, 2], ..ranked };
        assert_eq!(verdict(4.3, &[3, 1, 2], &put_aside), Verdict::Named(3));
    }

    #[test]
    fn a_cause_that_fits_is_put_aside_where_the_evidence_speaks_strongly_for_another() {
        let own = |cause: usize, log: f64, check: f64| Examined {
            cause,
            acting: Some(cause).into(),
            scope_share: 1.0,
            log,
            spread: 0.3,
            check: Some(check),
            conflict: None,
            evidence: 0.3,
            draws: Vec::new(),
        };
        let examined = [own(3, 5.0, 0.5), own(1, 2.1, 0.5), own(2, 1.9, 0.5), own(4, 9.0, 0.01)];
        let left: Vec<usize> = fitting(&examined, &Limits::default()).map(|own| own.cause).collect();
        // What does not fit speaks against none.
        assert_eq!(left, [3, 1]);
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
            acting: Some(cause).into(),
            scope_share: 1.0,
            log: 0.0,
            spread: 0.0,
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
            outside: None,
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
