//! Which cause explains the discrepancy? Networks learn it from campaigns that the causes would have shown, and that [unmodelled]
//! effects would. Sets of causes hold the true one nine times in ten, whichever it is.
//!
//! [unmodelled]: crate::critic::World::unmodelled

use rayon::prelude::*;

use crate::critic::causes::network::{Example, Network};
use crate::critic::discrepancy::{Discrepancy, Reference};
use crate::critic::simulate::{Design, World};
use crate::math::ln;
use crate::random::Streams;

/// Share of the sets that hold the true cause, for each cause.
pub const COVERED: f64 = 0.9;
/// One campaign in so many, under every cause, is kept from the training, for the sets.
const KEPT: u64 = 5;
/// And one in so many of the others for the networks' temperatures.
const HELD: u64 = 8;
/// Networks whose probabilities are averaged: each has its own start and its own faults (Lakshminarayanan et al. 2017). Two that have
/// learnt from 2,400 campaigns of each cause tell more of new ones than one that has learnt from 3,600.
const NETWORKS: u64 = 2;

/// No more than this is ever unmodelled: what causes share of the rest stays a number.
const SUREST: f64 = 1.0 - 1e-9;

/// The causes of a world as a design can tell them apart.
#[derive(Clone, Debug)]
pub struct Ranking {
    /// The cause of each class; the base model is the first. Unmodelled effects are one more class, the last.
    causes: Vec<Option<usize>>,
    networks: Vec<Network>,
    /// The least share of what unmodelled effects leave with which a cause is in the set.
    least: Vec<f64>,
}

/// What a campaign speaks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranked {
    /// Each cause with its probability, the base model among them; most likely first. Beforehand all causes are equally likely,
    /// and something unmodelled is as likely as one of them.
    pub causes: Vec<(Option<usize>, f64)>,
    /// Probability of something that is in no catalogue, with which all are 1.
    pub unmodelled: f64,
    /// The causes that cannot be put aside: for each cause, [`COVERED`] of its campaigns have it in here. The base model is not
    /// in it: whether there is a discrepancy is tested apart.
    pub set: Vec<usize>,
}

impl Ranking {
    /// Trained on `count` campaigns of every cause, of the base model and of unmodelled effects, drawn from the priors, those of
    /// the causes' scopes among them; a pure function of its arguments.
    pub fn trained(
        world: &World<'_>,
        design: &Design,
        reference: &Reference,
        count: u64,
        seed: u64,
    ) -> Ranking {
        let causes: Vec<Option<usize>> =
            std::iter::once(None).chain(world.causes().into_iter().map(Some)).collect();
        let classes = causes.len() + 1;
        let shown = |k: u64| -> Vec<Example> {
            // The same stones and errors under every cause.
            let streams = Streams::new(seed, k);
            let of = |cause: &Option<usize>| {
                let truth = world.drawn(world.scoped(*cause, &streams), &streams);
                world.campaign(design, &truth, &streams)
            };
            let all = causes.iter().map(of).chain(std::iter::once(world.unmodelled(design, &streams)));
            all.map(|campaign| inputs(&reference.discrepancy(design, &campaign))).zip(0..).collect()
        };
        let all: Vec<Vec<Example>> = (0..count).into_par_iter().map(shown).collect();
        let (mut examples, mut held, mut kept): (Vec<Example>, Vec<Example>, Vec<Example>) =
            Default::default();
        for (k, shown) in (0..count).zip(all) {
            let part = match k {
                k if k.is_multiple_of(KEPT) => &mut kept,
                k if k % HELD == 1 => &mut held,
                _ => &mut examples,
            };
            part.extend(shown);
        }
        let network = |number: u64| {
            let mut stream = Streams::new(seed, count + number).of("network");
            Network::trained(&examples, &held, classes, &mut stream)
        };
        let networks = (0..NETWORKS).into_par_iter().map(network).collect();
        let mut ranking = Ranking { causes, networks, least: Vec::new() };
        let given: Vec<(Vec<f64>, usize)> =
            kept.into_par_iter().map(|(inputs, class)| (ranking.shares(&inputs).0, class)).collect();
        let least = (0..ranking.causes.len()).map(|class| {
            let own = given.iter().filter(|(_, own)| *own == class);
            let mut shares: Vec<f64> = own.map(|(shares, _)| shares[class]).collect();
            shares.sort_by(f64::total_cmp);
            // With n campaigns the share that lies at or above the k-th smallest is at least 1 - k/(n + 1).
            let rank = ((1.0 - COVERED) * (shares.len() + 1) as f64).floor() as usize;
            rank.checked_sub(1).map_or(0.0, |k| shares[k])
        });
        ranking.least = least.collect();
        ranking
    }

