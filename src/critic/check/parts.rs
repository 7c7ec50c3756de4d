//! Is any part of a campaign further off than a cause predicts, from the coarse to the fine? One of the two statistics of the
//! [check](super::posterior).

use std::collections::BTreeMap;

use crate::critic::discrepancy::{Feature, Scale, features};
use crate::critic::simulate::{Campaign, Design};
use crate::stats;
use crate::study::MeasuredQuantity;

/// A part is judged that so large a share of the campaigns have.
const COMMON: f64 = 0.5;
/// No part is predicted better than this, in standard deviations of independent readings: where hardly anything varies, walls that
/// differ by a step of a protractor would be off beyond all measure.
const LEAST: f64 = 0.1;

/// What is predicted of the parts of campaigns: mean and standard deviation of each.
#[derive(Debug)]
pub(super) struct PredictedParts(BTreeMap<Part, (f64, f64)>);

/// The parts of a campaign, each in standard deviations of independent readings.
pub(super) type Parts = BTreeMap<Part, f64>;

impl PredictedParts {
    /// From campaigns that are predicted.
    pub(super) fn of(predicted: &[Parts]) -> PredictedParts {
        let mut by_part: BTreeMap<Part, Vec<f64>> = BTreeMap::new();
        for (part, value) in predicted.iter().flatten() {
            by_part.entry(*part).or_default().push(*value);
        }
        by_part.retain(|_, values| values.len() as f64 >= COMMON * predicted.len() as f64);
        let normal = |(part, values): (Part, Vec<f64>)| {
            Some((part, (stats::mean(&values)?, stats::sigma(&values)?.max(LEAST))))
        };
        PredictedParts(by_part.into_iter().filter_map(normal).collect())
    }

    /// How far off the part is that is furthest off, in standard deviations of what is predicted of it.
    pub(super) fn furthest(&self, parts: &Parts) -> f64 {
        let off = parts
            .iter()
            .filter_map(|(part, value)| self.0.get(part).map(|(mean, sigma)| ((value - mean) / sigma).abs()));
        off.fold(0.0, f64::max)
    }
}

/// A part of a campaign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// What the ranking sees as well.
    Feature(Feature),
    /// Readings of a quantity on a family in a third of its tilts, or of its way over the drift (0 to 2).
    Third(usize, MeasuredQuantity, usize),
    /// Those on one specimen.
    Own(usize, MeasuredQuantity, usize),
}

/// The parts of a campaign, each in standard deviations of independent readings.
pub(super) fn parts(design: &Design, scale: &Scale, campaign: &Campaign) -> Parts {
    let mut shown: BTreeMap<Part, Vec<f64>> = BTreeMap::new();
    let mut readings = scale.readings(design, campaign).into_iter();
    for (index, specimen) in design.specimens.iter().enumerate() {
        let place = specimen.places();
        let last = specimen.readings.iter().filter_map(|m| m.tilt).fold(f64::MIN_POSITIVE, f64::max);
        for (m, (family, z)) in specimen.readings.iter().zip(&mut readings) {
            let (Some(place), Some(z)) = (place(m), z) else { continue };
            // As tilts stand to the largest one, to the last bit.
            let thirds = m.tilt.map_or(3.0 * place, |tilt| 3.0 * tilt / last);
            let third = (thirds.ceil() as usize).clamp(1, 3) - 1;
            shown.entry(Part::Third(family, m.quantity, third)).or_default().push(z);
            shown.entry(Part::Own(index, m.quantity, third)).or_default().push(z);
        }
    }
    let mean = |(part, values): (Part, Vec<f64>)| {
        let root = (values.len() as f64).sqrt();
        Some((part, stats::mean(&values)? * root))
    };
    let coarse = features(design, scale, campaign).into_iter().map(|(f, value)| (Part::Feature(f), value));
    shown.into_iter().filter_map(mean).chain(coarse).collect()
}
