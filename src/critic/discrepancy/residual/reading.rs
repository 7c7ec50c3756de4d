//! A single reading beside the base model.

use crate::critic::compare::error_of_mean;
use crate::critic::discrepancy::residual::band::Band;
use crate::critic::discrepancy::residual::nested::Nested;
use crate::critic::discrepancy::residual::parts::Expected;
use crate::critic::simulate::{Seen, World};
use crate::study::Measurement;

/// A reading and what the base model shows of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// Index of the family's arm.
    pub family: usize,
    /// Whether the ends of its walls are held.
    pub held: bool,
    /// Weight of one of their stones as it is stated, in the mean over a wall (N).
    pub stone_weight: f64,
    /// The reading.
    pub reading: Measurement,
    /// What was seen.
    pub seen: Seen,
    /// Share of the simulated walls that had fallen.
    pub fallen: f64,
    /// What the others show, the band without the readings' errors; `None` where they are too few.
    pub expected: Option<Expected>,
    /// Measured less simulated, in standard deviations; `None` for a bound, and where nothing was seen or simulated.
    pub in_sd: Option<f64>,
    /// For a bound, share of the simulated readings that lie on its side.
    pub agreeing: Option<f64>,
}

impl Residual {
    /// The reading at this place of the design, before anything is measured.
    pub(super) fn new(
        (family, reading): (usize, &Measurement),
        place: usize,
        nested: &Nested,
        world: &World<'_>,
    ) -> Residual {
        let by_truth = nested.each(|shown| shown.values[place]);
        let standing = by_truth.concat();
        let expected =
            Band::of(&standing).and_then(|band| Expected::of(&by_truth, error_of_mean(&[reading]), band));
        Residual {
            family,
            held: world.is_held(family),
            stone_weight: world.stone_weight(family),
            reading: reading.clone(),
            seen: Seen::Nothing,
            fallen: 1.0 - standing.len() as f64 / nested.count() as f64,
            expected,
            in_sd: None,
            agreeing: reading.kind.is_censored().then(|| agreeing(&[(place, reading)], nested)).flatten(),
        }
    }

    /// Error of the reading, its rounding and the common one included: one standard deviation.
    pub fn error(&self) -> f64 {
        error_of_mean(&[&self.reading])
    }

    /// With what was seen.
    pub(super) fn with(&self, seen: Seen) -> Residual {
        let in_sd = match seen {
            Seen::Value(value) => self.expected.and_then(|expected| expected.in_sd(value)),
            Seen::Beyond | Seen::Fell | Seen::Stood | Seen::Nothing => None,
        };
        let agreeing = self.agreeing.filter(|_| seen.side(&self.reading).is_some());
        Residual { seen, in_sd, agreeing, ..self.clone() }
    }
}

/// Share of the simulated readings at these places that lie on the sides of their bounds; `None` where there are none.
pub(super) fn agreeing(places: &[(usize, &Measurement)], nested: &Nested) -> Option<f64> {
    let side = |(place, m): &(usize, &Measurement)| {
        nested.all(|shown| Some(f64::from(u8::from(Seen::of(shown.read[*place]?, m).is_as_said(m)))))
    };
    crate::stats::mean(&places.iter().flat_map(side).collect::<Vec<_>>())
}
