//! How the parts of a smooth discrepancy hang together from reading to reading, before anything is measured.

use crate::critic::simulate::Design;
use crate::math::{degrees, exp, ln};
use crate::study::{MeasuredQuantity, Measurement};

/// Over so many degrees of tilt a discrepancy changes.
const LENGTH_DEG: f64 = 5.0;
/// Over so large a factor on the drift (its logarithm) one does.
const LENGTH_LN_DRIFT: f64 = 1.0;
/// Share of its variance that is common to all families.
const COMMON: f64 = 0.5;
/// Variance of the left end less that of the middle, of the centre less that of the mean, and of the last test less that of a middle
/// one, in that of a reading's level.
const TWISTING: f64 = 0.5;
const BENDING: f64 = 0.5;
const DRIFTING: f64 = 0.5;

/// The components of a discrepancy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Of readings as they are, whatever the order of the tests.
    Level,
    /// Of the left end less the right one.
    Twist,
    /// Of the centre less the mean of the ends, where these were read each.
    Bow,
    /// Of a reading from each test to the next.
    Drift,
}

/// All of them, as they are numbered.
pub(super) const PARTS: [Component; 4] =
    [Component::Level, Component::Twist, Component::Bow, Component::Drift];

/// Quantities of different kinds have nothing in common.
pub(super) fn kind(quantity: MeasuredQuantity) -> u8 {
    match quantity {
        MeasuredQuantity::CollapseAngle => 0,
        MeasuredQuantity::Outcome => 5,
        MeasuredQuantity::PeakDisplacement => 6,
        MeasuredQuantity::ResidualDisplacement => 7,
        MeasuredQuantity::DisplacementCentreMinusEnds => 1,
        MeasuredQuantity::RemainderCentreMinusEnds => 2,
        other if other.is_remainder() => 3,
        _ => 4,
    }
}

/// Where a reading lies in a discrepancy.
pub struct Lies<'d> {
    pub(super) family: usize,
    pub(super) m: &'d Measurement,
    /// 1 for the left end, -1 for the right one.
    pub(super) side: f64,
    /// What a bow moves it by: 1 at the centre, -1/2 at the ends.
    pub(super) bow: f64,
    /// Where the test lies in the order of all: -1 the first, 1 the last; 0 where that is not known.
    pub(super) order: f64,
}

impl<'d> Lies<'d> {
    /// Every reading of the specimens, by specimen and reading.
    pub fn all(design: &'d Design) -> impl Iterator<Item = ((usize, usize), Lies<'d>)> {
        let (first, half) = (orders(design).fold(f64::INFINITY, f64::min), half_of_order(design));
        design.specimens.iter().enumerate().flat_map(move |(specimen, tested)| {
            let order = tested.order.map_or(0.0, |order| (f64::from(order) - first) / half.max(0.5) - 1.0);
            tested.readings.iter().enumerate().map(move |(reading, m)| {
                let (side, bow) = match m.quantity {
                    MeasuredQuantity::DisplacementLeft | MeasuredQuantity::RemainderLeft => (1.0, -0.5),
                    MeasuredQuantity::DisplacementRight | MeasuredQuantity::RemainderRight => (-1.0, -0.5),
                    MeasuredQuantity::DisplacementCentre | MeasuredQuantity::RemainderCentre => (0.0, 1.0),
                    _ => (0.0, 0.0),
                };
                ((specimen, reading), Lies { family: tested.family, m, side, bow, order })
            })
        })
    }

    /// Covariance of the discrepancies of two readings, all parts together, in the variance of a level.
    pub fn together(&self, other: &Lies<'_>) -> f64 {
        PARTS.iter().fold(0.0, |sum, part| sum + self.covariance(*part, other))
    }

    /// Covariance of a component of the discrepancies of two readings, in the variance of a level.
    pub(super) fn covariance(&self, part: Component, other: &Lies<'_>) -> f64 {
        if kind(self.m.quantity) != kind(other.m.quantity) {
            return 0.0;
        }
        let apart = match (self.m.drift, other.m.drift) {
            (Some(one), Some(another)) => ln(one / another) / LENGTH_LN_DRIFT,
            _ => degrees(self.m.tilt.unwrap_or(0.0) - other.m.tilt.unwrap_or(0.0)) / LENGTH_DEG,
        };
        let families = if self.family == other.family { 1.0 } else { COMMON };
        let over_the_tilt = families * exp(-0.5 * apart * apart);
        match part {
            Component::Level => over_the_tilt,
            Component::Twist => TWISTING * self.side * other.side * over_the_tilt,
            Component::Bow => BENDING * self.bow * other.bow * over_the_tilt,
            Component::Drift => DRIFTING * self.order * other.order,
        }
    }
}

fn orders(design: &Design) -> impl Iterator<Item = f64> {
    design.specimens.iter().filter_map(|specimen| specimen.order).map(f64::from)
}

/// From the middle of the tests to the last (tests).
pub(super) fn half_of_order(design: &Design) -> f64 {
    let (first, last) = (orders(design).fold(f64::INFINITY, f64::min), orders(design).fold(0.0, f64::max));
    0.5 * (last - first).max(0.0)
}
