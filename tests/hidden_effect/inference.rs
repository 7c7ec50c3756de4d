//! What the inference knows, and what it says of a campaign: a study, the catalogue with its priors, a bank, and the data.

use std::path::Path;

use pirca::critic::{
    self, Bank, Campaign, Design, Effort, Limits, Plan, PriorPredictive, Seen, Verdict, World,
};
use pirca::study::{Described, Measurement, Nuisance, Study, described, nuisances};
use serde::{Deserialize, Serialize};

/// Seeds of what is learnt, of the verdicts, and of what priors predict.
const SEEDS: [u64; 3] = [11, 13, 17];

/// What the inference knows.
pub struct Known {
    pub study: Study,
    pub mechanisms: Vec<Described>,
    pub nuisances: [Nuisance; 3],
    pub plan: Plan,
    pub bank: Bank,
}

impl Known {
    /// A study with the priors of the repository, and a bank of its plan.
    pub fn new(study: Study, points: u64, bank: impl FnOnce(&Plan) -> Bank) -> Known {
        let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let mechanisms = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        let nuisances = nuisances(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        let plan =
            Plan::new(&study, &mechanisms, &nuisances, points).unwrap_or_else(|faults| panic!("{faults}"));
        Known { bank: bank(&plan), study, mechanisms, nuisances, plan }
    }

    /// The same with a catalogue that lacks a mechanism.
    pub fn without(&self, mechanism: usize) -> Known {
        let (mut plan, mut bank, mut mechanisms) =
            (self.plan.clone(), self.bank.clone(), self.mechanisms.clone());
        let kept: Vec<usize> =
            (0..plan.places.len()).filter(|&wall| plan.places[wall].cause != Some(mechanism)).collect();
        plan.study.arms = kept.iter().map(|&wall| self.plan.study.arms[wall].clone()).collect();
        plan.places = kept.iter().map(|&wall| self.plan.places[wall].clone()).collect();
        let later = plan.places.iter_mut().filter_map(|place| place.cause.as_mut());
        later.filter(|cause| **cause > mechanism).for_each(|cause| *cause -= 1);
        bank.paths = kept.iter().map(|&wall| self.bank.paths[wall].clone()).collect();
        bank.endings = kept.iter().map(|&wall| self.bank.endings[wall].clone()).collect();
        mechanisms.remove(mechanism);
        Known { study: self.study.clone(), mechanisms, nuisances: self.nuisances.clone(), plan, bank }
    }
}

/// A judge of campaigns of one design.
pub struct Judge<'k> {
    pub known: &'k Known,
    pub judge: &'k critic::Judge<'k>,
}

/// What is said of a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Said {
    /// How often chance alone makes a campaign as odd.
    pub p_value: f64,
    pub verdict: Word,
    /// The causes of the verdict: one or two that are named, or a few.
    pub names: Vec<String>,
    /// The causes that the ranking cannot put aside.
    pub set: Vec<String>,
    /// Where something was found, the causes that nothing speaks against.
    pub open: Vec<String>,
    /// The most likely cause with its probability.
    pub likeliest: (String, f64),
    /// The posterior predictive check of the causes in question: the share of a cause's own campaigns that fit no better.
    #[serde(rename = "guard")]
    pub check: Vec<(String, f64)>,
    /// Share of the evidence of the causes that were examined.
    pub evidence: Vec<(String, f64)>,
    /// Share of the evidence of the best pair, where pairs were examined, and its posterior predictive check.
    pub pair: Option<([String; 2], f64, Option<f64>)>,
}

/// A verdict without its causes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Word {
    NothingFound,
    Named,
    NamedOutsidePrior,
    Ambiguous,
    Unexplained,
}

