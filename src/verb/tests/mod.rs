//! Hand-made rows and populations, and the tests on them.

mod beside;
mod capacity;
mod diagnosis;
mod figure;
mod force_drift;
mod gathered;
mod measured;
mod summary;
mod verdict;

use std::collections::BTreeMap;

use crate::ensemble::{Quantity, Reading, Row, TiltingRow};
use crate::model::Outcome;
use crate::study::{Claim, ClaimTest};
use crate::verb::run::answer::by_member::ByMember;
use crate::verb::run::answer::comparison::comparisons;
use crate::verb::run::answer::population::{Population, Without};
use crate::verb::run::answer::published::judge_all;
use crate::verb::run::answer::summary::{Summary, describe};

/// The stiffnesses of the hand-made studies (Pa/m).
const KN: [f64; 3] = [7.5e7, 1e8, 1.25e8];

/// A member that stands with this displacement at its top (m).
fn standing(member: u64, displacement: f64) -> Row {
    let reading = Reading { top_displacement_m: Some(displacement), ..Reading::default() };
    Row { reading, ..failed(member, Outcome::Equilibrium) }
}

/// A member that ended like this, without a displacement.
fn failed(member: u64, outcome: Outcome) -> Row {
    Row { arm: "irregular".into(), kn_pa_per_m: KN[0], member, outcome, ..Row::default() }
}

/// A member that stood to the end at this tilt (deg).
fn stood(member: u64, tilt: f64) -> Row {
    let reading = tilted(TiltingRow { largest_tilt_deg: Some(tilt), ..TiltingRow::default() });
    Row { reading, ..failed(member, Outcome::Equilibrium) }
}

/// What is read of a wall on a tilting table.
fn tilted(tilting: TiltingRow) -> Reading {
    Reading { tilting, ..Reading::default() }
}

/// An arm at one kn whose walls all stand, with these displacements (m).
fn population(arm: &str, fixed: bool, kn: f64, values: &[f64]) -> Population {
    let rows: Vec<Row> =
        values.iter().enumerate().map(|(member, value)| standing(member as u64, *value)).collect();
    collected((arm, fixed), (kn, values.len() as u64), Quantity::TopDisplacement, &rows)
}

/// The rows of an arm at one kn, by growing member.
fn collected(arm: (&str, bool), walls: (f64, u64), quantity: Quantity, rows: &[Row]) -> Population {
    let mut population = Population::new(arm, walls, quantity, 1, &[]);
    rows.iter().for_each(|row| population.take(row));
    population
}

/// The same without the value of one member.
fn without(population: &Population, member: u64) -> Population {
    let mut rest = population.clone();
    rest.values = ByMember::default();
    let others = population.values.iter().filter(|(number, _)| *number != member);
    others.for_each(|(number, value)| rest.values.push(number, value));
    rest
}

/// An arm in which nothing is drawn: one wall per kn with these displacements (m).
pub(crate) fn fixed_arm(arm: &str, displacements: &[f64]) -> Vec<Population> {
    KN.iter().zip(displacements).map(|(kn, value)| population(arm, true, *kn, &[*value])).collect()
}

/// An arm of eight walls per kn: 10 % below and 10 % above each of these means (m) in turn. Mean exact, sigma
/// 0.1 sqrt(8/7) of it.
fn random_arm(arm: &str, means: &[f64]) -> Vec<Population> {
    let walls = |mean: f64| -> Vec<f64> {
        (0..8).map(|i| if i % 2 == 0 { 0.9 * mean } else { 1.1 * mean }).collect()
    };
    KN.iter().zip(means).map(|(kn, mean)| population(arm, false, *kn, &walls(*mean))).collect()
}

fn claim(test: ClaimTest) -> Claim {
    Claim {
        claim: "as stated".into(),
        source: "a paper, section 1".into(),
        test,
        why: "reading error of a figure".into(),
    }
}

/// A summary of populations, as `summarise` makes it of a study.
pub(crate) fn summary_of(populations: &[Population], claims: &[Claim]) -> Summary {
    Summary {
        study: "hand-made".into(),
        question: "Does the report say what the rows say?".into(),
        variant: Some("two-wythes".into()),
        solver: "implicit",
        seed: 1,
        study_hash: "00ff".into(),
        sweep: Vec::new(),
        demand: None,
        arms: populations.iter().map(|population| describe(population.clone(), 1, BTreeMap::new())).collect(),
        comparisons: comparisons(populations, claims),
        published: judge_all(claims, populations),
        measured: None,
        shaken: None,
    }
}

/// Three arms like those of the source paper's Figure 10, with one wall lost.
fn three_arms() -> Vec<Population> {
    let mut all = fixed_arm("continuous", &[0.21e-3, 0.16e-3, 0.13e-3]);
    all.extend(fixed_arm("discontinuous", &[0.34e-3, 0.26e-3, 0.21e-3]));
    let mut irregular = random_arm("irregular", &[0.27e-3, 0.20e-3, 0.16e-3]);
    irregular[1] = without(&irregular[1], 3);
    irregular[1].outcomes = BTreeMap::from([("equilibrium".into(), 7), ("collapsed".into(), 1)]);
    let collapsed = Without { walls: 1, first: (3, "fell at load factor 0.5".to_owned()) };
    irregular[1].without = BTreeMap::from([("collapsed".into(), collapsed)]);
    all.extend(irregular);
    all
}
