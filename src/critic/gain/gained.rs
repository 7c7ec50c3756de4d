//! Scores of readings, summed up over specimens, and the interval of what one model gains over the other.

use std::collections::{BTreeMap, BTreeSet};

use crate::critic::discrepancy::Score;
use crate::stats;

/// Probability up to the upper end of a plain 95 % interval.
const PLAIN: f64 = 0.975;
/// Gains that differ by no more than this share of them are the same, but for rounding.
const SAME: f64 = 1e-9;
/// Share of the campaigns without any effect that may claim a gain.
const CLAIMED: f64 = 0.05;

/// How a held-out reading was predicted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its specimen.
    pub specimen: usize,
    /// The family of the specimen (its arm).
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
    /// Lower and upper end; infinite where specimens that all gain the same do not tell.
    pub ends: [f64; 2],
}

/// What was gained on readings that were held out.
#[derive(Clone, Debug, PartialEq)]
pub struct Gained {
    /// Readings scored.
    pub readings: usize,
    /// Of these so many with a value; all but the logarithm is of these.
    pub valued: usize,
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
    /// The same of the free discrepancy: no cause is chosen for it, and its intervals are plain ones.
    pub ceiling_gain: [Interval; 3],
}

/// Rows by the specimens whose differences are chance.
struct Sampled<'r> {
    rows: &'r [Row],
    strata: Vec<BTreeSet<usize>>,
}

