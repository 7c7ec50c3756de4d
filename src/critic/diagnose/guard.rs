//! Does a cause explain all that was seen, or only what it was chosen by? Single readings are set against those of the cause's own
//! campaigns that look most alike; a cause outside the catalogue fits the few numbers that the network sees better than it fits
//! these.

use rayon::prelude::*;

use crate::critic::diagnose::causes::Causes;
use crate::critic::diagnose::design::Campaign;
use crate::critic::diagnose::judge::Judge;
use crate::critic::diagnose::ranking::inputs;
use crate::random::Streams;
use crate::stats;

/// Campaigns of the cause.
const POOL: u64 = 1500;
/// Of these so many look most alike.
const ALIKE: usize = 60;
/// So many of them are judged as if they had been measured.
const JUDGED: usize = 300;
/// A reading is set against the others where so many of these show it.
const SHOWN: usize = 15;

/// What a campaign looks like.
struct Looks {
    inputs: Vec<f64>,
    readings: Vec<(usize, Option<f64>)>,
}

/// Share of the causes' own campaigns that fit them no better than this one does; a pure function of its arguments.
pub fn guarded(judge: &Judge<'_>, causes: impl Into<Causes>, campaign: &Campaign, seed: u64) -> f64 {
    let causes = causes.into();
    let Judge { world, design, reference, .. } = judge;
    let looks = |campaign: &Campaign| Looks {
        inputs: inputs(&reference.judge(design, campaign)),
        readings: reference.scale.readings(design, campaign),
    };
    let pool: Vec<Looks> = (0..POOL)
        .into_par_iter()
        .map(|k| {
            let streams = Streams::new(seed, k);
            looks(&world.campaign(design, &world.drawn(causes, &streams), &streams))
        })
        .collect();
    let own = misfit(&looks(campaign), &pool, None);
    let worse = (0..JUDGED).into_par_iter().filter(|&k| misfit(&pool[k], &pool, Some(k)) >= own).count();
    (worse + 1) as f64 / (JUDGED + 1) as f64
}

/// The largest of the families' mean squares of the readings less those of the campaigns most alike, in standard deviations of
/// these. `but` is not among them.
fn misfit(one: &Looks, pool: &[Looks], but: Option<usize>) -> f64 {
    let distance =
        |other: &Looks| one.inputs.iter().zip(&other.inputs).fold(0.0, |sum, (a, b)| sum + (a - b) * (a - b));
    let others = pool.iter().enumerate().filter(|(k, _)| Some(*k) != but);
    let near = stats::smallest(others.map(|(k, other)| (distance(other), k)), ALIKE);
    let families = one.readings.iter().map(|(family, _)| family + 1).max().unwrap_or(0);
    let mut squares: Vec<Vec<f64>> = vec![Vec::new(); families];
    for (place, (family, shown)) in one.readings.iter().enumerate() {
        let Some(z) = shown else { continue };
        let theirs: Vec<f64> = near.iter().filter_map(|&k| pool[k].readings[place].1).collect();
        let (Some(mean), Some(sigma)) = (stats::mean(&theirs), stats::sigma(&theirs)) else { continue };
        if theirs.len() >= SHOWN {
            // A reading at its bound in all of them does not vary: half a standard deviation of the base model then.
            let off = (z - mean) / sigma.max(0.5);
            squares[*family].push(off * off);
        }
    }
    squares.iter().filter_map(|squares| stats::mean(squares)).fold(0.0, f64::max)
}
