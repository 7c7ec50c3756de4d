//! What a study's own walls say of which method pays. They enter no answer that another method gives.

use nalgebra::{DMatrix, DVector};

use crate::ensemble::rare::{Draw, RareWalls};
use crate::ensemble::{Observed, Quantity, Row};
use crate::random::standard_normal;
use crate::solve::Solver;
use crate::stats::subset::Rare;
use crate::stats::{correlation, mean, sigma, strata};
use crate::study::{Study, WallParameter, parameters};

/// Most walls that are compared with limit analysis.
const MOST: usize = 50;
/// Fewer values tell neither a correlation nor a share.
const FEWEST: usize = 20;
/// So many walls on the worse side tell the probability better than a normal distribution of all values.
const TELLING: usize = 10;
/// The reliability index is looked for between these.
const INDEX: [f64; 2] = [0.0, 6.0];
/// What limit analysis leaves open is taken to be this share of the level at least.
const LEAST: f64 = 0.0025;
/// From this correlation on, limit analysis says anything at all.
const SAYS: f64 = 0.3;
/// Costs of a limit analysis over those of a solution, of the wall of 72 stones (benches/history).
const COST_IMPLICIT: f64 = 0.2;
const COST_EXPLICIT: f64 = 0.001;

/// What the walls of a group say.
pub struct Pilot {
    /// How many standard normals the level lies below the mean value, about.
    pub index: f64,
    /// What limit analysis says of values.
    pub limit: Option<Sorted>,
    /// What parameters that are drawn once per wall say of them.
    pub parameters: Option<Leaning>,
}

/// Values by limit analysis of the same walls.
#[derive(Clone, Copy)]
pub struct Sorted {
    /// How many were compared.
    pub walls: usize,
    /// Correlation of the two.
    pub rho: f64,
    /// A value is expected to be the first plus the second times its limit.
    line: [f64; 2],
    /// Standard deviation of values about that.
    left: f64,
    /// Costs of a limit analysis over those of a solution.
    pub cost: f64,
    level: f64,
}

/// Values by the standard normals of parameters.
pub struct Leaning {
    /// The parameters.
    pub parameters: Vec<&'static WallParameter>,
    /// Share of the variance of values that they explain.
    pub explained: f64,
    /// The direction of length 1 in which they lower values.
    pub direction: Vec<f64>,
}

impl Sorted {
    /// How many standard deviations the value that is expected of a wall lies above the level.
    pub fn above(&self, limit: f64) -> f64 {
        (self.line[0] + self.line[1] * limit - self.level) / self.left
    }

    /// Walls with a larger limit are expected beyond the level by four standard deviations and more.
    pub fn bound(&self) -> f64 {
        (self.level + strata::FAR * self.left - self.line[0]) / self.line[1]
    }
}

/// The study with limit analysis for a solver; `None` where it is that already, or limit analysis does not go with it.
pub fn limit_study(study: &Study) -> Option<Study> {
    let is_other = !matches!(study.solver, Solver::Limit(_));
    is_other.then(|| study.clone().with_solver("limit").ok()).flatten()
}

/// What the rows of an arm's own walls say of a level of signed values.
pub fn pilot(walls: &RareWalls<'_>, screen: Option<&RareWalls<'_>>, rows: &[Row], level: f64) -> Pilot {
    let quantity = Quantity::of(walls.study);
    let own: Vec<&Row> =
        rows.iter().filter(|row| (row.arm_index, row.point) == (walls.arm, walls.point)).collect();
    let (draws, values): (Vec<Draw>, Vec<f64>) = own
        .iter()
        .filter_map(|row| match quantity.observed(row) {
            Observed::Value(value) => Some((Draw::of(row.member), walls.signed(value))),
            _ => None,
        })
        .unzip();
    let is_explicit = matches!(walls.study.solver, Solver::Explicit(_));
    let cost = if is_explicit { COST_EXPLICIT } else { COST_IMPLICIT };
    Pilot {
        index: index(&values, own.len(), level),
        limit: screen.and_then(|screen| sorted(screen, &draws, &values, level, cost)),
        parameters: leaning(walls, &draws, &values),
    }
}

/// By those on the worse side where they are many, else by a normal distribution of the values.
fn index(values: &[f64], all: usize, level: f64) -> f64 {
    let worse = values.iter().filter(|value| **value <= level).count();
    let by_share = || -standard_normal::quantile(worse as f64 / all as f64);
    let by_normal = || {
        let (centre, spread) = mean(values).zip(sigma(values).filter(|spread| *spread > 0.0))?;
        Some((centre - level) / spread)
    };
    let index = if worse >= TELLING && worse < all { Some(by_share()) } else { by_normal() };
    index.unwrap_or(INDEX[1]).clamp(INDEX[0], INDEX[1])
}

/// `None` where too few walls have both values, where these have nothing to do with each other, and where a high value is the rare one,
/// of which limit analysis knows nothing.
fn sorted(screen: &RareWalls<'_>, draws: &[Draw], values: &[f64], level: f64, cost: f64) -> Option<Sorted> {
    if screen.is_high {
        return None;
    }
    let draws = &draws[..draws.len().min(MOST)];
    let fell = |limit: &f64| *limit < f64::MAX;
    let (limits, values): (Vec<f64>, Vec<f64>) = screen
        .values(draws)
        .into_iter()
        .zip(values)
        .filter_map(|(limit, value)| Some((limit.filter(fell)?, *value)))
        .unzip();
    if values.len() < FEWEST {
        return None;
    }
    let rho = correlation(&limits, &values).filter(|rho| *rho >= SAYS)?;
    let slope = rho * sigma(&values)? / sigma(&limits)?;
    let line = [mean(&values)? - slope * mean(&limits)?, slope];
    let left = (sigma(&values)? * (1.0 - rho * rho).sqrt()).max(LEAST * level.abs());
    Some(Sorted { walls: values.len(), rho, line, left, cost, level })
}

/// Least squares of values over the standard normals of parameters; `None` where there are none, too few walls, or no influence.
fn leaning(walls: &RareWalls<'_>, draws: &[Draw], values: &[f64]) -> Option<Leaning> {
    let arm = walls.arm as usize;
    let parameters = parameters(&walls.study.arms[arm..=arm]);
    let (n, k) = (values.len(), parameters.len());
    if k == 0 || n < FEWEST.max(5 * k) {
        return None;
    }
    let rows: Vec<Vec<f64>> = draws.iter().map(|draw| draw.normals(walls.study, &parameters)).collect();
    let normals = DMatrix::from_fn(n, k + 1, |at, of| if of == 0 { 1.0 } else { rows[at][of - 1] });
    let values = DVector::from_column_slice(values);
    let fitted = normals.clone().svd(true, true).solve(&values, 1e-9).ok()?;
    let left = (&values - normals * &fitted).norm_squared() / (n - k - 1) as f64;
    let all = values.map(|value| value - values.mean()).norm_squared() / (n - 1) as f64;
    let slope = fitted.rows(1, k).norm();
    (slope > 0.0 && all > 0.0).then(|| Leaning {
        parameters,
        explained: (1.0 - left / all).max(0.0),
        direction: fitted.rows(1, k).iter().map(|own| -own / slope).collect(),
    })
}