    /// The causes that are ranked, the base model first.
    pub fn causes(&self) -> &[Option<usize>] {
        &self.causes
    }

    /// Ranks the causes of a discrepancy.
    pub fn of(&self, discrepancy: &Discrepancy) -> Ranked {
        let (shares, unmodelled) = self.shares(&inputs(discrepancy));
        let inside = self.causes.iter().zip(&shares).zip(&self.least);
        let set = inside.filter(|((_, share), least)| share >= least).filter_map(|((cause, _), _)| *cause);
        let set = set.collect();
        Ranked::new(self.causes.iter().copied().zip(shares).collect(), unmodelled, set)
    }

    /// The share of each cause in what unmodelled effects leave of the probability, and theirs.
    fn shares(&self, inputs: &[f64]) -> (Vec<f64>, f64) {
        let mut sums = vec![0.0; self.causes.len() + 1];
        for network in &self.networks {
            sums.iter_mut().zip(network.probabilities(inputs)).for_each(|(sum, p)| *sum += p);
        }
        let unmodelled = sums.pop().unwrap_or(0.0) / self.networks.len() as f64;
        let rest = sums.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        (sums.into_iter().map(|sum| sum / rest).collect(), unmodelled)
    }
}

impl Ranked {
    /// Of causes with their shares, of sum 1, in what unmodelled effects leave of the probability, in any order.
    pub(in crate::critic) fn new(
        mut causes: Vec<(Option<usize>, f64)>,
        unmodelled: f64,
        set: Vec<usize>,
    ) -> Ranked {
        causes.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let unmodelled = unmodelled.min(SUREST);
        causes.iter_mut().for_each(|(_, p)| *p *= 1.0 - unmodelled);
        Ranked { causes, unmodelled, set }
    }

    /// The same causes, where something unmodelled has this probability.
    pub fn beside(&self, unmodelled: f64) -> Ranked {
        let causes = self.causes.iter().map(|(cause, p)| (*cause, p / (1.0 - self.unmodelled)));
        Ranked::new(causes.collect(), unmodelled, self.set.clone())
    }

    /// How much more likely it is that something is off, by any cause or none that has a name, than the base model (logarithm of
    /// the odds).
    pub fn odds(&self) -> f64 {
        let base = self.causes.iter().find(|(cause, _)| cause.is_none()).map_or(0.0, |(_, p)| *p);
        let tiny = 1e-12;
        ln((1.0 - base).max(tiny)) - ln(base.max(tiny))
    }

    /// The probability of a cause.
    pub fn probability(&self, cause: usize) -> f64 {
        let own = self.causes.iter().find(|(other, _)| *other == Some(cause));
        own.map_or(0.0, |(_, probability)| *probability)
    }

    /// The most likely cause, if it is at least so likely and not the base model.
    pub fn named(&self, least: f64) -> Option<usize> {
        let (cause, probability) = self.causes[0];
        cause.filter(|_| probability >= least)
    }
}

/// What the network sees: every excess and the scores of the joints, large ones by their logarithm.
pub fn inputs(discrepancy: &Discrepancy) -> Vec<f64> {
    let tamed = |x: f64| x.signum() * ln(1.0 + x.abs());
    let excess = discrepancy.excess.values().map(|x| tamed(x.unwrap_or(0.0)));
    excess.chain(discrepancy.joints.iter().flatten().map(|x| tamed(*x))).collect()
}
