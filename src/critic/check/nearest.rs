//! Does a campaign differ from the nearest of those that a cause predicts by more than these differ among themselves? One of the two
//! statistics of the [check](super::posterior).

use crate::critic::causes::inputs;
use crate::critic::discrepancy::Reference;
use crate::critic::simulate::{Campaign, Design};
use crate::stats;

/// Of the campaigns so many are nearest.
const NEAREST: usize = 60;
/// A reading is set against the others where so many of these show it.
const SHOWN: usize = 15;

/// A campaign in numbers that distances are taken of, and its readings.
#[derive(Debug)]
pub(super) struct Summary {
    inputs: Vec<f64>,
    readings: Vec<(usize, Option<f64>)>,
}

impl Summary {
    pub(super) fn of(design: &Design, reference: &Reference, campaign: &Campaign) -> Summary {
        Summary {
            inputs: inputs(&reference.discrepancy(design, campaign)),
            readings: reference.scale.readings(design, campaign),
        }
    }
}

/// The largest of the families' mean squares of the readings less those of the nearest campaigns, in standard deviations of
/// these. `but` is not among them.
pub(super) fn misfit(one: &Summary, pool: &[Summary], but: Option<usize>) -> f64 {
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
