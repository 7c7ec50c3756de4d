//! Does a cause explain all that was seen, or only what it was chosen by? A cause outside the catalogue fits the few numbers that
//! the network sees better than it fits all others.
//!
//! There are two statistics. One sets single readings against those of the [nearest](super::nearest) of the cause's own campaigns.
//! The other sets parts of the campaign, from the coarse to the fine, against what the cause predicts with the parameters and the
//! joints that the campaign itself speaks for (a posterior predictive check, Gelman, Meng and Stern 1996).

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::critic::check::nearest::Nearest;
use crate::critic::discrepancy::{Feature, Reference, Scale, features};
use crate::critic::simulate::{Campaign, Causes, Design, Truth, World};
use crate::random::Streams;
use crate::stats;
use crate::study::MeasuredQuantity;

/// Campaigns that are predicted.
const PREDICTED: u64 = 400;
/// A part is judged that so large a share of them have.
const COMMON: f64 = 0.5;
/// No part is predicted better than this, in standard deviations of independent readings: where hardly anything varies, walls that
/// differ by a step of a protractor would be off beyond all measure.
const LEAST: f64 = 0.1;
/// Number of statistics.
const STATISTICS: f64 = 2.0;

/// The check of causes on campaigns of a design.
#[derive(Clone, Copy, Debug)]
pub struct Check<'d> {
    /// What campaigns are simulated from.
    pub world: &'d World<'d>,
    /// What is read.
    pub design: &'d Design,
    /// The base model as the design sees it.
    pub reference: &'d Reference,
    /// Campaigns of the causes, as far as they have been simulated.
    pub nearest: &'d Nearest,
}

impl Check<'_> {
    /// Share of the causes' own campaigns that fit them no better than this one does, by the worse of the two statistics, their number
    /// accounted for; `draws` are what the campaign speaks for under the causes. A pure function of its arguments.
    pub fn p_value(&self, causes: impl Into<Causes>, draws: &[Truth], campaign: &Campaign, seed: u64) -> f64 {
        let Check { world, design, reference, nearest } = self;
        let of_nearest = nearest.share(world, design, reference, (causes.into(), seed), campaign);
        let shares = [of_nearest, self.predicted(draws, campaign, seed)];
        (STATISTICS * shares[0].min(shares[1])).min(1.0)
    }

    /// Share of the campaigns that draws predict which are as far off in any part.
    fn predicted(&self, draws: &[Truth], campaign: &Campaign, seed: u64) -> f64 {
        let Check { world, design, reference, .. } = self;
        let shown: Vec<BTreeMap<Part, f64>> = (0..PREDICTED)
            .into_par_iter()
            .map(|k| {
                let streams = Streams::new(seed.wrapping_add(1), k);
                let truth = &draws[streams.of("predicted").below(draws.len())];
                parts(design, &reference.scale, &world.campaign(design, truth, &streams))
            })
            .collect();
        let mut by_part: BTreeMap<Part, Vec<f64>> = BTreeMap::new();
        for (part, value) in shown.iter().flatten() {
            by_part.entry(*part).or_default().push(*value);
        }
        by_part.retain(|_, values| values.len() as f64 >= COMMON * PREDICTED as f64);
        let normal = |(part, values): (Part, Vec<f64>)| {
            Some((part, (stats::mean(&values)?, stats::sigma(&values)?.max(LEAST))))
        };
        let normals: BTreeMap<Part, (f64, f64)> = by_part.into_iter().filter_map(normal).collect();
        let furthest = |parts: &BTreeMap<Part, f64>| {
            let off = parts.iter().filter_map(|(part, value)| {
                normals.get(part).map(|(mean, sigma)| ((value - mean) / sigma).abs())
            });
            off.fold(0.0, f64::max)
        };
        let own = furthest(&parts(design, &reference.scale, campaign));
        let further = shown.iter().filter(|parts| furthest(parts) >= own).count();
        (further + 1) as f64 / (PREDICTED + 1) as f64
    }
}

/// A part of a campaign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    /// What the ranking sees as well.
    Feature(Feature),
    /// Readings of a quantity on a family in a third of its tilts, or of its way over the drift (0 to 2).
    Third(usize, MeasuredQuantity, usize),
    /// Those on one specimen.
    Own(usize, MeasuredQuantity, usize),
}

/// The parts of a campaign, each in standard deviations of independent readings.
fn parts(design: &Design, scale: &Scale, campaign: &Campaign) -> BTreeMap<Part, f64> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::judged;
    use crate::critic::simulate::Seen;

    #[test]
    fn what_a_cause_does_not_predict_is_seen_and_its_own_campaigns_are_not() {
        let (made, judge) = judged();
        let (world, design) = (judge.world, &judge.design);
        let truth = world.drawn(Some(made.cause("creep")), &Streams::new(23, 1));
        let draws = vec![truth.clone(); 20];
        let shown = |k: u64| world.campaign(design, &truth, &Streams::new(24, k));
        let few = (0..40).filter(|&k| judge.posterior_check().predicted(&draws, &shown(k), 3) < 0.1).count();
        // One in ten, of forty: 4 +- 1.9.
        assert!(few <= 9, "{few}");
        // The second specimen of the stones moves 2 cm further from one tilt on.
        let further = (0..10).filter(|&k| {
            let mut campaign = shown(k);
            let own = design.specimens.iter().position(|s| s.name == "SBL2").expect("it was tested");
            for (m, seen) in design.specimens[own].readings.iter().zip(&mut campaign.specimens[own]) {
                if let (Some(tilt), Seen::Value(value)) = (m.tilt, &mut *seen) {
                    *value += if tilt > 0.1 { 20e-3 } else { 0.0 };
                }
            }
            judge.posterior_check().predicted(&draws, &campaign, 3) < 0.02
        });
        let further = further.count();
        assert!(further >= 8, "{further} of 10");
    }
}
