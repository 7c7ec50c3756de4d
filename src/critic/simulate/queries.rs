//! The queries of the bank: each quantity of a family at each tilt, or drift, once, however many readings are of it.

use crate::critic::compare::of_points;
use crate::critic::simulate::bank::{NUMBERS, Pushes};
use crate::critic::simulate::design::{motions, tilts};
use crate::math::exp;
use crate::study::{Earthquakes, MeasuredQuantity, Measurement};

/// The quantities that readings are of.
pub struct Queries {
    /// Tilts (rad) or drifts, ascending.
    pub tilts: Vec<f64>,
    /// Each query: a quantity, with the place of its tilt or drift where it has one.
    what: Vec<(MeasuredQuantity, Option<usize>)>,
    /// Of each under a motion of the base its number on the path of a wall, and whether that is shown as it is.
    shaken: Vec<(usize, bool)>,
    /// Which of these each reading is of.
    pub by_reading: Vec<usize>,
    /// Whether any is of what is left after the platform has gone back.
    pub goes_back: bool,
}

impl Queries {
    /// By readings of one family; with what is sought under the motions of a base, where it moves.
    pub fn by(readings: &[&Measurement], sought: Option<&Earthquakes>) -> Queries {
        let tilts = tilts(readings.iter().copied());
        let place = |tilt: f64| tilts.partition_point(|known| *known < tilt);
        let met = motions(readings.iter().copied());
        let motion = |m: &Measurement| met.iter().position(|own| Some(*own) == m.under.as_ref());
        let all: Vec<_> =
            readings.iter().map(|m| (m.quantity, m.at().map(place).or_else(|| motion(m)))).collect();
        let mut what = all.clone();
        what.sort_unstable();
        what.dedup();
        let by_reading = all.iter().map(|one| what.partition_point(|known| known < one)).collect();
        let goes_back = what.iter().any(|(quantity, _)| quantity.is_remainder());
        let number = |(quantity, motion): &(MeasuredQuantity, Option<usize>)| {
            let place = sought?.place_of(*quantity, met.get((*motion)?)?)?;
            Some((1 + place, *quantity == MeasuredQuantity::Outcome))
        };
        let shaken = what.iter().filter_map(number).collect();
        Queries { tilts, what, shaken, by_reading, goes_back }
    }

    /// What a wall of these numbers shows whose base moved.
    pub fn shaken(&self, numbers: &[f64; NUMBERS]) -> Vec<f64> {
        let one = |(number, as_it_is): &(usize, bool)| {
            let number = numbers[*number];
            if *as_it_is { number } else { exp(number) }
        };
        self.shaken.iter().map(one).collect()
    }

    /// What a sheared wall shows; one that has fallen its last push.
    pub fn pushes(&self, wall: &Pushes) -> Vec<f64> {
        let drift = |at: &Option<usize>| at.map_or(0.0, |at| self.tilts[at]);
        self.what.iter().map(|(_, at)| wall.last_at(drift(at))).collect()
    }

    /// What a wall shows that falls at this tilt and moves left, centre and right by so much at each of the tilts; if any
    /// [goes back](Self::goes_back), with what is left after each.
    pub fn shown(&self, collapse: f64, points: &[[f64; 3]], left: &[[f64; 3]]) -> Vec<f64> {
        let one = |(quantity, at): &(MeasuredQuantity, Option<usize>)| {
            let read = if quantity.is_remainder() { left } else { points };
            at.and_then(|at| of_points(*quantity, read[at])).unwrap_or(collapse)
        };
        self.what.iter().map(one).collect()
    }
}
