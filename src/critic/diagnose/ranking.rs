//! Which cause explains what is wrong? A network trained on campaigns that the causes would have shown, and sets of causes that
//! hold the true one nine times in ten, whichever it is.

use crate::critic::diagnose::design::{Campaign, Design};
use crate::critic::diagnose::network::{Example, Network};
use crate::critic::diagnose::world::World;
use crate::critic::diagnose::wrong::{Reference, Wrong};
use crate::math::ln;
use crate::random::Streams;
use crate::stats;

/// Share of the sets that hold the true cause, for each cause.
pub const COVERED: f64 = 0.9;
/// One campaign in so many is kept from the training, for the sets.
const KEPT: u64 = 5;

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
        let mut examples: Vec<Example> = Vec::new();
        let mut kept: Vec<Example> = Vec::new();
        for k in 0..count {
            for (class, cause) in causes.iter().enumerate() {
                // The same stones and errors under every cause.
                let streams = Streams::new(seed, k);
                let truth = world.drawn(*cause, &streams);
                let wrong = reference.judge(design, &world.campaign(design, &truth, &streams));
                let to = if k % KEPT == 0 { &mut kept } else { &mut examples };
                to.push((inputs(&wrong), class));
            }
        }
        let network = Network::trained(&examples, classes, &mut Streams::new(seed, count).of("network"));
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

    /// Ranks the causes of what is wrong with a campaign.
    pub fn of(&self, wrong: &Wrong) -> Ranked {
        let probabilities = self.network.probabilities(&inputs(wrong));
        let mut causes: Vec<(Option<usize>, f64)> =
            self.causes.iter().copied().zip(probabilities.iter().copied()).collect();
        causes.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let inside = self.causes.iter().zip(&probabilities).zip(&self.least);
        let set = inside.filter(|((_, p), least)| p >= least).filter_map(|((cause, _), _)| *cause);
        Ranked { causes, set: set.collect() }
    }
}

/// What the network sees: every excess and the scores of the joints, large ones by their logarithm.
pub(super) fn inputs(wrong: &Wrong) -> Vec<f64> {
    let tamed = |x: f64| x.signum() * ln(1.0 + x.abs());
    let excess = wrong.excess.values().map(|x| tamed(x.unwrap_or(0.0)));
    excess.chain(wrong.joints.iter().flatten().map(|x| tamed(*x))).collect()
}

/// How often diagnoses of a design find and name what is hidden, by simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfTest {
    /// For each cause and for the base model (first): campaigns, how many are found, named rightly, named wrongly, and in how many
    /// of those found the set holds the cause; and the mean number of causes in these sets.
    pub rows: Vec<SelfTestRow>,
}

/// A line of the self-test.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfTestRow {
    /// What was hidden; none where nothing was.
    pub cause: Option<usize>,
    /// Campaigns.
    pub campaigns: u64,
    /// In which something was found.
    pub found: u64,
    /// In which the cause was named.
    pub named: u64,
    /// In which another one was.
    pub misnamed: u64,
    /// Of those found, whose set holds the cause.
    pub covered: u64,
    /// Mean number of causes in the sets of those found.
    pub set_size: f64,
}

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

impl Ranking {
    /// The cause that a campaign names, if any.
    pub fn named(&self, wrong: &Wrong, limits: &Limits) -> Option<usize> {
        if wrong.p_value >= limits.found {
            return None;
        }
        let (cause, probability) = self.of(wrong).causes[0];
        cause.filter(|_| probability >= limits.named)
    }

    /// Diagnoses `count` campaigns of every cause and of the base model, drawn from the priors with another seed than the
    /// training's.
    pub fn self_test(
        &self,
        world: &World<'_>,
        design: &Design,
        reference: &Reference,
        limits: &Limits,
        count: u64,
        seed: u64,
    ) -> SelfTest {
        let row = |cause: Option<usize>| {
            let (mut found, mut named, mut misnamed, mut covered) = (0, 0, 0, 0);
            let mut sizes = Vec::new();
            for k in 0..count {
                let streams = Streams::new(seed, k);
                let truth = world.drawn(cause, &streams);
                let shown: Campaign = world.campaign(design, &truth, &streams);
                let wrong = reference.judge(design, &shown);
                if wrong.p_value >= limits.found {
                    continue;
                }
                found += 1;
                let set = self.of(&wrong).set;
                sizes.push(set.len() as f64);
                covered += u64::from(cause.is_some_and(|cause| set.contains(&cause)));
                match self.named(&wrong, limits) {
                    Some(name) if Some(name) == cause => named += 1,
                    Some(_) => misnamed += 1,
                    None => {}
                }
            }
            let set_size = stats::mean(&sizes).unwrap_or(0.0);
            SelfTestRow { cause, campaigns: count, found, named, misnamed, covered, set_size }
        };
        SelfTest { rows: self.causes.iter().map(|cause| row(*cause)).collect() }
    }
}
