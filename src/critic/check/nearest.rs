//! Does a campaign differ from the cause's own that look most alike by more than these differ among themselves? One of the
//! [check](super::posterior)'s two looks.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use rayon::prelude::*;

use crate::critic::causes::inputs;
use crate::critic::discrepancy::Reference;
use crate::critic::simulate::{Campaign, Causes, Design, World};
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

/// Who judges whether campaigns of a design are like a cause's own.
///
/// The own campaigns of a single cause are kept, by cause and seed: where many campaigns are judged, most questions are about the
/// same few causes. Pairs are many, and seldom asked about twice.
#[derive(Debug, Default)]
pub struct Alike(Mutex<BTreeMap<(usize, u64), Arc<Own>>>);

/// Causes' own campaigns.
#[derive(Debug)]
struct Own {
    pool: Vec<Looks>,
    /// How far each of the first is from those most alike.
    misfits: Vec<f64>,
}

/// What a campaign looks like.
#[derive(Debug)]
struct Looks {
    inputs: Vec<f64>,
    readings: Vec<(usize, Option<f64>)>,
}

impl Alike {
    /// Share of the own campaigns of causes, drawn with a seed, whose readings differ as much from those that look most alike as a
    /// campaign's do. A pure function of its arguments; all but the causes and the campaign are the same in every call.
    pub(in crate::critic) fn share(
        &self,
        world: &World<'_>,
        design: &Design,
        reference: &Reference,
        (causes, seed): (Causes, u64),
        campaign: &Campaign,
    ) -> f64 {
        let simulated = || Arc::new(Own::of(world, design, reference, causes, seed));
        let own = match causes.single() {
            Some(cause) => self.kept((cause, seed), simulated),
            None => simulated(),
        };
        let misfit = misfit(&Looks::of(design, reference, campaign), &own.pool, None);
        let worse = own.misfits.iter().filter(|own| **own >= misfit).count();
        (worse + 1) as f64 / (JUDGED + 1) as f64
    }

    fn kept(&self, of: (usize, u64), simulated: impl FnOnce() -> Arc<Own>) -> Arc<Own> {
        let all = || self.0.lock().expect("nothing panics that holds it");
        let before = all().get(&of).cloned();
        // All threads simulate: none may wait here meanwhile. Two that ask at once simulate the same.
        before.unwrap_or_else(|| {
            let own = simulated();
            all().entry(of).or_insert(own).clone()
        })
    }
}

impl Own {
    fn of(world: &World<'_>, design: &Design, reference: &Reference, causes: Causes, seed: u64) -> Own {
        let one = |k: u64| {
            let streams = Streams::new(seed, k);
            let campaign = world.campaign(design, &world.drawn(causes, &streams), &streams);
            Looks::of(design, reference, &campaign)
        };
        let pool: Vec<Looks> = (0..POOL).into_par_iter().map(one).collect();
        let misfits = (0..JUDGED).into_par_iter().map(|k| misfit(&pool[k], &pool, Some(k))).collect();
        Own { pool, misfits }
    }
}

impl Looks {
    fn of(design: &Design, reference: &Reference, campaign: &Campaign) -> Looks {
        Looks {
            inputs: inputs(&reference.discrepancy(design, campaign)),
            readings: reference.scale.readings(design, campaign),
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::judged;

    #[test]
    fn a_cause_that_was_asked_about_before_is_answered_for_as_if_it_had_not_been() {
        let (made, judge) = judged();
        let (world, design) = (judge.world, &judge.design);
        let [creep, lean] = ["creep", "lean"].map(|cause| made.cause(cause));
        let shown = |k: u64| {
            world.campaign(design, &world.drawn(Some(creep), &Streams::new(24, k)), &Streams::new(24, k))
        };
        let share = |alike: &Alike, (causes, seed): (Causes, u64), k: u64| {
            alike.share(world, design, &judge.reference, (causes, seed), &shown(k))
        };
        let (all, [one, other]) = (Alike::default(), [creep, lean].map(|cause| Causes::from(Some(cause))));
        let asked = [(one, 3), (other, 3), (one, 4), (one, 3), (Causes::pair(creep, lean), 3), (one, 3)];
        for (k, of) in asked.into_iter().enumerate() {
            let k = k as u64;
            assert_eq!(share(&all, of, k), share(&Alike::default(), of, k), "{of:?}");
        }
        assert_eq!(all.0.lock().expect("nobody holds it").len(), 3);
    }
}
