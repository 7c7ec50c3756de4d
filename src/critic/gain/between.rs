//! What the walls of one family say of those of another, by the chain rule: log p(B given A) = log Z(A, B) - log Z(A), where Z is the evidence
//! of what was read. No parameter is fitted, so that nothing is lost to a fit on few readings. The causes are those of the verdict.

use rayon::prelude::*;

use crate::critic::causes::{Evidence, RUNS, evidence_again};
use crate::critic::gain::fold::{campaign_of, design_of, whole};
use crate::critic::gain::gained::Interval;
use crate::critic::simulate::{Campaign, Causes};
use crate::critic::verdict::Judge;
use crate::stats;

/// The specimens that are predicted are left out in so many groups at most, one after the other.
const GROUPS: usize = 6;
/// Probability up to the upper end of a 95 % interval, and its standard errors where these are known.
const UPPER: f64 = 0.975;
const KNOWN: f64 = 1.96;

/// What a cause gains where one family is predicted from another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Between {
    /// The family that is known (its arm, with those that are alike).
    pub known: usize,
    /// The family that is predicted.
    pub predicted: usize,
    /// Specimens that are predicted.
    pub specimens: usize,
    /// Readings on them.
    pub readings: usize,
    /// Gain of the extended over the base model in the logarithm of the probability of all that was read on them (nat). Its ends come
    /// from leaving out specimens that are predicted (jackknife) and from how far the evidence scatters between runs; infinite with one
    /// specimen.
    pub gain: Interval,
}

/// The specimens of a pair of families, and the groups in which the predicted ones are left out.
struct Pair {
    known: usize,
    predicted: usize,
    groups: Vec<Vec<usize>>,
}

/// Gains between all families of a campaign, from each to each; a pure function of its arguments.
pub fn between(judge: &Judge<'_>, campaign: &Campaign, causes: Causes, seed: u64) -> Vec<Between> {
    let of = |specimen: usize| judge.world.stands_for(judge.design.specimens[specimen].family);
    let mut families: Vec<usize> = (0..judge.design.specimens.len()).map(of).collect();
    families.sort_unstable();
    families.dedup();
    let pairs = families.iter().flat_map(|known| families.iter().map(move |predicted| (*known, *predicted)));
    let pairs = pairs.filter(|(known, predicted)| known != predicted).map(|(known, predicted)| {
        let own: Vec<usize> = (0..judge.design.specimens.len()).filter(|k| of(*k) == predicted).collect();
        let count = own.len().min(GROUPS);
        let group = |group: usize| own.iter().copied().skip(group).step_by(count).collect();
        Pair { known, predicted, groups: (0..count).map(group).collect() }
    });
    let pairs: Vec<Pair> = pairs.collect();
    let part = |keeps: &dyn Fn(usize) -> bool| -> Vec<bool> {
        (0..judge.design.specimens.len()).map(keeps).collect()
    };
    let alone = |pair: &Pair| part(&|k| of(k) == pair.known);
    let both = |pair: &Pair, without: &[usize]| {
        part(&|k| [pair.known, pair.predicted].contains(&of(k)) && !without.contains(&k))
    };
    let mut parts: Vec<Vec<bool>> = Vec::new();
    for pair in &pairs {
        parts.extend([alone(pair), both(pair, &[])]);
        parts.extend(pair.groups.iter().filter(|_| pair.groups.len() > 1).map(|out| both(pair, out)));
    }
    parts.sort();
    parts.dedup();
    let evidences: Vec<[Evidence; 2]> = parts
        .par_iter()
        .map(|part| {
            let known = whole(&judge.design, |specimen| part[specimen]);
            let (design, seen) = (design_of(&judge.design, &known), campaign_of(campaign, &known));
            [Causes::default(), causes].map(|causes| {
                let run = |run: u64| evidence_again(judge.world, &design, &seen, causes, (seed, run));
                Evidence::of_runs((0..RUNS).into_par_iter().map(run).collect())
            })
        })
        .collect();
    // The logarithm of how much more likely the extended model makes a part, and the variance of that.
    let more = |part: &Vec<bool>| {
        let [base, extended] = &evidences[parts.binary_search(part).expect("it was computed")];
        (extended.log - base.log, extended.spread * extended.spread + base.spread * base.spread)
    };
    let gained = |pair: &Pair| {
        let (known, of_known) = more(&alone(pair));
        let (whole, of_whole) = more(&both(pair, &[]));
        let value = whole - known;
        let specimens = pair.groups.iter().map(Vec::len).sum::<usize>();
        let groups = pair.groups.len() as f64;
        // What a specimen gains in the mean, without a group of them.
        let without = |out: &Vec<usize>| {
            let left = (specimens - out.len()) as f64;
            (left > 0.0).then(|| (more(&both(pair, out)).0 - known) / left)
        };
        let without: Vec<f64> = pair.groups.iter().filter_map(without).collect();
        let jackknifed = stats::sigma(&without)
            .map_or(f64::INFINITY, |sigma| sigma * (groups - 1.0) / groups.sqrt() * specimens as f64);
        let by_specimens = match jackknifed.is_finite() {
            true => stats::student_quantile(UPPER, groups - 1.0) * jackknifed,
            false => f64::INFINITY,
        };
        let reach = (by_specimens * by_specimens + KNOWN * KNOWN * (of_known + of_whole)).sqrt();
        let readings = pair.groups.iter().flatten().map(|k| judge.design.specimens[*k].readings.len());
        Between {
            known: pair.known,
            predicted: pair.predicted,
            specimens,
            readings: readings.sum(),
            gain: Interval { value, ends: [value - reach, value + reach] },
        }
    };
    pairs.iter().map(gained).collect()
}
