//! Which cause explains what is wrong? A network trained on campaigns that the causes would have shown, and sets of causes that
//! hold the true one nine times in ten, whichever it is.

use rayon::prelude::*;

use crate::critic::diagnose::design::Design;
use crate::critic::diagnose::network::{Example, Network};
use crate::critic::diagnose::world::World;
use crate::critic::diagnose::wrong::{Reference, Wrong};
use crate::math::ln;
use crate::random::Streams;

/// Share of the sets that hold the true cause, for each cause.
pub const COVERED: f64 = 0.9;
/// One campaign in so many, under every cause, is kept from the training, for the sets.
const KEPT: u64 = 5;
/// And one in so many of the others for the network's temperature.
const HELD: u64 = 8;

/// The causes of a world as a design can tell them apart.
#[derive(Clone, Debug)]
pub struct Ranking {
    /// The cause of each class; the base model is the first.
    causes: Vec<Option<usize>>,
    network: Network,
    /// The least probability with which a cause is in the set.
    least: Vec<f64>,
}

/// What a campaign speaks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranked {
    /// Each cause with its probability, all causes being equally likely beforehand, the base model among them; most likely first.
    pub causes: Vec<(Option<usize>, f64)>,
    /// The causes that cannot be put aside: for each cause, [`COVERED`] of its campaigns have it in here. The base model is not
    /// asked: whether anything is wrong is judged apart.
    pub set: Vec<usize>,
}

impl Ranking {
    /// Trained on `count` campaigns of every cause and of the base model, drawn from the priors; a pure function of its
    /// arguments.
    pub fn trained(
        world: &World<'_>,
        design: &Design,
        reference: &Reference,
        count: u64,
        seed: u64,
    ) -> Ranking {
        let causes: Vec<Option<usize>> =
            std::iter::once(None).chain(world.causes().into_iter().map(Some)).collect();
        let classes = causes.len();
        let shown = |k: u64, (class, cause): (usize, &Option<usize>)| -> Example {
            // The same stones and errors under every cause.
            let streams = Streams::new(seed, k);
            let truth = world.drawn(*cause, &streams);
            (inputs(&reference.judge(design, &world.campaign(design, &truth, &streams))), class)
        };
        let all: Vec<Vec<Example>> = (0..count)
            .into_par_iter()
            .map(|k| causes.iter().enumerate().map(|cause| shown(k, cause)).collect())
            .collect();
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
        let mut stream = Streams::new(seed, count).of("network");
        let network = Network::trained(&examples, &held, classes, &mut stream);
        let least = (0..classes).map(|class| {
            let own = kept.iter().filter(|(_, own)| *own == class);
            let mut given: Vec<f64> = own.map(|(inputs, _)| network.probabilities(inputs)[class]).collect();
            given.sort_by(f64::total_cmp);
            // With n campaigns the share that lies at or above the k-th smallest is at least 1 - k/(n + 1).
            let rank = ((1.0 - COVERED) * (given.len() + 1) as f64).floor() as usize;
            rank.checked_sub(1).map_or(0.0, |k| given[k])
        });
        let least = least.collect();
        Ranking { causes, network, least }
    }

    /// The causes that are told apart, the base model first.
    pub fn causes(&self) -> &[Option<usize>] {
        &self.causes
    }

    /// Ranks the causes of what is wrong with a campaign.
    pub fn of(&self, wrong: &Wrong) -> Ranked {
        let probabilities = self.network.probabilities(&inputs(wrong));
        let causes = self.causes.iter().copied().zip(probabilities.iter().copied()).collect();
        let inside = self.causes.iter().zip(&probabilities).zip(&self.least);
        let set = inside.filter(|((_, p), least)| p >= least).filter_map(|((cause, _), _)| *cause);
        Ranked::new(causes, set.collect())
    }
}

impl Ranked {
    /// Of causes with their probabilities, in any order.
    pub(super) fn new(mut causes: Vec<(Option<usize>, f64)>, set: Vec<usize>) -> Ranked {
        causes.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        Ranked { causes, set }
    }

    /// How much more likely any cause is than the base model (logarithm of the odds).
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
pub(super) fn inputs(wrong: &Wrong) -> Vec<f64> {
    let tamed = |x: f64| x.signum() * ln(1.0 + x.abs());
    let excess = wrong.excess.values().map(|x| tamed(x.unwrap_or(0.0)));
    excess.chain(wrong.joints.iter().flatten().map(|x| tamed(*x))).collect()
}
