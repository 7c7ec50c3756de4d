//! The mean of a quantity over the specimens of a family, at one tilt, beside the base model.

use crate::critic::compare::error_of_mean;
use crate::critic::discrepancy::residual::band::Band;
use crate::critic::discrepancy::residual::nested::Nested;
use crate::critic::discrepancy::residual::parts::Expected;
use crate::critic::discrepancy::residual::reading::agreeing;
use crate::critic::simulate::{Seen, Side as Lies};
use crate::stats;
use crate::study::{MeasuredQuantity, Measurement};

/// A mean agrees at this p-value or above: it lies where nine in ten simulated means do.
const AGREES: f64 = 0.1;
/// Means that differ by less than this share are the same: sums in another order, degrees and radians.
const SAME: f64 = 1e-9;

/// The readings of one quantity on a family at one tilt, and what the base model shows of their mean. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Index of the family's arm.
    pub family: usize,
    /// What was measured.
    pub quantity: MeasuredQuantity,
    /// At which tilt (rad); `None` where the quantity has none of its own.
    pub tilt: Option<f64>,
    /// At which drift; `None` where the quantity has none of its own.
    pub drift: Option<f64>,
    /// Readings that show something.
    pub seen: usize,
    /// Of these, so many only that they are below a bound.
    pub below: usize,
    /// And so many only that they are above one.
    pub above: usize,
    /// Mean of what was seen, a bound as if it were the value; `None` where nothing was.
    pub measured: Option<f64>,
    /// Share of the simulated walls that had fallen.
    pub fallen: f64,
    /// What the others show, the band with the readings' errors and beyond bounds; `None` where they are too few. In its
    /// standard deviation errors and scatter are averaged over the specimens, the common error and the parameters are whole.
    pub expected: Option<Expected>,
    /// Measured less simulated, in standard deviations; `None` where a bound is among the readings.
    pub in_sd: Option<f64>,
    /// Share of the simulated readings that lie on the sides of the bounds; `None` without bounds.
    pub agreeing: Option<f64>,
    /// Share of simulated campaigns in which the mean, read with its errors, rounding and bounds, is as far off, whichever
    /// way; of this group alone, not corrected for the number of groups.
    pub p_value: Option<f64>,
    /// On which side of the simulated means the measured one lies.
    pub side: Side,
}

/// Where a measured mean lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Among the simulated ones, or nothing can be said.
    Within,
    /// Above nearly all of them.
    Above,
    /// Below nearly all of them.
    Below,
}

/// A group before anything is measured.
pub(super) struct GroupBase {
    /// What is known of it, with nothing seen.
    group: Group,
    /// Its readings with their places in the design.
    members: Vec<(usize, Measurement)>,
    /// The means that simulated campaigns read.
    read: Vec<f64>,
}

impl GroupBase {
    /// Of readings of one family, quantity and tilt at these places of the design; `None` without any.
    pub fn new(family: usize, members: &[(usize, &Measurement)], nested: &Nested) -> Option<GroupBase> {
        let (_, first) = members.first()?;
        let over = |shown: &[Option<f64>]| -> Option<f64> {
            // Of outcomes the share that stood.
            let own = |(place, m): &(usize, &Measurement)| match m.quantity {
                MeasuredQuantity::Outcome => Seen::of(shown[*place]?, m).number(m),
                _ => shown[*place],
            };
            stats::mean(&members.iter().filter_map(own).collect::<Vec<_>>())
        };
        let by_truth = nested.each(|shown| over(&shown.values));
        let readings: Vec<&Measurement> = members.iter().map(|(_, m)| *m).collect();
        let expected = Band::of(&nested.all(|shown| over(&shown.read)))
            .and_then(|band| Expected::of(&by_truth, error_of_mean(&readings), band));
        let read = nested.all(|shown| {
            let number = |(place, m): &(usize, &Measurement)| Seen::of(shown.read[*place]?, m).number(m);
            stats::mean(&members.iter().filter_map(number).collect::<Vec<_>>())
        });
        let standing = members.iter().map(|(place, _)| nested.all(|shown| shown.values[*place]).len());
        let bounds: Vec<_> = members.iter().copied().filter(|(_, m)| m.kind.is_censored()).collect();
        let group = Group {
            family,
            quantity: first.quantity,
            tilt: first.tilt,
            drift: first.drift,
            seen: 0,
            below: 0,
            above: 0,
            measured: None,
            fallen: 1.0 - standing.sum::<usize>() as f64 / (nested.count() * members.len()) as f64,
            expected,
            in_sd: None,
            agreeing: agreeing(&bounds, nested),
            p_value: None,
            side: Side::Within,
        };
        Some(GroupBase {
            group,
            members: members.iter().map(|(place, m)| (*place, (*m).clone())).collect(),
            read,
        })
    }

    /// With what was seen, in the order of the design's readings.
    pub fn with(&self, seen: &[Seen]) -> Group {
        let own = || self.members.iter().map(|(place, m)| (seen[*place], m));
        let numbers: Vec<f64> = own().filter_map(|(seen, m)| seen.number(m)).collect();
        let on = |side| own().filter(|(seen, m)| seen.side(m) == Some(side)).count();
        let (below, above) = (on(Lies::Below), on(Lies::Above));
        let measured = stats::mean(&numbers);
        let judged = measured.filter(|_| self.group.expected.is_some()).map(|mean| self.judged(mean));
        let in_sd = measured.filter(|_| below + above == 0).and_then(|mean| self.group.expected?.in_sd(mean));
        Group {
            seen: numbers.len(),
            below,
            above,
            measured,
            in_sd,
            agreeing: self.group.agreeing.filter(|_| below + above > 0),
            p_value: judged.map(|(p, _)| p),
            side: judged.map_or(Side::Within, |(_, side)| side),
            ..self.group.clone()
        }
    }

    /// The p-value of a mean, and on which side of the others it lies.
    fn judged(&self, mean: f64) -> (f64, Side) {
        let same = SAME * mean.abs();
        let share = |beyond: &dyn Fn(f64) -> bool| {
            let count = self.read.iter().filter(|x| beyond(**x)).count();
            (count + 1) as f64 / (self.read.len() + 1) as f64
        };
        let (at_most, at_least) = (share(&|x| x <= mean + same), share(&|x| x >= mean - same));
        let p = (2.0 * at_most.min(at_least)).min(1.0);
        match (p >= AGREES, at_least < at_most) {
            (true, _) => (p, Side::Within),
            (false, true) => (p, Side::Above),
            (false, false) => (p, Side::Below),
        }
    }
}
