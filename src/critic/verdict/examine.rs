//! The causes of a finding ranked by all readings: those that are likely are examined by their evidence.

use rayon::prelude::*;

use crate::critic::causes::{
    Evidence, OverScopes, RUNS, Ranked, evidence_again, outside_evidence, reweighed, rough_evidence, weighed,
};
use crate::critic::discrepancy::{ComponentEstimate, Predicted, SmoothDiscrepancy};
use crate::critic::simulate::{Campaign, Causes, Truth};
use crate::critic::verdict::judge::{Finding, Judge};
use crate::critic::verdict::limits::Limits;
use crate::math::ln;

/// So many causes, the most likely, are examined.
const LIKELIEST: usize = 5;
/// And those whose rough evidence is within so much of the largest one's (nat): the ranking may know nothing of how they look.
const NEAR: f64 = 6.0;
/// A model whose rough evidence is further behind than this has no part in what is said (nat).
const FAR: f64 = 12.0;
/// But no more than this.
const SHORTLIST: usize = 8;

/// A finding with the evidence of its likely causes.
#[derive(Clone, Debug, PartialEq)]
pub struct Examination {
    /// The finding, its causes weighed by the evidence.
    pub finding: Finding,
    /// The causes that were examined; none where nothing was found.
    pub shortlist: Vec<usize>,
    /// The evidence of the base model, then that of each of these over its scopes; empty where nothing was found.
    pub evidences: Vec<OverScopes>,
    /// Logarithm of the evidence of something that is in no catalogue; `None` where nothing was found.
    pub outside: Option<f64>,
    /// What the base model with fitted joints misses; empty where nothing was found.
    pub components: Vec<ComponentEstimate>,
}

impl Examination {
    /// Logarithms of the evidence, that of the base model first.
    pub(super) fn logs(&self) -> Vec<f64> {
        self.evidences.iter().map(|evidence| evidence.log).collect()
    }
}

impl Judge<'_> {
    /// Ranks the causes of a finding, where something was found; a pure function of the judge and the arguments.
    pub fn rank(&self, finding: Finding, campaign: &Campaign, limits: &Limits, seed: u64) -> Examination {
        if finding.p_value >= limits.found {
            let (shortlist, evidences, components) = (Vec::new(), Vec::new(), Vec::new());
            return Examination { finding, shortlist, evidences, outside: None, components };
        }
        let (ranked, rough) = self.weighed(&finding.ranked, campaign, seed);
        let finding = Finding { ranked, ..finding };
        let shortlist = shortlist(&finding, &rough);
        let in_rough = |cause: Option<usize>| rough.iter().find(|rough| rough.causes.each().next() == cause);
        let models = std::iter::once(None).chain(shortlist.iter().copied().map(Some)).filter_map(in_rough);
        let evidences = self.closely(campaign, &models.collect::<Vec<_>>(), seed);
        let components = self.components(campaign, &evidences[0].draws, seed.wrapping_add(2));
        let units = self.reference.scale.units();
        let outside = outside_evidence(self.world, &self.design, campaign, &units, seed.wrapping_add(1)).log;
        let mut examination =
            Examination { finding, shortlist, evidences, outside: Some(outside), components };
        let ranked = &examination.finding.ranked;
        examination.finding.ranked = reweighed(ranked, &examination.shortlist, &examination.logs());
        examination
    }

    /// A ranking weighed by the rough evidence of every cause, and that evidence.
    pub(in crate::critic) fn weighed(
        &self,
        ranked: &Ranked,
        campaign: &Campaign,
        seed: u64,
    ) -> (Ranked, Vec<OverScopes>) {
        let models = ranked.causes.iter().map(|(cause, _)| self.world.models(*cause)).collect();
        let rough = self.roughly(campaign, models, seed);
        (weighed(ranked, &rough.iter().map(|rough| rough.log).collect::<Vec<_>>()), rough)
    }

    /// The evidence of each of these over its models, all of which have a rough one. A model that is far behind keeps it, unless it is
    /// the likeliest of its cause. Those that come near the largest are run several times: they alone can change places.
    pub(super) fn closely(&self, campaign: &Campaign, rough: &[&OverScopes], seed: u64) -> Vec<OverScopes> {
        let among = |all: &[(Causes, f64, Evidence)]| -> f64 {
            all.iter().map(|(_, p, own)| ln(*p) + own.log).fold(f64::NEG_INFINITY, f64::max)
        };
        let run = |causes: Causes, number: u64| {
            let seed = (seed.wrapping_add(1), number);
            evidence_again(self.world, &self.design, campaign, causes, seed)
        };
        let largest = rough.iter().map(|own| among(&own.models)).fold(f64::NEG_INFINITY, f64::max);
        let all: Vec<(usize, &(Causes, f64, Evidence))> =
            rough.iter().enumerate().flat_map(|(k, own)| own.models.iter().map(move |m| (k, m))).collect();
        let once = all.par_iter().map(|(k, (causes, p, roughly))| {
            let is_far = *causes != rough[*k].causes && ln(*p) + roughly.log < largest - FAR;
            let own = if is_far { roughly.clone() } else { run(*causes, 0) };
            (*causes, *p, own)
        });
        let once: Vec<(Causes, f64, Evidence)> = once.collect();
        let largest = among(&once);
        let repeated = once.into_par_iter().map(|(causes, p, own)| {
            let is_near = causes == Causes::default() || ln(p) + own.log >= largest - NEAR;
            if own.draws.is_empty() || !is_near {
                return own;
            }
            let again = (1..RUNS).into_par_iter().map(|number| run(causes, number));
            Evidence::of_runs(std::iter::once(own).chain(again.collect::<Vec<_>>()).collect())
        });
        let mut repeated = repeated.collect::<Vec<_>>().into_iter();
        let over = |own: &&OverScopes| {
            let models = own.models.iter().map(|(causes, p, _)| (*causes, *p));
            OverScopes::of(models, repeated.by_ref().take(own.models.len()).collect())
        };
        rough.iter().map(over).collect()
    }

    /// The rough evidence of each of these over its models, which come with their probabilities beforehand.
    pub(super) fn roughly(
        &self,
        campaign: &Campaign,
        models: Vec<Vec<(Causes, f64)>>,
        seed: u64,
    ) -> Vec<OverScopes> {
        let all: Vec<Causes> = models.iter().flatten().map(|(causes, _)| *causes).collect();
        let rough = |causes: &Causes| {
            rough_evidence(self.world, &self.design, campaign, *causes, seed.wrapping_add(1))
        };
        let mut evidences = all.par_iter().map(rough).collect::<Vec<_>>().into_iter();
        let over = |models: Vec<(Causes, f64)>| {
            let evidences = evidences.by_ref().take(models.len()).collect();
            OverScopes::of(models, evidences)
        };
        models.into_iter().map(over).collect()
    }

    /// What the base model with these joints misses.
    fn components(&self, campaign: &Campaign, joints: &[Truth], seed: u64) -> Vec<ComponentEstimate> {
        let base = Predicted::of(self.world, &self.design, joints, seed);
        let known: Vec<Vec<bool>> =
            self.design.specimens.iter().map(|specimen| vec![true; specimen.readings.len()]).collect();
        let units = self.reference.scale.units();
        SmoothDiscrepancy::new(&self.design, campaign, &known, &base, &units)
            .map_or_else(Vec::new, |free| free.components())
    }
}

