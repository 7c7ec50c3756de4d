//! Scores of readings, summed up over specimens, and the interval of what one model gains over the other.

use std::collections::{BTreeMap, BTreeSet};

use crate::critic::diagnose::predicted::Score;
use crate::stats;

/// A plain 95 % interval reaches so many standard errors: the least that any interval does.
const PLAIN: f64 = 1.96;
/// Share of the campaigns without any effect that may claim a gain.
const CLAIMED: f64 = 0.05;

/// How a held-out reading was predicted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its specimen.
    pub specimen: usize,
    /// The family of that (its arm).
    pub family: usize,
    /// By the base model.
    pub base: Score,
    /// By the extended model.
    pub extended: Score,
    /// By the base model with a free discrepancy; `None` where that was not asked.
    pub ceiling: Option<Score>,
}

/// Means over readings: bounds count in the first alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scores {
    /// Of the logarithm of the probability given to a reading; large is good.
    pub log: f64,
    /// Of the continuous ranked probability score, in standard deviations of the base model's readings; small is good.
    pub crps: f64,
    /// Root of the mean square of the errors, in the same unit.
    pub rms: f64,
}

/// A gain with its interval; above 0 is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The gain.
    pub value: f64,
    /// Lower and upper end.
    pub ends: [f64; 2],
}

/// What was gained on readings that were held out.
#[derive(Clone, Debug, PartialEq)]
pub struct Gained {
    /// Readings scored.
    pub readings: usize,
    /// Specimens that they were read on.
    pub specimens: usize,
    /// The base model.
    pub base: Scores,
    /// The extended model.
    pub extended: Scores,
    /// The base model with a free discrepancy.
    pub ceiling: Scores,
    /// Gain in the logarithm, the ranked score and the root mean square.
    pub gain: [Interval; 3],
}

/// Scores of a model over rows.
fn scores(rows: &[&Row], of: fn(&Row) -> Score) -> Scores {
    let all = || rows.iter().map(|row| of(row));
    let mean = |values: Vec<f64>| stats::mean(&values).unwrap_or(0.0);
    Scores {
        log: mean(all().map(|score| score.log).collect()),
        crps: mean(all().filter_map(|score| score.crps).collect()),
        rms: mean(all().filter_map(|score| score.square).collect()).sqrt(),
    }
}

fn gains(rows: &[&Row]) -> [f64; 3] {
    let (base, extended) = (scores(rows, |row| row.base), scores(rows, |row| row.extended));
    [extended.log - base.log, base.crps - extended.crps, base.rms - extended.rms]
}

/// The gains with their standard errors, by leaving out each specimen in turn (jackknife: readings of a specimen stand together).
/// Families are not drawn: they are what was built, in these numbers, and an effect may show in one and not in another. What is
/// left to chance is how the specimens of a family differ (stratified jackknife, Wolter 2007, section 4.5).
pub fn estimates(rows: &[Row]) -> [[f64; 2]; 3] {
    let all: Vec<&Row> = rows.iter().collect();
    let without = |out: &usize| gains(&rows.iter().filter(|row| row.specimen != *out).collect::<Vec<_>>());
    let strata: Vec<Vec<[f64; 3]>> =
        strata(rows).iter().map(|specimens| specimens.iter().map(without).collect()).collect();
    let whole = gains(&all);
    // Without one of n specimens the mean of all moves by 1 / (n - 1) of what this one is off, with it by 1 / n.
    let n = strata.iter().map(Vec::len).sum::<usize>() as f64;
    let share = (n - 1.0) / n;
    [0, 1, 2].map(|k| {
        let variance = strata.iter().fold(0.0, |sum, without| {
            let values: Vec<f64> = without.iter().map(|gains| gains[k]).collect();
            let spread = stats::sigma(&values).unwrap_or(f64::INFINITY) * share;
            sum + values.len() as f64 * spread * spread
        });
        [whole[k], variance.sqrt()]
    })
}

/// The specimens by family. Those that are alone in theirs are taken together, and one that is left alone joins the smallest of
/// the others (collapsed strata, Wolter 2007, section 2.5): what families differ by counts as chance there.
fn strata(rows: &[Row]) -> Vec<BTreeSet<usize>> {
    let mut families: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for row in rows {
        families.entry(row.family).or_default().insert(row.specimen);
    }
    let (alone, mut strata): (Vec<_>, Vec<_>) =
        families.into_values().partition(|specimens| specimens.len() == 1);
    let alone: BTreeSet<usize> = alone.into_iter().flatten().collect();
    match strata.iter_mut().min_by_key(|specimens| specimens.len()) {
        Some(smallest) if alone.len() == 1 => smallest.extend(alone),
        _ if alone.is_empty() => (),
        _ => strata.push(alone),
    }
    strata
}

/// Sums up rows; `nulls` are the estimates of campaigns without any effect. `None` without rows of two specimens.
pub fn gained(rows: &[Row], nulls: &[[[f64; 2]; 3]]) -> Option<Gained> {
    let specimens = rows.iter().map(|row| row.specimen).collect::<BTreeSet<_>>().len();
    if specimens < 2 {
        return None;
    }
    let all: Vec<&Row> = rows.iter().collect();
    let estimates = estimates(rows);
    let gain = [0, 1, 2].map(|k| {
        let [value, error] = estimates[k];
        let reach = reach(nulls.iter().map(|null| null[k])) * error;
        Interval { value, ends: [value - reach, value + reach] }
    });
    Some(Gained {
        readings: rows.len(),
        specimens,
        base: scores(&all, |row| row.base),
        extended: scores(&all, |row| row.extended),
        ceiling: scores(&all, |row| row.ceiling.unwrap_or(row.base)),
        gain,
    })
}

/// How many standard errors an interval reaches, so that no more than [`CLAIMED`] of the campaigns without effect claim a gain.
fn reach(nulls: impl Iterator<Item = [f64; 2]>) -> f64 {
    let ratio = |[value, error]: [f64; 2]| if value > 0.0 && error > 0.0 { value / error } else { 0.0 };
    let mut ratios: Vec<f64> = nulls.map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let above = (CLAIMED * ratios.len() as f64).floor() as usize;
    ratios.len().checked_sub(above + 1).map_or(PLAIN, |at| ratios[at].max(PLAIN))
}
