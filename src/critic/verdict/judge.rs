//! Who judges campaigns of one design: all that is learnt from simulation beforehand, whatever was measured.

use rayon::prelude::*;

use crate::critic::causes::{Ranked, Ranking};
use crate::critic::check::Check;
use crate::critic::conflict::PriorPredictive;
use crate::critic::discrepancy::{Discrepancy, Reference};
use crate::critic::simulate::{ByCause, Campaign, Design, World};
use crate::critic::verdict::detection::Detection;
use crate::critic::verdict::limits::{Limits, MOST_AMBIGUOUS};
use crate::random::Streams;

/// Campaigns that are simulated to learn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Of the base model, for the discrepancy and once more for how large it is by chance.
    pub reference: u64,
    /// Of each cause and of unmodelled effects, for the ranking.
    pub training: u64,
}

impl Default for Effort {
    fn default() -> Self {
        Effort { reference: 2000, training: 2400 }
    }
}

/// All that a design's campaigns are judged by.
#[derive(Debug)]
pub struct Judge<'w> {
    /// What campaigns are simulated from.
    pub world: &'w World<'w>,
    /// What is read.
    pub design: Design,
    /// The base model as the design sees it.
    pub reference: Reference,
    /// The causes as it can tell them apart.
    pub ranking: Ranking,
    detection: Detection,
    /// What the physical priors of causes predict.
    pub(super) predictions: ByCause<PriorPredictive>,
}

/// What is found in a campaign: its discrepancy, how likely that is by chance, and the ranking of the causes.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What is off.
    pub discrepancy: Discrepancy,
    /// The causes with their probabilities.
    pub ranked: Ranked,
    /// Share of campaigns without any effect that are as far off.
    pub p_value: f64,
    /// The same by each statistic alone: the furthest single number, all numbers together, likeness to a cause.
    pub p_by_statistic: [f64; 3],
}

impl Finding {
    /// The cause that would be named if nothing else spoke against it.
    pub fn named(&self, limits: &Limits) -> Option<usize> {
        self.ranked.named(limits.named).filter(|_| self.p_value < limits.sure)
    }

    /// Whether the causes that the ranking cannot put aside are few. Of many, the check would choose some by chance.
    pub(super) fn leaves_few(&self) -> bool {
        self.ranked.set.len() <= 2 * MOST_AMBIGUOUS
    }

    /// Whether a pair of causes may be named at all.
    pub(super) fn allows_pair(&self, limits: &Limits) -> bool {
        self.p_value < limits.sure && self.ranked.unmodelled <= limits.pair.unmodelled
    }
}

impl<'w> Judge<'w> {
    /// Learns from simulated campaigns; a pure function of its arguments. `None` where the readings say nothing.
    pub fn trained(world: &'w World<'w>, design: &Design, effort: Effort, seed: u64) -> Option<Judge<'w>> {
        let reference = Reference::new(world, design, effort.reference, seed)?;
        let ranking = Ranking::trained(world, design, &reference, effort.training, seed.wrapping_add(1));
        let chance = seed.wrapping_add(2);
        let one = |k: u64| {
            let streams = Streams::new(chance, k);
            let campaign = world.campaign(design, &world.drawn(None, &streams), &streams);
            let discrepancy = reference.discrepancy(design, &campaign);
            let ranked = ranking.of(&discrepancy);
            (discrepancy, ranked)
        };
        let campaigns: Vec<(Discrepancy, Ranked)> = (0..effort.reference).into_par_iter().map(one).collect();
        let detection = Detection::of(&campaigns);
        Some(Judge {
            world,
            design: design.clone(),
            reference,
            ranking,
            detection,
            predictions: ByCause::default(),
        })
    }

    /// The posterior predictive check of causes on the design's campaigns.
    pub(in crate::critic) fn posterior_check(&self) -> Check<'_> {
        Check { world: self.world, design: &self.design, reference: &self.reference }
    }

    /// Compares a campaign with those of the base model, and ranks the causes by how it looks.
    pub fn compare(&self, campaign: &Campaign) -> Finding {
        let discrepancy = self.reference.discrepancy(&self.design, campaign);
        let ranked = self.ranking.of(&discrepancy);
        let (p_value, p_by_statistic) = self.detection.p_values(&discrepancy, &ranked);
        Finding { discrepancy, ranked, p_value, p_by_statistic }
    }
}