/// The causes that are worth being examined: those that the ranking finds likely or cannot put aside, where these are few, and those
/// whose rough evidence is near the largest. Of too many those come first that stand high in either order.
fn shortlist(finding: &Finding, rough: &[OverScopes]) -> Vec<usize> {
    let likely: Vec<usize> = finding.ranked.causes.iter().filter_map(|(cause, _)| *cause).collect();
    let evidence: Vec<(usize, f64)> =
        rough.iter().filter_map(|rough| Some((rough.causes.each().next()?, rough.log))).collect();
    let largest = evidence.iter().map(|(_, log)| *log).fold(f64::NEG_INFINITY, f64::max);
    let open = |cause: usize| finding.leaves_few() && finding.ranked.set.contains(&cause);
    let chosen = |(rank, cause): (usize, usize)| {
        let log = evidence.iter().find(|(other, _)| *other == cause)?.1;
        let further = evidence.iter().filter(|(_, other)| *other > log).count();
        let is_chosen = rank < LIKELIEST || open(cause) || log >= largest - NEAR;
        is_chosen.then_some((rank.min(further), rank, cause))
    };
    let mut chosen: Vec<(usize, usize, usize)> = likely.into_iter().enumerate().filter_map(chosen).collect();
    chosen.sort_unstable();
    chosen.into_iter().take(SHORTLIST).map(|(.., cause)| cause).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::discrepancy::Discrepancy;
    use crate::critic::simulate::Scope;

    #[test]
    fn what_has_the_evidence_is_examined_whatever_the_ranking_says_of_it() {
        let examined = |logs: &dyn Fn(usize) -> f64, set: &[usize]| {
            // Twelve causes, the later the less likely.
            let causes = (0..12).map(|cause| (Some(cause), 1.0 / f64::from(2_u32 << cause))).collect();
            let ranked = Ranked::new(causes, 0.0, set.to_vec());
            let discrepancy = Discrepancy { excess: Default::default(), joints: Vec::new(), distance: 0.0 };
            let finding = Finding { discrepancy, ranked, p_value: 0.001, p_by_statistic: [0.001; 3] };
            let one = |cause: usize| OverScopes {
                causes: Causes::one(cause, Scope::All),
                share: 1.0,
                log: logs(cause),
                spread: 0.0,
                models: Vec::new(),
                draws: Vec::new(),
            };
            let mut examined = shortlist(&finding, &(0..12).map(one).collect::<Vec<_>>());
            examined.sort_unstable();
            examined
        };
        let at = |cause: usize| if cause == 9 || cause == 11 { 3.0 } else { -10.0 };
        assert_eq!(examined(&at, &[]), [0, 1, 2, 3, 4, 9, 11]);
        // The seventh cannot be put aside, and of nine the one is left out that stands high in neither order.
        assert_eq!(examined(&at, &[6]), [0, 1, 2, 3, 4, 6, 9, 11]);
        assert_eq!(examined(&at, &[6, 7]), [0, 1, 2, 3, 4, 6, 9, 11]);
        // Where all have as much, the likeliest.
        assert_eq!(examined(&|_| 0.0, &[]), [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}
