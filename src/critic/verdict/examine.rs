//! The causes of a finding ranked by all readings: those that are likely are examined by their evidence.

use rayon::prelude::*;

use crate::critic::causes::{Evidence, OverScopes, Ranked, evidence, reweighed, rough_evidence, weighed};
use crate::critic::discrepancy::{ComponentEstimate, Predicted, SmoothDiscrepancy};
use crate::critic::simulate::{Campaign, Causes, Truth};
use crate::critic::verdict::judge::{Finding, Judge};
use crate::critic::verdict::limits::Limits;

/// So many causes, the most likely, are examined.
const SHORTLIST: usize = 5;

/// A finding with the evidence of its likely causes.
#[derive(Clone, Debug, PartialEq)]
pub struct Examination {
    /// The finding, its causes weighed by the evidence.
    pub finding: Finding,
    /// The causes that were examined; none where nothing was found.
    pub shortlist: Vec<usize>,
    /// The evidence of the base model, then that of each of these over its scopes; empty where nothing was found.
    pub evidences: Vec<OverScopes>,
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
            return Examination { finding, shortlist, evidences, components };
        }
        let (ranked, _) = self.weighed(&finding.ranked, campaign, seed);
        let finding = Finding { ranked, ..finding };
        let likely = finding.ranked.causes.iter().filter_map(|(cause, _)| *cause);
        let open = |cause: &usize| finding.leaves_few() && finding.ranked.set.contains(cause);
        let shortlist = likely.enumerate().filter(|(rank, cause)| *rank < SHORTLIST || open(cause));
        let shortlist: Vec<usize> = shortlist.map(|(_, cause)| cause).collect();
        let models: Vec<Option<usize>> =
            std::iter::once(None).chain(shortlist.iter().copied().map(Some)).collect();
        let evidences = self.over_scopes(&models, |models| self.evidences(campaign, models, seed));
        let components = self.components(campaign, &evidences[0].draws, seed.wrapping_add(2));
        let mut examination = Examination { finding, shortlist, evidences, components };
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
        let causes: Vec<Option<usize>> = ranked.causes.iter().map(|(cause, _)| *cause).collect();
        let rough = self.over_scopes(&causes, |models| self.rough(campaign, models, seed));
        (weighed(ranked, &rough.iter().map(|rough| rough.log).collect::<Vec<_>>()), rough)
    }

    /// The evidence of causes over their scopes, from that of models.
    fn over_scopes(
        &self,
        causes: &[Option<usize>],
        evidences: impl Fn(&[Causes]) -> Vec<Evidence>,
    ) -> Vec<OverScopes> {
        let models: Vec<Vec<(Causes, f64)>> = causes.iter().map(|cause| self.world.models(*cause)).collect();
        let all: Vec<Causes> = models.iter().flatten().map(|(causes, _)| *causes).collect();
        let mut evidences = evidences(&all).into_iter();
        let over = |models: Vec<(Causes, f64)>| {
            let evidences = evidences.by_ref().take(models.len()).collect();
            OverScopes::of(models, evidences)
        };
        models.into_iter().map(over).collect()
    }

    /// The evidence of each model.
    pub(super) fn evidences(&self, campaign: &Campaign, models: &[Causes], seed: u64) -> Vec<Evidence> {
        let of =
            |causes: &Causes| evidence(self.world, &self.design, campaign, *causes, seed.wrapping_add(1));
        models.par_iter().map(of).collect()
    }

    /// The evidence of each model, roughly.
    pub(super) fn rough(&self, campaign: &Campaign, models: &[Causes], seed: u64) -> Vec<Evidence> {
        let rough = |causes: &Causes| {
            rough_evidence(self.world, &self.design, campaign, *causes, seed.wrapping_add(1))
        };
        models.par_iter().map(rough).collect()
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