impl<'r> Sampled<'r> {
    /// A stratum for each family: families are not drawn, they are what was built, in these numbers, and an effect may show in one
    /// and not in another. Specimens that are alone in theirs are taken together, and one that is left alone joins the smallest of
    /// the others (collapsed strata, Wolter 2007, section 2.5): what families differ by counts as chance there.
    fn of(rows: &'r [Row]) -> Sampled<'r> {
        let mut families: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for row in rows {
            families.entry(row.family).or_default().insert(row.specimen);
        }
        let (alone, mut strata): (Vec<_>, Vec<_>) =
            families.into_values().partition(|specimens| specimens.len() == 1);
        let alone: BTreeSet<usize> = alone.into_iter().flatten().collect();
        let smallest = strata.iter_mut().min_by_key(|specimens| specimens.len());
        if let Some(smallest) = smallest.filter(|_| alone.len() == 1) {
            smallest.extend(alone);
        } else if !alone.is_empty() {
            strata.push(alone);
        }
        Sampled { rows, strata }
    }

    fn specimens(&self) -> usize {
        self.strata.iter().map(BTreeSet::len).sum()
    }

    /// Scores of a model, with a specimen or without it: its stratum then counts as much as before.
    fn scores(&self, of: fn(&Row) -> Score, without: Option<usize>) -> Scores {
        let mean = |measure: fn(&Score) -> Option<f64>| {
            let (mut sum, mut count) = (0.0, 0.0);
            for stratum in &self.strata {
                let own = self.rows.iter().filter(|row| stratum.contains(&row.specimen));
                let own = own.filter_map(|row| Some((row.specimen, measure(&of(row))?)));
                let (specimens, values): (Vec<usize>, Vec<f64>) = own.unzip();
                let kept = specimens.iter().zip(&values).filter(|(specimen, _)| Some(**specimen) != without);
                if let Some(mean) = stats::mean(&kept.map(|(_, value)| *value).collect::<Vec<_>>()) {
                    sum += values.len() as f64 * mean;
                    count += values.len() as f64;
                }
            }
            if count > 0.0 { sum / count } else { 0.0 }
        };
        Scores {
            log: mean(|score| Some(score.log)),
            crps: mean(|score| score.crps),
            rms: mean(|score| score.square).sqrt(),
        }
    }

    /// What a model gains over the base model.
    fn gains(&self, model: fn(&Row) -> Score, without: Option<usize>) -> [f64; 3] {
        let models: [fn(&Row) -> Score; 2] = [|row| row.base, model];
        let [base, own] = models.map(|of| self.scores(of, without));
        [own.log - base.log, base.crps - own.crps, base.rms - own.rms]
    }

    /// The gains of a model with their standard errors, by leaving out each specimen in turn: readings of a specimen stand together
    /// (stratified jackknife, Wolter 2007, section 4.5).
    fn estimates(&self, model: fn(&Row) -> Score) -> [[f64; 2]; 3] {
        let left_out = |stratum: &BTreeSet<usize>| -> Vec<[f64; 3]> {
            stratum.iter().map(|specimen| self.gains(model, Some(*specimen))).collect()
        };
        let left_out: Vec<Vec<[f64; 3]>> = self.strata.iter().map(left_out).collect();
        let whole = self.gains(model, None);
        [0, 1, 2].map(|k| {
            let variance = left_out.iter().fold(0.0, |sum, stratum| {
                let values: Vec<f64> = stratum.iter().map(|gains| gains[k]).collect();
                let n = values.len() as f64;
                // The jackknife's sum of squares is (n - 1) times the usual variance of the values.
                let part = stats::sigma(&values)
                    .map_or(f64::INFINITY, |sigma| sigma * sigma * (n - 1.0) * (n - 1.0) / n);
                sum + part
            });
            // Specimens that all gain the same are one path that was read several times: they do not tell how sure it is.
            let error = variance.sqrt();
            let is_told = error > SAME * whole[k].abs() || whole[k] == 0.0;
            [whole[k], if is_told { error } else { f64::INFINITY }]
        })
    }

    /// The gains of a model with intervals that reach as many standard errors as is right for each, and no fewer than a plain one.
    fn intervals(&self, model: fn(&Row) -> Score, reach: impl Fn(usize, f64) -> f64) -> [Interval; 3] {
        let (estimates, plain) = (self.estimates(model), self.plain());
        [0, 1, 2].map(|k| {
            let [value, error] = estimates[k];
            let reach = reach(k, plain) * error;
            Interval { value, ends: [value - reach, value + reach] }
        })
    }

    /// How many standard errors a plain interval reaches, the least that any does.
    fn plain(&self) -> f64 {
        stats::student_quantile(PLAIN, (self.specimens() - self.strata.len()) as f64)
    }
}

fn extended(row: &Row) -> Score {
    row.extended
}

/// Where a discrepancy has nothing to be free over, it is the base model.
fn ceiling(row: &Row) -> Score {
    row.ceiling.unwrap_or(row.base)
}

/// The gains of the extended model with their standard errors.
pub fn estimates(rows: &[Row]) -> [[f64; 2]; 3] {
    Sampled::of(rows).estimates(extended)
}

/// Sums up rows; `nulls` are the estimates of campaigns without any effect. `None` without rows of two specimens.
pub fn gained(rows: &[Row], nulls: &[[[f64; 2]; 3]]) -> Option<Gained> {
    let sampled = Sampled::of(rows);
    if sampled.specimens() < 2 {
        return None;
    }
    let calibrated = |k: usize, plain: f64| reach(nulls.iter().map(|null| null[k]), plain);
    Some(Gained {
        readings: rows.len(),
        valued: rows.iter().filter(|row| row.base.crps.is_some()).count(),
        specimens: sampled.specimens(),
        base: sampled.scores(|row| row.base, None),
        extended: sampled.scores(extended, None),
        ceiling: sampled.scores(ceiling, None),
        gain: sampled.intervals(extended, calibrated),
        ceiling_gain: sampled.intervals(ceiling, |_, plain| plain),
    })
}

/// How many standard errors an interval reaches, so that another campaign without effect claims a gain with a probability of no
/// more than [`CLAIMED`], and no fewer than a plain one. Of n campaigns and another one each is as likely to have the largest ratio,
/// so that the other has a larger one than the k-th largest with a probability of k / (n + 1); fewer than nineteen cannot tell, and
/// the largest stands for them.
fn reach(nulls: impl Iterator<Item = [f64; 2]>, plain: f64) -> f64 {
    let ratio = |[value, error]: [f64; 2]| if value > 0.0 && error > 0.0 { value / error } else { 0.0 };
    let mut ratios: Vec<f64> = nulls.map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let rank = ((CLAIMED * (ratios.len() + 1) as f64).floor() as usize).max(1);
    ratios.len().checked_sub(rank).map_or(plain, |at| ratios[at].max(plain))
}