impl<'k> Judge<'k> {
    /// Of campaigns in which the rows of these measurements were planned.
    pub fn new(known: &'k Known, planned: Vec<Measurement>) -> Judge<'k> {
        Judge::trained(known, planned, Effort::default())
    }

    /// The same from other numbers of campaigns.
    pub fn trained(known: &'k Known, planned: Vec<Measurement>, effort: Effort) -> Judge<'k> {
        let world = World::new(&known.study, &known.mechanisms, &known.nuisances, &known.plan, &known.bank)
            .expect("enough walls");
        let (design, _) = Design::of(&Study { measured: planned, ..known.study.clone() });
        // Judges live as long as the test, and so does what they rest on.
        let world: &World<'k> = Box::leak(Box::new(world));
        let judge = critic::Judge::trained(world, &design, effort, SEEDS[0]).expect("it can be told");
        Judge { known, judge: Box::leak(Box::new(judge)) }
    }

    /// The place of a mechanism in the catalogue.
    pub fn index(&self, mechanism: &str) -> usize {
        let place = self.known.mechanisms.iter().position(|own| own.name == mechanism);
        place.unwrap_or_else(|| panic!("{mechanism} is in no catalogue"))
    }

    /// What the physical prior of a mechanism predicts.
    pub fn expects(&self, mechanism: usize) -> PriorPredictive {
        let own = self.judge;
        PriorPredictive::of(own.world, &own.design, &own.reference, Some(mechanism), SEEDS[2])
    }

    /// Share of what a prior predicts that is as far out as what was measured.
    pub fn conflict(&self, expected: &PriorPredictive, measured: &[Measurement]) -> f64 {
        let own = self.judge;
        expected.p_value(&own.design, &own.reference, &matched(&own.design, measured))
    }

    /// Judges what was measured. What was planned and is not there was not seen.
    pub fn said(&self, measured: &[Measurement]) -> Said {
        let campaign = matched(&self.judge.design, measured);
        let found = self.judge.diagnosed(&campaign, &Limits::default(), SEEDS[1]);
        let name = |cause: &usize| self.known.mechanisms[*cause].name.to_owned();
        let (verdict, names) = match &found.verdict {
            Verdict::NothingFound => (Word::NothingFound, Vec::new()),
            Verdict::Named(cause) => (Word::Named, vec![name(cause)]),
            Verdict::NamedOutsidePrior(cause) => (Word::NamedOutsidePrior, vec![name(cause)]),
            Verdict::NamedPair(causes) => (Word::Named, causes.iter().map(name).collect()),
            Verdict::Ambiguous(causes) => (Word::Ambiguous, causes.iter().map(name).collect()),
            Verdict::Unexplained => (Word::Unexplained, Vec::new()),
        };
        let ranked = &found.finding.ranked;
        let mut causes = ranked.causes.iter();
        let likeliest = causes.find_map(|(cause, p)| Some((name(&(*cause)?), *p))).expect("a catalogue");
        let set = ranked.set.iter().map(name).collect();
        let is_found = found.verdict != Verdict::NothingFound;
        let open = if is_found { found.left_open().iter().map(name).collect() } else { Vec::new() };
        let check = found.examined.iter().filter_map(|own| Some((name(&own.cause), own.check?))).collect();
        let evidence = found.examined.iter().map(|own| (name(&own.cause), own.evidence)).collect();
        let best = found.pairs.first();
        let pair = best.map(|own| ([0, 1].map(|k| name(&own.cause[k])), own.evidence, own.check));
        Said { p_value: found.finding.p_value, verdict, names, set, open, likeliest, check, evidence, pair }
    }
}

/// What was seen of a design. A row that was not planned stops the program.
fn matched(design: &Design, measured: &[Measurement]) -> Campaign {
    let mut left: Vec<&Measurement> = measured.iter().collect();
    let mut seen = |planned: &Measurement| {
        let same = |m: &&Measurement| {
            (&m.specimen, m.quantity, m.tilt) == (&planned.specimen, planned.quantity, planned.tilt)
        };
        match left.iter().position(same).map(|at| left.remove(at)) {
            Some(m) if m.kind.is_censored() => Seen::Beyond,
            Some(m) => Seen::Value(m.value),
            None => Seen::Nothing,
        }
    };
    let specimens = design.specimens.iter().map(|s| s.readings.iter().map(&mut seen).collect());
    let specimens = specimens.collect();
    let apart = design.apart.iter().map(|(_, planned)| seen(planned)).collect();
    assert!(left.is_empty(), "{:?} was not planned", left[0]);
    Campaign { specimens, apart }
}
