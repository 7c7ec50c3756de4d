//! Does a campaign differ from the nearest of the cause's own by more than these differ among themselves? One of the two statistics
//! of the [check](super::posterior).

use rayon::prelude::*;

use crate::critic::causes::inputs;
use crate::critic::discrepancy::Reference;
use crate::critic::simulate::{ByCause, Campaign, Causes, Design, World};
use crate::random::Streams;
use crate::stats;

/// Campaigns of the cause.
const SIMULATED: u64 = 1500;
/// Of these so many are nearest.
const NEAREST: usize = 60;
/// So many of them are judged as if they had been measured.
const JUDGED: usize = 300;
/// A reading is set against the others where so many of these show it.
const SHOWN: usize = 15;

/// The nearest of the causes' own campaigns, for campaigns of a design.
#[derive(Debug, Default)]
pub struct Nearest(ByCause<Simulated>);

/// Causes' own campaigns.
#[derive(Debug)]
struct Simulated {
    pool: Vec<Summary>,
    /// How far each of the first is from those nearest to it.
    misfits: Vec<f64>,
}

/// A campaign in numbers that distances are taken of, and its readings.
#[derive(Debug)]
struct Summary {
    inputs: Vec<f64>,
    readings: Vec<(usize, Option<f64>)>,
}

impl Nearest {
    /// Share of the own campaigns of causes, drawn with a seed, whose readings differ as much from those nearest to them as a
    /// campaign's do. A pure function of its arguments; all but the causes and the campaign are the same in every call.
    pub(in crate::critic) fn share(
        &self,
        world: &World<'_>,
        design: &Design,
        reference: &Reference,
        (causes, seed): (Causes, u64),
        campaign: &Campaign,
    ) -> f64 {
        let own = self.0.of((causes, seed), || Simulated::of(world, design, reference, causes, seed));
        let misfit = misfit(&Summary::of(design, reference, campaign), &own.pool, None);
        let worse = own.misfits.iter().filter(|own| **own >= misfit).count();
        (worse + 1) as f64 / (JUDGED + 1) as f64
    }
}

impl Simulated {
    fn of(world: &World<'_>, design: &Design, reference: &Reference, causes: Causes, seed: u64) -> Simulated {
        let one = |k: u64| {
            let streams = Streams::new(seed, k);
            let campaign = world.campaign(design, &world.drawn(causes, &streams), &streams);
            Summary::of(design, reference, &campaign)
        };
        let pool: Vec<Summary> = (0..SIMULATED).into_par_iter().map(one).collect();
        let misfits = (0..JUDGED).into_par_iter().map(|k| misfit(&pool[k], &pool, Some(k))).collect();
        Simulated { pool, misfits }
    }
}

impl Summary {
    fn of(design: &Design, reference: &Reference, campaign: &Campaign) -> Summary {
        Summary {
            inputs: inputs(&reference.discrepancy(design, campaign)),
            readings: reference.scale.readings(design, campaign),
        }
    }
}

/// The largest of the families' mean squares of the readings less those of the nearest campaigns, in standard deviations of
/// these. `but` is not among them.
fn misfit(one: &Summary, pool: &[Summary], but: Option<usize>) -> f64 {
    let distance = |other: &Summary| {
        one.inputs.iter().zip(&other.inputs).fold(0.0, |sum, (a, b)| sum + (a - b) * (a - b))
    };
    let others = pool.iter().enumerate().filter(|(k, _)| Some(*k) != but);
    let near = stats::smallest(others.map(|(k, other)| (distance(other), k)), NEAREST);
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
    fn a_cause_that_was_checked_before_is_checked_as_if_it_had_not_been() {
        let (made, judge) = judged();
        let (world, design) = (judge.world, &judge.design);
        let [creep, lean] = ["creep", "lean"].map(|cause| made.cause(cause));
        let shown = |k: u64| {
            world.campaign(design, &world.drawn(Some(creep), &Streams::new(24, k)), &Streams::new(24, k))
        };
        let share = |nearest: &Nearest, (causes, seed): (Causes, u64), k: u64| {
            nearest.share(world, design, &judge.reference, (causes, seed), &shown(k))
        };
        let (all, [one, other]) = (Nearest::default(), [creep, lean].map(|cause| Causes::from(Some(cause))));
        let checked = [(one, 3), (other, 3), (one, 4), (one, 3), (Causes::pair(creep, lean), 3), (one, 3)];
        for (k, of) in checked.into_iter().enumerate() {
            let k = k as u64;
            assert_eq!(share(&all, of, k), share(&Nearest::default(), of, k), "{of:?}");
        }
    }
}
