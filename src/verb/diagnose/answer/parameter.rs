//! The parameters of a cause, as far as the data tell them, beside their physical priors.

use crate::critic::{Scored, Truth, World};
use crate::math::exp;
use crate::render::number::{bracketed, significant, with_interval};
use crate::stats;
use crate::verb::diagnose::answer::scope::{acted_on, enumerated};

/// Quantiles of a parameter.
const INTERVAL: [f64; 2] = [0.05, 0.95];
/// Draws that count with the physical prior must be worth so many at least, or nothing is said of it.
const LEAST_DRAWS: f64 = 8.0;

/// What keys with a unit end in.
const UNITS: [&str; 7] = ["_n_m_per_rad", "_pa_per_m", "_n_per_m", "_per_deg", "_pa", "_deg", "_m"];

/// A parameter of a cause.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ParameterEntry {
    /// Its key.
    pub key: &'static str,
    /// The families that it holds for; null where it holds for all.
    pub arms: Option<Vec<String>>,
    /// Its unit.
    pub unit: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// Median, with the search prior.
    pub median: f64,
    /// 5 and 95 % quantile, with the search prior.
    pub interval: [f64; 2],
    /// 5 and 95 % quantile of its physical prior.
    pub prior_interval: [f64; 2],
    /// How many standard deviations of the physical prior the median lies from its centre; null for a constant.
    pub prior_sd: Option<f64>,
    /// What the physical prior makes of it; null where that leaves hardly any of the draws.
    pub within_prior: Option<WithinPrior>,
}

/// A parameter with its physical prior.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct WithinPrior {
    /// Median.
    pub median: f64,
    /// 5 and 95 % quantile.
    pub interval: [f64; 2],
}

impl ParameterEntry {
    /// In words: key, median, interval and unit, and the families that it holds for.
    pub(crate) fn words(&self) -> String {
        let ParameterEntry { unit, median, interval, .. } = self;
        format!("{} {}", self.place(), amount(*median, *interval, unit))
    }

    /// Its name, and the families that it holds for.
    pub(crate) fn place(&self) -> String {
        let arms = self.arms.as_ref().map_or_else(String::new, |arms| format!(" ({})", enumerated(arms)));
        format!("{}{arms}", name(self.key))
    }

    /// Where it lies in its physical prior, and what that makes of it; `None` for a constant.
    pub(crate) fn beside_prior(&self) -> Option<String> {
        let ParameterEntry { unit, prior_interval, prior_sd, within_prior, .. } = self;
        let sd = (*prior_sd)?;
        let side = if sd < 0.0 { "below" } else { "above" };
        let within = within_prior.map_or_else(
            || "with that prior hardly any of the posterior is left".to_owned(),
            |own| format!("with that prior {}", amount(own.median, own.interval, unit)),
        );
        Some(format!(
            "{}: {} sd {side} the centre of its prior {}; {within}.",
            self.place(),
            significant(sd.abs(), 2),
            bracketed(prior_interval.map(|end| as_read(unit).0 * end), 3)
        ))
    }
}

/// A median with its interval and unit.
pub(crate) fn amount(median: f64, interval: [f64; 2], unit: &'static str) -> String {
    let (times, unit) = as_read(unit);
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    format!("{}{unit}", with_interval(Some(times * median), Some(interval.map(|end| times * end)), 3))
}

/// A key without the unit at its end, which the number has: in another unit it would contradict it.
fn name(key: &str) -> String {
    let bare = UNITS.iter().find_map(|unit| key.strip_suffix(unit)).unwrap_or(key);
    bare.replace('_', " ")
}

/// The unit in which people read a quantity, and how many of it make one of the key's: what lengths of a cause do is a matter of millimetres.
pub(crate) fn as_read(unit: &'static str) -> (f64, &'static str) {
    match unit {
        "m" => (1000.0, "mm"),
        "1" => (1.0, ""),
        unit => (1.0, unit),
    }
}

/// What draws from a posterior say of a cause's parameters; nothing without a draw.
pub fn parameters(world: &World<'_>, cause: usize, draws: &[Truth]) -> Vec<ParameterEntry> {
    let Some(first) = draws.first() else { return Vec::new() };
    let weights = physical_weights(world, draws);
    let entry = |(place, Scored { parameter, kind, .. }): (usize, Scored<'_>)| {
        let values: Vec<f64> =
            draws.iter().map(|truth| parameter.search.at_score(truth.parameters[place])).collect();
        let at = |p: f64| stats::quantile(&values, p);
        let median = at(0.5)?;
        let weighed = weights.as_ref().map(|weights| {
            let at = |p: f64| weighted_quantile(&values, weights, p);
            WithinPrior { median: at(0.5), interval: INTERVAL.map(at) }
        });
        Some(ParameterEntry {
            key: parameter.key,
            arms: kind.map(|kind| acted_on(world, &[kind])[0].clone()),
            unit: parameter.unit,
            meaning: parameter.meaning,
            median,
            interval: [at(INTERVAL[0])?, at(INTERVAL[1])?],
            prior_interval: INTERVAL.map(|p| parameter.prior.quantile(p)),
            prior_sd: parameter.spreads_out(median),
            within_prior: weighed,
        })
    };
    let scored = world.scored(first.causes).enumerate().filter(|(_, own)| own.cause == cause);
    scored.filter_map(entry).collect()
}

/// Weights of draws from the posterior of the search prior, of sum 1, under the physical prior; `None` where they leave too few.
fn physical_weights(world: &World<'_>, draws: &[Truth]) -> Option<Vec<f64>> {
    let logs: Vec<f64> = draws.iter().map(|truth| world.log_weight(truth)).collect();
    let largest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if !largest.is_finite() {
        return None;
    }
    let raw: Vec<f64> = logs.iter().map(|log| exp(log - largest)).collect();
    let sum = stats::sum(&raw);
    let weights: Vec<f64> = raw.iter().map(|w| w / sum).collect();
    let squares: Vec<f64> = weights.iter().map(|w| w * w).collect();
    (1.0 / stats::sum(&squares) >= LEAST_DRAWS).then_some(weights)
}

/// The smallest value up to which the weights reach a share.
fn weighted_quantile(values: &[f64], weights: &[f64], share: f64) -> f64 {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut reached = 0.0;
    for &k in &order {
        reached += weights[k];
        if reached >= share {
            return values[k];
        }
    }
    order.last().map_or(f64::NAN, |&k| values[k])
}
