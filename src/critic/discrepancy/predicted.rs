//! What a model predicts of readings that it has not seen, and how good that is: the logarithm of the probability it gave, the
//! continuous ranked probability score, and the square of its error (Gneiting and Raftery 2007).

use crate::critic::compare::log_likelihood;
use crate::critic::simulate::{Design, MayShow, Queries, Seen, Specimen, Truth, World};
use crate::math::{exp, ln};
use crate::random::Streams;
use crate::random::standard_normal::{cdf, density, quantile};
use crate::stats;
use crate::study::{MeasuredKind, Measurement};

/// Walls that are drawn for each truth.
const WALLS: usize = 8;
/// Width of the kernels that make a density of draws, in their standard deviation (Silverman's rule for some hundred
/// independent draws).
const KERNEL: f64 = 0.3;

/// What is less likely than this counts as this: logarithms of numbers too small to be told from nothing.
const LEAST_LOG: f64 = -600.0;

/// How good a prediction of a reading was.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Score {
    /// Logarithm of the probability (or its density) that the reading was given.
    pub log: f64,
    /// Continuous ranked probability score, in standard deviations of the base model's readings; `None` of a bound.
    pub crps: Option<f64>,
    /// Square of the mean's error in these; `None` of a bound.
    pub square: Option<f64>,
}

/// Walls that a model expects, drawn.
pub struct Predicted {
    /// By draw, specimen and reading, before errors.
    pub walls: Vec<Vec<Vec<f64>>>,
}

impl Predicted {
    /// From draws of the truth; walls of different specimens are independent of each other, given the truth.
    pub fn of(world: &World<'_>, design: &Design, draws: &[Truth], seed: u64) -> Predicted {
        let one = |(index, truth): (usize, &Truth)| -> Vec<Vec<Vec<f64>>> {
            let mut stones = Streams::new(seed, index as u64).of("predicted stones");
            let families: Vec<(usize, MayShow)> = design
                .families()
                .into_iter()
                .map(|family| {
                    let own = design.specimens.iter().filter(|specimen| specimen.family == family);
                    let readings: Vec<&Measurement> = own.flat_map(|specimen| &specimen.readings).collect();
                    let queries = Queries::by(&readings, world.sought());
                    let mut shown = world.may_show(family, &queries, truth, 1);
                    let all = |path: &mut Vec<f64>| {
                        *path = queries.by_reading.iter().map(|&at| path[at]).collect();
                    };
                    shown.paths.iter_mut().chain([&mut shown.by_stiffness]).for_each(all);
                    (family, shown)
                })
                .collect();
            (0..WALLS)
                .map(|_| {
                    let mut first: Vec<usize> = vec![0; families.len()];
                    let shared: Vec<usize> =
                        families.iter().map(|(_, shown)| stones.below(shown.paths.len())).collect();
                    let of = |specimen: &Specimen| {
                        let at = families.iter().position(|(family, ..)| *family == specimen.family);
                        let at = at.unwrap_or_default();
                        let MayShow { paths, random, by_stiffness } = &families[at].1;
                        let path = if *random { stones.below(paths.len()) } else { shared[at] };
                        let stiffness = quantile(stones.uniform());
                        let from = first[at];
                        first[at] += specimen.readings.len();
                        let read = from..first[at];
                        let shown = paths[path][read.clone()].iter().zip(&by_stiffness[read]);
                        shown.map(|(path, by)| path + stiffness * by).collect()
                    };
                    design.specimens.iter().map(of).collect()
                })
                .collect()
        };
        Predicted { walls: draws.iter().enumerate().flat_map(one).collect() }
    }

    /// What the draws say of a reading.
    pub fn reading(&self, specimen: usize, reading: usize) -> Vec<f64> {
        self.walls.iter().map(|wall| wall[specimen][reading]).collect()
    }

    /// How good they are for what was seen; `None` where nothing was. `unit` is the base model's standard deviation.
    pub fn score(
        &self,
        (specimen, reading): (usize, usize),
        m: &Measurement,
        seen: Seen,
        unit: f64,
    ) -> Option<Score> {
        let m = observed(m, seen)?;
        let walls = self.reading(specimen, reading);
        let sigma = stats::sigma(&walls)?;
        let error = m.error * m.error + m.common_error * m.common_error;
        let sd = (error + KERNEL * KERNEL * sigma * sigma).sqrt().max(1e-9 * unit);
        let logs: Vec<f64> = walls.iter().map(|wall| log_likelihood(&m, *wall, sd).max(LEAST_LOG)).collect();
        let largest = logs.iter().copied().fold(f64::MIN, f64::max);
        let sum = stats::sum(&logs.iter().map(|log| exp(log - largest)).collect::<Vec<_>>());
        let log = largest + ln(sum / walls.len() as f64);
        if m.kind.is_censored() {
            return Some(Score { log, crps: None, square: None });
        }
        let mut errors = Streams::new(0, 0).of("predicted errors");
        let mut read: Vec<f64> =
            walls.iter().map(|wall| wall + error.sqrt() * quantile(errors.uniform())).collect();
        read.sort_by(f64::total_cmp);
        let off = (stats::mean(&walls)? - m.value) / unit;
        Some(Score { log, crps: Some(crps(&read, m.value) / unit), square: Some(off * off) })
    }
}

/// The score of a normal prediction.
pub fn normal_score(m: &Measurement, seen: Seen, mean: f64, sd: f64, unit: f64) -> Option<Score> {
    let m = observed(m, seen)?;
    let log = log_likelihood(&m, mean, sd).max(LEAST_LOG);
    if m.kind.is_censored() {
        return Some(Score { log, crps: None, square: None });
    }
    let z = (m.value - mean) / sd;
    // Gneiting, Raftery, Westveld and Goldman 2005, equation 5.
    let crps = sd * (z * (2.0 * cdf(z) - 1.0) + 2.0 * density(z) - 1.0 / std::f64::consts::PI.sqrt());
    Some(Score {
        log,
        crps: Some(crps / unit),
        square: Some((mean - m.value) * (mean - m.value) / (unit * unit)),
    })
}

/// The measurement as if this had been seen.
fn observed(m: &Measurement, seen: Seen) -> Option<Measurement> {
    let kind = if m.kind.is_censored() { MeasuredKind::Exact } else { m.kind };
    match seen {
        Seen::Value(value) => Some(Measurement { value, kind, ..m.clone() }),
        Seen::Beyond => Some(m.clone()),
        Seen::Fell => Some(Measurement { kind: MeasuredKind::Below, ..m.clone() }),
        Seen::Stood => Some(Measurement { kind: MeasuredKind::Above, ..m.clone() }),
        Seen::Nothing => None,
    }
}

/// Of draws in ascending order.
fn crps(draws: &[f64], value: f64) -> f64 {
    let n = draws.len() as f64;
    let off: Vec<f64> = draws.iter().map(|x| (x - value).abs()).collect();
    // Mean distance of two draws, from their order.
    let apart: Vec<f64> = draws.iter().enumerate().map(|(k, x)| (2.0 * k as f64 + 1.0 - n) * x).collect();
    stats::sum(&off) / n - stats::sum(&apart) / (n * n)
}
