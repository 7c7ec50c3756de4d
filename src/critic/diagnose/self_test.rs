//! How often diagnoses of a design find and name what is hidden, by simulation from the bank.

use crate::critic::diagnose::design::Design;
use crate::critic::diagnose::ranking::Ranking;
use crate::critic::diagnose::verdict::Limits;
use crate::critic::diagnose::world::World;
use crate::critic::diagnose::wrong::Reference;
use crate::random::Streams;
use crate::stats;

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

impl Ranking {
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
                let wrong = reference.judge(design, &world.campaign(design, &truth, &streams));
                if wrong.p_value >= limits.found {
                    continue;
                }
                found += 1;
                let ranked = self.of(&wrong);
                sizes.push(ranked.set.len() as f64);
                covered += u64::from(cause.is_some_and(|cause| ranked.set.contains(&cause)));
                match ranked.named(limits.named) {
                    Some(name) if Some(name) == cause => named += 1,
                    Some(_) => misnamed += 1,
                    None => {}
                }
            }
            let set_size = stats::mean(&sizes).unwrap_or(0.0);
            SelfTestRow { cause, campaigns: count, found, named, misnamed, covered, set_size }
        };
        SelfTest { rows: self.causes().iter().map(|cause| row(*cause)).collect() }
    }
}
