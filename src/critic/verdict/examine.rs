//! The causes of a finding ranked by all readings: those that are likely are examined by their evidence.

use rayon::prelude::*;

use crate::critic::causes::{Evidence, Ranked, evidence, reweighed, rough_evidence, weighed};
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
    /// The evidence of the base model, then that of each of these; empty where nothing was found.
    pub evidences: Vec<Evidence>,
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
        let finding = Finding { ranked: self.weighed(&finding.ranked, campaign, seed), ..finding };
        let likely = finding.ranked.causes.iter().filter_map(|(cause, _)| *cause);
        let open = |cause: &usize| finding.leaves_few() && finding.ranked.set.contains(cause);
        let shortlist = likely.enumerate().filter(|(rank, cause)| *rank < SHORTLIST || open(cause));
        let shortlist: Vec<usize> = shortlist.map(|(_, cause)| cause).collect();
        let models = std::iter::once(None).chain(shortlist.iter().copied().map(Some)).map(Causes::from);
        let evidences = self.evidences(campaign, &models.collect::<Vec<_>>(), seed);
        let components = self.components(campaign, &evidences[0].draws, seed.wrapping_add(2));
        let mut examination = Examination { finding, shortlist, evidences, components };
        let ranked = &examination.finding.ranked;
        examination.finding.ranked = reweighed(ranked, &examination.shortlist, &examination.logs());
        examination
    }

    /// The evidence of each model.
    pub(super) fn evidences(&self, campaign: &Campaign, models: &[Causes], seed: u64) -> Vec<Evidence> {
        let of =
            |causes: &Causes| evidence(self.world, &self.design, campaign, *causes, seed.wrapping_add(1));
        models.par_iter().map(of).collect()
    }

    /// A ranking weighed by the rough evidence of every cause.
    pub(in crate::critic) fn weighed(&self, ranked: &Ranked, campaign: &Campaign, seed: u64) -> Ranked {
        let logs = self.rough(campaign, ranked.causes.iter().map(|(cause, _)| Causes::from(*cause)), seed);
        weighed(ranked, &logs)
    }

    /// The logarithm of the evidence of each model, roughly.
    pub(super) fn rough(
        &self,
        campaign: &Campaign,
        models: impl Iterator<Item = Causes>,
        seed: u64,
    ) -> Vec<f64> {
        let rough =
            |causes: Causes| rough_evidence(self.world, &self.design, campaign, causes, seed.wrapping_add(1));
        models.collect::<Vec<_>>().into_par_iter().map(rough).collect()
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
