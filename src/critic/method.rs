//! The method: what a measured campaign says of the base model, from simulated campaigns to advice.

use crate::critic::advise::{Offered, SelfTest, offers};
use crate::critic::causes::evidence;
use crate::critic::check::Relation;
use crate::critic::discrepancy::{Baseline, Residuals};
use crate::critic::extend::{Extension, extension};
use crate::critic::gain::{self, Between, Folds, Gain, Measuring};
use crate::critic::simulate::{Campaign, Design, World};
use crate::critic::verdict::{Diagnosis, Effort, Judge, Limits, Verdict};

/// Seeds that a step may use from its own on: each draws numbers of its own.
pub const SEEDS: u64 = 1000;

/// A step of the method that takes long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Campaigns are simulated, and the ranking learns from them.
    Simulate,
    /// Readings are set beside the base model.
    Compare,
    /// The causes are ranked and checked.
    RankAndCheck,
    /// The gain on readings held out is measured.
    Predict,
    /// The next measurement is sought.
    Advise,
}

/// Who is told of the steps.
pub trait Steps {
    /// Does the work of a step, and gives what comes of it.
    fn during<T>(&self, step: Step, work: impl FnOnce() -> T) -> T;
}

/// What is to be diagnosed.
#[derive(Clone, Copy, Debug)]
pub struct Task<'w> {
    /// What campaigns are simulated from.
    pub world: &'w World<'w>,
    /// What was read.
    pub design: &'w Design,
    /// What was seen.
    pub measured: &'w Campaign,
    /// First seed of all random numbers.
    pub seed: u64,
    /// Whether the gain is measured, where something is found.
    pub with_gain: bool,
}

/// All that a campaign says.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The verdict, with what it rests on.
    pub diagnosis: Diagnosis,
    /// How far readings and their means lie from the base model.
    pub residuals: Residuals,
    /// How often such a diagnosis is right.
    pub self_test: SelfTest,
    /// The base model extended by each cause of the verdict, or by its pair.
    pub extensions: Vec<Extension>,
    /// How much better the extended model predicts; `None` where that was not measured.
    pub gain: Option<Gain>,
    /// What the best explanation gains where one family is predicted from another; empty where the gain was not measured.
    pub between: Vec<Between>,
    /// How angles and displacements of a specimen go with each other; `None` where too few specimens have both.
    pub relation: Option<Relation>,
    /// Measurements that would separate the causes that are possible, the most information per hour first.
    pub offered: Vec<Offered>,
    /// Whether these causes are those that nothing speaks against, see [`Diagnosis::possible`].
    pub are_left: bool,
}

/// Diagnoses a measured campaign. The self-test depends on the judge alone, and may have been kept. `None` where the readings say
/// nothing: at their tilts or drifts all simulated walls have fallen.
pub fn diagnose<'w>(
    task: &Task<'w>,
    steps: &impl Steps,
    self_test: impl FnOnce(&Judge<'w>) -> SelfTest,
) -> Option<Analysis> {
    let &Task { world, design, measured, seed, with_gain } = task;
    let (part, limits) = (|number: u64| seed.wrapping_add(number * SEEDS), Limits::default());
    let judge = steps.during(Step::Simulate, || Judge::trained(world, design, Effort::default(), seed))?;
    let diagnosis = steps.during(Step::RankAndCheck, || {
        let finding = judge.compare(measured);
        let examination = judge.rank(finding, measured, &limits, part(1));
        judge.check(examination, measured, &limits, part(1))
    });
    let relation = related(&judge, &diagnosis, measured, [part(8), part(9)]);
    let self_test = self_test(&judge);
    let residuals = steps.during(Step::Compare, || Baseline::new(world, design, part(6)).residuals(measured));
    let extensions = extend(world, &diagnosis);
    let (possible, are_left) = diagnosis.possible();
    let offered = steps.during(Step::Advise, || offers(&judge, &possible, part(4)));
    let gain = (with_gain && diagnosis.verdict != Verdict::NothingFound).then(|| {
        let folds = Folds::new(&judge, Measuring::default(), part(3));
        steps.during(Step::Predict, || folds.gain(measured))
    });
    let between =
        gain.as_ref().and_then(|_| diagnosis.best()).and_then(|(_, draws)| Some(draws.first()?.causes));
    let between = between.map_or_else(Vec::new, |causes| {
        steps.during(Step::Predict, || gain::between(&judge, measured, causes, part(10)))
    });
    let gain = gain.flatten();
    Some(Analysis { diagnosis, residuals, self_test, extensions, gain, between, relation, offered, are_left })
}

/// How angles and displacements go with each other beside what the best explanation predicts, or the base model where there is none.
fn related(
    judge: &Judge<'_>,
    diagnosis: &Diagnosis,
    measured: &Campaign,
    [fitted, predicted]: [u64; 2],
) -> Option<Relation> {
    let draws = match diagnosis.best() {
        Some((_, draws)) => draws.to_vec(),
        None => evidence(judge.world, &judge.design, measured, None, fitted).draws,
    };
    judge.posterior_check().relation(&draws, measured, predicted)
}

/// The base model extended by the causes of a verdict.
fn extend(world: &World<'_>, diagnosis: &Diagnosis) -> Vec<Extension> {
    diagnosis.explained_by().iter().filter_map(|(_, draws)| extension(world, draws)).collect()
}
