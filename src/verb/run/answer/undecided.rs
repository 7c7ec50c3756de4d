//! Walls whose value rigid blocks leave open, among the walls of an arm.

use serde::Serialize;

use crate::ensemble::{Observed, Quantity, Row};
use crate::render::number::significant;
use crate::verb::question::Answer;

/// How many there are, and what is known if each bears what stiff joints bear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeftOpen {
    /// Walls that need thrust which their weight does not bring about.
    pub walls: u64,
    /// The least of what stiff joints bear in these walls (in the unit of the quantity).
    pub lowest: f64,
    /// The mean of all walls with these numbers in the place of the values; null where some wall has no value.
    pub mean: Option<f64>,
}

/// The same while rows are taken one by one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct OpenSoFar {
    walls: u64,
    lowest: f64,
    /// By how much the values are above, in all.
    above: f64,
}

impl OpenSoFar {
    /// Takes a row.
    pub fn take(&mut self, quantity: Quantity, row: &Row) {
        if row.undecided.is_none() {
            return;
        }
        let Observed::Value(stiff) = quantity.observed(&row.with_stiff_joints()) else { return };
        self.lowest = if self.walls == 0 { stiff } else { self.lowest.min(stiff) };
        self.walls += 1;
        if let Observed::Value(value) = quantity.observed(row) {
            self.above += value - stiff;
        }
    }

    /// All of them, among walls whose values are these; `None` where there are none.
    pub fn among(&self, values: &[f64]) -> Option<LeftOpen> {
        let sum = values.iter().fold(0.0, |sum, x| sum + x);
        let mean = (!values.is_empty()).then(|| (sum - self.above) / values.len() as f64);
        (self.walls > 0).then_some(LeftOpen { walls: self.walls, lowest: self.lowest, mean })
    }
}

/// The answer to a question of the capacity with what stiff joints bear in the place of the values that are open.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeftOpenAnswer {
    /// Walls whose value is open.
    pub walls: u64,
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
    /// Its 95 % interval.
    pub interval: Option<[f64; 2]>,
}

impl LeftOpen {
    /// In words, of so many walls.
    pub fn said(&self, quantity: Quantity, of: u64) -> String {
        let shown = |x: f64| significant(quantity.shown(x), 3);
        let mean =
            self.mean.map_or_else(String::new, |mean| format!("; with theirs the mean is {}", shown(mean)));
        format!(
            "rigid blocks leave {} of {of} walls open, which need thrust that their weight does not bring about: stiff joints bear {} {} and more{mean}",
            self.walls,
            shown(self.lowest),
            quantity.shown_unit()
        )
    }
}
