//! Whether limit analysis says enough of walls to begin with it, judged by walls that enter no answer.

use crate::ensemble::{Draw, Observed, Quantity, RareWalls, Row};
use crate::solve::Solver;
use crate::stats::subset::Rare;
use crate::stats::{correlation, mean, sigma};
use crate::study::Study;

/// Most walls that are compared.
const MOST: usize = 50;
/// Fewer do not tell a correlation.
const FEWEST: usize = 20;
/// From this correlation on, limit analysis sorts walls well enough to begin with it.
const PAYS: f64 = 0.7;
/// The bound on limit analysis lies so many standard deviations above what walls of the level have in the mean, and at least this share.
const SPREADS: f64 = 4.0;
const LEAST: f64 = 0.01;

/// Walls by limit analysis beside the study's own solver.
#[derive(Clone, Copy)]
pub(super) struct Pilot {
    /// How many were compared.
    pub walls: usize,
    /// Correlation of the two values.
    pub rho: f64,
    /// Whether it is high enough to begin with limit analysis.
    pub pays: bool,
    /// What limit analysis finds at most of walls at the level: the level times the ratio of the two values, its mean and four
    /// standard deviations, or a hundredth if that is more.
    pub bound: f64,
}

/// The study with limit analysis for a solver; `None` where it is that already, or limit analysis does not go with it.
pub(super) fn limit_study(study: &Study) -> Option<Study> {
    let is_other = !matches!(study.solver, Solver::Limit(_));
    is_other.then(|| study.clone().with_solver("limit").ok()).flatten()
}

/// Compares the rows of the study's own walls with limit analysis of these walls; `None` where too few have both values, and where a
/// high value is the rare one, of which limit analysis knows nothing.
pub(super) fn pilot(screen: &RareWalls<'_>, rows: &[Row], level: f64) -> Option<Pilot> {
    if screen.is_high {
        return None;
    }
    let quantity = Quantity::of(&screen.study.protocol);
    let own = rows.iter().filter(|row| (row.arm_index, row.point) == (screen.arm, screen.point));
    let (draws, values): (Vec<Draw>, Vec<f64>) = own
        .filter_map(|row| match quantity.observed(row) {
            Observed::Value(value) => Some((Draw { member: row.member, moves: Vec::new() }, value)),
            _ => None,
        })
        .take(MOST)
        .unzip();
    let found = screen.values(&draws);
    let (limit, value): (Vec<f64>, Vec<f64>) = found
        .into_iter()
        .zip(values)
        .filter_map(|(limit, value)| Some((limit.filter(|limit| *limit < f64::MAX)?, value)))
        .unzip();
    if value.len() < FEWEST {
        return None;
    }
    let rho = correlation(&limit, &value)?;
    let ratios: Vec<f64> = limit.iter().zip(&value).map(|(limit, value)| limit / value).collect();
    let bound = level * (mean(&ratios)? + (SPREADS * sigma(&ratios)?).max(LEAST));
    Some(Pilot { walls: value.len(), rho, pays: rho >= PAYS, bound })
}
