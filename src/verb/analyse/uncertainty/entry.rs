//! The answer as it is written.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::ensemble::{Observed, Unsure, predicted};
use crate::render::number::range;

/// Probability of the interval.
const LEVEL: f64 = 0.9;

/// A parameter as it was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// What is known of it.
    pub unsure: Unsure,
    /// The same as it was spelled.
    pub stated: String,
    /// Its unit.
    pub unit: &'static str,
    /// What it is, in words: friction.
    pub word: &'static str,
}

/// What came of the wall at some values.
#[derive(Clone, Debug, PartialEq)]
pub struct Ended {
    /// Name of the outcome.
    pub outcome: &'static str,
    /// The load at collapse, as far as it is known; 0 of a wall that does not stand at rest.
    pub observed: Observed,
}

/// The load that answers are given in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answered {
    /// Its name in the files.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Answers that differ by less are the same to the solvers.
    pub resolution: f64,
}

/// How sure an answer is. What is not known is null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UncertaintySummary {
    /// By their names.
    pub parameters: BTreeMap<&'static str, ParameterEntry>,
    /// What the design came to.
    pub answer: AnswerEntry,
    /// What each parameter does alone, with the others at their middle.
    pub influence: Vec<InfluenceEntry>,
    /// How the points cover the ranges.
    pub design: &'static str,
    /// Seed of the design.
    pub seed: u64,
    /// Every evaluation.
    #[serde(skip)]
    pub points: Vec<(Vec<f64>, Ended)>,
    /// The parameters in the order of the values of a point.
    #[serde(skip)]
    pub asked: Vec<Asked>,
    /// What the answers are.
    #[serde(skip)]
    pub answered: Answered,
}

/// What is known of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterEntry {
    /// As it was asked for.
    pub stated: String,
    /// Whether a range is even in the logarithm.
    pub logarithmic: bool,
    /// Unit of the values.
    pub unit: &'static str,
    /// Median.
    pub middle: f64,
    /// The bounds of a range; the 5 and 95 % points of a distribution.
    pub ends: [f64; 2],
}

/// The answers of all points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AnswerEntry {
    /// What the numbers are.
    pub quantity: &'static str,
    /// Their unit.
    pub unit: &'static str,
    /// With all parameters at their middle.
    pub middle: Option<f64>,
    /// One more wall lies between these with the probability `level`.
    pub interval: [Option<f64>; 2],
    /// That probability.
    pub level: f64,
    /// The least of the walls that fall.
    pub min: Option<f64>,
    /// The most; null where a wall stood to the end.
    pub max: Option<f64>,
    /// Walls of the design.
    pub walls: usize,
    /// Walls that stood to the end of the load.
    pub stood: usize,
    /// Walls whose load is not known, by how they ended.
    pub failed: BTreeMap<&'static str, usize>,
    /// All of them by how they ended.
    pub outcomes: BTreeMap<&'static str, usize>,
}

/// What a parameter does alone.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InfluenceEntry {
    /// Its name.
    pub parameter: &'static str,
    /// Its values at the low end, the middle and the high end.
    pub at: [f64; 3],
    /// The answers there.
    pub answers: [Option<f64>; 3],
    /// How the wall ended there.
    pub outcomes: [&'static str; 3],
    /// The answer at the high end less that at the low one.
    pub change: Option<f64>,
    /// Whether the answers differ by more than the solver tells apart.
    pub matters: bool,
    /// Why it does not, where the mechanism shows it.
    pub why: Option<String>,
}

impl UncertaintySummary {
    /// From the parameters, what came of the wall at their middle, at the ends of each with the others at their middle, and at the
    /// points of the design. `why` says for each parameter what would explain that it does not matter.
    pub fn of(
        (asked, answered, seed): (Vec<Asked>, Answered, u64),
        middle: &Ended,
        ends: &[[Ended; 2]],
        points: Vec<(Vec<f64>, Ended)>,
        why: Vec<Option<String>>,
    ) -> UncertaintySummary {
        let answer = answer(answered, middle, &points);
        // Of a single parameter the design shows also what it does between its ends.
        let alone = (asked.len() == 1).then(|| points.iter().map(|(_, ended)| ended).collect::<Vec<_>>());
        let influence = asked.iter().zip(ends).zip(why).map(|((own, [low, high]), why)| {
            let three = [low, middle, high];
            let looked_at = three.into_iter().chain(alone.iter().flatten().copied());
            let matters = !are_the_same(looked_at, answered.resolution);
            let [bottom, top] = own.unsure.spread.ends();
            InfluenceEntry {
                parameter: own.unsure.name,
                at: [bottom, own.unsure.spread.middle(), top],
                answers: three.map(Ended::value),
                outcomes: three.map(|ended| ended.outcome),
                change: high.value().zip(low.value()).map(|(high, low)| high - low),
                matters,
                why: why.filter(|_| !matters),
            }
        });
        let influence = influence.collect();
        let entry = |own: &Asked| ParameterEntry {
            stated: own.stated.clone(),
            logarithmic: own.unsure.spread.is_log(),
            unit: own.unit,
            middle: own.unsure.spread.middle(),
            ends: own.unsure.spread.ends(),
        };
        let parameters = asked.iter().map(|own| (own.unsure.name, entry(own))).collect();
        UncertaintySummary { parameters, answer, influence, design: "sobol", seed, points, asked, answered }
    }
}

impl Ended {
    /// The load at collapse.
    pub fn value(&self) -> Option<f64> {
        match self.observed {
            Observed::Value(value) => Some(value),
            _ => None,
        }
    }
}

fn answer(answered: Answered, middle: &Ended, points: &[(Vec<f64>, Ended)]) -> AnswerEntry {
    let observed: Vec<Observed> = points.iter().map(|(_, ended)| ended.observed).collect();
    let least_and_most = range(points.iter().filter_map(|(_, ended)| ended.value()));
    let stood = observed.iter().filter(|own| matches!(own, Observed::Above(_))).count();
    let mut all = BTreeMap::new();
    let mut failed = BTreeMap::new();
    for (_, ended) in points {
        *all.entry(ended.outcome).or_insert(0) += 1;
        if ended.observed == Observed::Nothing {
            *failed.entry(ended.outcome).or_insert(0) += 1;
        }
    }
    AnswerEntry {
        quantity: answered.name,
        unit: answered.unit,
        middle: middle.value(),
        interval: predicted(&observed),
        level: LEVEL,
        min: least_and_most.map(|[least, _]| least),
        max: least_and_most.map(|[_, most]| most).filter(|_| stood == 0),
        walls: points.len(),
        stood,
        failed,
        outcomes: all,
    }
}

/// Whether all walls fall at the same load, or all of them stand. Nothing is like a load that is not known.
fn are_the_same<'e>(all: impl Iterator<Item = &'e Ended>, resolution: f64) -> bool {
    let all: Vec<&Ended> = all.collect();
    if all.iter().all(|ended| matches!(ended.observed, Observed::Above(_))) {
        return true;
    }
    let values: Option<Vec<f64>> = all.iter().map(|ended| ended.value()).collect();
    values.and_then(range).is_some_and(|[least, most]| most - least < resolution)
}
